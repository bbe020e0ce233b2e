#!/usr/bin/env bash
# Tables of comparisons, from figures that are known.
#   tests/pipelines/tables.sh
set -uo pipefail
source "$(dirname "$0")/folder.sh"
tables=$root/pipelines/tables
cd "$work" || exit 1

failures=0
# expect WHAT TEXT: a line of the file `out`.
expect() {
  grep -qxF -- "$2" out && return
  echo "FAIL $1: no \"$2\" in"; cat out
  ((++failures))
}
rows() { printf '%s\n' scene,method,seed,seconds,preprocess_seconds,spp,mse,relmse,relmse_trimmed "$@" > t.csv; }
figures() { awk -f "$tables/figures.awk" -f "$tables/$1.awk" "${@:2}" t.csv > out; }

# Times closer than a factor of 1.5, and a render that writes its last checkpoints late.
rows box,bsdf,1,10.2,0,10,4,4,4 box,bsdf,1,20.03,0,20,2,2,2 box,bsdf,1,30.01,0,30,1,1,1 \
  box,product,1,30,0,30,0.5,0.5,0.5 box,product,2,28,0,28,0.1,0.1,0.1 box,product,2,20,0,20,9,9,9
figures equal-time
expect "the last row of each seed" '| box | bsdf | 1 | 30 | 0 | 30 | 1 | 1 | 1 | 1 |  | 1 |'
expect "an arithmetic mean over seeds" '|  | product | 2 | 29 | 0 | 29 | 0.3 | 0.3 | 0.3 | 3.33 |  | 3.33 |'

# Preprocessing is paid by both sides.
rows box,none,1,40,20,1,1,1,1 box,all,1,40,30,1,1,0.25,0.25
figures talk -v wanted='none all' -v talk='- -' -v minutes=1
expect "training of both" '| box | all | 1 | 40 | 30 | 1 | 0.25 | 0.25 | 4 | 2 |'
figures equal-time -v base=none
expect "preprocessing of both" '|  | all | 1 | 40 | 30 | 1 | 1 | 0.25 | 0.25 | 4 |  | 2 |'
figures summary
expect "a summary of both" 'bought    all: 1/4 of the error of none in 40 s (1/4 without the worst pixels); 1/2 with 30 s of preprocessing in them'

# The noise of the reference taken out can leave less than nothing.
rows box,bsdf,1,4,0,1,1,1,1 box,auto,1,4,2,1,1,-0.01,0.1
figures summary
expect "an error below the noise" 'bought    auto: below the noise in 4 s (1/10 without the worst pixels); below the noise with 2 s of preprocessing in them'
figures auto
expect "auto below the noise" '| box | 4 | below the noise | below the noise | bsdf | 0.100 | 0.100 | bsdf |'

# Relative standard errors: 0 of bsdf, a half of auto over two seeds, a third of product.
rows box,bsdf,1,4,0,1,1,8,8 box,bsdf,2,4,0,1,1,8,8 box,product,1,4,0,1,1,2,2 box,product,2,4,0,1,1,4,4 \
  box,auto,1,4,0,1,1,2,6 box,auto,2,4,0,1,1,6,6
figures auto
expect "errors of ratios" '| box | 4 | 0.500 ± 0.250 | 1.333 ± 0.801 | product | 0.750 ± 0.000 | 2.000 ± 0.667 | product |'

# Three standard errors are needed to break a promise, and a case without light has none.
row() { printf '{"case": "%s", "method": "%s", "cost": %s, "cost_variance": %s}' "$@"; }
{ row dark bsdf 0 0; row dark auto 0 0; row room bsdf 4 0; row room product 1 0; row room auto 2 0.0625
  row wall bsdf 1 0; row wall auto 2 0.01; } | jq -s . | jq -rf "$root/pipelines/stability/auto.jq" > out
expect "auto beyond chance" '| wall | 2 ± 0.2 * | 2 ± 0.2 * | bsdf |'
expect "auto within chance" '| room | 0.5 ± 0.13 | 2 ± 0.5 | product |'
grep -q dark out && { echo "FAIL a case without light has a cost"; ((++failures)); }

# The summary is of the stages of its run, whatever others left.
traced() { printf '{"stored": %s, "emitted": 9, "paths": 0, "seconds": 1}' "$1" > "$2.json"; }
trained() { printf '{"cells": %s, "mean_effective_samples": 3, "mean_components": 2, "seconds": 1}' "$1" > "$2.json"; }
traced 1 photon-trace; traced 2 photon-trace-1; traced 3 importon-trace-1
trained 4 cache-train; trained 5 cache-train-1
"$tables/summary.sh" . t.csv importon-trace-1 photon-trace-1 cache-train-1 > out
expect "importons" 'importons 3 of 9 particles; 1 s'
expect "photons of a pass" 'photons   2 of 9 particles; 1 s'
expect "cells of a pass" 'cells     5, of 3 effective photons and 2 components on average; 1 s'
[[ $(grep -cE '^(photons|cells)' out) == 2 ]] || { echo "FAIL what another run left is told"; cat out; ((++failures)); }
((failures == 0)) && echo "tables say what was measured"
((failures == 0))
