#!/usr/bin/env bash
# What pipelines/train-until.sh does when a stage fails, and where its folder has links. The tools are
# stand-ins; FAILING is a pattern of the commands that fail.
#   tests/pipelines/training.sh
set -uo pipefail
source "$(dirname "$0")/folder.sh"
cd "$work" || exit 1
mkdir bin

cat > bin/photon-trace << 'TOOL'
#!/bin/sh
case "$0 $*" in ${FAILING:-}) echo "$(basename "$0") failed" >&2; exit 3 ;; esac
while [ $# -gt 0 ]; do
  case $1 in
    -o) echo made > "$2" ;;
    --stats) echo '{"seconds": 1, "cpu_seconds": 1, "emitted": 5, "stored": 4, "paths": 0,
      "samples": 0, "relmse_trimmed": 0.1}' > "$2" ;;
  esac
  shift
done
case $0 in *image-compare) echo "{\"relmse_trimmed\": 0.$((9 - $(wc -l < "$COUNT")))}"; echo >> "$COUNT" ;; esac
TOOL
chmod +x bin/photon-trace
for tool in cache-train render image-compare; do cp bin/photon-trace "bin/$tool"; done

failures=0
fail() { echo "FAIL $*"; cat log; ((++failures)); }
train() {
  : > count
  BIN=bin SIZE=8x8 SEED=1 COUNT=count MOST_PHOTONS=500000 \
    "$root/pipelines/train-until.sh" out 1000 scene.xml > log 2>&1
}

mkdir out other
for stage in photon-trace cache-train; do
  echo '{"seconds": 7}' > "other/$stage.json"
  ln "other/$stage.json" "out/$stage.json"
done
train || fail "a sound training fails"
[[ $(cat other/*.json | sort -u) == '{"seconds": 7}' ]] || fail "statistics of another folder are written"
[[ $(jq .emitted out/photon-trace.json) == 15 && $(wc -l < out/training.csv) == 4 ]] ||
  fail "not three passes of five photons"

# Not a decision by what the pass before left.
rm -r out && mkdir out
FAILING='*render*/pass-2.cache*' train && fail "a failed probe is taken for a decision"
grep -q '^render failed' log || fail "what a probe says is lost"
[[ ! -e out/scene.cache && ! -e out/training.csv ]] || fail "a failed training leaves its outputs"
((failures == 0)) && echo "training until it pays"
((failures == 0))
