# Verdicts on a method of fitting, from the rows of `brdf-fit --report`: all figures are numbers, no
# entry takes longer than a quarter of a second, and in the mean over a material the held-out error is
# no more than 0.02 above that of EM.
def rows: split("\n") | map(select(. != "") | split(",")) | .[0] as $names | .[1:]
  | map([$names, .] | transpose | map({(.[0]): .[1]}) | add);
def number: tonumber? // nan;
def figures: ["theta", "components", "error", "em_error", "ms"];
def mean: add / length;
def loss: map((.error | number) - (.em_error | number)) | mean;

($report | rows) as $rows
| ([$rows[] | .[figures[]] | number | select(isnan or isinfinite)] | length) as $bad
| ($rows | map(.ms | number) | max) as $ms
| ($rows | group_by(.material) | max_by(loss)) as $worst
| {finite: (if $bad > 0 then "\($bad) figures not finite" else "pass" end),
   bounded: (if $timed == 1 and $ms > 250 then "\($ms | round) ms an entry" else "pass" end),
   harmless: (if ($worst | loss) > 0.02
     then "error of \($worst[0].material) \($worst | loss * 1000 | round / 1000) above that of EM" else "pass" end)}
| ([.finite, .bounded, .harmless] | map(select(. != "pass")) | join("; ")) as $wrong
| {case: $case, row: $row, set: $set, method: $method, verdict: (if $wrong == "" then "pass" else $wrong end),
   unbiased: "-"} + . + {entries: ($rows | length), worst_loss: ($worst | loss), slowest_ms: $ms}
