# A ladder of lobes, fitted with each method; their reports are judged.
judge_method() {
  attempt "$method" "$BIN/brdf-fit" "$here/scenes/$scene" -o "$folder/$method.brdf" $how --tolerance 0 \
    --elevations "$ENTRIES" --directions "$ENTRIES" --threads 1 --report "$folder/$method.csv" --quiet &&
    attempt "$method" "$BIN/cache-info" "$folder/$method.brdf" --check
  judge "$method" fits.jq --rawfile report "$folder/$method.csv"
}
