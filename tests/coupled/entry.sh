#!/usr/bin/env bash
# A wedge enters calm water with constant velocity, without gravity: its force, the pressure on its face and where the jet's root is are those of the
# self-similar potential flow (entry_reference.py), no water is inside, momentum is closed.
# Usage: entry.sh ROOT BUILD [long | fall | DEADRISE DEPTH [launch.sh arguments]]
# long: rows of SOLIDS_AMONG_PHASES.md, too; fall: one of a wedge of 70 kg/m that is free to move down; DEADRISE (degrees) DEPTH (m): one such row
set -euo pipefail
source "$(dirname "$0")/run.sh"
limit=3000
cp "$here"/entry.{geo,yaml} "$scratch"
enter() { # label deadrise depth [launch.sh arguments]
  case=$scratch/$2.yaml
  gmsh -2 -setnumber deadrise "$2" "$scratch/entry.geo" -o "$scratch/$2.msh" >/dev/null
  sed "s/entry.msh/$2.msh/" "$scratch/entry.yaml" >"$case"
  local arguments=()
  mapfile -t arguments < <("$python" "$here/entry.py" "$2" "$3")
  must "$2 $1" 1:1:1 --set "${arguments[0]}" --set "${arguments[1]}" "${@:4}"
}
coarse=(--set fluid.adapt.size_min=0.02 --set fluid.adapt.interface_size=0.04)
case ${1:-} in
  fall) enter fall 30 0.1 --set time.end=0.14 --set "solid.bodies[0]={mesh: 30.msh, material: wedge, velocity: [0.0, -1.0], prescribed: [{velocity: [0, 0], component: x}]}" "${@:2}" ;;
  [0-9]*) enter tried "$1" "$2" "${@:3}" ;;
  *) enter "le 0.02" 30 0.1 "${coarse[@]}" ;;&
  long)
    enter "le 0.01" 30 0.1
    enter "le 0.01" 20 0.06
    enter "le 0.01" 45 0.15
    ;;
esac
"$python" "$here/entry.py" "$scratch"
