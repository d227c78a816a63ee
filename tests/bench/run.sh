#!/usr/bin/env bash
# Set-up, build, and the README's table and chart of what posing costs: measured by both builds of
# the solver, beside Ceres' trust region, the limit, CGAL and a read-sum. Run it on a quiet machine.
# Then bars posed beside CGAL's, with the picture of them. With a folder of Botsch and Sorkine's
# deformation survey (survey_NAME.off, .sel and .def) its models as well, into build/release/bench.
#   tests/bench/run.sh [SURVEY_FOLDER]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
./setup.sh --bench
cmake --preset release -D SUPPLE_TESTS=ON -D SUPPLE_BENCH=ON
cmake --build --preset release --target pose_bench speed_report beside_arap
results=build/release/bench
mkdir -p "$results"
measure() { # measure NAME: into NAME.json
  build/release/tests/pose_bench --benchmark_out="$results/$1.json" --benchmark_out_format=json
}
measure fast
GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2_Usable,-AVX2 measure baseline
build/release/tests/speed_report "$results"/{fast,baseline}.json README.md docs/pose_speed.png
build/release/tests/beside_arap "$results/bars"
cp "$results/bars/beside_arap.png" docs/beside_arap.png
(($# == 0)) || build/release/tests/beside_arap "$results/survey" "$1"
