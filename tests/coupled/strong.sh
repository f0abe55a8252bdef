#!/usr/bin/env bash
# Coupling iterations: a disc of a twentieth of the fluid's density rises smoothly, on any number of ranks and while the mesh adapts, in few iterations a
# step; a heavy one moves off in long steps as in short ones, with one; a step that cracks and does not converge is halved, and one that never does ends the run with a reason.  Usage: strong.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
light=(--set solid.materials.disc.density=50 --set time.end=0.3 --set coupler.max_iterations=30)
adapt=(--set fluid.adapt.size_min=0.02 --set fluid.adapt.size_max=0.25 --set fluid.adapt.velocity_error=0.005 --set fluid.adapt.every=7
  --set "fluid.mesh.refine[0].size=0.2" --set "solid.bodies[0].size=0.03")
must one 1:1:1 "${light[@]}"
must three 2:3:2 "${light[@]}"
must adaptive 1:1:1 "${light[@]}" "${adapt[@]}"
brittle='{density: 900.0, youngs_modulus: 1.0e6, poisson_ratio: 0.3, damping: 0.2, tensile_strength: 6.0e2, shear_strength: 1.2e3, fracture_energy: 0.05}'
for ranks in 1:1:1 1:2:2; do
  must "cracks-${ranks//:/-}" "$ranks" --set "solid.materials.disc=$brittle" --set "solid.bodies[0]=$bar" --set time.end=0.4 --set coupler.max_iterations=30
done
# a bar of a twentieth of the fluid's density: steps that crack converge when they are halved; accepted as they are, cracks run through all of it
weak='{density: 50.0, youngs_modulus: 1.0e6, poisson_ratio: 0.3, damping: 0.2, tensile_strength: 6.0e3, shear_strength: 1.2e4, fracture_energy: 1.0}'
must weak 1:1:1 --set "solid.materials.disc=$weak" --set "solid.bodies[0]=$bar" --set time.end=0.12
must short 1:1:1 --set time.end=0.1 --set time.dt_max=0.00125 "${adapt[@]}"
must long 1:1:1 --set time.end=0.1 "${adapt[@]}"
if run few 1:1:1 "${light[@]}" --set coupler.max_iterations=2; then echo "two iterations were enough"; exit 1; fi
grep -q 'error: the step from t = .* does not converge' "$scratch/few.log" || { cat "$scratch/few.log"; exit 1; }
"$python" - "$scratch" <<'E2'
from results import column, rows, summary
def speeds(label):
    return column(label, "coupler", "u_y [m/s]")
for label in ("one", "three", "adaptive"):
    u, iterations = speeds(label)[5:], column(label, "coupler", "iterations")
    assert u[-1] > 0.5 and all(b > a for a, b in zip(u, u[1:])), "%s: velocities %s" % (label, u)
    assert 1.5 < sum(iterations) / len(iterations) < 4, "%s: %s iterations" % (label, iterations)
    totals = summary(label)
    assert totals["largest_momentum_imbalance"] < 1e-10 and totals["iterations"] == sum(iterations), "%s: %s" % (label, totals)
    assert len(rows(label, "fluid")) == len(rows(label, "solid")) == len(iterations), "%s: rows for iterations that do not stand" % label
for label in ("cracks-1-1-1", "cracks-1-2-2"):
    solid, iterations = rows(label, "solid"), column(label, "coupler", "iterations")
    assert solid[-1]["broken joints"] >= 3 and max(iterations) > 1, "%s: %g broken joints, iterations %s" % (label, solid[-1]["broken joints"], iterations)
    assert summary(label)["largest_momentum_imbalance"] < 1e-10
broken = [rows(label, "solid")[-1]["broken joints"] for label in ("cracks-1-1-1", "cracks-1-2-2")]
assert broken[0] == broken[1], "broken joints: %s" % broken
# a step of more than thirty iterations is one that was halved; from then on steps grow by at most 1.3
weak, solid = rows("weak", "coupler"), rows("weak", "solid")
steps, iterations = [r["dt [s]"] for r in weak], [r["iterations"] for r in weak]
assert 2 <= solid[-1]["broken joints"] <= 8 and max(iterations) > 30, "weak: %g broken joints, iterations %s" % (solid[-1]["broken joints"], iterations)
assert min(steps) < 0.006 and all(b < 1.3001 * a for a, b in zip(steps, steps[1:])) and abs(weak[-1]["t [s]"] - 0.12) < 1e-12, "steps %s" % steps
one, three = speeds("one")[-1], speeds("three")[-1]
assert abs(one / three - 1) < 1e-3, "one rank %g m/s, three %g" % (one, three)
assert len({r["triangles"] for r in rows("adaptive", "fluid")}) > 3, "the mesh has not changed"
# steps eight times as long: the first iteration is right
short, long = speeds("short")[-1], speeds("long")[-1]
assert abs(long / short - 1) < 0.03, "%g m/s in long steps, %g in short ones" % (long, short)
assert {r["iterations"] for r in rows("long", "coupler")} == {1.0}, "a heavy disc takes more than one iteration"
E2
