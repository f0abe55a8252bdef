#!/usr/bin/env bash
# The pressure of the fluid around compresses a block as it does in theory, (1 + nu)(1 - 2 nu) p/E along both axes in plane strain, the same on other
# numbers of ranks; a run that resumes has what has risen of the load.  Without the key the block stays as it is.  Usage: pressure.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/pressure.yaml
# the equations are solved as far as the digits that are compared
far=(--set "fluid.petsc=-pressure_varying_ksp_rtol 1e-12 -momentum_ksp_rtol 1e-9")
must whole 1:1:1 "${far[@]}"
must ranks 2:2:2 "${far[@]}" --set time.end=0.1
must resumed 1:1:1 "${far[@]}" --set time.end=0.1
must resumed 1:1:1 "${far[@]}" --set time.end=0.2 --set resume=last
must spread 1:1:1 "${far[@]}" --set time.end=0.1
must spread 1:2:2 "${far[@]}" --set time.end=0.2 --set resume=last
must off 1:1:1 --set time.end=0.1 --set solid.pressure_load=false
"$python" - "$scratch" <<'E2'
from results import rows
SIDE, THEORY = 0.1, (1 + 0.3) * (1 - 2 * 0.3) * 5e3 / 1e6
def strains(label):
    """Of each step: its time and the block's strains along x and y."""
    return [(r["t [s]"], (r["right_x [m]"] - r["left_x [m]"]) / SIDE, (r["top_y [m]"] - r["bottom_y [m]"]) / SIDE) for r in rows(label, "solid_probes")]
def compare(label, end, tolerance):
    found = strains(label)
    assert abs(found[-1][0] - end) < 1e-9, (label, found[-1])
    for r, s in zip(whole, found):
        assert abs(r[0] - s[0]) < 1e-9 and all(abs(a - b) < tolerance * THEORY for a, b in zip(r[1:], s[1:])), "%s: %s instead of %s" % (label, s, r)
whole = strains("whole")
for strain in whole[-1][1:]:
    assert abs(strain / -THEORY - 1) < 0.02, "strain %g, in theory %g" % (strain, -THEORY)
compare("ranks", 0.1, 1e-6)
compare("resumed", 0.2, 1e-9)
compare("spread", 0.2, 1e-6)
for strain in strains("off")[-1][1:]:
    assert abs(strain) < 0.01 * THEORY, "without the load: strain %g" % strain
E2
