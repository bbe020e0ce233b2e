#!/usr/bin/env bash
# Methods that fail have a verdict in the table of pipelines/stability.mk, and nothing is judged again
# without need. The tools are stand-ins that write what a sound run does; FAILING is a pattern of the
# commands that crash, as "*tool*what it is called with*".
#   tests/pipelines/verdicts.sh
set -uo pipefail
source "$(dirname "$0")/folder.sh"
export LC_ALL=C.UTF-8
cp -r "$root/pipelines" "$work"
cd "$work" || exit 1
mkdir -p bin

cat > bin/tool << 'TOOL'
#!/bin/sh
case "$0 $*" in ${FAILING:-}) exit 139 ;; esac
tool=$(basename "$0")
while [ $# -gt 0 ]; do
  case $1 in
    -o) echo made > "$2" ;;
    --stats) echo '{"estimated_relmse": 0.01, "cpu_seconds": 1, "invalid_samples": 0,
      "mean_path_length": 3, "copies_per_path": 0, "peak_memory_bytes": 1e6}' > "$2" ;;
    --report) printf 'material,theta,components,error,em_error,ms\na,0,1,0.1,0.1,1\n' > "$2" ;;
  esac
  shift
done
[ "$tool" != image-compare ] && exit
echo '{"relmse_of_each": [0.1, 0.1], "mean_ratio": 1, "non_finite": 0, "z": {"tiles":
  {"count": 30, "beyond3": 0, "largest": 1, "unexplained": '"${UNEXPLAINED:-0}"'}}}'
TOOL
chmod +x bin/tool
for tool in brdf-fit photon-trace cache-train cache-reduce cache-info render image-compare make-cloud; do
  cp bin/tool "bin/$tool"
done

failures=0
fail() { echo "FAIL $*"; cat log; ((++failures)); }
run() {
  make --no-print-directory -f pipelines/stability.mk fast BIN=bin OUT=out CASES='lobes room jewelry' \
    surface_methods='bsdf ris product' "$@" > log 2>&1
}
verdict() { jq -r --arg case "$1" --arg method "$2" \
  '.[] | select(.case == $case and .method == $method) | .verdict' out/table.json; }

run || fail "a sound run fails"
[[ $(jq -r 'map(.verdict) | unique | .[]' out/table.json) == pass ]] || fail "a sound run does not pass"

# crash PATTERN CASE METHOD TOOL: the method has the crash as its verdict, and the others pass.
crash() {
  rm -rf out
  FAILING=$1 run && fail "the crash of $4 passes"
  [[ $(verdict "$2" "$3") == "$4: exit code 139" ]] || fail "$2 $3 is \"$(verdict "$2" "$3")\""
  [[ $(jq 'map(select(.verdict != "pass")) | length' out/table.json) == "${5:-1}" ]] ||
    fail "the crash of $4 is not $3's alone"
}
crash '*brdf-fit*--fit em*' lobes em brdf-fit
crash '*brdf-fit*--fit best*' lobes best brdf-fit
crash '*image-compare*/room/ris-1.exr*' room ris image-compare
crash '*image-compare*/room/bsdf-1.exr*' room bsdf image-compare
crash '*render*/room/product-2.exr*' room product render
crash '*render*/room/reference.exr*' room product render 3

# A verdict that jq cannot give.
rm -rf out
mv pipelines/stability/renders.jq kept.jq
sed 's/^\$of\[0\]/(if $method == "ris" then error("none") else empty end), &/' kept.jq \
  > pipelines/stability/renders.jq
run && fail "a verdict that cannot be given passes"
[[ $(verdict room ris) == "renders.jq: no verdict" ]] || fail "room ris is \"$(verdict room ris)\""
mv kept.jq pipelines/stability/renders.jq

# A difference that no noise explains.
rm -rf out
UNEXPLAINED=12 run && fail "a constant image against a black reference passes"
[[ $(verdict room bsdf) == "12 scores without noise" ]] || fail "room is \"$(verdict room bsdf)\""

# What is judged again, case by case.
judged() { grep '^stability: ' log | sed 's/.*: //' | sort | xargs; }
# again FILE CASES: they are run again when the file is newer, and no others.
again() {
  touch "$1"
  run || fail "a run after $1 fails"
  [[ $(judged) == "$2" ]] || fail "after $1 ran \"$(judged)\", not \"$2\""
}
run
run
[[ $(judged) == "" ]] || fail "a second run ran \"$(judged)\""
for file in scenes/jewelry.xml stability/scenes/room.xml stability/renders.jq stability/run.sh; do
  again "pipelines/$file" "jewelry lobes room"
done
again bin/cache-info "jewelry lobes room"
[[ ! -e out/room/verdicts.tmp ]] || fail "a temporary file is left"

make -n --no-print-directory -f pipelines/stability.mk fast auto BIN=bin > log 2>&1
grep -q 'out/stability-fast/auto.md' log || fail "\"fast auto\" is not of the fast table"
((failures == 0)) && echo "methods that fail have verdicts"
((failures == 0))
