# Writes a torus as OBJ with smooth normals:
#   awk -f torus.awk -v major=1 -v minor=0.2 -v height=1 -v rings=192 -v sides=64
# major: radius of the ring; minor: radius of its section, stretched by `height` along the axis (y).
BEGIN {
  pi = atan2(0, -1)
  for (i = 0; i < rings; ++i)
    for (j = 0; j < sides; ++j) {
      a = 2 * pi * i / rings; b = 2 * pi * j / sides
      r = major + minor * cos(b)
      printf "v %.6f %.6f %.6f\n", r * cos(a), minor * height * sin(b), r * sin(a)
      nx = cos(b); ny = sin(b) / height; n = sqrt(nx * nx + ny * ny)
      printf "vn %.6f %.6f %.6f\n", nx / n * cos(a), ny / n, nx / n * sin(a)
    }
  for (i = 0; i < rings; ++i)
    for (j = 0; j < sides; ++j) {
      p = i * sides + j + 1;             q = i * sides + (j + 1) % sides + 1
      s = (i + 1) % rings * sides + j + 1; t = (i + 1) % rings * sides + (j + 1) % sides + 1
      printf "f %d//%d %d//%d %d//%d %d//%d\n", p, p, q, q, t, t, s, s
    }
}
