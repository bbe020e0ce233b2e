# After figures.awk: what mode auto keeps of its promises, per scene. Its error at equal time over
# that of the first method, which should be at most 1.05, and over that of the best of all fixed
# ones, at most 1.10; both also without the worst pixels.
function share(of, over) { return of > 0 && over > 0 ? sprintf("%.3f", of / over) : "below the noise" }
function error(key, kind) { return (kind == "all" ? relmse[key] : trimmed[key]) / seeds[key] }
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
      base = scene SUBSEP methods[scene, 1]
      least = best(scene, kind)
      split(least, name, SUBSEP)
      printf " %s | %s | %s |", share(error(auto, kind), error(base, kind)), \
             share(error(auto, kind), error(least, kind)), name[2]
    }
    print ""
  }
}
