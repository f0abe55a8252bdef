#!/usr/bin/env bash
# Gravity in time, as in the frame of a ground that is shaken: water in a tank sloshes, and strikes a dam, as in potential theory (shaken.py); bodies that
# are free, of the fluid's density and of twice that, follow it with the step's mean and no lag; a constant one in rows is the constant; it is
# in the budget of momentum; a run resumes as if nothing had happened.  Usage: shaken.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/shaken.yaml
sway=$("$python" -c "import math; print([[0.05 * k, -0.05 * math.sin(math.pi * 0.05 * k), -9.81] for k in range(61)])")
must slosh 2:1:1 --set "gravity=$sway" --set fluid.adapt.size_min=0.01
"$python" "$here/shaken.py" surface "$scratch/slosh" 1.0 "$sway" 0.06
quake='[[0.0, 0.0, -9.81], [0.05, 0.0, -9.81], [0.050001, 0.25, -9.81]]'
must dam 1:1:1 --set "gravity=$quake" --set time.end=0.15 --set time.dt_max=0.005 --set 'fluid.mesh.upper=[2.6, 0.5]' --set 'fluid.regions[1].upper=[2.0, 0.3]' \
  --set 'solid.bodies=[{shape: rectangle, centre: [2.05, 0.21], width: 0.1, height: 0.42, size: 0.02, material: concrete, fixed: true}]'
"$python" "$here/shaken.py" dam "$scratch/dam" 2.0 "$quake" 0.05

# a disc in a box full of one fluid: constant gravity, the same in rows, one that rises from 0 to it, another one that does after half of the time
case=$here/disc.yaml
box=(--set fluid.viscosity=0.1 --set 'fluid.petsc=-momentum_ksp_rtol 1e-12' --set 'solid.bodies[0].centre=[1.0, 1.0]')
must constant 1:1:1 "${box[@]}" --set 'gravity=[1.0, 0.0]'
must rows 1:1:1 "${box[@]}" --set 'gravity=[[0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]'
must rising 2:1:2 "${box[@]}" --set 'gravity=[[0.0, 0.0, 0.0], [0.1, 1.0, 0.0]]'
must late 1:1:1 "${box[@]}" --set 'gravity=[[0.0, 0.0, 0.0], [0.045, 0.0, 0.0], [0.045000001, 1.0, 0.0]]'
must neutral 1:1:1 "${box[@]}" --set 'gravity=[[0.0, 0.0, 0.0], [0.1, 1.0, 0.0]]' --set solid.materials.disc.density=1000
must half 1:1:1 "${box[@]}" --set 'gravity=[[0.0, 0.0, 0.0], [0.1, 1.0, 0.0]]' --set time.end=0.05
must half 1:1:1 "${box[@]}" --set 'gravity=[[0.0, 0.0, 0.0], [0.1, 1.0, 0.0]]' --set resume=last
for run in rising late slosh; do
  "$python" "$root/scripts/momentum.py" "$scratch/$run" --bound 1e-9 >"$scratch/report" || { cat "$scratch/report"; exit 1; }
done
"$python" - "$scratch" <<'E2'
from results import column
def last(run):
    return column(run, "solid", "u0 [m/s]")[-1]
constant = last("constant")
assert last("rows") == constant, "rows of one value: %.17g m/s, the value %.17g" % (last("rows"), constant)
for run, part, tolerance in ("rising", 0.5, 0.01), ("half", 0.5, 0.01), ("late", 0.55, 0.01), ("neutral", 0.0, 3e-3):
    report = "%s: %.5f of the velocity by constant gravity, expected %g" % (run, last(run) / constant, part)
    print(report)
    assert abs(last(run) / constant - part) < tolerance, report
assert abs(last("half") / last("rising") - 1.0) < 1e-6, "resumed: %.9g m/s, %.9g" % (last("half"), last("rising"))
E2
