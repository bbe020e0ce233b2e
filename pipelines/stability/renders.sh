# A case that is rendered by every method: caches, a reference, and SEEDS renders of each.

scene=$here/scenes/$scene

# stage OUTPUT TOOL ARGUMENTS...: makes a file and checks every number in it.
stage() {
  attempt caches "$BIN/$2" "${@:3}" -o "$folder/$1" --threads 1 --stats "$folder/$1.json" --quiet &&
    attempt caches "$BIN/cache-info" "$folder/$1" --check
}

make_caches() {
  stage scene.brdf brdf-fit "$scene" $flags --elevations 16 --directions 64 &&
    stage scene.photons photon-trace "$scene" $flags --count "$photons" &&
    stage scene.cache cache-train --photons "$folder/scene.photons" ${CACHE_TRAIN_FLAGS:-} &&
    stage reduced.cache cache-reduce "$folder/scene.cache" &&
    stage reduced.brdf cache-reduce "$folder/scene.brdf"
}

# render_one NAME SAMPLES SEED FLAGS...
render_one() {
  attempt "$1" "$BIN/render" "$scene" -o "$folder/$1.exr" --stats "$folder/$1.json" --size "$SIZE" \
    --threads 1 --aov variance --spp "$2" --seed "$3" "${@:4}" --quiet
}

cache_flags() {
  [[ $1 == *cache* ]] && echo "--cache $folder/reduced.cache"
  [[ $1 == *brdf* ]] && echo "--brdf $folder/reduced.brdf"
}

# No more of a method that failed, or whose caches did.
render_seed() {
  [[ $caches != - && -e $folder/caches.failed ]] && cp "$folder/caches.failed" "$folder/$method.failed"
  [[ -e $folder/$method.failed ]] && return
  render_one "$method-$1" "$spp" "$1" $flags $how $(cache_flags "$caches") ||
    mv "$folder/$method-$1.failed" "$folder/$method.failed"
}

# Seed by seed, so that what else the machine does falls on all methods alike.
render_all() {
  for ((seed = 1; seed <= SEEDS; ++seed)); do
    while read -r _ method caches how; do render_seed "$seed"; done < <(methods)
  done
}

# compare WHAT TILE FLOOR: the mean of all seeds of the method, to METHOD.WHAT.json.
compare() {
  local repeats=() output=$folder/$method.$1.json
  for ((seed = 2; seed <= SEEDS; ++seed)); do repeats+=(--repeat "$folder/$method-$seed.exr"); done
  attempt "$method" "$BIN/image-compare" "$folder/$method-1.exr" "$folder/reference.exr" \
    "${repeats[@]}" --z self --tile "$2" --z-floor "$3" --json
}

# Figures of the method, or null where it failed; nothing can be judged without the reference.
figures() {
  [[ -e $folder/reference.failed ]] && cat "$folder/reference.failed" >> "$folder/$method.failed"
  if [[ ! -e $folder/$method.failed ]] && compare tiles 8 0.01 && compare image 4096 0; then
    cat "$folder/$method".{tiles,image}.json "$folder/reference.json" "$folder/$method"-[0-9]*.json |
      jq -s .
  else
    echo null
  fi
}

judge_method() {
  figures > "$folder/$method.json"
  judge "$method" renders.jq --argjson longest "$longest" --slurpfile of "$folder/$method.json" \
    --slurpfile base "$folder/bsdf.json"
}

make_caches
read -r _ _ caches how < <(methods | awk -v method="$reference_method" '$2 == method')
render_one reference "$reference_spp" 1000003 ${reference:-$flags} $how $(cache_flags "$caches")
render_all
