# After figures.awk: what mode auto keeps of its promises, per scene. Its error at equal time over
# that of the first method, which should be at most 1.05, and over that of the best of all fixed
# ones, at most 1.10; both also without the worst pixels. Each with its standard error over the seeds.
function error(key, kind) { return (kind == "all" ? relmse[key] : trimmed[key]) / seeds[key] }
# Squared, of the mean, relative to it.
function uncertainty(key, kind,   n, mean, squares) {
  n = seeds[key]; mean = error(key, kind)
  if (n < 2) return 0
  squares = (kind == "all" ? relmse_squares[key] : trimmed_squares[key]) / n - mean * mean
  return (squares > 0 ? squares : 0) / (n - 1) / (mean * mean)
}
function share(of, over, kind,   a, b, shown) {
  a = error(of, kind); b = error(over, kind)
  if (a <= 0 || b <= 0) return "below the noise"
  shown = sprintf("%.3f", a / b)
  if (of == over || seeds[of] < 2 || seeds[over] < 2) return shown
  return shown sprintf(" ± %.3f", a / b * sqrt(uncertainty(of, kind) + uncertainty(over, kind)))
}
function best(scene, kind,   m, key, least) {
  for (m = 1; m <= method_count[scene]; ++m) {
    key = scene SUBSEP methods[scene, m]
    if (methods[scene, m] == "auto") continue
    if (!least || error(key, kind) < error(least, kind)) least = key
  }
  return least
}
END {
  print "| scene | s | auto over " methods[scenes[1], 1] " | over the best | which | " \
        "trimmed: over " methods[scenes[1], 1] " | over the best | which |"
  print "|---|---|---|---|---|---|---|---|"
  for (s = 1; s <= scene_count; ++s) {
    scene = scenes[s]
    auto = scene SUBSEP "auto"
    if (!(auto in seeds)) continue
    printf "| %s | %.3g |", scene, time[auto] / seeds[auto]
    for (k = 1; k <= 2; ++k) {
      kind = k == 1 ? "all" : "trimmed"
      least = best(scene, kind)
      split(least, name, SUBSEP)
      printf " %s | %s | %s |", share(auto, scene SUBSEP methods[scene, 1], kind), \
             share(auto, least, kind), name[2]
    }
    print ""
  }
}
