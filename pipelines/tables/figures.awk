# What the tables of comparisons have in common: reads the tables of `image-compare --csv`. Figures
# are arithmetic means over the seeds, of the longest render of each: the mean of squared errors is
# what a render is expected to have, and what a bright pixel of one seed adds is part of it. "Counting
# preprocessing": variance falls with one over time, so with the time of preprocessing taken from that
# of rendering the error counts times seconds / (seconds - preprocessing).
BEGIN { FS = ","; figure_count = split("seconds preprocess_seconds spp mse relmse relmse_trimmed", figures, " ") }
FNR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
{
  scene = $column["scene"]; method = $column["method"]; seconds = $column["seconds"] + 0
  if (!(scene in first)) { first[scene] = 1; scenes[++scene_count] = scene }
  key = scene SUBSEP method
  if (!(key in known)) { known[key] = 1; methods[scene, ++method_count[scene]] = method }
  run = key SUBSEP ("seed" in column ? $column["seed"] : "")
  if (!(run in key_of)) { key_of[run] = key; runs[++run_count] = run }
  if (seconds < longest[run]) next
  longest[run] = seconds
  for (i = 1; i <= figure_count; ++i) figure[run, figures[i]] = $column[figures[i]]
}
END {
  for (r = 1; r <= run_count; ++r) {
    run = runs[r]; key = key_of[run]
    ++seeds[key]
    time[key] += figure[run, "seconds"]
    before[key] += figure[run, "preprocess_seconds"]
    spp[key] += figure[run, "spp"]
    mse[key] += figure[run, "mse"]
    relmse[key] += figure[run, "relmse"]
    trimmed[key] += figure[run, "relmse_trimmed"]
    relmse_squares[key] += figure[run, "relmse"] ^ 2
    trimmed_squares[key] += figure[run, "relmse_trimmed"] ^ 2
  }
}
# Mean relMSE as it would be with the time of preprocessing taken from that of rendering.
function at_total_time(key) {
  return before[key] < time[key] ? relmse[key] / seeds[key] * time[key] / (time[key] - before[key]) : -1
}
# Errors below the noise of the reference, when that is taken out of them, have no ratio.
function ratio(of, over) { return over > 0 && of > 0 ? sprintf("%.3g", of / over) : "" }
function mean_relmse(key) { return key in seeds ? relmse[key] / seeds[key] : -1 }
