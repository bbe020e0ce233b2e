# Table, Markdown: jq -s --arg scene NAME, over the statistics of renders guided by illumination, by
# unreduced products and by reduced ones. Microseconds of one core per path edge.
def percent: . * 1000 | round / 10 | tostring + " %";
def us: . * 1000 | round / 1000 | tostring;
map(.seconds * 1e6 / (.width * .height * .spp * .mean_path_length)) as [$light, $naive, $reduced] |
"| scene | illumination, µs | product, µs | overhead, not reduced | reduced |",
"|---|---|---|---|---|",
"| \($scene) | \($light | us) | \($reduced | us) | \($naive / $light - 1 | percent) | \($reduced / $light - 1 | percent) |"
