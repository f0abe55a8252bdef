#!/usr/bin/env bash
# The force on each body of what holds or moves it: a fixed and a prescribed platen press a block with forces that are equal, opposite, those of the
# block's stress and of the work that is done; a body hangs on a spring; all together are the budget's impulse.  On one rank, and on two that exchange elements.
# Usage: platens.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
cat >"$scratch/platens.yaml" <<'E2'
case: platens
gravity: [0.0, -1.0]
time: {end: 0.5, dt_max: 0.005}
solid:
  materials:
    stone: {density: 1.0, youngs_modulus: 1.0e4, poisson_ratio: 0.0, damping: 0.5}
    steel: {density: 10.0, youngs_modulus: 1.0e5, poisson_ratio: 0.0, damping: 0.5}
  bodies:
    - {shape: rectangle, centre: [0.0, 0.1], width: 0.1, height: 0.2, size: 0.05, material: stone}
    - {shape: rectangle, centre: [0.0, -0.05], width: 0.3, height: 0.1, size: 0.05, material: steel, fixed: true}
    - {shape: rectangle, centre: [0.0, 0.25], width: 0.3, height: 0.1, size: 0.05, material: steel, prescribed: [{velocity: [0.0, -0.004], rise: 0.1, name: ram}]}
    - {shape: rectangle, centre: [1.0, 0.0], width: 0.1, height: 0.1, size: 0.05, material: steel}
  springs: [{name: rope, point: [1.0, 0.0], anchor: [1.0, 1.0], stiffness: 10.0, damping: 2.0}]
output: {folder: out/platens, every: 1.0}
E2
for ranks in 1 2; do
  alone "$ranks" "$scratch/platens.yaml" --ranks "1:1:$ranks" --set solid.rebalance=1
done
"$python" - "$scratch" <<'E2'
import csv, sys
def read(n, series):
    return [{k.split(" [")[0]: float(v) for k, v in r.items()} for r in csv.DictReader(open("%s/%s/%s.csv" % (sys.argv[1], n, series)))]
runs = [[{**r, **probe} for r, probe in zip(read(n, "solid"), read(n, "solid_probes"))] for n in "12"]
for rows in runs:
    for before, r in zip(rows, rows[1:]):
        dt = r["t"] - before["t"]
        total = sum(r["ry%d" % b] for b in range(4))
        assert abs(total * dt - r["reaction_y"]) < 1e-9, "%g s: %g N/m on the bodies, %g of all" % (r["t"], total, r["reaction_y"] / dt)
        assert abs(r["ram_force_y"] - r["ry2"]) < 1e-9 * abs(r["ry2"]) + 1e-12, "the ram has %g of %g N/m" % (r["ram_force_y"], r["ry2"])
        touch = sum(r["cy%d" % b] for b in range(4))
        assert abs(touch * dt - r["walls_y"]) < 1e-9, "%g s: contact pushes bodies by %g N/m, walls by %g" % (r["t"], touch, r["walls_y"] / dt)
    weight = [r["mass%d" % b] for b in range(4)]
    assert abs(r["cy0"] / weight[0] - 1.0) < 1e-3, "contact bears %g of %g N/m" % (r["cy0"], weight[0])
    assert r["ry0"] == 0.0, "a free body is held by %g" % r["ry0"]
    bears, presses = r["ry1"] - weight[1], weight[2] - r["ry2"]
    assert abs(bears - presses - weight[0]) < 1e-4 * bears, "the platens' forces %g and %g" % (bears, presses)
    # of the block's strain alone: 9 N/m; contact is compliant, by a tenth of that
    assert 7.0 < bears < 9.0, "a platen bears %g N/m" % bears
    power = r["reaction work"] / dt
    assert abs(power + 0.004 * r["ry2"] - r["v3"] * r["ry3"]) < 1e-3 * power, "%g W/m of a force of %g N/m" % (power, r["ry2"])
    assert abs(r["ry3"] / weight[3] - 1.0) < 0.05, "the rope holds %g of %g N/m" % (r["ry3"], weight[3])
for first, second in zip(*runs):
    for key in first:
        if key[:2] in ("rx", "ry"):
            assert abs(first[key] - second[key]) < 1e-6, "%g s, %s: %g and %g" % (first["t"], key, first[key], second[key])
E2
