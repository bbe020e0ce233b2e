#!/usr/bin/env bash
# Runs one case of TABLE and judges every method: run.sh NAME FOLDER
#
# Everything goes to FOLDER, which is made anew; the verdicts to FOLDER/verdicts.json, an object a
# line. From the environment: BIN, INPUTS, TABLE, METHODS (a table `set method caches flags`), SIZE,
# SPP, REFERENCE_SPP, SEEDS, PHOTONS, ENTRIES (of a fit), LIMIT (seconds of one tool), TIMED (1: judge
# time too).
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
name=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder"
flags='' reference='' photons=$PHOTONS spp=$SPP reference_spp=$REFERENCE_SPP longest=64
reference_method=bsdf
IFS='|' read -r _ row set scene settings < <(grep -E "^$name +\|" "$TABLE")
read -r row set scene <<< "$row $set $scene"
eval "$settings"

# attempt NAME COMMAND...: what fails, or takes too long, leaves its reason in NAME.failed.
attempt() {
  local what=$1 status
  shift
  timeout "$LIMIT" "$@" >> "$folder/log" 2> "$folder/error" && return
  status=$?
  cat "$folder/error" >> "$folder/log"
  local reason="exit code $status"
  ((status == 124)) && reason="stopped after $LIMIT s"
  echo "$(basename "$1"): $reason" >> "$folder/$what.failed"
  return 1
}

methods() { awk -v set="$set" '$1 == set' "$METHODS"; }

failure_of() { [[ -e $folder/$1.failed ]] && head -n 1 "$folder/$1.failed"; }

# judge METHOD JQ-FILE ARGUMENTS...
judge() {
  jq -nc --arg case "$name" --arg row "$row" --arg set "$set" --arg method "$1" \
    --arg failed "$(failure_of "$1")" --argjson timed "$TIMED" "${@:3}" -f "$here/$2"
}

case $set in
  tests | fits) source "$here/$set.sh" ;;
  *) source "$here/renders.sh" ;;
esac
methods | while read -r _ method caches how; do judge_method; done > "$folder/verdicts.json"
