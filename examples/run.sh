#!/usr/bin/env bash
# From a fresh clone to the first poses: set-up, build, and real shapes bent by their handles: a
# closed mesh, a mesh with holes, a scan without faces. Writes into out/. The shapes come out of
# Debian's libcgal-demo archive, which is fetched once and not installed; where it cannot be had, a
# bar made in code takes their place.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
data=build/data

shapes=(meshes/armadillo.off meshes/elephant-with-holes.off points_3/kitten.xyz)

have_shapes() {
  local shape
  for shape in "${shapes[@]}"; do [[ -f $data/${shape##*/} ]] || return 1; done
}

fetch_shapes() {
  local folder=$data/download
  rm -rf "$folder" && mkdir -p "$folder"
  (cd "$folder" && apt-get --quiet=2 -o APT::Sandbox::User=root download libcgal-demo) &&
    dpkg-deb --fsys-tarfile "$folder"/libcgal-demo_*.deb |
      tar --extract --to-stdout ./usr/share/doc/libcgal-dev/data.tar.gz |
      tar --extract --gzip --directory "$folder" "${shapes[@]/#/data/}" &&
    mv "${shapes[@]/#/$folder/data/}" "$data"
  local status=$?
  rm -rf "$folder"
  return $status
}

# pose NAME EXTENSION [OPTION...]: the example of that name, into out/
pose() {
  local name=$1 output=out/$1.$2
  shift 2
  local command=(build/release/supple pose "examples/$name/scene.yaml" -o "$output"
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
if have_shapes || fetch_shapes; then
  pose pose_armadillo off --camera 205,12
  pose pose_holes off --camera 60,10
  pose pose_scan ply --camera 30,10
else
  echo "Debian's libcgal-demo archive cannot be had here: posing a bar made in code instead."
  pose bent_bar off
fi
