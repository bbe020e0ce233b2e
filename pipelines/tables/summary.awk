# After figures.awk: what each method bought over the first of its scene. At equal time errors are
# variances, which fall with one over time: a method of 1/8 the error is eight times as fast.
END {
  for (s = 1; s <= scene_count; ++s) {
    scene = scenes[s]
    base = scene SUBSEP methods[scene, 1]
    for (m = 2; m <= method_count[scene]; ++m) {
      key = scene SUBSEP methods[scene, m]
      printf "bought    %s: 1/%s of the error of %s in %.3g s (1/%s without the worst pixels)", \
             methods[scene, m], ratio(mean_relmse(base), mean_relmse(key)), methods[scene, 1], \
             time[key] / seeds[key], ratio(trimmed[base] / seeds[base], trimmed[key] / seeds[key])
      total = at_total_time(key)
      if (total > 0) printf "; 1/%s with %.3g s of preprocessing in them", \
                            ratio(mean_relmse(base), total), before[key] / seeds[key]
      else printf "; preprocessing took %.3g s", before[key] / seeds[key]
      print ""
    }
  }
}
