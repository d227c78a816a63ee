#!/usr/bin/env bash
# From a fresh clone to the first pose: set-up, build, and a real mesh bent by its handles. Writes
# into out/. The mesh comes out of Debian's libcgal-demo archive, which is fetched once and not
# installed; where it cannot be had, a bar made in code takes its place.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
data=build/data

fetch_armadillo() {
  local folder=$data/download
  rm -rf "$folder" && mkdir -p "$folder"
  (cd "$folder" && apt-get --quiet=2 -o APT::Sandbox::User=root download libcgal-demo) &&
    dpkg-deb --fsys-tarfile "$folder"/libcgal-demo_*.deb |
      tar --extract --to-stdout ./usr/share/doc/libcgal-dev/data.tar.gz |
      tar --extract --gzip --directory "$folder" data/meshes/armadillo.off &&
    mv "$folder/data/meshes/armadillo.off" "$data/armadillo.off"
  local status=$?
  rm -rf "$folder"
  return $status
}

pose() {
  local name=$1
  shift
  local command=(build/release/supple pose "examples/$name/scene.yaml" -o "out/$name.off"
    --picture "out/$name.png" --report "out/$name.json" "$@")
  echo "${command[*]}"
  "${command[@]}"
  ls -l out/"$name".*
}

./setup.sh
cmake --preset release -D SUPPLE_TESTS=OFF
cmake --build --preset release --target supple

mkdir -p "$data" out
examples/make_bar.sh >"$data/bar.off"
if [[ -f $data/armadillo.off ]] || fetch_armadillo; then
  pose pose_armadillo --camera 205,12
else
  echo "Debian's libcgal-demo archive cannot be had here: posing a bar made in code instead."
  pose bent_bar
fi
