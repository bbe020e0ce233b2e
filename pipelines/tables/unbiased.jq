# Table, Markdown: jq -n --arg scene NAME --arg base METHOD, over image-compare --z --json, each file
# named METHOD.json. A tile has three scores, one a colour.
"| scene | method against \($base) | ratio of means | scores | beyond 2σ (chance) | beyond 3σ (chance) |",
"|---|---|---|---|---|---|",
(inputs |
 "| \($scene) | \(input_filename | sub(".*/"; "") | rtrimstr(".json")) | \(.mean_ratio * 1e4 | round / 1e4) | \(.z.tiles.count) | \(.z.tiles.beyond2) (\(.z.tiles.expected2 | round)) | \(.z.tiles.beyond3) (\(.z.tiles.expected3 * 10 | round / 10)) |")
