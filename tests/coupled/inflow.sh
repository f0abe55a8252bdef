#!/usr/bin/env bash
# Water flows into air: at once, rising on a mesh that is adapted, and beside an inflow of air. The phases fill the domain, no more and no less, from the
# first step on.  Usage: inflow.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/inflow.yaml
adapt=(--set 'fluid.adapt={size_min: 0.02, size_max: 0.06, velocity_error: 0.1, every: 3}')
must once 1:1:1
must once2 2:1:1
must rising 1:1:1 "${adapt[@]}" --set fluid.boundaries.left.rise=0.2
must swinging 2:1:1 "${adapt[@]}" --set fluid.boundaries.left.period=0.2
must beside 1:1:1 --set 'fluid.boundaries.bottom={velocity: [0.1, 0.4], phase: air}'
must beside2 2:1:1 "${adapt[@]}" --set 'fluid.boundaries.bottom={velocity: [0.1, 0.4], phase: air}'
"$python" - "$scratch" <<'E2'
import results
for label in ("once", "once2", "rising", "swinging", "beside", "beside2"):
    rows = results.rows(label, "fluid")
    assert rows[-1]["water [m2]"] > 5e-3, "%s: %g m2 of water came in" % (label, rows[-1]["water [m2]"])
    for row in rows:
        both = row["air [m2]"] + row["water [m2]"]
        assert abs(both - 0.18) < 1e-10 and row["volume gap [m2]"] < 1e-10, "%s, %g s: air and water %.15g m2, gap %g m2" % (
            label, row["t [s]"], both, row["volume gap [m2]"])
        for name in ("air", "water"):
            assert abs(row[name + " made [m2]"]) < 1e-12, "%s, %g s: %s made %g m2" % (label, row["t [s]"], name, row[name + " made [m2]"])
    if label.startswith("once"):  # 1 m/s through 0.3 m from the first step on; a little of it leaves through the corner at the top
        assert all(0.9 < row["water [m2]"] / (0.3 * row["t [s]"]) < 1.0 + 1e-9 for row in rows), label
E2
