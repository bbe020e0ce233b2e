#!/usr/bin/env bash
# Installs, builds, and runs the main job on the shipped interior: caches, images, figures, chart.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install.sh -DWAYLIGHT_TESTS=OFF -DWAYLIGHT_BENCH=OFF
make -f pipelines/gap-room.mk all report

out=out/gap-room
last=$(ls -t "$out"/product-*s.exr | head -n 1)
printf '\nimage     %s  %s\ncaches    %s  %s\nfigures   %s\nchart     %s\npage      %s\n' \
  "$last" "${last%.exr}.png" "$out/reduced.brdf" "$out/reduced.cache" \
  "$out/gap-room.csv" "$out/gap-room.svg" "$out/report.html"
