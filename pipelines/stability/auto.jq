# What mode auto keeps of its promises, case by case, from table.json: its cost over that of bsdf and
# over that of the best of all fixed methods, each with its standard error. The best of many is partly
# the luckiest, so a ratio breaks its promise where it is above it by more than three errors. Cases
# without light have no cost.
def shown: . * 100 | round / 100 | tostring;
def over($other): (.cost / $other.cost) as $ratio
  | {$ratio, error: ($ratio * (.cost_variance + $other.cost_variance | sqrt))};
def broken($most): (.ratio / $most | log) > 3 * .error / .ratio;
def cell($most): "\(.ratio | shown) ± \(.error | shown)\(if broken($most) then " *" else "" end)";

"| case | auto over bsdf | over the best | which |", "|---|---|---|---|",
(map(select((.cost // 0) > 0)) | group_by(.case)
 | map({auto: map(select(.method == "auto"))[0], plain: map(select(.method == "bsdf"))[0],
        best: map(select(.method != "auto")) | min_by(.cost)} | select(.auto and .plain)
       | {case: .auto.case, best: .best.method, plain: (.plain as $of | .auto | over($of)),
          over: (.best as $of | .auto | over($of))})
 | sort_by(-.over.ratio) | .[]
 | "| \(.case) | \(.plain | cell(1.05)) | \(.over | cell(1.1)) | \(.best) |"),
"", "* above 1.05 of bsdf, or 1.1 of the best, by more than three standard errors"
