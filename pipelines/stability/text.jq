# The table as text, from table.jq: for each set of methods one, methods across and cases down.
def pad($n): . + (" " * ($n - length) // "");
def cells: map(.verdict + if .status == "known" then " *" else "" end);
def unique_in_order: reduce .[] as $x ([]; if index([$x]) then . else . + [$x] end);
def table: (map(.method) | unique_in_order) as $methods
  | [["case", "row"] + $methods]
    + [(map(.case) | unique_in_order)[] as $case | map(select(.case == $case))
       | [.[0].case, .[0].row] + cells]
  | (transpose | map(map(length) | max)) as $widths
  | .[] | [., $widths] | transpose | map(.[1] as $n | .[0] | pad($n)) | join("  ") | sub(" +$"; "");

((map(.set) | unique_in_order)[] as $set | map(select(.set == $set)) | (table, "")),
(map(select(.status == "known")) | group_by(.reason)[]
 | "* \(map("\(.case) \(.method)") | join(", ")): \(.[0].reason)"),
(map(.status) | "\(map(select(. == "pass")) | length) pass, \(map(select(. == "known")) | length) known to fail, \(map(select(. == "fail")) | length) fail")
