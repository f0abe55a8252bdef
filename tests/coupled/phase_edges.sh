#!/usr/bin/env bash
# Phases in unusual domains: on ranks without elements, with a gas and a checkpoint, from which a run with other phases does not go on; far from the origin; with an interface that lies along the cut between ranks, which is
# refined all the same; beside a slanted wall that moves along itself, which is a wall, in a closed tank, too; gas that comes in has the density of the pressure there; and where
# gravity changes, the first step after a resume is that of the run without a stop.  A zone of absorption draws the phase that it names alone.
# Fractions of what comes in whose decimals are cut off fill elements all the same.
# Usage: phase_edges.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/phase_edges.yaml
gas='{name: air, density: 1.2, viscosity: 1.8e-5, gas: {pressure: 1.0e5, exponent: 1.4}}'
must empty 4:1:1 --set output.checkpoint=1e-9
must "empty gas" 4:1:1 --set output.checkpoint=1e-9 --set "fluid.phases[1]=$gas"
must "empty gas again" 3:1:1 --set "resume=$scratch/empty gas/checkpoint" --set time.end=0.006 --set "fluid.phases[1]=$gas"
# phases in another order are those of the same names; with other names, another number of them, or one compressible that was not, the run does not go on
water='{name: water, density: 1000.0, viscosity: 1.0e-3}' air='{name: air, density: 1.2, viscosity: 1.8e-5}'
on() { local label=$1; shift; run "$label" 1:1:1 --set "resume=$scratch/empty/checkpoint" --set time.end=0.006 "$@"; }
on order --set "fluid.phases=[$air, $water]" || { cat "$scratch/order.log"; exit 1; }
"$python" - "$scratch" <<'E7'
from results import rows
last = rows("order", "fluid")[-1]
assert abs(last["water [m2]"] - 0.4) < 1e-9 and abs(last["water made [m2]"]) < 1e-12, "resumed with phases in another order: %s" % last
E7
refused() {
  on "$1" "${@:3}" && { echo "resumed with $1 it has run"; exit 1; }
  grep -q "error: fluid.phases: $2" "$scratch/$1.log" || { cat "$scratch/$1.log"; exit 1; }
}
refused names "expected the names .*empty/checkpoint/fluid.h5, where 'steam' is none" --set fluid.phases[1].name=steam --set fluid.regions[0].phase=steam
refused masses "expected 'air' without gas" --set "fluid.phases[1]=$gas"
refused number "expected 2, as in .*found 3" --set "fluid.phases=[$water, $air, {name: oil, density: 850.0, viscosity: 0.05}]"
sed -e '/^  phases:/,/phase: water, lower/d' -e 's/^fluid:/fluid: {density: 1000.0, viscosity: 1.0e-3,/' -e 's/^  mesh: \(.*\)/  mesh: \1,/' -e 's/^  boundaries: \(.*\)/  boundaries: \1}/' \
  "$case" >"$scratch/single.yaml"
case=$scratch/single.yaml refused single "expected 2, as in .*found 0"
# northings of maps
must far 1:1:1 --set fluid.mesh.lower='[500000, 4200000]' --set fluid.mesh.upper='[500001, 4200001]' --set fluid.mesh.size_max=0.2 \
  --set 'fluid.regions[1]={phase: water, lower: [499999, 4199999], upper: [500002, 4200000.4]}'
# water beside air, along the middle of a box of two cells
for ranks in 1 2; do
  must "cut$ranks" $ranks:1:1 --set time.end=0.01 --set fluid.mesh.upper='[2, 1]' --set fluid.mesh.size_max=0.5 --set 'fluid.regions[1].upper=[1, 2]' \
    --set 'fluid.adapt={size_min: 0.05, size_max: 0.5, velocity_error: 10, every: 1000}'
done
"$python" - "$scratch" <<'E2'
from results import column
one, two = (column("cut%d" % n, "fluid", "triangles")[0] for n in (1, 2))
assert one > 150 and abs(two / one - 1.0) < 0.25, "an interface along the cut between ranks: %d triangles, on one rank %d" % (two, one)
E2
# a parallelogram whose left side, at 60 degrees, moves along itself
"$python" - "$scratch/slanted.msh" <<'E3'
import sys
N, SLOPE = 12, 0.57735026918962573
number = lambda i, j: j * (N + 1) + i + 1
with open(sys.argv[1], "w") as out:
    out.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 1 "bottom"\n1 2 "top"\n1 3 "left"\n1 4 "right"\n2 5 "fluid"\n$EndPhysicalNames\n$Nodes\n%d\n' % (N + 1)**2)
    for j in range(N + 1):
        for i in range(N + 1):
            out.write("%d %.17g %.17g 0\n" % (number(i, j), i / N + SLOPE * (j / N), j / N))
    lines = [(tag, number(*a), number(*b)) for k in range(N) for tag, a, b in
             ((1, (k, 0), (k + 1, 0)), (2, (k, N), (k + 1, N)), (3, (0, k), (0, k + 1)), (4, (N, k), (N, k + 1)))]
    triangles = [t for j in range(N) for i in range(N) for t in
                 ((number(i, j), number(i + 1, j), number(i, j + 1)), (number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)))]
    out.write("$EndNodes\n$Elements\n%d\n" % (len(lines) + len(triangles)))
    for k, (tag, a, b) in enumerate(lines):
        out.write("%d 1 2 %d %d %d %d\n" % (k + 1, tag, tag, a, b))
    for k, t in enumerate(triangles):
        out.write("%d 2 2 5 5 %d %d %d\n" % (len(lines) + k + 1, *t))
    out.write("$EndElements\n")
E3
for top in open no_slip; do
  must "slanted $top" 1:1:1 --set time.end=0.5 --set time.dt_max=0.02 --set "fluid.mesh={file: $scratch/slanted.msh}" --set 'fluid.regions[1].upper=[3, 0.52]' \
    --set "fluid.boundaries={left: {velocity: [0.5, 0.86602540378443865]}, right: no_slip, bottom: no_slip, top: $top}"
done
"$python" - "$scratch" <<'E4'
from results import column
for top in ("open", "no_slip"):
    out = column("slanted " + top, "fluid", "water out [m2]")[-1]
    assert abs(out) < 1e-6, "beside a slanted wall that moves along itself, top %s: %g m2 of water out" % (top, out)
E4
must breath 1:1:1 --set gravity='[0, 0]' --set time.end=0.1 --set time.cfl=100 --set "fluid.phases[1]={name: air, density: 1.2, viscosity: 1.8e-5, gas: {pressure: 1.0e5, exponent: 1.0}}" \
  --set 'fluid.regions=[{phase: air}]' --set 'fluid.mesh={lower: [0, 0], upper: [0.3, 1], size_max: 0.1}' --set 'fluid.boundaries.top={pressure: 8.0e4, rise: 0.1}'
"$python" - "$scratch" <<'E5'
import math
from results import column, rows
mass = next(name for name in rows("breath", "fluid")[0] if name.startswith("air ["))
lack = max(1.0 - m / (0.36 * (1.0 + 0.8 * 0.5 * (1.0 - math.cos(math.pi * t / 0.1)))) for t, m in zip(column("breath", "fluid", "t [s]"), column("breath", "fluid", mass)))
print("gas that comes in: lack of mass at most %.2f %%" % (100.0 * lack))
assert lack < 0.04, lack  # 8.4 % with the density of the pressure 0
E5
shaken=(--set 'gravity=[[0, 0, -1], [0.2, 0.5, -40], [1, 0.5, -40]]' --set time.dt_max=0.05 --set fluid.mesh.size_max=0.08 --set fluid.boundaries.top=open --set 'fluid.regions[1].upper=[2, 0.5]')
must stopped 1:1:1 "${shaken[@]}" --set time.end=0.274
must stopped 1:1:1 "${shaken[@]}" --set time.end=0.4 --set resume=last
must whole 1:1:1 "${shaken[@]}" --set time.end=0.4
"$python" - "$scratch" <<'E6'
from results import column
step = lambda label: next(dt for t, dt in zip(column(label, "fluid", "t [s]"), column(label, "fluid", "dt [s]")) if t > 0.2741)
assert step("stopped") < 1.1 * step("whole"), "gravity in time: the step after a resume is %.6g s, without a stop %.6g s" % (step("stopped"), step("whole"))
E6
# the force on fluid at rest: rate times velocity times the mass of what is drawn, in a box that keeps it at rest
for phase in water air; do must "drawn $phase" 1:1:1 --set fluid.mesh.size_max=0.2 --set "fluid.absorption=[{from: [-2, 0], to: [-1, 0], rate: 1, velocity: [0.1, 0], phase: $phase}]"; done
"$python" - "$scratch" <<'E7'
from results import column
for phase, expected in (("water", 0.1 * 1000.0 * 0.4), ("air", 0.1 * 1.2 * 0.6)):
    force = column("drawn " + phase, "fluid_forces", "absorption x [N/m]")[0]
    assert abs(force / expected - 1.0) < 0.01, "%s is drawn with %g N/m, expected %g" % (phase, force, expected)
E7
must thirds 1:1:1 --set time.end=0.02 --set fluid.mesh.size_max=0.2 --set fluid.boundaries.right=open \
  --set 'fluid.boundaries.left={velocity: [1, 0], fractions: [{phase: water, value: 0.333333333}, {phase: air, value: 0.666666666}]}'
"$python" - "$scratch" <<'E8'
from results import column
gap = abs(column("thirds", "fluid", "volume gap [m2]")[-1])
assert gap < 1e-13, "fractions whose sum is not quite 1 leave a gap of %g m2" % gap
E8
