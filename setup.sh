#!/usr/bin/env bash
# Installs the Debian packages that are missing; does nothing where all are there.
#   ./setup.sh           what the build and the program need
#   ./setup.sh --tests   what the tests and their sanitizer build need as well
#   ./setup.sh --bench   what the benchmarks and their peers need as well
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache
  libeigen3-dev libceres-dev libnlopt-dev libopenblas0-pthread libtbb-dev libnanoflann-dev
  libosmesa6-dev libpng-dev libassimp-dev libyaml-cpp-dev libcli11-dev nlohmann-json3-dev libfmt-dev)
test_packages=(libgtest-dev clang libclang-rt-dev clang-format valgrind man-db)
bench_packages=(libgtest-dev libbenchmark-dev libcgal-dev)

case "${1-}" in
  '') ;;
  --tests) packages+=("${test_packages[@]}") ;;
  --bench) packages+=("${bench_packages[@]}") ;;
  *) echo "usage: ${0##*/} [--tests|--bench]" >&2; exit 2 ;;
esac

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  {
    echo "This is not Debian or one of its kind. Please install these, named as in Debian 12:"
    printf '  %s\n' "${packages[@]}"
  } >&2
  exit 1
fi

installed=$(dpkg-query --show --showformat='${Package}:${db:Status-Status}\n' \
  "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
  grep --quiet --line-regexp --fixed-strings "$package:installed" <<<"$installed" ||
    missing+=("$package")
done
((${#missing[@]} > 0)) || exit 0

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "These packages are missing; please install them as root: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update --quiet=2
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install --quiet=2 --yes --no-install-recommends "${missing[@]}"
