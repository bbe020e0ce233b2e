# One row of trade-off-fit.csv: jq -r --arg fit F --arg components K, over the statistics of brdf-fit.
# The error is the mean over entries; materials that share another's count once.
[.materials[] | select(.shares_with == "" and .entries > 0)] as $own |
[$fit, $components, .seconds,
 ($own | map(.held_out_error * .entries) | add) / ($own | map(.entries) | add)]
| map(tostring) | join(",")
