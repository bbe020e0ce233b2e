#!/bin/sh
# Meshes and grids of the cases: inputs.sh FOLDER BIN
set -eu
here=$(dirname "$0")
folder=$1 bin=$2
mkdir -p "$folder"
awk -f "$here/../scenes/torus.awk" -v major=1 -v minor=0.09 -v height=2.6 -v rings=48 -v sides=12 \
  > "$folder/ring.obj"
awk -f "$here/washboard.awk" > "$folder/washboard.obj"
for damage in sound degenerate zero-normals flipped-normals duplicate-faces; do
  awk -f "$here/box.awk" -v damage=$damage > "$folder/$damage.obj"
done
"$bin/make-cloud" -o "$folder/cloud.vdb" --resolution 32 --quiet

# vol FILE: a grid of 8 x 8 x 8 bytes from the standard input, in the box of make-cloud.
vol() {
  {
    printf 'VOL\003\003\000\000\000\010\000\000\000\010\000\000\000\010\000\000\000\001\000\000\000'
    printf '\000\000\200\277\232\231\031\277\000\000\100\277\000\000\200\077\232\231\031\077\000\000\100\077'
    cat
  } > "$1"
}
head -c 512 /dev/zero | vol "$folder/empty.vol"
# Blocks of full density beside nothing.
awk 'BEGIN { for (z = 0; z < 8; ++z) for (y = 0; y < 8; ++y) for (x = 0; x < 8; ++x)
  printf "%s", (int(x / 2) + int(y / 2) + int(z / 2)) % 2 ? "\177" : "0" }' | tr '0' '\000' |
  vol "$folder/blocks.vol"
