#!/usr/bin/env bash
# A case without bodies is a fluid alone: a lid drives it, the same on any number of ranks, and with a mesh that adapts the same after a checkpoint.
# Usage: alone.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
# ranks are compared to 1e-6 of the velocity: the momentum equation is solved as far
lid=(--set "fluid.petsc=-momentum_ksp_rtol 1e-6" --set 'solid.bodies=[]' --set 'solid.materials={}' --set 'fluid.boundaries.top={velocity: [1, 0], rise: 0.1}' --set fluid.viscosity=50 --set time.end=0.2
  --set time.dt_max=0.02 --set 'fluid.probes=[{name: axis, line: {from: [1, 0.4], to: [1, 1.9], points: 4}}, {name: under, point: [0.3, 1.6]}]')
adapt=(--set fluid.adapt.size_min=0.05 --set fluid.adapt.size_max=0.25 --set fluid.adapt.velocity_error=0.02 --set fluid.adapt.every=4)
must one 1:1:1 "${lid[@]}"
must many 3:2:2 "${lid[@]}"
must adapted 1:1:1 "${lid[@]}" "${adapt[@]}"
must resumed 1:1:1 "${lid[@]}" "${adapt[@]}" --set time.end=0.1
must resumed 1:2:1 "${lid[@]}" "${adapt[@]}" --set resume=last
! run missing 1:1:1 --set solid=null || { echo "a case without solid.bodies is accepted"; exit 1; }
"$python" - "$scratch" <<'E2'
from results import column, rows
def triangles(label):
    return set(column(label, "fluid", "triangles"))
assert len(triangles("one")) == 1 and len(triangles("resumed")) > 1, "%s and %s triangles" % (triangles("one"), triangles("resumed"))
for label, same in (("one", "many"), ("adapted", "resumed")):
    first, second = ([list(r.values()) for r in rows(run, "fluid_probes")] for run in (label, same))
    top = max(abs(r[10]) for r in first)
    assert len(first) == len(second) >= 10 and 0.2 < top < 1.0, "%s: %d rows, %d; u below the lid at most %g m/s" % (label, len(first), len(second), top)
    for r, s in zip(first, second):
        assert all(abs(r[k] - s[k]) < 1e-6 * top for k in range(16) if k == 0 or k % 3), "%s at %g s: %s, %s: %s" % (label, r[0], r, same, s)
E2
