#!/usr/bin/env bash
# A square among water and air: few coupling iterations, momentum and water kept, the same on other ranks and after a resume.
# Usage: phases.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/phases.yaml
must one 1:1:1
must two 2:1:1
must half 1:1:1 --set time.end=0.06
must half 1:1:1 --set resume=last
"$python" - "$scratch" ${1:+print} <<'E2'
import csv, h5py, numpy as np, sys
def rows(label, part):
    return list(csv.DictReader(open("%s/%s/%s.csv" % (sys.argv[1], label, part))))
def water(label):
    grid = h5py.File("%s/%s/fluid.h5" % (sys.argv[1], label))["snapshot"]
    areas = []
    for key in sorted(grid):
        velocity = grid[key]["velocity"]
        if "points" in velocity:
            x, cells = velocity["points"][:], velocity["cells"][:]
        a, b, c = (x[cells[:, k]] for k in range(3))
        area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
        areas.append((area * velocity["cell/water"][:]).sum())
    return np.array(areas)
place = {}
for label in ("one", "two", "half"):
    assert abs(water(label) - 0.039).max() < 1e-8, "%s: water %s m2" % (label, water(label))
    coupler, last = rows(label, "coupler"), rows(label, "solid")[-1]
    # water in an element of the surface is heavier than this solid: where that happens the step is repeated
    iterations = [int(float(r["iterations"])) for r in coupler]
    assert sum(iterations) < 1.2 * len(iterations), "%s: %s iterations" % (label, iterations)
    assert max(float(r["imbalance"]) for r in coupler) < 1e-10, label
    place[label] = np.array([float(last["x0 [m]"]), float(last["y0 [m]"])])
    assert 0.15 < place[label][1] < 0.19, "%s: at %s" % (label, place[label])
for label in ("two", "half"):
    assert abs(place[label] - place["one"]).max() < 5e-4, "%s: at %s, one rank at %s" % (label, place[label], place["one"])
if len(sys.argv) > 2: print(place)
E2
