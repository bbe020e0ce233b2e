#!/bin/sh
# Table of the preprocessing of one or more scenes, Markdown, from the statistics of the stages.
#   preprocessing.sh FOLDER...     folders of results of pipelines/rules.mk, named by their scene
set -eu
printf '| scene | BRDFs | entries | components | reduced | fit s | caches | components | reduced |'
printf ' photons | trace s | train s | reduce s | BRDF MB | cache MB | bytes per cell |\n'
printf '|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n'
for folder in "$@"; do
  jq -rn --arg scene "$(basename "$folder")" \
    --slurpfile fit "$folder/brdf-fit.json" --slurpfile trace "$folder/photon-trace.json" \
    --slurpfile train "$folder/cache-train.json" \
    --slurpfile brdf "$folder/cache-reduce-brdf.json" \
    --slurpfile cache "$folder/cache-reduce-cache.json" '
    def digits($n): . * pow(10; $n) | round / pow(10; $n);
    $fit[0] as $fit | $trace[0] as $trace | $train[0] as $train | $brdf[0] as $brdf |
    $cache[0] as $cache |
    [$scene, ($fit.materials | length), $fit.entries,
     ($brdf.components_before | digits(2)), ($brdf.components_after | digits(2)),
     ($fit.seconds | digits(1)),
     $train.cells, ($cache.components_before | digits(2)), ($cache.components_after | digits(2)),
     ($trace.stored / 1e6 | digits(1) | tostring + " M"), ($trace.seconds | digits(1)),
     ($train.seconds | digits(1)), ($cache.seconds + $brdf.seconds | digits(1)),
     ($brdf.bytes_after / 1e6 | digits(2)), ($cache.bytes_after / 1e6 | digits(2)),
     ($cache.bytes_after / ([$train.cells, 1] | max) | digits(0))]
    | "| " + (map(tostring) | join(" | ")) + " |"'
done
