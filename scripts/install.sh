#!/usr/bin/env bash
# Installs what Waylight needs from Debian's packages and builds it (Release, build/).
#   scripts/install.sh [cmake options]
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(
  libembree-dev libopenexr-dev libopenvdb-dev libboost-iostreams-dev libceres-dev
  libcli11-dev libflatbuffers-dev flatbuffers-compiler libtbb-dev libeigen3-dev libpugixml-dev
  libtinyobjloader-dev libstb-dev libfmt-dev nlohmann-json3-dev zlib1g-dev libxxhash-dev
  libgtest-dev libbenchmark-dev cmake ninja-build g++ make gnuplot-nox jq
)
missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if ((${#missing[@]})); then
  echo "installing: ${missing[*]}"
  apt-get update -q
  DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
fi
cmake --preset release "$@"
cmake --build build
