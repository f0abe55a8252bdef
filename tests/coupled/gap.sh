#!/usr/bin/env bash
# Viscous flow through a crack between held blocks and through an array of held discs (gap.py): the crack's hydraulic width is its width within 0.26 of
# an element, the drag on a disc that of Sangani and Acrivos (1982) within 10 % where it has 10 elements a diameter and 2.5 in the gap.  With a case prints its row; long: the rows of
# README.md.  Usage: gap.sh ROOT BUILD [long|CASE of gap.py [launch.sh arguments]]
set -euo pipefail
source "$(dirname "$0")/run.sh"
limit=1800 case=$scratch/gap.yaml failed=0
cp "$here/gap.yaml" "$scratch"

# row CASE... [--set ...]
row() {
  local kind=() keys=()
  while (($#)) && [[ $1 != --* ]]; do kind+=("$1") && shift; done
  "$python" "$here/gap.py" keys "$scratch" "${kind[@]}" >"$scratch/keys"
  while read -r key; do keys+=(--set "$key"); done <"$scratch/keys"
  must gap 1:1:1 "${keys[@]}" "$@"
  "$python" "$here/gap.py" row "$scratch" gap "${kind[@]}" || failed=1
}

if ((!$#)); then
  row crack 4 1 0
  row crack 4 1 20
  row array 0.5 10
elif [[ $1 == long ]]; then
  for n in 2 4 8 16; do
    row wall "$n"
    for angle in 0 20; do row crack "$n" 1 "$angle"; done
  done
  for width in 0.5 0.25; do row crack 8 "$width" 0; done
  for n in 10 20 40; do
    for c in 0.1 0.3 0.5; do row array "$c" "$n"; done
  done
  for n in 2 4 8; do
    for length in 1 2; do row piston "$n" "$length"; done
  done
else
  row "$@"
fi
exit "$failed"
