# The smallest pipeline, run once in the folder of the golden cases.
set -e
brdf-fit box.xml -o box.brdf --elevations 8 --quiet
photon-trace box.xml -o box.photons --count 20000 --quiet
cache-train --photons box.photons -o box.cache --photons-per-cell 2000 --quiet
cache-reduce box.cache -o reduced.cache --quiet
cache-reduce box.brdf -o reduced.brdf --quiet
render box.xml -o plain.exr --spp 16 --aov variance --png plain.png --quiet
render box.xml -o guided.exr --mode product --cache reduced.cache --brdf reduced.brdf --spp 16 \
  --aov all --stats guided.json --quiet
head -c 2000 box.cache > truncated.cache
head -c 3000 box.photons > truncated.photons
head -c 700 box.brdf > truncated.brdf
printf 'not one of ours, but long enough to be read as if it were' > noise.bin
: > empty.bin
