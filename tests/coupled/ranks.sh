#!/usr/bin/env bash
# Any number of ranks gives the same answer to solver tolerance, ranks that own nothing included; and the momentum that the fluid
# gains is what the solid loses, to round-off.  Usage: ranks.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
for ranks in 1:1:1 2:1:1 1:2:2 3:3:3; do must "${ranks//:/-}" "$ranks" --set 'fluid.petsc=-momentum_ksp_rtol 1e-9'; done
"$python" - "$scratch" <<'E2'
from results import rows, summary
def last(label):
    row = rows(label, "coupler")[-1]
    imbalance = summary(label)["largest_momentum_imbalance"]
    assert imbalance < 1e-10, "%s: momentum imbalance %g" % (label, imbalance)
    return row["u_y [m/s]"], row["F_y [N]"]
u, f = last("1-1-1")
assert -0.35 < u < -0.2, "the disc falls at %g m/s" % -u
for label in ("2-1-1", "1-2-2", "3-3-3"):
    v, g = last(label)
    assert abs(v - u) < 1e-7 * abs(u), "%s: velocity %.12g instead of %.12g" % (label, v, u)
    assert abs(g - f) < 1e-6 * abs(f), "%s: force %.12g instead of %.12g" % (label, g, f)
E2
