#!/usr/bin/env bash
# What goes wrong while a run runs is said for what it is: a full disk, no memory, a mesh of two components, a body that falls apart or leaves; and
# snapshots cost the hundredth time what they cost the first.  Usage: attacks.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/../coupled/run.sh"
fail() { echo "$1: $2"; cat "$scratch/$1.log"; exit 1; }
# stops NAME EXPECTED launch.sh's arguments: the run ends with one error that says this
stops() {
  local name=$1 expect=$2
  shift 2
  ! run "$name" 1:1:1 "$@" || fail "$name" 'the run ended as if all were well'
  [ "$(grep -c 'error:' "$scratch/$name.log")" -eq 1 ] && grep -q "error: .*$expect" "$scratch/$name.log" || fail "$name" "expected one error: $expect"
}

# programs that may write files of so many KiB, have so many KiB of memory
limited() { printf '#!/bin/bash\ntrap "" XFSZ\nulimit %s %s\nexec %s/fluid/coracle-fluid "$@"\n' "$1" "$2" "$build" >"$scratch/limited$1" && chmod +x "$scratch/limited$1"; }
build=$(realpath "$build")
limited -f 5000
stops full 'fluid.h5.*File too large\|write failed' --fluid "$scratch/limited-f" --set fluid.mesh.size_max=0.02 --set output.every=0.01 --set output.checkpoint=0
limited -v 1000000
stops memory 'out of memory: this rank has had up to [0-9]* MB; a coarser mesh' --fluid "$scratch/limited-v" --set fluid.mesh.size_max=0.003

# a mesh of two squares apart, and of one whose triangles lie there twice
squares() { # OFFSET
  printf '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 1 "wall"\n$EndPhysicalNames\n$Nodes\n8\n'
  awk -v d="$1" 'BEGIN { for (k = 0; k < 8; k++) print k + 1, (k % 4 == 1 || k % 4 == 2) * 2 + (k > 3) * d, (k % 4 > 1) * 2, 0 }'
  printf '$EndNodes\n$Elements\n4\n1 2 2 0 1 1 2 3\n2 2 2 0 1 1 3 4\n3 2 2 0 1 5 6 7\n4 2 2 0 1 5 7 8\n$EndElements\n'
}
sed -e '/lower: \[0.0/,/refine/d' -e '/- {lower/d' -e 's/^  mesh:/  mesh: {file: squares.msh}/' -e 's/boundaries: .*/boundaries: {boundary: no_slip}/' "$here/disc.yaml" >"$scratch/pieces.yaml"
for offset in 3 0; do
  squares $offset >"$scratch/squares.msh"
  case=$scratch/pieces.yaml stops "pieces$offset" "'fluid.mesh.file': .*the mesh has 2 components that share no vertex, expected one"
done

# a ring too thin for its weight, in one iteration, stops when it fails, not at the end
stops ring "at t = 0.0[0-9]* s the solid's velocity has become\|has turned inside out at t = 0.0" --set time.end=0.5 --set coupler.max_iterations=1 \
  --set 'solid.bodies[0]={shape: ring, centre: [1, 1], radius: 0.1, thickness: 1.0e-4, size: 0.05, layers: 1, material: disc}'

# a stream that nothing stands
stops stream 'turned inside out\|runs away\|has become' --set 'fluid.boundaries.left={velocity: [1.0e6, 0]}' --set fluid.boundaries.right=open

# a body that falls through an open side
must leaves 1:1:1 --set fluid.boundaries.bottom=open --set 'solid.bodies[0].centre=[1, 0.2]' --set time.end=0.4 --set solid.materials.disc.density=8000
[ "$(grep -c 'note: at t = .* has left the fluid.s domain' "$scratch/leaves.log")" -eq 1 ] || fail leaves 'nobody says once that the body has left'

# six times as many snapshots: the same memory
for n in 100 600; do
  must snapshots$n 1:1:1 --set time.dt_max=0.0005 --set output.every=0.0005 --set "time.end=$(awk "BEGIN {print $n * 0.0005}")"
done
"$python" - "$scratch" <<'E2'
import json, sys
few, many = (json.load(open(f"{sys.argv[1]}/snapshots{n}/summary.json"))["participants"] for n in (100, 600))
for who in few:
    a, b = few[who]["peak_memory_mb"], many[who]["peak_memory_mb"]
    assert b < a + 6, f"{who} has {a} MB with 100 snapshots, {b} MB with 600"
E2
