#!/usr/bin/env bash
# What bodies do to each other: a block on the floor that bears a disc and is pushed from the left.  At rest normal force, friction and their places are those of statics; in each step all
# contacts of a body together are what is left of its momentum's change (cx, cy); snapshots have the same pairs; ranks agree.  Friction takes the kinetic energy of a block that slides till it stops, damping most of that of
# a disc that falls; budgets say so where series are thinned.  Usage: contact_probes.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
cat >"$scratch/case.yaml" <<'E2'
case: contact_probes
gravity: [0.0, -9.81]
time: {end: 1.0, dt_max: 0.01}
solid:
  materials: {stone: {density: 2000.0, law: rigid, penalty: 1.0e7, friction: 0.5, contact_damping: 0.3}}
  walls: {lower: [0.0, 0.0], upper: [2.0, 1.0]}
  bodies:
    - {shape: rectangle, centre: [1.0, 0.1], width: 0.4, height: 0.2, size: 0.05, material: stone, loads: [{boundary: left, pressure: 1.0e3}]}
    - {shape: disc, centre: [1.1, 0.3], radius: 0.1, size: 0.03, material: stone}
  contact_probes:
    - {name: base, body: 0, other: bottom}
    - {name: disc, body: 1, other: 0}
    - {name: block, body: 0}
    - {name: far, body: 1, other: top}
output: {folder: out/contact_probes, every: 1.0, checkpoint: 0}
E2
for ranks in 1 2 3; do alone "r$ranks" "$scratch/case.yaml" --ranks "1:1:$ranks"; done
slides='{shape: rectangle, centre: [1.0, 0.1], width: 0.4, height: 0.2, size: 0.05, material: stone, velocity: [1.0, 0.0]}'
falls='{shape: disc, centre: [0.3, 0.3], radius: 0.1, size: 0.03, material: stone}'
for every in 0 0.1; do
  alone "slides_$every" "$scratch/case.yaml" --set "solid.bodies=[$slides, $falls]" --set solid.contact_probes=[] --set output.series_every=$every
  "$python" "$root/scripts/energy.py" "$scratch/slides_$every" >"$scratch/energy_$every"
done
if grep taken "$scratch/energy_0.1" || "$python" "$root/scripts/momentum.py" "$scratch/slides_0.1" >"$scratch/log" 2>&1 || ! grep 'do not have every step' "$scratch/log" >"$scratch/said"; then
  echo 'budgets of thinned series'; cat "$scratch/log"; exit 1
fi
"$python" "$root/scripts/momentum.py" "$scratch/slides_0" --bound 1e-11 >"$scratch/log" || { cat "$scratch/log"; exit 1; }
"$python" - "$scratch" <<'E2'
from math import isnan
import sys
import h5py
from results import column
weight = (2000*9.81*0.08, 2000*9.81*3.14159265358979*0.01)
push = 1e3*0.2
both = sum(weight)
place = (weight[0]*1.0 + weight[1]*1.1 + push*0.1)/both
def near(label, what, value, expected, bound):
    assert abs(value - expected) < bound, "%s, %s: %.10g, expected %.10g" % (label, what, value, expected)
for ranks in (1, 2, 3):
    label = "r%d" % ranks
    probe = lambda name: column(label, "solid_probes", name)
    for k, body in enumerate("xy"):
        rest = column(label, "solid", "c%s0 [N/m]" % body)
        for step, value in enumerate(rest):
            near(label, "c%s0 in step %d" % (body, step), probe("block_normal_%s [N/m]" % body)[step] + probe("block_friction_%s [N/m]" % body)[step], value, 1e-7*both)
    for name, expected in (("base_normal_x", 0), ("base_normal_y", both), ("base_friction_x", -push), ("base_friction_y", 0), ("disc_normal_y", weight[1]),
                           ("block_normal_y", weight[0])):
        near(label, name, probe(name + " [N/m]")[-1], expected, 2e-3*both)
    for name, expected in (("base_place_x", place), ("base_place_y", 0), ("disc_place_x", 1.1), ("disc_place_y", 0.2)):
        near(label, name, probe(name + " [m]")[-1], expected, 1e-3)
    assert probe("far_normal_y [N/m]")[-1] == 0 and isnan(probe("far_place_x [m]")[-1]), "the disc does not touch the top"
    with h5py.File("%s/%s/solid.h5" % (sys.argv[1], label)) as file:
        grid = file["snapshot"][sorted(file["snapshot"])[-1]]["contacts"]
        found = {(int(b), int(o)): (x, n, f) for b, o, x, n, f in zip(grid["node/body"][:], grid["node/other"][:], grid["points"][:], grid["node/normal_force"][:], grid["node/friction_force"][:])}
    assert sorted(found) == [(0, -2), (0, 1)], sorted(found)
    near(label, "snapshot, normal force of the floor", found[0, -2][1][1], both, 5e-3*both)
    near(label, "snapshot, friction of the floor", found[0, -2][2][0], -push, 5e-3*both)
    near(label, "snapshot, normal force of the disc", found[0, 1][1][1], -weight[1], 5e-3*both)
    near(label, "snapshot, place on the floor", found[0, -2][0][0], place, 1e-3)
energy = {line.split()[0]: line.split() for line in open(sys.argv[1] + "/energy_0")}
taken, lost = float(energy["friction"][-2]), -float(energy["all"][3])
near("slides", "energy that contact took", taken, lost, 0.03*lost)
left = column("slides_0", "solid", "kinetic0 [J/m]")[-1]
assert left < 1.0, "the block still slides: %g J/m" % left
for ranks in (2, 3):
    for name in ("base_normal_y [N/m]", "disc_normal_y [N/m]"):
        near("r%d" % ranks, name, column("r%d" % ranks, "solid_probes", name)[20], column("r1", "solid_probes", name)[20], 1e-6*both)
E2
