# What mode auto keeps of its promises, case by case, from table.json: its cost over that of bsdf with
# its standard error, and over that of the best of all fixed methods. Cases without light have none.
def cost: if .method == "bsdf" then 1 else .cost_ratio end;
def shown: . * 100 | round / 100 | tostring;

"| case | auto over bsdf | over the best | which |", "|---|---|---|---|",
(map(select((.cost_ratio | type) == "number" or .method == "bsdf")) | group_by(.case)
 | map({auto: map(select(.method == "auto"))[0], best: map(select(.method != "auto")) | min_by(cost)})
 | map(select(.auto) | .over = (.auto | cost) / (.best | cost)) | sort_by(-.over)[]
 | "| \(.auto.case) | \(.auto | cost | shown) ± \(.auto.cost_error | shown) | \(.over | shown) | \(.best.method) |")
