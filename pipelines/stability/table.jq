# The verdicts of all cases, each with its status: pass, fail, or known where the file `known`, a
# line `case | method | verdicts | reason` each, says why all that fails does.
def trim: sub("^\\s+"; "") | sub("\\s+$"; "");
def failing: . as $v | ["unbiased", "finite", "bounded", "harmless"]
  | map(select($v[.] != "pass" and $v[.] != "-"));
($known | split("\n") | map(select(test("^[^#].*\\|")) | split("|") | map(trim))) as $lines
| map(. as $v
  | ($lines | map(select(.[0] == $v.case and (.[1] == $v.method or .[1] == "*")
                         and ($v | failing) - (.[2] | split(" ")) == [])) | .[0][3]) as $reason
  | . + {status: (if .verdict == "pass" then "pass" elif $reason then "known" else "fail" end),
         reason: (if .verdict == "pass" then "" else $reason // "" end)})
