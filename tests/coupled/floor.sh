#!/usr/bin/env bash
# A block that stands on a floor under water presses on it with its weight less the displaced water's (coupler/force/uplift.h), in one fluid and beneath
# air, also let down with a gap, and friction stops one that slides (before, the water carried it: no force on the floor, 0.13 m in 0.3 s); what
# the floor gives back is in the budget of momentum.  Water leaves the gap beneath one that comes down alike with long and short steps.  One that is held at first presses on it once it is let go.  Usage: floor.sh ROOT BUILD [caisson]
# caisson: prints the water's force up on one that holds 0.5 m of water against 0.3 m, which is 1570 N/m: a row of SOLIDS_AMONG_PHASES.md
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/floor.yaml
if [[ ${1:-} == caisson ]]; then
  must caisson 1:1:1 --set time.end=0.71 --set 'fluid.regions=[{phase: air}, {phase: water, lower: [-1.0, -1.0], upper: [1.0, 0.5]}, {phase: water, lower: [1.0, -1.0], upper: [3.0, 0.3]}]' \
    --set 'fluid.mesh={lower: [0.0, 0.0], upper: [2.0, 0.8], size_max: 0.1}' --set fluid.adapt.size_min=0.015 --set fluid.adapt.velocity_error=0.03 --set fluid.boundaries.top=open \
    --set 'solid.materials.rock={density: 2200.0, youngs_modulus: 1.0e8, poisson_ratio: 0.3, damping: 0.2, friction: 0.6, contact_damping: 0.3}' \
    --set 'solid.bodies=[{shape: rectangle, centre: [1.0, 0.3], width: 0.4, height: 0.6, size: 0.04, material: rock}]' --set 'solid.walls={lower: [0.0, 0.0], upper: [2.0, 2.0]}'
  "$python" - "$scratch" <<'E2'
from results import rows
print(", ".join("%.0f N/m at %.1f s" % (next(row for row in rows("caisson", "solid") if row["t [s]"] > t - 1e-6)["fy0 [N/m]"], t) for t in (0.2, 0.3, 0.7)))
E2
  exit
fi
end="--set time.end=0.4"
must stands 1:1:1 $end
must ranks 2:2:2 $end
one='fluid={density: 1000.0, viscosity: 1.0e-3, petsc: -momentum_ksp_rtol 1e-13, mesh: {lower: [0.0, 0.0], upper: [1.0, 0.3], size_max: 0.1}, adapt: {size_min: 0.014, size_max: 0.1, velocity_error: 0.05, every: 10}, boundaries: {left: free_slip, right: free_slip, bottom: free_slip, top: free_slip}}'
must lowered 1:1:1 $end --set "$one" --set "solid.bodies[0].centre=[0.3, 0.045]"
must released 1:1:1 $end --set "solid.bodies[0].prescribed=[{velocity: [0, 0], release: 0.1}]"
must slides 1:1:1 --set time.end=0.5 --set "solid.bodies[0].centre=[0.3, 0.045]" --set "solid.bodies[0].velocity=[0.5, 0.0]"
for dt in 0.004 0.001; do
  must "sinks_$dt" 1:1:1 --set time.end=0.06 --set time.dt_max=$dt --set "solid.bodies[0].centre=[0.3, 0.043]" --set "solid.bodies[0].velocity=[0.5, 0.0]"
done
"$python" "$root/scripts/momentum.py" "$scratch/lowered" --bound 1e-10 >"$scratch/report" || { cat "$scratch/report"; exit 1; }
"$python" - "$scratch" <<'E2'
from results import column
expected = 9.81 * (2600.0 - 1000.0) * 0.08 * 0.08
for run in "stands", "ranks", "lowered", "released":
    t, impulse = column(run, "solid", "t [s]"), column(run, "solid", "walls_y [N s/m]")
    first = next(k for k in range(len(t)) if t[k] > 0.3)
    force = sum(impulse[first:]) / (t[-1] - t[first - 1])
    print("%s: %.2f N/m on the floor, of %.2f" % (run, force, expected))
    assert abs(force / expected - 1.0) < 0.02, "%s: %g N/m on the floor, expected %g" % (run, force, expected)
x = column("slides", "solid", "x0 [m]")
assert 0.01 < x[-1] - 0.3 < 0.09 and x[-1] - x[2 * len(x) // 3] < 0.002, "it has slid to %g m, %g before" % (x[-1], x[2 * len(x) // 3])
for dt in "0.004", "0.001":
    gap = 1e3 * (column("sinks_" + dt, "solid", "y0 [m]")[-1] - 0.04)  # 0.3 mm in both; before the film had a rate 1.3 and 2.2
    assert 0.1 < gap < 0.45, "steps of %s s: a gap of %g mm" % (dt, gap)
E2
