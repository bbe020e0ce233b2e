# The verdicts of all cases, each with its status: pass, fail, or known where the file `known`, a
# line `case | method | reason` each, says why it fails.
def trim: sub("^\\s+"; "") | sub("\\s+$"; "");
($known | split("\n") | map(select(test("^[^#].*\\|")) | split("|") | map(trim))) as $lines
| map(. as $v
  | ($lines | map(select(.[0] == $v.case and (.[1] == $v.method or .[1] == "*"))) | .[0][2]) as $reason
  | . + {status: (if .verdict == "pass" then "pass" elif $reason then "known" else "fail" end),
         reason: (if .verdict == "pass" then "" else $reason // "" end)})
