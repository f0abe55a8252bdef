#!/usr/bin/env bash
# A plate clamped at the floor with water on one side: its frequency, by bending waves and potential theory (clamped_reference.py), what it loses in a
# period, and how far the water's weight bends it.  Usage: clamped.sh ROOT BUILD [long | --set key=value...]
# long: steps of twice and half the length, and with the latter half the elements; --set: one run with these keys, without bounds
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/clamped.yaml limit=1800
case ${1:-} in
  --set) must tried 1:1:1 "$@" ;;
  *) must 0.001 1:1:1 ;;&
  long)
    must 0.002 1:1:1 --set time.dt_max=0.002
    must 0.0005 1:1:1 --set time.dt_max=0.0005
    must half 1:1:1 --set time.dt_max=0.0005 --set fluid.adapt.size_min=0.0025
    ;;
esac
"$python" - "$scratch" <<'E2'
import numpy as np, os, sys
from clamped_reference import plate
from results import rows
_, frequency, tip = plate(0.2, 0.01, 1100.0, 3.3e8, 0.3, 1000.0, 0.15, 0.45, 9.81)
# bounds of frequency, deflection, and of what is lost a period
for run, bounds in ("0.002", (0.07, 0.015, 0.25)), ("0.001", (0.02, 0.015, 0.09)), ("0.0005", (0.012, 0.015, 0.05)), ("half", (0.008, 0.01, 0.05)), ("tried", (9, 9, 9)):
    if not os.path.exists("%s/%s" % (sys.argv[1], run)): continue
    t, x = np.array([[row["t [s]"], row["tip_x [m]"]] for row in rows(run, "solid_probes") if row["t [s]"] > 0.22]).T

    def swing(hertz, rate):
        """The mean, with what is left of x = mean + (a cos + b sin)(2 pi hertz t) e^(- rate t) by least squares."""
        decay = np.exp(-rate * t)
        basis = np.array([t ** 0, decay * np.cos(2 * np.pi * hertz * t), decay * np.sin(2 * np.pi * hertz * t)]).T
        best = np.linalg.lstsq(basis, x, rcond=None)[0]
        return np.linalg.norm(basis @ best - x), best[0]

    found, rate, width = frequency, 1.0, 2.0
    while width > 1e-4:
        _, found, rate = min((swing(f, r)[0], f, r) for f in found + width * np.linspace(-1, 1, 9) for r in rate + width * np.linspace(-1, 1, 9))
        width *= 0.6
    deflection, lost = swing(found, rate)[1], 1.0 - np.exp(-rate / found)
    report = "%s: %.2f Hz (%+.1f %%), tip %.3f mm (%+.1f %%), lost a period %.1f %%; theory %.2f Hz, %.3f mm" % (
        run, found, 100.0 * (found / frequency - 1.0), 1e3 * deflection, 100.0 * (deflection / tip - 1.0), 100.0 * lost, frequency, 1e3 * tip)
    print(report)
    assert abs(found / frequency - 1.0) < bounds[0] and abs(deflection / tip - 1.0) < bounds[1] and 0.0 < lost < bounds[2], report
E2
