# Writes ridges along z as OBJ, their sides at 60 degrees: awk -f washboard.awk
BEGIN {
  ridges = 40; width = 3 / ridges; height = width / 2 * sqrt(3)
  for (i = 0; i <= 2 * ridges; ++i)
    for (s = -1; s <= 1; s += 2) printf "v %.6f %.6f %g\n", -1.5 + i * width / 2, i % 2 * height, s
  for (i = 0; i < 2 * ridges; ++i)
    printf "f %d %d %d %d\n", 2 * i + 1, 2 * i + 2, 2 * i + 4, 2 * i + 3
}
