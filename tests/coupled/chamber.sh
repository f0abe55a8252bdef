#!/usr/bin/env bash
# A gas in a chamber of held walls has the pressure of its volume on meshes that change, whether it is also what fills the walls or a phase of its own.  Two pockets at the
# pressures that levels of water 40 mm apart ask for are at rest from the start; without gas.initial_pressure the water swings.
# Usage: chamber.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/chamber.yaml
must own 1:1:1
must filling 1:1:1 --set 'fluid.phases=[{name: water, density: 1000.0, viscosity: 1.0e-3}, {name: gas, density: 1.2, viscosity: 1.8e-5, gas: {pressure: 1.0e4, exponent: 1.4}}]' --set 'fluid.regions[0].phase=gas'
pockets() { must "$1" 1:1:1 --set time.end=0.1 --set fluid.boundaries.top=free_slip --set 'fluid.phases[1].gas={pressure: 1.0e4, exponent: 1.4}' --set 'fluid.phases[2].density=1.25' "${@:2}"; }
pockets rest --set 'fluid.phases[2].gas.initial_pressure=392.4'
pockets swing
"$python" - "$scratch" <<'E2'
from results import column
HEIGHT, FALLEN, PRESSURE, EXPONENT = 0.4, 0.5, 1e4, 1.4 # of the gas at the start, m; level of the open arm then, m
for label in ("own", "filling"):
    t, level, p = (column(label, "fluid_probes", name) for name in ("t [s]", "level_last [m]", "chamber_p [Pa]"))
    theory = [PRESSURE * ((HEIGHT / (HEIGHT - (FALLEN - y))) ** EXPONENT - 1.0) for y in level]
    late = [k for k in range(len(t)) if t[k] > 0.1]
    slope = sum(p[k] * theory[k] for k in late) / sum(theory[k] ** 2 for k in late)
    print("%s: pressure %.3f times that of the volume" % (label, slope))
    assert abs(slope - 1.0) < 0.035, "%s: the pressure is %.3f times that of the volume" % (label, slope)
level, swings = (abs(column(label, "fluid_probes", "level_last [m]")[-1] - 0.5) for label in ("rest", "swing"))
print("in 0.1 s the level moves by %.2g m, without initial_pressure by %.2g m" % (level, swings))
assert level < 3e-5 and swings > 5e-4, "levels move by %g and %g m" % (level, swings)
E2
