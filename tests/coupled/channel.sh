#!/usr/bin/env bash
# The benchmark of Schaefer and Turek (1996) with the cylinder immersed, D/le = 25.  2D-1: drag 5.5795 within 1 %.  2D-2: largest drag
# 3.22 .. 3.24, lift 0.99 .. 1.01, St 0.295 .. 0.305, each within 3 % of that interval's middle.  Usage: channel.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
limit=3600 case=$here/channel.yaml
must steady 1:1:1 --set time.end=3
must shedding 1:1:1 --set time.end=7 --set time.dt_max=0.01 --set "fluid.boundaries.left.velocity=[1.5, 0.0]" --set fluid.adapt.velocity_error=0.01
"$python" - "$scratch" <<'E2'
import sys
from results import rows
def forces(label, per_newton, start):
    late = [r for r in rows(label, "solid") if r["t [s]"] > start]
    return [r["t [s]"] for r in late], *([per_newton * r[k] for r in late] for k in ("fx0 [N/m]", "fy0 [N/m]"))
failed = False
def compare(name, value, reference, bound):
    global failed
    print("%s %.4f, reference %g: %+.2f %%" % (name, value, reference, 100 * (value / reference - 1)))
    failed |= abs(value / reference - 1) > bound
t, drag, lift = forces("steady", 500.0, 2.7)
compare("2D-1: drag", sum(drag) / len(drag), 5.5795, 0.01)
t, drag, lift = forces("shedding", 20.0, 5.0)
up = [a - (b - a) * p / (q - p) for a, b, p, q in zip(t, t[1:], lift, lift[1:]) if p < 0 <= q]
compare("2D-2: St", 0.1 * (len(up) - 1) / (up[-1] - up[0]), 0.3, 0.03)
compare("2D-2: largest drag", max(drag), 3.23, 0.03)
compare("2D-2: largest lift", max(lift), 1.0, 0.03)
sys.exit(failed)
E2
