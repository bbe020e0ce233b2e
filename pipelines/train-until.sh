#!/usr/bin/env bash
# Trains a cache until another pass would not pay for itself, for a render of so many seconds.
#   train-until.sh FOLDER SECONDS SCENE [-D name=value ...]
# Environment: BIN LAUNCH SIZE SEED FIRST_PHOTONS MOST_PHOTONS TRAIN_FROM PHOTON_TRACE_FLAGS
#   CACHE_TRAIN_FLAGS QUIET
#
# Each pass traces twice the photons of the one before and goes on with its cache. Two small renders
# that differ by their seed tell the error that the cache leaves, times the time of a sample. What
# is left to gain falls with one over the photons, so the next pass should gain half of what this one
# did, and takes twice as long. It is made if that share of the render is longer. Written are
# scene.cache, training.csv, and photon-trace.json and cache-train.json with the time of all passes;
# that of the small renders counts as training.
set -euo pipefail
shopt -s inherit_errexit  # the renders of a probe run in a substitution
folder=$1 seconds=$2
shift 2
photons=${FIRST_PHOTONS:-125000} most=${MOST_PHOTONS:-64000000}
work=$folder/training
rm -rf "$work"
mkdir -p "$work"

number() { jq -r ".$2" "$1"; }
calculate() { awk "BEGIN { printf \"%.6g\", ($*) }"; }

# statistics PASS-FILE FILTER FILE: FILE is made anew, since it may be a link to that of another folder.
statistics() { jq "$2" "$1" > "$work/statistics" && mv "$work/statistics" "$folder/$3"; }

# What a pass traces: photons, a quarter as many camera paths guided by the pass before, or both.
traced() {
  local count=$photons
  [[ ${TRAIN_FROM:-lights} == camera ]] && count=0
  echo --count "$count"
  [[ ${TRAIN_FROM:-lights} == lights ]] && return
  echo --paths "$((photons / 4))" ${previous/--in/--cache}
}

train_pass() {
  ${LAUNCH:-} "$BIN/photon-trace" "${scene[@]}" -o "$work/pass.photons" $(traced) --seed "$SEED" \
    --pass "$pass" --stats "$work/photons-$pass.json" ${PHOTON_TRACE_FLAGS:-} ${QUIET:-}
  ${LAUNCH:-} "$BIN/cache-train" --photons "$work/pass.photons" $previous -o "$work/pass-$pass.cache" \
    --stats "$work/train-$pass.json" ${CACHE_TRAIN_FLAGS:-} ${QUIET:-}
  rm "$work/pass.photons"
  previous="--in $work/pass-$pass.cache"
  local trace train
  trace=$(number "$work/photons-$pass.json" seconds) train=$(number "$work/train-$pass.json" seconds)
  spent=$(calculate "$trace + $train")
  tracing=$(calculate "$tracing + $trace") training=$(calculate "$training + $train")
}

# The error without the worst pixels times the seconds that it took: less is better.
probe() {
  local i
  rm -f "$work"/probe*
  for i in 1 2; do
    ${LAUNCH:-} "$BIN/render" "${scene[@]}" -o "$work/probe-$i.exr" --mode illumination --bsdf-share 0.5 \
      --cache "$work/pass-$pass.cache" --spp 4 --size "$SIZE" --seed "$((SEED + i))" \
      --stats "$work/probe-$i.json" --quiet
  done
  ${LAUNCH:-} "$BIN/image-compare" "$work/probe-1.exr" "$work/probe-2.exr" --json > "$work/probe.json"
  calculate "$(number "$work/probe.json" relmse_trimmed) * \
    ($(number "$work/probe-1.json" cpu_seconds) + $(number "$work/probe-2.json" cpu_seconds))"
}

scene=("$@")
previous= error= next=1 tracing=0 training=0 emitted=0 stored=0 paths=0 samples=0
echo pass,photons,seconds,error,gain,predicted_gain > "$work/training.csv"
for ((pass = 1; ; ++pass, photons *= 2)); do
  train_pass
  for what in emitted stored paths samples; do
    (($what += $(number "$work/photons-$pass.json" $what))) || true
  done
  last=$error error=$(probe)
  training=$(calculate "$training + $(number "$work/probe-1.json" seconds) + \
    $(number "$work/probe-2.json" seconds)")
  gain=$([[ -n $last ]] && calculate "1 - $error / $last" || true)
  next=$([[ -n $gain ]] && calculate "$gain > 0 ? $gain / 2 : 0" || echo 1)
  echo "$pass,$photons,$spent,$error,$gain,$next" >> "$work/training.csv"
  ((2 * photons > most)) && reason="another would have more than $most photons" && break
  [[ $(calculate "$next * $seconds > 2 * $spent") == 1 ]] && continue
  reason="another would take $(calculate "2 * $spent") s and save $(calculate "$next * $seconds") s of $seconds s"
  break
done

statistics "$work/photons-$pass.json" ".seconds = $tracing | .emitted = $emitted | .stored = $stored |
  .paths = $paths | .samples = $samples" photon-trace.json
statistics "$work/train-$pass.json" ".seconds = $training" cache-train.json
mv "$work/training.csv" "$folder/training.csv"
mv "$work/pass-$pass.cache" "$folder/scene.cache"
rm -r "$work"
echo "trained in $pass passes; stopped because $reason"
