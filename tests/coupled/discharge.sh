#!/usr/bin/env bash
# The discharge over a broad-crested weir and under a sluice gate that are held bodies, or sides of the domain, on meshes as fine; means over a second at the end,
# about a period of the waves that run between the level at the left and the weir or the gate.  Theory: critical depth on the crest, (2/3)^1.5 sqrt(g) E^1.5, and
# a contraction to 0.61 of the opening a (Henderson, 1966), 0.61 a sqrt(2 g (E - 0.61 a)), E the energy head: the level outside less u^2/2g.
# Usage: discharge.sh ROOT BUILD [--set key=value...]     --set: the weir as a body alone with these keys, without bounds
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/weir.yaml limit=1800
if [[ ${1:-} == --set ]]; then
  must "weir tried" 1:1:1 "$@"
else
  sides='corners: [[-0.5, 0], [0, 0], [0, 0.05], [0.05, 0.1], [0.4, 0.1], [0.4, 0], [0.8, 0], [0.8, 0.3], [-0.5, 0.3]], sides: [bottom, weir, weir, weir, weir, bottom, right, top, left]'
  grep -v '^coupler' "$case" >"$scratch/sides.yaml" # without bodies
  for le in 0.02 0.01; do
    must "weir body $le" 1:1:1 --set fluid.adapt.size_min=$le
    case=$scratch/sides.yaml must "weir side $le" 1:1:1 --set fluid.adapt.size_min=$le --set fluid.boundaries.weir=no_slip --set "fluid.mesh={$sides, size_max: 0.04}" --set solid.bodies=[]
  done
  gate=(--set time.end=1.8 --set 'fluid.regions=[{phase: air}, {phase: water, lower: [-1, -1], upper: [0, 0.2]}]' --set fluid.boundaries.left.level=0.2 --set fluid.adapt.size_min=0.005
    --set 'fluid.probes=[{name: q, flow: {from: [-0.1, 0.0], to: [-0.1, 0.3], phase: water}}]')
  must "gate body 0.005" 1:1:1 "${gate[@]}" --set 'fluid.mesh={lower: [-0.4, 0.0], upper: [0.35, 0.3], size_max: 0.04}' \
    --set 'solid.bodies=[{shape: polygon, corners: [[0.0, 0.03], [0.01, 0.04], [0.01, 0.3], [0.0, 0.3]], size: 0.01, material: stone, fixed: true}]'
  sides='corners: [[-0.4, 0], [0.35, 0], [0.35, 0.3], [0.01, 0.3], [0.01, 0.04], [0, 0.03], [0, 0.3], [-0.4, 0.3]], sides: [bottom, right, top, gate, gate, gate, top, left]'
  case=$scratch/sides.yaml must "gate side 0.005" 1:1:1 "${gate[@]}" --set fluid.boundaries.gate=no_slip --set "fluid.mesh={$sides, size_max: 0.04}" --set solid.bodies=[]
fi
"$python" - "$scratch" <<'E2'
import os, sys
from results import column
HEAD, OPENING, CONTRACTION, G = {"weir": 0.18, "gate": 0.2}, 0.03, 0.61, 9.81
BOUNDS = {"weir body 0.02": (-0.25, -0.08), "weir side 0.02": (-0.08, 0.02), "weir body 0.01": (-0.18, -0.05), "weir side 0.01": (-0.08, 0.02),
          "gate body 0.005": (-0.03, 0.08), "gate side 0.005": (0.0, 0.1), "weir tried": (-1.0, 1.0)}
for label, (least, most) in BOUNDS.items():
    if not os.path.exists(sys.argv[1] + "/" + label): continue
    t, q = column(label, "fluid_probes", "t [s]"), column(label, "fluid_probes", "q_flow [m2/s]")
    late = [flow for time, flow in zip(t, q) if time > t[-1] - 1.1]
    flow, kind = sum(late) / len(late), label.split()[0]
    head = HEAD[kind] - (flow / HEAD[kind]) ** 2 / (2.0 * G)
    jet = CONTRACTION * OPENING
    theory = (2.0 / 3.0) ** 1.5 * G ** 0.5 * (head - 0.1) ** 1.5 if kind == "weir" else jet * (2.0 * G * (head - jet)) ** 0.5
    report = "%s: %.4f m2/s, %+.1f %% of theory" % (label, flow, 100.0 * (flow / theory - 1.0))
    print(report)
    assert least < flow / theory - 1.0 < most, report
E2
