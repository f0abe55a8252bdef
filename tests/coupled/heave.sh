#!/usr/bin/env bash
# A cylinder let go a tenth of its radius above where it floats heaves as linear potential theory says for the same tank (heave_reference.py, which is that
# of Maskell and Ursell where the tank is large): when it passes its place, how far it goes below and above.
# Usage: heave.sh ROOT BUILD [long | box | --set key=value...]     long: half the size, and a rigid square that is let go a twentieth of its draught above where it floats, too;
# box: the square from other heights and with half the size (a table of SOLIDS_AMONG_PHASES.md); --set: one run with these keys, without bounds
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/heave.yaml limit=1800
half=(--set fluid.adapt.size_min=0.005 --set fluid.adapt.interface_size=0.01 --set time.dt_max=0.002 --set "solid.bodies[0].size=0.005")
square() { # label height [launch.sh arguments]
  must "$1 $2" 1:1:1 --set time.end=1.6 --set "solid.bodies=[{shape: rectangle, centre: [1.5, $(awk "BEGIN { print 1.0 + $2 }")], width: 0.2, height: 0.2, size: 0.02, material: disc, prescribed: [{velocity: [0, 0], component: x}]}]" \
    --set solid.materials.disc.law=rigid "${@:3}"
}
case ${1:-} in
  --set) must tried 1:1:1 "$@" ;;
  box)
    for height in 0.02 0.01 0.005; do square 0.01 $height; done
    square 0.005 0.005 "${half[@]}" --set "solid.bodies[0].size=0.01"
    ;;
  *) must 0.01 1:1:1 ;;&
  long)
    must 0.005 1:1:1 "${half[@]}"
    square 0.01 0.005
    ;;
esac
"$python" - "$scratch" <<'E2'
import glob, numpy as np, os, sys
from heave_reference import decay, heave, marks, tank
from results import rows
from roll_reference import Tank
RADIUS, LEVEL = 0.1, 1.0

def square_theory():
    """Zeros, minimum and maximum of a square of 0.2 m; the error at its corners is of order 4/3."""
    t = np.linspace(0.0, 1.2, 1201)
    coarse, fine = [np.array(marks(t, Tank(3.0, 1.0, 1.5, 0.2, 0.2, 0.1, 0.5, 9.81, size).motion.released(t, 1))) for size in (0.05, 0.025)]
    return fine + (fine - coarse) / (2.0 ** (4.0 / 3.0) - 1.0)

squares = glob.glob(sys.argv[1] + "/* */")
theory = square_theory() if squares else None
for label in sorted(folder.split("/")[-2] for folder in squares):
    time, z = np.array([[row["t [s]"], row["y0 [m]"] - LEVEL] for row in rows(label, "solid") if row["t [s]"] < 1.2]).T
    found = np.array(marks(time, z / float(label.split()[1])))
    report = "square, le %s, height %s m: 0 at %.4f and %.4f s, minimum %.3f, maximum %.3f; theory %.4f, %.4f, %.3f, %.3f" % (*label.split(), *found, *theory)
    print(report)
    if label.endswith(" 0.005"): assert (abs(found / theory - 1.0)[:2] < 0.015).all() and (abs(found - theory)[2:] < 0.015).all(), report
if squares and not os.path.exists(sys.argv[1] + "/0.01"): sys.exit()
t = np.linspace(0.0, 8.4, 841)
for w in 0.5, 1.0, 2.0, 4.0:
    _, damping, energy = heave(w)
    assert abs(damping - energy) < 1e-4, "damping %g, by the waves' energy %g" % (damping, energy)
deep, large = decay(t), tank(t, 80.0, 40.0, 0.1)
assert abs(deep[0] - 1.0) < 1e-4, "theory begins at %g" % deep[0]
assert abs(large - deep).max() < 0.006, "a large tank differs from deep water by %g" % abs(large - deep).max()
theory = np.array(marks(t, tank(t, 15.0, 10.0, 0.05)))
for size, most_time, most_height in ("0.01", 0.03, 0.02), ("0.005", 0.015, 0.015), ("tried", 1.0, 1.0):
    if not os.path.exists("%s/%s" % (sys.argv[1], size)): continue
    time, z = np.array([[row["t [s]"], row["y0 [m]"] - LEVEL] for row in rows(size, "solid")]).T
    found = np.array(marks(time / np.sqrt(RADIUS / 9.81), z / round(z[0], 4)))  # let go at z, which the first step has not changed by 0.05 mm
    report = "le %s: 0 at %.3f and %.3f, minimum %.3f, maximum %.3f; theory %.3f, %.3f, %.3f, %.3f" % (size, *found, *theory)
    print(report)
    assert (abs(found / theory - 1.0)[:2] < most_time).all() and (abs(found - theory)[2:] < most_height).all(), report
E2
