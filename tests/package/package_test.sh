#!/usr/bin/env bash
# Installs a build into a folder, moves that, and uses it from there: the program, its man page and
# completion, and the CMake package from a project of its own.
#   package_test.sh BUILD FOLDER COMPILER
set -euo pipefail
build=$1 folder=$2 compiler=$3
source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
rm -rf "$folder"
cmake --install "$build" --prefix "$folder/first" >/dev/null
mv "$folder/first" "$folder/prefix"

# The build's own libraries must not be what is found.
"$folder/prefix/bin/supple" --version
found=$(ldd "$folder/prefix/bin/supple")
[[ $found == *"libsupple_solver.so => $folder/prefix/"* ]]
printf '0 0 0 1 0 0 0 1 0\n' >"$folder/triangle.raw"
[[ $("$folder/prefix/bin/supple" inspect "$folder/triangle.raw") == *"read by assimp"* ]]
man --warnings -E UTF-8 -l "$folder/prefix/share/man/man1/supple.1" >/dev/null 2>"$folder/man.txt"
[[ ! -s $folder/man.txt ]]

# completed WORD...: what the shell offers for the last one
completed() {
  bash -c 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _supple; echo "${COMPREPLY[*]}"' \
    - "$folder/prefix/share/bash-completion/completions/supple" "$folder/prefix/bin/supple" "$@"
}
[[ $(completed insp) == inspect ]]
[[ $(completed pose --hard) == --hard-handles ]]

cmake -S "$source" -B "$folder/project" -D CMAKE_PREFIX_PATH="$folder/prefix" \
  -D CMAKE_CXX_COMPILER="$compiler" >/dev/null
cmake --build "$folder/project" >/dev/null
"$folder/project/uses_supple"
