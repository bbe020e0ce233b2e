# The smallest pipeline, and scenes and files that are wrong in one respect each; made once, in the
# folder that is copied for each golden case.
set -e

brdf-fit box.xml -o box.brdf --elevations 8 --quiet
photon-trace box.xml -o box.photons --count 20000 --quiet
cache-train --photons box.photons -o box.cache --photons-per-cell 2000 --quiet
photon-trace box.xml -o box.importons --from camera --count 10000 --quiet
cache-train --photons box.importons -o box.importance.cache --quiet
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

# variant NAME FROM TO: box.xml with one text for another.
variant() {
  sed "s|$2|$3|" box.xml > "$1.xml"
  ! cmp -s box.xml "$1.xml"
}
variant repainted 'value="0.7, 0.6, 0.5"' 'value="0.2, 0.6, 0.5"'
variant unknown '"roughconductor"' '"rufconductor"'
variant nan 'value="20, 18, 15"' 'value="nan, 18, 15"'
variant infinite 'name="fov" value="60"' 'name="fov" value="inf"'
variant negative 'value="20, 18, 15"' 'value="20, -18, 15"'
variant dark 'value="20, 18, 15"' 'value="0"'
variant flat '<scale x="0.5" y="0.4"/>' '<scale x="0.5" y="0"/>'
variant away 'target="0, 0.9, 0"' 'target="0, 1, 10"'
variant stare 'target="0, 0.9, 0"' 'target="0, 1, 3.4"'
variant mesh '<shape type="rectangle" id="screen">' \
  '<shape type="obj" id="screen"><string name="filename" value="screen.obj"/>'
variant unclosed '</scene>' ''
printf '<scene version="3.0.0"/>\n' > bare.xml

# Triangles of which one has no area.
printf 'v %s\n' '-1 -1 0' '1 -1 0' '1 1 0' '2 2 0' > screen.obj
printf 'f %s\n' '1 2 3' '1 3 4' >> screen.obj

# A table as image-compare writes it: two methods, one of them with two seeds.
{
  echo scene,method,seed,seconds,preprocess_seconds,spp,sample_ms,path_length,memory_bytes,relmse,relmse_trimmed,image,reference,preprocess_stats
  echo box,bsdf,1,1,,16,62.5,3.5,40000000,0.8,0.7,plain.exr,guided.exr,
  echo box,bsdf,1,2,,32,62.5,3.5,40000000,0.4,0.3,plain.exr,guided.exr,
  echo box,product,1,1,0.5,8,125,3,50000000,0.6,0.5,guided.exr,guided.exr,guided.json
  echo box,product,1,2,0.5,16,125,3,50000000,0.3,0.2,guided.exr,guided.exr,guided.json
  echo box,product,2,1,0.5,8,125,3,50000000,0.6,0.5,guided.exr,guided.exr,guided.json
  echo box,product,2,2,0.5,16,125,3,50000000,0.15,0.1,guided.exr,guided.exr,guided.json
} > report.csv

# A table of pipelines/stability.mk: a case that all pass, and one with a known failure.
{
  echo case,row,set,method,status,verdict,reason
  echo open,F1,surfaces,bsdf,pass,pass,
  echo open,F1,surfaces,product,pass,pass,
  echo 'slit,F3,surfaces,product,known,"cost 1.3","thin, <and> narrow"'
} > stability.csv
