# Writes a box as OBJ with normals, sound or damaged in one respect:
#   awk -f box.awk -v damage=sound|degenerate|zero-normals|flipped-normals|duplicate-faces
function corner(c, axis) { return int(c / 2 ^ axis) % 2 ? 1 : -1 }
function face(a, b, c, n) {
  printf "f %d//%d %d//%d %d//%d\n", a + 1, n, b + 1, n, c + 1, n
}
# Corners a, a + p, a + p + q, a + q; normal number n.
function side(a, p, q, n) {
  face(a, a + p, a + p + q, n)
  face(a, a + p + q, a + q, n)
  if (damage == "degenerate") { face(a, a, a + p, n); face(a, 8, a + p, n) }
  if (damage == "duplicate-faces") { face(a, a + p, a + p + q, n); face(a, a + p + q, a + q, n) }
}
BEGIN {
  length_of_normal = damage == "zero-normals" ? 0 : damage == "flipped-normals" ? -1 : 1
  for (c = 0; c < 8; ++c)
    printf "v %.6f %.6f %.6f\n", -0.3 + 0.4 * corner(c, 0), 0.45 + 0.4 * corner(c, 1), 0.4 * corner(c, 2)
  print "v -0.7 0.05 -0.4"  # the first corner again
  for (axis = 0; axis < 3; ++axis)
    for (s = -1; s <= 1; s += 2)
      printf "vn %g %g %g\n", (axis == 0) * s * length_of_normal, (axis == 1) * s * length_of_normal,
        (axis == 2) * s * length_of_normal
  side(0, 4, 2, 1); side(1, 2, 4, 2)
  side(0, 1, 4, 3); side(2, 4, 1, 4)
  side(0, 2, 1, 5); side(4, 1, 2, 6)
}
