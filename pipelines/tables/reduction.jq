# One row of reduction.csv: jq -s --arg threshold T, over the statistics of cache-reduce of BRDFs and
# of cells, of the render, and the figures of image-compare --json.
. as [$brdf, $cache, $render, $error] |
[$threshold, $brdf.components_after, $cache.components_after, $error.relmse, $error.relmse_trimmed,
 $render.seconds * 1e6 / ($render.width * $render.height * $render.spp * $render.mean_path_length),
 $brdf.bytes_after, $cache.bytes_after, "product"] | map(tostring) | join(",")
