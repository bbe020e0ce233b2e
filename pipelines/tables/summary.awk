# After figures.awk: what each method bought over the first of its scene. At equal time errors are
# variances, which fall with one over time: a method of 1/8 the error is eight times as fast. Both pay
# for their preprocessing.
function share(of, over, what,  times) {
  times = ratio(of, over)
  return times == "" ? "below the noise" : "1/" times what
}
END {
  for (s = 1; s <= scene_count; ++s) {
    scene = scenes[s]
    base = scene SUBSEP methods[scene, 1]
    for (m = 2; m <= method_count[scene]; ++m) {
      key = scene SUBSEP methods[scene, m]
      printf "bought    %s: %s in %.3g s (%s without the worst pixels)", methods[scene, m], \
             share(mean_relmse(base), mean_relmse(key), " of the error of " methods[scene, 1]), \
             time[key] / seeds[key], share(trimmed[base] / seeds[base], trimmed[key] / seeds[key])
      if (before[key] < time[key] && before[base] < time[base])
        printf "; %s with %.3g s of preprocessing in them", \
               share(at_total_time(base), at_total_time(key)), before[key] / seeds[key]
      else printf "; preprocessing took %.3g s", before[key] / seeds[key]
      print ""
    }
  }
}
