#!/usr/bin/env bash
# A ring whose rotation is prescribed spins up the fluid in it, against the series of Bessel functions; one and two ranks.
# Usage: spin.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/spin.yaml
for ranks in 1:1:1 2:1:2; do must "spin ${ranks//:/-}" $ranks; done
"$python" - "$scratch" <<'E2'
import numpy as np
from results import rows

RADIUS, NU, SPIN = 0.3, 0.05, 1.0
ZEROS = np.array([3.8317059702, 7.0155866698, 10.1734681351, 13.3236919363, 16.4706300509])  # of J1
angle = (np.arange(4000) + 0.5) * np.pi / 4000


def bessel(order, x):
    return np.cos(order * angle - x * np.sin(angle)).mean()


def theory(r, t):
    decay = np.exp(-ZEROS**2 * NU * t / RADIUS**2)
    return SPIN * (r + 2.0 * RADIUS * sum(bessel(1, z * r / RADIUS) / (z * bessel(0, z)) * d for z, d in zip(ZEROS, decay)))


for ranks in "1-1-1", "2-1-2":
    for row in rows("spin " + ranks, "fluid_probes"):
        t = row["t [s]"]
        if t < 0.1:
            continue
        for name, r, column, sign in ("near", 0.25, "v", 1.0), ("half", 0.15, "u", -1.0), ("middle", 0.0, "u", 1.0):
            found, expected = sign * row["%s_%s [m/s]" % (name, column)], theory(r, t)
            report = "%s, t %.3f s, %s: %.5f m/s, theory %.5f" % (ranks, t, name, found, expected)
            assert abs(found - expected) < 0.01 * SPIN * RADIUS, report
    print(report)
E2
