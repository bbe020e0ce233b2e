#!/usr/bin/env bash
# Golden cases of the tools.
#   tests/golden/run.sh BIN [TOOL...]           compares
#   tests/golden/run.sh --update BIN [TOOL...]  redoes the expected outputs
#
# tests/golden/TOOL/cases has one case a line: `name | exit code | command`. Each command runs in a
# folder of its own with the scenes and the small pipeline of setup.sh; what it prints, stdout and
# stderr, must equal tests/golden/TOOL/name.txt. Numbers may differ by a part in 500: the compiler
# may fuse operations differently. Hashes are masked, since they follow the last bit, and so are the
# sizes of files in cache-info's table, since those of images are of compressed data.
#
# A pipeline fails with its first command that does. Commands may use
#   left PATTERN...           prints which files there are by these names, or "nothing left"
#   interrupted SECONDS COMMAND...   the command, with Ctrl-C after some seconds
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
update=0
if [[ ${1:-} == --update ]]; then update=1; shift; fi
bin=$(cd "${1:?usage: run.sh [--update] BIN [TOOL...]}" && pwd)
shift
tools=("$@")
if ((${#tools[@]} == 0)); then
  for cases in "$here"/*/cases; do tools+=("$(basename "$(dirname "$cases")")"); done
fi

export PATH=$bin:$PATH LC_ALL=C
unset SLURM_CPUS_PER_TASK
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
mkdir "$work/fixtures"
cp "$here"/scenes/* "$work/fixtures"
(cd "$work/fixtures" && bash "$here/setup.sh") || { echo "setup.sh failed"; exit 1; }

mask() { sed -E 's/(^|[^.0-9a-f])[0-9a-f]{16}\b/\1HASH/g; s/^(bytes +)[0-9]+$/\1SIZE/'; }

left() {
  local found
  found=$(for pattern in "$@"; do compgen -G "$pattern"; done | sort)
  echo "${found:-nothing left}"
}

interrupted() { timeout --foreground --preserve-status -s INT "$@"; }

# Word by word, also between commas; numbers by value.
agree() {
  awk -v expected="$1" '
    function number(w) { gsub(/[",:;()\[\]]/, "", w); return w ~ /^[-+]?[0-9]*\.?[0-9]+(e[-+]?[0-9]+)?$/ ? w : "" }
    function same(a, b,  x, y, d, m) {
      if (a == b) return 1
      x = number(a); y = number(b)
      if (x == "" || y == "") return 0
      d = x - y; if (d < 0) d = -d
      m = x < 0 ? -x : x
      return d <= 0.002 * m + 1e-6
    }
    { if ((getline line < expected) <= 0) exit 1
      n = split($0, a, /[ \t]+|,/); if (n != split(line, b, /[ \t]+|,/)) exit 1
      for (i = 1; i <= n; ++i) if (!same(a[i], b[i])) exit 1 }
    END { if ((getline line < expected) > 0) exit 1 }' "$2"
}

# Runs one case: its output, masked, goes to $work/out.
run_case() {
  rm -rf "$work/case"
  cp -r "$work/fixtures" "$work/case"
  (cd "$work/case" && eval "$1") < /dev/null > "$work/raw" 2>&1
  local status=$?
  mask < "$work/raw" > "$work/out"
  return $status
}

passed=0 failed=0
fail() { echo "FAIL $1"; ((++failed)); }
for tool in "${tools[@]}"; do
  while IFS='|' read -r name code command; do
    read -r name <<< "$name"
    read -r code <<< "$code"
    [[ -z $name || $name == \#* ]] && continue
    expected=$here/$tool/$name.txt
    run_case "$command"
    status=$?
    if [[ $status != "$code" ]]; then
      fail "$tool/$name: exit code $status, not $code"
      cat "$work/out"
      continue
    fi
    ((update)) && ! agree "$expected" "$work/out" 2> /dev/null && cp "$work/out" "$expected"
    if agree "$expected" "$work/out"; then
      ((++passed))
    else
      fail "$tool/$name"
      diff "$expected" "$work/out"
    fi
  done < "$here/$tool/cases"
  # Outputs whose case has gone would never be looked at again.
  for expected in "$here/$tool"/*.txt; do
    name=$(basename "$expected" .txt)
    grep -qE "^$name +\|" "$here/$tool/cases" && continue
    if ((update)); then rm "$expected"; else fail "$tool/$name: has no case"; fi
  done
done
echo "$passed passed, $failed failed"
((failed == 0))
