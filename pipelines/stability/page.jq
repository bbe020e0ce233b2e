# The table as a page that needs nothing else, from table.jq. Hovering a cell shows what was measured.
def unique_in_order: reduce .[] as $x ([]; if index([$x]) then . else . + [$x] end);
def measured: [if (.cost_ratio // "") != "" then "cost × \(.cost_ratio) ± \(.cost_error)" else empty end,
  if .tiles then "\(.beyond3) of \(.tiles) scores beyond 3σ, \(.allowed3) allowed; image \(.image_z)σ" else empty end,
  if .path_length then "\(.path_length) edges, \(.copies) copies, \(.memory_mb) MB" else empty end,
  .reason | select(. != "")] | join("\n");
def cell: "<td class=\"\(.status)\" title=\"\(measured | @html)\">\(.verdict | @html)</td>";
def table: (map(.method) | unique_in_order) as $methods
  | "<table><tr><th>case</th><th>row</th>\($methods | map("<th>\(@html)</th>") | add)</tr>",
    ((map(.case) | unique_in_order)[] as $case | map(select(.case == $case))
     | "<tr><td>\(.[0].case | @html)</td><td>\(.[0].row)</td>\(map(cell) | add)</tr>"),
    "</table>";
"<!doctype html><meta charset=\"utf-8\"><title>Stability</title>",
"<style>body{font:14px sans-serif;margin:2em}table{border-collapse:collapse;margin:1em 0}",
"td,th{border:1px solid #ccc;padding:2px 8px;text-align:left}.pass{color:#286}",
".known{background:#fea}.fail{background:#fbb}</style><h1>Stability</h1>",
"<p>Cases down, methods across: pass, or the figure that failed.</p>",
((map(.set) | unique_in_order)[] as $set | "<h2>\($set)</h2>", (map(select(.set == $set)) | table)),
(map(select(.status == "known")) | group_by(.reason)
 | if . == [] then empty else "<h2>Known failures</h2><ul>",
   (.[] | "<li>\(map("\(.case) \(.method)") | join(", ") | @html): \(.[0].reason | @html)</li>"), "</ul>" end)
