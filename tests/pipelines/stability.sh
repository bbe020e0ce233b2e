#!/usr/bin/env bash
# The fast table of pipelines/stability.mk is that of stability.txt.
#   tests/pipelines/stability.sh BIN             compares
#   tests/pipelines/stability.sh --update BIN    redoes it
set -uo pipefail
source "$(dirname "$0")/folder.sh"
here=$(cd "$(dirname "$0")" && pwd)
expected=$here/stability.txt
if [[ ${1:-} == --update ]]; then expected=''; shift; fi
bin=$(cd "${1:?usage: stability.sh [--update] BIN}" && pwd)
export LC_ALL=C.UTF-8
cd "$here/../.." || exit 1
make --no-print-directory -f pipelines/stability.mk fast -j2 OUT="$work" BIN="$bin" > "$work/log" 2>&1
status=$?
if [[ -z $expected ]]; then
  cp "$work/table.txt" "$here/stability.txt"
elif ! diff "$expected" "$work/table.txt"; then
  echo "FAIL the table of stability.mk, exit code $status"
  tail -n 40 "$work/log"
  exit 1
fi
exit $status
