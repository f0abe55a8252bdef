#!/usr/bin/env bash
# Ten bodies in one tank, soft and stiff, light and heavy, two of them in contact: they run to the end on 1:1:1 and on
# 2:2:2 ranks, momentum is conserved, and both move alike until contacts multiply what differs.  Usage: bodies.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$scratch/case.yaml
"$python" - >"$case" <<'E2'
import random
draw, at = random.Random(3), []
print("case: bodies\ngravity: [0.0, -9.81]\ntime: {end: 0.2, dt_max: 0.005, cfl: 0.5}\nfluid:\n  density: 1000.0\n  viscosity: 10.0")
print("  mesh: {lower: [0.0, 0.0], upper: [2.0, 2.0], size_max: 0.2, growth: 0.4, refine: [{lower: [0.25, 0.45], upper: [1.8, 1.5], size: 0.05}]}")
print("  boundaries: {left: no_slip, right: no_slip, bottom: no_slip, top: no_slip}\nsolid:\n  materials:")
for k in range(10):
    print("    m%d: {density: %d, youngs_modulus: %.3e, poisson_ratio: 0.3, damping: 0.2}" % (k, (50, 500, 1000, 2000, 6000)[k % 5], 10.0 ** draw.uniform(4.5, 7.0)))
print("  bodies:")
for k in range(10):
    x, y = 0.4 + 0.3 * (k % 5) + draw.uniform(-0.02, 0.02), 0.7 + 0.4 * (k // 5) + draw.uniform(-0.05, 0.05)
    if k == 9:
        x, y = at[8][0], at[8][1] + 0.163  # a heavy disc on a lighter one
    at.append((x, y))
    shape = "rectangle, width: 0.16, height: 0.12, angle: %.2f" % draw.uniform(0.0, 3.0) if k % 3 == 1 else "disc, radius: 0.08"
    print("    - {shape: %s, centre: [%.4f, %.4f], size: 0.04, material: m%d}" % (shape, x, y, k))
print("  walls: {lower: [0.0, 0.0], upper: [2.0, 2.0]}\ncoupler: {shell_thickness: 0.001}\noutput: {folder: out/bodies, every: 0.1}")
E2
must one 1:1:1 --set "fluid.petsc=-momentum_ksp_rtol 1e-13"
"$python" "$root/scripts/momentum.py" "$scratch/one" --bound 1e-10 >"$scratch/report" || { cat "$scratch/report"; exit 1; }
must two 2:2:2
"$python" - "$scratch" <<'E2'
from results import column, rows, summary
one, two = rows("one", "solid"), rows("two", "solid")
for label in ("one", "two"):
    assert abs(rows(label, "coupler")[-1]["t [s]"] - 0.2) < 1e-12
    iterations = column(label, "coupler", "iterations")
    assert sum(iterations) < 12 * len(iterations), "%s: iterations %s" % (label, iterations)
    assert summary(label)["largest_momentum_imbalance"] < 1e-10
speed = lambda rows, t, body: next(r["v%d [m/s]" % body] for r in rows if r["t [s]"] > t - 1e-9)
velocities = [(speed(one, 0.05, k), speed(two, 0.05, k)) for k in range(10)]
largest = max(abs(a) for a, b in velocities)
assert largest > 0.1, velocities
for k, (a, b) in enumerate(velocities):
    assert abs(a - b) < 0.01 * largest, "body %d falls at %g m/s on one rank each, at %g on two" % (k, -a, -b)
E2
