#!/bin/sh
# What a pipeline modelled, what that cost in time and bytes, and what it bought.
#   summary.sh FOLDER TABLE.csv    folder of results of pipelines/rules.mk, and its figures
set -eu
folder=$1 table=$2
tables=$(dirname "$0")

# stage FILE FILTER: a line of the statistics of a stage that was run.
stage() {
  [ -e "$folder/$1" ] || return 0
  jq -r 'def digits($n): . * pow(10; $n) | round / pow(10; $n);
    def size: if . >= 1e6 then "\(. / 1e6 | digits(2)) MB" else "\(. / 1e3 | digits(1)) kB" end;
    def time: "\(. | digits(2)) s";
    '"$2" "$folder/$1"
}

stage brdf-fit.json '"fits      \(.entries) entries for \(.materials | length) materials, of " +
  "\(.full.entries) without --tolerance; \(.bytes | size), \(.seconds | time)"'
stage photon-trace.json '"photons   \(.stored) of \(.emitted) particles" +
  (if .paths > 0 then ", \(.samples) samples of \(.paths) camera paths" else "" end) +
  "; \(.seconds | time)"'
stage cache-train.json '"cells     \(.cells), of \(.mean_effective_samples | digits(0)) effective photons and " +
  "\(.mean_components | digits(2)) components on average; \(.seconds | time)"'
for kind in brdf cache; do
  stage cache-reduce-$kind.json '"reduced   '$kind': \(.components_after | digits(2)) of " +
    "\(.components_before | digits(2)) components; \(.bytes_after | size) of \(.bytes_before | size)"'
done
for stats in "$folder"/*.json; do
  stage "$(basename "$stats")" 'select(type == "object") | .auto // empty |
    "auto      \(.method); cells by bsdf \(.cells_bsdf), illumination \(.cells_illumination), " +
    "product \(.cells_product); pilot \(.pilot_seconds | time)"'
done | sort | uniq -c | sort -rn | sed 's/^ *[0-9]* //' | head -n 3
awk -f "$tables/figures.awk" -f "$tables/summary.awk" "$table"
