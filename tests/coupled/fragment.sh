#!/usr/bin/env bash
# A drop smaller than an element falls, as far with half of the step and on two ranks and after a resume, and as its velocity says; its volume
# and what has left through the open top are kept, and kinetic and potential energy together do not grow.  Usage: fragment.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/fragment.yaml
must long 1:1:1
must short 1:1:1 --set time.dt_max=0.001
must two 2:1:1
must half 1:1:1 --set time.end=0.07
must half 1:1:1 --set resume=last
"$python" - "$scratch" ${1:+print} <<'E2'
import sys
from results import column
def of(label): return [column(label, "fluid_probes", "drop_" + key) for key in ("y [m]", "v [m/s]", "area [m2]")], column(label, "fluid_probes", "t [s]")
fall = {}
for label in ("long", "short", "two", "half"):
    (y, v, area), t = of(label)
    fall[label] = y[0] - y[-1]
    said = -sum(0.5 * (v[k] + v[k + 1]) * (t[k + 1] - t[k]) for k in range(len(t) - 1))
    energy = [k + p for k, p in zip(column(label, "fluid", "kinetic energy [J/m]"), column(label, "fluid", "potential energy [J/m]"))]
    freed = -1000.0 * 9.81 * area[0] * (y[-1] - y[0])
    rise = max(e - min(energy[: k + 1]) for k, e in enumerate(energy))
    if len(sys.argv) > 2: print(label, "fall", fall[label], "by its velocity", said, "rise of energy", rise / freed, "end", (energy[-1] - energy[0]) / freed)
    kept = [a + out for a, out in zip(area, column(label, "fluid", "water out [m2]"))]
    assert max(abs(a / area[0] - 1.0) for a in kept) < 1e-9, "%s: areas with what has left %s" % (label, kept)
    assert 0.04 < fall[label] < 0.5 * 9.81 * 0.15**2, "%s: it falls by %g m" % (label, fall[label])
    assert abs(said - fall[label]) < 0.01, "%s: it falls by %g m, by its velocity by %g m" % (label, fall[label], said)
    assert rise < 0.02 * freed and energy[-1] < energy[0], "%s: kinetic and potential energy rise by %g of %g J/m" % (label, rise, freed)
for label in ("short", "two", "half"):  # within one and a half elements: meshes differ
    assert abs(fall[label] - fall["long"]) < 0.015, "%s: it falls by %g m, in long steps by %g m" % (label, fall[label], fall["long"])
E2
