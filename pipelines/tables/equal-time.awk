# Table of a comparison, Markdown, from the tables of `image-compare --csv`.
#   awk -f figures.awk -f equal-time.awk [-v base=bsdf] [-v other=illumination] TABLE.csv...
# "base ÷" says how many times smaller the relMSE is than that of `base` at equal rendering time;
# "with preprocessing" the same at equal total time, of which both take their preprocessing.
BEGIN { if (!base) base = "bsdf"; if (!other) other = "illumination" }
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
        ratio(at_total_time(scenes[s] SUBSEP base), at_total_time(key))
    }
}
