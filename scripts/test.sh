#!/usr/bin/env bash
# Installs, builds and runs all tests. `scripts/test.sh -LE slow` leaves the slow ones out.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install.sh -DWAYLIGHT_TESTS=ON
ctest --test-dir build --output-on-failure -j "$(nproc)" "$@"
