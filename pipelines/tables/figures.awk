# What the tables of comparisons have in common: reads the tables of `image-compare --csv`. Figures
# are means over the seeds of the longest renders. "Counting preprocessing": variance falls with one
# over time, so with the time of preprocessing taken from that of rendering the error counts times
# seconds / (seconds - preprocessing).
BEGIN { FS = "," }
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
