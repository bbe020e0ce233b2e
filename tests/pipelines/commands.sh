#!/usr/bin/env bash
# What pipelines would run, by `make -n`, without the tools.
#   tests/pipelines/commands.sh
set -uo pipefail
source "$(dirname "$0")/folder.sh"
cp -r "$root/pipelines" "$work"
cd "$work" || exit 1
mkdir bin
for tool in brdf-fit photon-trace cache-train cache-reduce render image-compare chart report; do
  touch "bin/$tool"
done

failures=0
fail() { echo "FAIL $*"; cat log; ((++failures)); }
# would PIPELINE MAKE-ARGUMENTS...: its commands are in `log`.
would() { make -n --no-print-directory -f "pipelines/$1.mk" BIN=bin "${@:2}" > log 2>&1; }

# What COMPARE_FLAGS and RENDER_FLAGS say holds for kitchenette too; its reference has the size and the
# longest path of its own images.
kitchenette() {
  would compare SCENES=kitchenette WAYLIGHT_SCENES=elsewhere \
    COMPARE_FLAGS=--subtract-reference-noise "$@"
  grep -q "COMPARE_FLAGS='--subtract-reference-noise --resize-reference'" log
}
kitchenette RENDER_FLAGS='--clock cpu' || fail "compare: no --resize-reference for kitchenette"
grep -q "RENDER_FLAGS='--max-depth 21 --clock cpu'" log || fail "compare: kitchenette has longer paths"
kitchenette RENDER_FLAGS='--max-depth 9'
grep -q 'max-depth 21' log && fail "compare: kitchenette has two longest paths"
kitchenette SIZE=32x18 && fail "compare: kitchenette has a reference of another size"

# A SIZE for all scenes is that of gap-room too, and kitchenette then has a reference of its own.
would surface-paper SCENES=gap-room SIZE=32x18 equal-time
if ! grep -q -- '--size 32x18' log || grep -q -- '--size 640x360' log; then
  fail "surface-paper: gap-room has not the SIZE that is asked for"
fi

# SCENE_FLAGS come beside those that a pipeline gives itself, and no shipped reference is of them.
would jewelry SCENE_FLAGS='-D roughness=0.3'
grep -q 'photon-trace .* -D meshes=[^ ]*jewelry -D roughness=0.3 ' log ||
  fail "jewelry: SCENE_FLAGS take the place of its own"
would jewelry trade-off-split OUT=elsewhere SCENE_FLAGS='-D roughness=0.3'
grep -q "PIPELINE_FLAGS='-D meshes=[^ ]*elsewhere' SCENE_FLAGS='-D roughness=0.3'" log ||
  fail "jewelry: a trade-off has not the flags of its pipeline"
would gap-room
grep -q 'pipelines/references/gap-room.exr' log || fail "gap-room: the shipped reference is not taken"
would gap-room SCENE_FLAGS='-D gap=0.3'
grep -q 'pipelines/references' log && fail "gap-room: the shipped reference is taken for another scene"
((failures == 0)) && echo "pipelines would run what they are asked for"
((failures == 0))
