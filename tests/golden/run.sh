#!/usr/bin/env bash
# Golden cases of the tools.
#   tests/golden/run.sh BIN [TOOL...]           compares
#   tests/golden/run.sh --update BIN [TOOL...]  redoes the expected outputs
#
# tests/golden/TOOL/cases has one case a line: `name | exit code | command`. A command runs in an
# empty folder with the scenes and the small pipeline of setup.sh; what it prints, stdout and
# stderr, must equal tests/golden/TOOL/name.txt. Numbers may differ by a part in 500: the compiler
# may fuse operations differently. Hashes are masked, since they follow the last bit.
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
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here"/scenes/* "$work"
cd "$work" || exit 1
bash "$here/setup.sh" || { echo "setup.sh failed"; exit 1; }

mask() { sed -E 's/\b[0-9a-f]{16}\b/HASH/g'; }

# Word by word; numbers by value.
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
      n = split($0, a, /[ \t]+/); if (n != split(line, b, /[ \t]+/)) exit 1
      for (i = 1; i <= n; ++i) if (!same(a[i], b[i])) exit 1 }
    END { if ((getline line < expected) > 0) exit 1 }' "$2"
}

passed=0 failed=0
for tool in "${tools[@]}"; do
  while IFS='|' read -r name code command; do
    name=$(xargs <<< "$name") code=$(xargs <<< "$code")
    [[ -z $name || $name == \#* ]] && continue
    (eval "$command") < /dev/null > out.raw 2>&1
    status=$?
    mask < out.raw > out.txt
    expected=$here/$tool/$name.txt
    if ((update)) && [[ $status == "$code" ]]; then cp out.txt "$expected"; fi
    if [[ $status != "$code" ]]; then
      echo "FAIL $tool/$name: exit code $status, not $code"; cat out.txt; ((++failed))
    elif [[ -f $expected ]] && agree "$expected" out.txt; then
      ((++passed))
    else
      echo "FAIL $tool/$name"; diff "$expected" out.txt; ((++failed))
    fi
  done < "$here/$tool/cases"
done
echo "$passed passed, $failed failed"
((failed == 0))
