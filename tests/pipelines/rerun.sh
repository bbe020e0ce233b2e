#!/usr/bin/env bash
# Pipelines run from a clean state, and again only as far as something changed.
#   tests/pipelines/rerun.sh BIN
# With WAYLIGHT_SCENES, a folder of scenes made elsewhere, the pipelines of those scenes run too.
set -uo pipefail
source "$(dirname "$0")/folder.sh"
bin=$(cd "${1:?usage: rerun.sh BIN}" && pwd)
cp -r "$root/pipelines" "$work"
cd "$work" || exit 1

# The tools are links with a fixed old date, so that a build that goes on at the same time does not
# look like a change.
mkdir bin
for tool in brdf-fit photon-trace cache-train cache-reduce render image-compare chart report \
    make-cloud; do
  printf '#!/bin/sh\n[ "$LAUNCHED" ] || echo %s >> unlaunched\nexec "%s/%s" "$@"\n' \
    "$tool" "$bin" "$tool" > "bin/$tool"
  chmod +x "bin/$tool"
  touch -d 2001-01-01 "bin/$tool"
done

pipeline=gap-room
tiny=(SIZE=32x18 'TIMES=0.05 0.1' PHOTONS=20000 REFERENCE_SPP=4 BIN=bin QUIET=-q
      'METHODS=bsdf product' 'BRDF_FIT_FLAGS=--elevations 8')
run() { make --no-print-directory -f "pipelines/$pipeline.mk" "${tiny[@]}" "$@" > log 2>&1; }

# What the last run ran: the tools, in alphabetical order.
ran() { grep -oE '^ *bin/[a-z-]+' log | sed 's|.*/||' | sort -u | xargs; }

failures=0
expect() {
  local what=$1 expected=$2 actual
  actual=$(ran)
  [[ $actual == "$expected" ]] && return
  echo "FAIL $pipeline: $what ran \"$actual\", not \"$expected\""
  cat log
  ((++failures))
}
must_run() { run "$@" || { echo "FAIL $pipeline: make $* failed"; cat log; ((++failures)); }; }

everything="brdf-fit cache-reduce cache-train chart image-compare photon-trace render"

must_run
expect "a clean start" "$everything"
for file in reduced.brdf reduced.cache bsdf-0.05s.exr product-0.1s.png product-0.1s-error.png \
    gap-room.csv gap-room.svg; do
  [[ -s out/gap-room/$file ]] || { echo "FAIL gap-room: no $file"; ((++failures)); }
done
must_run
expect "a second run" ""

reference=$(stat -c %y out/gap-room/reference.exr)
must_run RENDER_FLAGS='--max-depth 5'
expect "other RENDER_FLAGS" "chart image-compare render"
[[ $(stat -c %y out/gap-room/reference.exr) == "$reference" ]] ||
  { echo "FAIL gap-room: other RENDER_FLAGS made the reference again"; ((++failures)); }
eval "must_run $(sed -n 's/^    make -f pipelines.gap-room.mk \(RENDER_FLAGS=[^#]*\)#.*/\1/p' "$root/docs/pipelines.md")"
expect "other RENDER_FLAGS, as the documentation has them" "chart image-compare render"
must_run RENDER_FLAGS="-D quote='two words'"
expect "RENDER_FLAGS with quotes" "chart image-compare render"
must_run
expect "the first flags again" "chart image-compare render"
must_run COMPARE_FLAGS=--subtract-reference-noise
expect "other COMPARE_FLAGS" "chart image-compare"
cp -p out/gap-room/reference.exr other.exr
must_run REFERENCE=other.exr
expect "another REFERENCE" "chart image-compare"
must_run
expect "the first reference again" "chart image-compare"
must_run CACHE_REDUCE_FLAGS='--max-components 4'
expect "other CACHE_REDUCE_FLAGS" "cache-reduce chart image-compare render"
must_run PHOTONS=30000
expect "other PHOTONS" "cache-reduce cache-train chart image-compare photon-trace render"
must_run PHOTONS=30000 TIMES=0.05
expect "fewer TIMES" "chart"
must_run PHOTONS=30000 'TIMES=0.05 0.1 0.2'
expect "one more time" "chart image-compare render"
renders() {
  [[ $(grep -c '^ *bin/render' log) == "$2" ]] && return
  echo "FAIL gap-room: $1 is not $2 renders"; cat log; ((++failures))
}
renders "a time more" 2
if [[ out/gap-room/bsdf-0.05s.csv -ot out/gap-room/bsdf-0.05s.exr ]]; then
  echo "FAIL gap-room: figures are older than their image"; ((++failures))
fi
must_run PHOTONS=30000 METHODS=product
expect "fewer METHODS" "chart"
variant=(PHOTONS=30000 METHODS='product product-short' mode_product-short=product
         flags_product-short='--max-depth 3')
must_run "${variant[@]}"
expect "a method with flags of its own" "chart image-compare render"
must_run "${variant[@]}" SEEDS='1 2'
expect "one more seed" "chart image-compare render"
renders "a seed more" 2
[[ -s out/gap-room/product-short-seed2-0.1s.exr ]] ||
  { echo "FAIL gap-room: no image of the second seed"; ((++failures)); }
must_run "${variant[@]}" SEEDS='1 2'
expect "the seeds again" ""
must_run "${variant[@]}" SEEDS='1 2' RENDER_FLAGS='--rr none'
turns=$(grep -oE 'gap-room/product[a-z0-9-]*\.exr --mode' log | sed 's|.*/||; s|\..*||' | xargs)
[[ $turns == 'product product-short product-seed2 product-short-seed2' ]] ||
  { echo "FAIL gap-room: methods do not take turns, but $turns"; ((++failures)); }
must_run PHOTONS=auto TRAIN_FOR=0.01 TIMES=0.05
expect "PHOTONS=auto" "cache-reduce chart image-compare render"
[[ $(wc -l < out/gap-room/training.csv) == 2 ]] ||
  { echo "FAIL gap-room: a short render is worth one pass"; cat log; ((++failures)); }
grep -q '^bought .*product' out/gap-room/summary.txt ||
  { echo "FAIL gap-room: no summary"; cat log; ((++failures)); }
must_run PHOTONS=auto TRAIN_FOR=0.01 TIMES=0.05
expect "PHOTONS=auto again" ""
statistics=$(cksum out/gap-room/*.json)
must_run trade-off-cells PHOTONS=auto TRAIN_FOR=0.01 TIMES=0.05 CELLS_TRIED=600 STUDY_SPP=2
[[ $(cksum out/gap-room/*.json) == "$statistics" ]] ||
  { echo "FAIL gap-room: a trade-off with PHOTONS=auto writes into the statistics"; ((++failures)); }

# Training from camera paths, once, in passes and until it does not pay.
must_run PHOTONS=30000 TIMES=0.05 METHODS=product
must_run PHOTONS=30000 TIMES=0.05 METHODS=product TRAIN_FROM=both
expect "camera paths too" "cache-reduce cache-train chart image-compare photon-trace render"
must_run PHOTONS=30000 TIMES=0.05 METHODS=product TRAIN_FROM=both
expect "camera paths again" ""
must_run PHOTONS=30000 TIMES=0.05 METHODS=product TRAIN_FROM=camera PASSES=2
expect "passes of camera paths" "cache-reduce cache-train chart image-compare photon-trace render"
[[ $(grep -c -- '--cache [^ ]*pass-1.cache --count 0 --paths 7500' log) == 1 ]] ||
  { echo "FAIL gap-room: paths of pass 2 are not guided by pass 1"; cat log; ((++failures)); }
[[ $(grep -c '^photons' out/gap-room/summary.txt) == 2 && $(grep -c '^cells' out/gap-room/summary.txt) == 2 ]] ||
  { echo "FAIL gap-room: the summary is not of two passes"; cat out/gap-room/summary.txt; ((++failures)); }
must_run PHOTONS=auto TRAIN_FOR=0.01 TIMES=0.05 METHODS=product TRAIN_FROM=both
expect "PHOTONS=auto from both" "cache-reduce chart image-compare render"
run TRAIN_FROM=nowhere && { echo "FAIL gap-room: TRAIN_FROM=nowhere is taken"; ((++failures)); }
pipeline=daylight must_run -n PHOTONS=auto
must_run
touch pipelines/scenes/gap-room.xml
must_run
expect "a touched scene" "$everything"
must_run report charts
expect "more charts and a report" "chart report"
must_run report charts
expect "the same again" ""

# Trade-offs run only the stage that has the option, and what follows it.
must_run trade-off-photons 'PHOTONS_TRIED=10000 20000' STUDY_SPP=2
expect "a trade-off of photons" "cache-reduce cache-train chart image-compare photon-trace render"
must_run trade-off-photons 'PHOTONS_TRIED=10000 20000' STUDY_SPP=2
expect "the trade-off again" ""
must_run trade-off-photons 'PHOTONS_TRIED=10000 20000' STUDY_SPP=2 'CACHE_REDUCE_FLAGS=--max-cost 5'
expect "the trade-off with other CACHE_REDUCE_FLAGS" "cache-reduce chart image-compare render"
must_run trade-off-split 'SPLITS_TRIED=1 2' STUDY_SPP=2 'CACHE_REDUCE_FLAGS=--max-cost 5'
expect "a trade-off of splitting" "chart image-compare render"
must_run trade-off-fit-components 'FITS_TRIED=1 2'
expect "a trade-off of fits" "brdf-fit chart"
must_run clean
must_run trade-off-split 'SPLITS_TRIED=1 2' STUDY_SPP=2
[[ $(grep -c '^ *bin/photon-trace' log) == 1 ]] ||
  { echo "FAIL gap-room: a trade-off from a clean start trains more than once"; cat log; ((++failures)); }
must_run

# Every tool is launched by LAUNCH, in the studies and in training that decides itself too.
rm unlaunched
must_run clean
must_run LAUNCH='env LAUNCHED=1' PHOTONS=auto TRAIN_FOR=0.01 FIRST_PHOTONS=5000 THRESHOLDS=50 \
  STUDY_SPP=2 UNBIASED_SPP=2 all charts report reduction overhead unbiased
[[ ! -e unlaunched ]] ||
  { echo "FAIL gap-room: without LAUNCH ran $(sort -u unlaunched | xargs)"; ((++failures)); }
grep -q '^1,5000,' out/gap-room/training.csv ||
  { echo "FAIL gap-room: FIRST_PHOTONS is not what the first pass traces"; ((++failures)); }
must_run

# Stopped between the two outputs of a stage.
rm out/gap-room/product-0.1s.{json,csv}
must_run
expect "a render without statistics" "chart image-compare render"

# Stopped in the middle of a stage.
# stopped SIGNAL TEXT MAKE-ARGUMENTS...: a run that is stopped a moment after it prints the text.
stopped() {
  local signal=$1 text=$2
  shift 2
  : > log  # else it may still be that of the run before
  setsid make --no-print-directory -f pipelines/gap-room.mk "${tiny[@]}" "$@" > log 2>&1 &
  for ((i = 0; i < 200; ++i)); do
    grep -q -- "$text" log && break
    sleep 0.05
  done
  sleep 0.3
  # Make hands SIGTERM on; to the whole group it would come to the tools twice.
  if [[ $signal == TERM ]]; then kill -TERM "$!"; else kill "-$signal" -- "-$!"; fi
  wait "$!" 2> /dev/null
}
must_run clean
stopped TERM bin/photon-trace cache PHOTONS=4000000000
if compgen -G "out/gap-room/scene.photons*"; then
  echo "FAIL gap-room: a stopped trace left photons"; ((++failures))
fi
stopped KILL bin/photon-trace cache PHOTONS=4000000000
must_run
expect "after a killed trace" "$everything"
stopped KILL 'mode product' RENDER_FLAGS='--max-depth 4' flags_product='--time 100'
must_run RENDER_FLAGS='--max-depth 4'
expect "after a killed render" "chart image-compare render"
renders "what a killed render left" 1

# Studies and tables.
small=(SCENES=gap-room SECONDS=0.05 SEEDS=1 BIN=bin OUT=out/paper
       'options_gap-room=SIZE=64x32 PHOTONS=20000 REFERENCE_SPP=4 STUDY_SPP=2 UNBIASED_SPP=4 '
       THRESHOLDS='0 50' QUIET=-q)
small[-3]+='BRDF_FIT_FLAGS="--elevations 8"'
if ! make --no-print-directory -f pipelines/surface-paper.mk "${small[@]}" > log 2>&1; then
  echo "FAIL surface-paper: make failed"; cat log; ((++failures))
fi
for table in equal-time preprocessing overhead unbiased; do
  [[ $(grep -c '^| gap-room' "out/paper/$table.md") -ge 1 ]] ||
    { echo "FAIL surface-paper: no gap-room in $table.md"; ((++failures)); }
done
[[ $(wc -l < out/paper/gap-room/reduction.csv) == 3 && -s out/paper/gap-room/reduction.svg ]] ||
  { echo "FAIL surface-paper: no study of reduction"; ((++failures)); }

small=(SCENES='smoky-room cloud' TIME=0.05 SEEDS=1 BIN=bin OUT=out/volume SIZE=32x18
       METHODS='none direction both splitting all' SHAFTS_SIZE=32x18 SHAFTS_SPP=2 QUIET=-q)
for scene in smoky-room cloud light-shafts; do
  small+=("options_$scene=PHOTONS=2000 REFERENCE_SPP=4 UNBIASED_SPP=4")
done
if ! make --no-print-directory -f pipelines/volume-paper.mk "${small[@]}" all shafts > log 2>&1; then
  echo "FAIL volume-paper: make failed"; cat log; ((++failures))
fi
for scene in smoky-room cloud; do
  for table in comparisons:8 training:1 unbiased:5; do
    [[ $(grep -c "^| $scene" "out/volume/${table%:*}.md") == "${table#*:}" ]] ||
      { echo "FAIL volume-paper: not ${table#*:} rows of $scene in ${table%:*}.md"; ((++failures)); }
  done
done
for image in none-2 distance-2; do
  [[ -s out/volume/shafts/$image.png ]] ||
    { echo "FAIL volume-paper: no light shafts $image"; ((++failures)); }
done

make --no-print-directory -f pipelines/volume-paper.mk "${small[@]}" shafts > log 2>&1
expect "shafts again" ""
make --no-print-directory -f pipelines/volume-paper.mk "${small[@]}" shafts SHAFTS_SIZE=16x9 > log 2>&1
expect "shafts of another size" "render"

# Times that both seeds reach on a busy machine: those of the processors.
small=("${tiny[@]}" 'TIMES=0.2 0.4' SEEDS='1 2' OUT=out/compare 'SCENES=gap-room smoky-room'
       'RENDER_FLAGS=--clock cpu'
       'MEDIA_METHODS=none both' 'options_smoky-room=PHOTONS=2000')
pipeline=compare
run_compare() { make --no-print-directory -f pipelines/compare.mk "${small[@]}" > log 2>&1; }
run_compare || { echo "FAIL compare: make failed"; cat log; ((++failures)); }
[[ $(wc -l < out/compare/compare.csv) == 17 && $(wc -l < out/compare/reach.csv) == 5 &&
   -s out/compare/report.html && -s out/compare/smoky-room/smoky-room-spp.svg ]] ||
  { echo "FAIL compare: not all figures, charts and the report"; ((++failures)); }
run_compare
expect "a second run" ""

# What would do nothing, or the wrong thing, is refused, and nothing is removed.
# refused TEXT MAKE-ARGUMENTS...
refused() {
  local text=$1
  shift
  if make --no-print-directory "$@" > log 2>&1 || ! grep -q -- "$text" log || [[ ! -d out ]]; then
    echo "FAIL make $*: not refused with \"$text\""; cat log; ((++failures))
  fi
}
for part in rules media grown-cloud studies passes trade-offs; do
  refused 'included by pipelines' -f "pipelines/$part.mk" clean
done
refused 'root of the repository' -C pipelines -f gap-room.mk clean
refused 'no case nonsense: known are' -f pipelines/stability.mk CASES='few-photons nonsense'
refused 'passes-chart needs PASSES' -f pipelines/gap-room.mk BIN=bin PASSES=0 passes-chart
refused 'no elsewhere/living-room/scene.xml: WAYLIGHT_SCENES' -f pipelines/living-room.mk \
  WAYLIGHT_SCENES=elsewhere
refused 'No rule to make target' -f pipelines/gap-room.mk BIN=bin trade-off-medium-cells

# The other pipelines, once and not again.
others=(jewelry)
[[ -n ${WAYLIGHT_SCENES:-} ]] && others+=(veach-ajar kitchenette living-room)
for pipeline in "${others[@]}"; do
  once=(TIMES=0.05 'METHODS=bsdf illumination product')
  must_run "${once[@]}"
  expect "a clean start" "$everything"
  must_run "${once[@]}"
  expect "a second run" ""
done

# Those of media, which need no fits of BRDFs.
in_media="cache-reduce cache-train chart image-compare photon-trace render"
others=(light-shafts haze lantern lamp-behind backlit-wax smoky-room cloud)
[[ -n ${WAYLIGHT_SCENES:-} ]] && others+=(wdas-cloud)
for pipeline in "${others[@]}"; do
  once=(TIMES=0.05 METHODS='none both' PHOTONS=3000)
  makes=$in_media
  [[ $pipeline == cloud ]] && makes=${in_media/photon-trace/make-cloud photon-trace}
  must_run "${once[@]}"
  expect "a clean start" "$makes"
  must_run "${once[@]}"
  expect "a second run" ""
done
((failures == 0)) && echo "pipelines run again as they should"
((failures == 0))
