# A case that tests of the suite provoke: `scene` is a filter of their names.
judge_method() {
  attempt tests "$BIN/../tests/test_stability" --gtest_filter="$scene"
  judge tests tests.jq
}
