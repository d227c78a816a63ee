#!/usr/bin/env bash
# Hard case B12: all files of two collections that Debian packages are posed gently: shapes of many
# formats, dirty, broken and hostile ones among them, and what is no shape. None may crash or take
# more than 4 GB; each ends as endings.txt says: ok, degraded or failed with its reasons, refused
# with its exit code (4: the importer died), or, two of hundreds of crossing parts, not in 20 s.
#   tests/corpora/run.sh PROGRAM FOLDER           compares; shapes are fetched into FOLDER once
#   tests/corpora/run.sh PROGRAM FOLDER --store   writes endings.txt anew
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$(realpath "$1")
mkdir -p "$2" && cd "$2"

fetch() {
  rm -rf download && mkdir download
  (cd download && apt-get --quiet=2 -o APT::Sandbox::User=root download assimp-testmodels libcgal-demo)
  dpkg-deb --extract download/assimp-testmodels_*.deb download
  dpkg-deb --fsys-tarfile download/libcgal-demo_*.deb |
    tar --extract --to-stdout ./usr/share/doc/libcgal-dev/data.tar.gz |
    tar --extract --gzip --directory download
  mkdir shapes
  mv download/usr/share/assimp/models shapes/assimp
  mv download/data shapes/cgal
  rm -rf download
}

# ending FILE: how posing it ended, as a line.
ending() {
  local work status
  work=$(mktemp --directory)
  status=0
  (
    ulimit -v $((4 << 20))
    timeout 20 "$program" pose "$1" --fix 'y<10%' --move 'y>90%' --by 5%,0,0 --quiet \
      -o "$work/posed.ply" --report "$work/report.json" >"$work/words" 2>&1
  ) || status=$?
  case $status in
    0 | 1) printf '%s\t%s\n' "$1" "$(status_and_reasons "$work/report.json")" ;;
    2 | 3 | 4) printf '%s\trefused %d\n' "$1" $status ;;
    124) printf '%s\ttook more than 20 s\n' "$1" ;;
    *) printf '%s\tcrashed %d\n' "$1" $status ;;
  esac
  rm -rf "$work"
}

status_and_reasons() {
  grep --quiet '\bnan\|\binf' "$1" && echo 'not finite' && return
  sed --quiet --regexp-extended \
    -e 's/^  "status": "(.*)",/\1/p' -e '/^  "reasons": \[/,/^  \]/ s/^ *"([a-z_]+)",?$/\1/p' "$1" |
    uniq | paste --serial --delimiters=' '
}

[[ -d shapes ]] || fetch
export program
export -f ending status_and_reasons
find shapes -type f | LC_ALL=C sort |
  xargs --delimiter='\n' --max-args=1 --max-procs="$(nproc)" bash -c 'ending "$0"' |
  LC_ALL=C sort >endings.txt

if [[ ${3-} == --store ]]; then
  cp endings.txt "$here/endings.txt"
else
  diff "$here/endings.txt" endings.txt
  echo "$(wc -l <endings.txt) shapes ended as stored"
fi
