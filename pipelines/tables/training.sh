#!/bin/sh
# Table of the training of one or more scenes with media, Markdown, from the statistics of the
# stages.
#   training.sh FOLDER...     folders of results of pipelines/rules.mk, named by their scene
set -eu
printf '| scene | particles | photons on surfaces | in media | trace s | photons/s | train s |'
printf ' photons/s | reduce s | cells of surfaces | of media | lobes | reduced | cache MB |\n'
printf '|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n'
for folder in "$@"; do
  jq -rn --arg scene "$(basename "$folder")" --slurpfile trace "$folder/photon-trace.json" \
    --slurpfile train "$folder/cache-train.json" \
    --slurpfile reduction "$folder/cache-reduce-cache.json" '
    def digits($n): . * pow(10; $n) | round / pow(10; $n);
    def millions: . / 1e6 | digits(2) | tostring + " M";
    $trace[0] as $trace | $train[0] as $train | $reduction[0] as $reduction |
    ($trace.stored + $trace.in_media) as $photons |
    [$scene, ($trace.emitted | millions), ($trace.stored | millions), ($trace.in_media | millions),
     ($trace.seconds | digits(1)), ($photons / $trace.seconds | millions),
     ($train.seconds | digits(1)), ($photons / $train.seconds | millions),
     ($reduction.seconds | digits(1)), $train.cells, $train.media.cells // 0,
     ($reduction.media.components_before // 0 | digits(2)),
     ($reduction.media.components_after // 0 | digits(2)), ($reduction.bytes_after / 1e6 | digits(2))]
    | "| " + (map(tostring) | join(" | ")) + " |"'
done
