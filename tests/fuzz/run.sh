#!/usr/bin/env bash
# Fuzzes our readers, each for so many seconds, all at once, from what earlier runs found worth
# keeping; a finding stays in FOLDER.
#   tests/fuzz/run.sh [SECONDS [FOLDER]]
# To keep what a run found: build/asan/tests/TARGET_fuzz -set_cover_merge=1 -max_len=700 NEW
# FOLDER/TARGET, and pack NEW as corpus/TARGET.tar.gz.
# The targets are those of the sanitizer build: cmake --preset asan; cmake --build --preset asan
set -euo pipefail
seconds=${1-60}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=${2-$root/build/asan/fuzz}

mkdir -p "$folder"
declare -A runs
for target in meshes gltf scenes; do
  mkdir -p "$folder/$target"
  tar -C "$folder/$target" -xf "$root/tests/fuzz/corpus/$target.tar.gz"
  "$root/build/asan/tests/${target}_fuzz" -max_total_time="$seconds" -timeout=10 \
    -rss_limit_mb=2048 -max_len=20000 -print_final_stats=1 -artifact_prefix="$folder/$target-" \
    "$folder/$target" "$root/tests/fuzz/corpus/$target" &>"$folder/$target.log" &
  runs[$target]=$!
done

failed=0
for target in "${!runs[@]}"; do
  if wait "${runs[$target]}"; then
    echo "$target: $(sed -n 's/^stat::number_of_executed_units: //p' "$folder/$target.log") inputs, no finding"
  else
    failed=1
    echo "$target: see $folder/$target.log"
    tail -n 40 "$folder/$target.log"
  fi
done
exit $failed
