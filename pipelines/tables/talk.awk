# Table of a comparison of the talk on volume guiding, Markdown, with the talk's own figures on top:
#   awk -f figures.awk -f talk.awk -v wanted='none distance' -v talk='960:1.342 424:0.901' \
#     -v minutes=45 TABLE.csv...
# wanted: methods, of which the first is compared with; talk: SPP:relMSE of each, or - where it has none.
# "÷" says how many times smaller the relMSE is than that of the first method at equal rendering
# time; "with training" the same at equal total time, of which both take their training.
function talk_row(i,  figures, base) {
  if (split(quoted[i], figures, ":") < 2) return
  split(quoted[1], base, ":")
  printf "| the talk | %s | | %d | | %d | %s | | %s | |\n", shown[i], 60 * minutes, figures[1],
    figures[2], ratio(base[2], figures[2])
}
function row(scene, i,  key, base, n) {
  key = scene SUBSEP shown[i]; base = scene SUBSEP shown[1]
  if (!(key in seeds)) return
  n = seeds[key]
  printf "| %s | %s | %d | %.0f | %.0f | %.0f | %.3g | %.3g | %s | %s |\n", scene, shown[i], n,
    time[key] / n, before[key] / n, spp[key] / n, relmse[key] / n, trimmed[key] / n,
    ratio(mean_relmse(base), mean_relmse(key)), ratio(at_total_time(base), at_total_time(key))
}
END {
  count = split(wanted, shown, " "); split(talk, quoted, " ")
  title = shown[1]
  for (i = 2; i <= count; ++i) title = title " → " shown[i]
  printf "### %s\n\n", title
  print "| scene | method | seeds | seconds | training | SPP | relMSE | trimmed | ÷ | ÷ with training |"
  print "|---|---|---|---|---|---|---|---|---|---|"
  for (i = 1; i <= count; ++i) talk_row(i)
  for (s = 1; s <= scene_count; ++s)
    for (i = 1; i <= count; ++i) row(scenes[s], i)
  print ""
}
