#!/usr/bin/env bash
# Counts calls by callgrind and allocations by dhat: a pose that asks for no effect beside handles and
# rigidity executes no function of the others, allocates no byte by them and takes one step; one that
# asks for each of them does.
#   only_what_is_called.sh PROGRAM FOLDER
set -euo pipefail
program=$1
folder=$2
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
mkdir -p "$folder"
cd "$folder"
"$source"/examples/make_bar.sh >bar.off
cat >pose.yaml <<'SCENE'
shape: {mesh: bar.off, particles: 40, coupling: straight}
pose:
  substeps: 1
  weights: {volume: 0}
  handles:
    - fix: y<10%
    - {move: y>90%, by: [2%, 0, 0]}
SCENE

# What an effect's functions are called, and what asks for it.
effects=(
  'VolumeEnergy::(add_square|evaluate)|pose.weights.volume=1'
  'HardConstraints::|pose.hard_handles=true'
  'InversionBarrier::evaluate|pose.no_inversion=true'
  'RegionBlend::|pose.region=y<200%'
  'stiffness_factors|pose.stiffness=[{select: y>50%, times: 3}]'
  'mirrored_handle|pose.mirror={normal: [1, 0, 0]}'
  'fill_gaps|'
  'fit_pose|'
  '::repair|'
  'InsideDetours::|shape.coupling=inside'
  'nlopt_|pose.solver=nlopt'
  'minimize_trust_region|pose.solver=trust_region'
)

# called NAME [SETTING]: the functions that a pose executed
called() {
  local name=$1
  shift
  valgrind --tool=callgrind --callgrind-out-file="$name.out" --quiet \
    "$program" pose pose.yaml --threads 1 --quiet --allow-degraded "$@" -o posed.off \
    >"$name.log" 2>&1 || { cat "$name.log" >&2; return 1; }
  grep -oE '^c?fn=\([0-9]+\) .*' "$name.out" | sed -E 's/^c?fn=\([0-9]+\) //' | sort -u >"$name.txt"
}

failures=0
complain() {
  echo "$1" >&2
  failures=$((failures + 1))
}

# allocating NAME: the functions that allocated memory in that pose, or called what did
allocating() {
  valgrind --tool=dhat --num-callers=50 --dhat-out-file="$1.dhat" \
    "$program" pose pose.yaml --threads 1 --quiet --allow-degraded -o posed.off \
    >"$1.log" 2>&1 || { cat "$1.log" >&2; return 1; }
  sed -n '/"ftbl"/,$p' "$1.dhat" | sort -u
}

# times FUNCTION NAME: how often the pose of that name called it
times() {
  awk -v name="$1" '
    /^c?fn=/ && match($0, /\([0-9]+\)/) {
      id = substr($0, RSTART, RLENGTH)
      if (index($0, name)) wanted[id] = 1
      if (/^cfn=/) callee = id
    }
    /^calls=/ { if (callee in wanted) count += substr($1, 7) }
    END { print count + 0 }' "$2.out"
}

called plain
(($(times PoseSolver::step plain) == 1)) || complain 'a plain pose takes more steps than one'
called asked --set pose.substeps=3
(($(times PoseSolver::step asked) == 3)) || complain 'pose.substeps=3 does not take three steps'
grep -q 'RigidityEnergy::add_square' plain.txt || complain 'the rigidity is not seen: no names?'
allocating plain >plain_allocating.txt
grep -q 'EnergySum::add' plain_allocating.txt || complain 'no allocation is seen: no names?'
for effect in "${effects[@]}"; do
  pattern=${effect%|*} setting=${effect##*|}
  if grep -E "$pattern" plain.txt; then complain "a plain pose calls $pattern"; fi
  if grep -E "$pattern" plain_allocating.txt; then complain "a plain pose allocates by $pattern"; fi
  [[ -n $setting ]] || continue
  called asked --set "$setting"
  grep -qE "$pattern" asked.txt || complain "$setting does not call $pattern"
done
echo "$(wc -l <plain.txt) functions, ${#effects[@]} effects, $failures failures"
((failures == 0))
