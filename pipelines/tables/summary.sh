#!/bin/sh
# What a pipeline modelled, what that cost in time and bytes, and what it bought.
#   summary.sh FOLDER TABLE.csv STAGE...    folder of results of pipelines/rules.mk, its figures, and
#                                           the stages of this run, whose statistics are STAGE.json
set -eu
folder=$1 table=$2
shift 2
tables=$(dirname "$0")

# stage FILE FILTER: a line of the statistics of a stage.
stage() {
  jq -r 'def digits($n): . * pow(10; $n) | round / pow(10; $n);
    def size: if . >= 1e6 then "\(. / 1e6 | digits(2)) MB" else "\(. / 1e3 | digits(1)) kB" end;
    def time: "\(. | digits(2)) s";
    '"$2" "$folder/$1"
}

fits='"fits      \(.entries) entries for \(.materials | length) materials, of " +
  "\(.full.entries) without --tolerance; \(.bytes | size), \(.seconds | time)"'
traced='\(.stored) of \(.emitted) particles" +
  (if .paths > 0 then ", \(.samples) samples of \(.paths) camera paths" else "" end) +
  "; \(.seconds | time)"'
cells='\(.cells), of \(.mean_effective_samples | digits(0)) effective photons and " +
  "\(.mean_components | digits(2)) components on average; \(.seconds | time)"'
reduced='\(.components_after | digits(2)) of \(.components_before | digits(2)) components; " +
  "\(.bytes_after | size) of \(.bytes_before | size)"'
for name in "$@"; do
  case $name in
    brdf-fit) stage $name.json "$fits" ;;
    importon-trace*) stage $name.json '"importons '"$traced" ;;
    photon-trace*) stage $name.json '"photons   '"$traced" ;;
    importance-train*) stage $name.json '"cells     of importance '"$cells" ;;
    cache-train*) stage $name.json '"cells     '"$cells" ;;
    cache-reduce-*) stage $name.json '"reduced   '"${name##*-}: $reduced" ;;
  esac
done
for stats in "$folder"/*.json; do
  stage "$(basename "$stats")" 'select(type == "object") | .auto // empty |
    "auto      \(.method); cells by bsdf \(.cells_bsdf), illumination \(.cells_illumination), " +
    "product \(.cells_product); pilot \(.pilot_seconds | time)"'
done | sort | uniq -c | sort -rn | sed 's/^ *[0-9]* //' | head -n 3
awk -f "$tables/figures.awk" -f "$tables/summary.awk" "$table"
