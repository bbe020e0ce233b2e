#!/usr/bin/env bash
# Runs one case of TABLE and judges every method: run.sh NAME FOLDER
#
# Everything goes to FOLDER, which is made anew; the verdicts to FOLDER/verdicts.json, an object a
# line for each method, also for one that fails. From the environment: BIN, INPUTS, TABLE, METHODS (a table `set method caches flags`), SIZE,
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

# attempt NAME COMMAND...: what fails, or takes too long, leaves its reason in NAME.failed. Its output
# goes to the file `output`, else to the log.
attempt() {
  local what=$1 status
  shift
  timeout -k 10 "$LIMIT" "$@" >> "${output:-$folder/log}" 2> "$folder/error" && return
  status=$?
  cat "$folder/error" >> "$folder/log"
  local reason="exit code $status"
  ((status == 124)) && reason="stopped after $LIMIT s"
  echo "$(basename "$1"): $reason" >> "$folder/$what.failed"
  return 1
}

methods() { awk -v set="$set" '$1 == set' "$METHODS"; }

# verdict METHOD JQ-ARGUMENTS...: a line of the verdicts.
verdict() {
  jq -nc --arg case "$name" --arg row "$row" --arg set "$set" --arg method "$1" \
    --argjson timed "$TIMED" "${@:2}" 2>> "$folder/log"
}

# judge METHOD JQ-FILE JQ-ARGUMENTS...: what failed, or cannot be judged, has the reason as verdict.
judge() {
  local failed=$folder/$1.failed
  [[ ! -e $failed ]] && verdict "$1" "${@:3}" -f "$here/$2" && return
  [[ -e $failed ]] || echo "$2: no verdict" > "$failed"
  verdict "$1" --arg failed "$(head -n 1 "$failed")" -f "$here/failed.jq"
}

case $set in
  tests | fits) source "$here/$set.sh" ;;
  *) source "$here/renders.sh" ;;
esac
methods | while read -r _ method caches how; do judge_method; done > "$folder/verdicts.tmp"
if [[ ! -s $folder/verdicts.tmp || $(wc -l < "$folder/verdicts.tmp") != $(methods | wc -l) ]]; then
  echo "stability: $name has not a verdict for each method of $set, see $folder/log" >&2
  exit 1
fi
mv "$folder/verdicts.tmp" "$folder/verdicts.json"
