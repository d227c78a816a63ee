#!/usr/bin/env bash
# Set-up, build, all tests. Arguments go to ctest: tests/run.sh -R Picture
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
./setup.sh --tests
cmake --preset release -D SUPPLE_TESTS=ON
cmake --build --preset release
ctest --preset release "$@"
