# Tables with one header as one, a column before them: awk -f labelled.awk column=pass value=1 a.csv
# value=2 b.csv ...
FNR > 1 { print value "," $0; next }
!headed++ { print column "," $0 }
