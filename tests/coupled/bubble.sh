#!/usr/bin/env bash
# A bubble with surface tension: its area is kept, its rise is the same on other ranks and after a resume; steps keep to the capillary
# limit.
# Usage: bubble.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/bubble.yaml
must one 1:1:1
must two 2:1:1
must half 1:1:1 --set time.end=0.12
must half 1:1:1 --set resume=last
must short 1:1:1 --set fluid.capillary_cfl=0.2 --set time.end=0.12
"$python" - "$scratch" ${1:+print} <<'E2'
import csv, numpy as np, sys
def columns(label, part):
    rows = list(csv.reader(open("%s/%s/%s.csv" % (sys.argv[1], label, part))))
    return {name.split(" [")[0]: np.array([float(r[k]) for r in rows[1:]]) for k, name in enumerate(rows[0])}
runs = {label: columns(label, "fluid_probes") for label in ("one", "two", "half", "short")}
for label, run in runs.items():
    assert abs(run["bubble_area"] / run["bubble_area"][0] - 1.0).max() < 1e-9, "%s: area %s" % (label, run["bubble_area"])
    assert (np.diff(run["bubble_y"][2:]) > 0.0).all(), label
steps = {label: columns(label, "fluid")["dt"] for label in runs}
assert steps["one"].max() < 0.02 and steps["short"].max() < 0.6 * steps["one"].max(), "steps of %g and %g s" % (steps["one"].max(), steps["short"].max())
last = {label: np.array([run[name][-1] for name in ("bubble_x", "bubble_y", "bubble_v")]) for label, run in runs.items()}
assert len(runs["half"]["t"]) >= len(runs["one"]["t"])
for label in ("two", "half"):
    assert abs(last[label] - last["one"]).max() < 1e-3, "%s: %s, one rank %s" % (label, last[label], last["one"])
if len(sys.argv) > 2: print(last)
E2
