# Table of a comparison, Markdown, from the tables of `image-compare --csv`.
#   awk -f equal-time.awk [-v base=bsdf] [-v other=illumination] TABLE.csv...
# Figures are means over the seeds of the longest renders. "base / relMSE" says how many times smaller
# the error is than that of `base` at equal rendering time; "with preprocessing" the same at equal
# total time: variance falls with one over time, so the error counts times
# seconds / (seconds - preprocessing).
BEGIN { FS = ","; if (!base) base = "bsdf"; if (!other) other = "illumination" }
FNR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
  scene = $column["scene"]; method = $column["method"]; seconds = $column["seconds"] + 0
  if (!(scene in first)) { first[scene] = 1; scenes[++scene_count] = scene }
  key = scene SUBSEP method
  if (!(key in longest)) methods[scene, ++method_count[scene]] = method
  if (seconds > 1.5 * longest[key]) {  # a longer time begins
    longest[key] = seconds
    seeds[key] = time[key] = before[key] = spp[key] = mse[key] = relmse[key] = trimmed[key] = 0
  } else if (seconds < longest[key] / 1.5) next
  ++seeds[key]
  time[key] += seconds
  before[key] += $column["preprocess_seconds"]
  spp[key] += $column["spp"]
  mse[key] += $column["mse"]
  relmse[key] += $column["relmse"]
  trimmed[key] += $column["relmse_trimmed"]
}
# Mean relMSE as it would be with the time of preprocessing taken from that of rendering.
function at_total_time(key) {
  return before[key] < time[key] ? relmse[key] / seeds[key] * time[key] / (time[key] - before[key]) : -1
}
function ratio(of, over) { return over > 0 && of > 0 ? sprintf("%.3g", of / over) : "" }
function mean_relmse(key) { return key in seeds ? relmse[key] / seeds[key] : -1 }
END {
  printf "| scene | method | seeds | seconds | preprocessing | spp | MSE | relMSE | trimmed |"
  printf " %s ÷ | %s ÷ | %s ÷ with preprocessing |\n", base, other, base
  print "|---|---|---|---|---|---|---|---|---|---|---|---|"
  for (s = 1; s <= scene_count; ++s)
    for (m = 1; m <= method_count[scenes[s]]; ++m) {
      method = methods[scenes[s], m]; key = scenes[s] SUBSEP method; n = seeds[key]
      printf "| %s | %s | %d | %.0f | %.0f | %.0f | %.3g | %.3g | %.3g | %s | %s | %s |\n",
        m == 1 ? scenes[s] : "", method, n, time[key] / n, before[key] / n, spp[key] / n,
        mse[key] / n, relmse[key] / n, trimmed[key] / n,
        ratio(mean_relmse(scenes[s] SUBSEP base), mean_relmse(key)),
        ratio(mean_relmse(scenes[s] SUBSEP other), mean_relmse(key)),
        ratio(mean_relmse(scenes[s] SUBSEP base), at_total_time(key))
    }
}
