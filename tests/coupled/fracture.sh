#!/usr/bin/env bash
# A beam held at its left end cracks there under its weight and sinks in the tank: shell and overlap follow its pieces, momentum goes from fluid to solid to
# round-off, and any number of ranks gives the same answer.  Usage: fracture.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
for ranks in 1:1:1 1:2:2; do
  must "${ranks//:/-}" "$ranks" --set "solid.materials.disc=$brittle" --set "solid.bodies[0]=$bar" --set time.end=0.4
done
"$python" - "$scratch" <<'E2'
from results import rows, summary
def last(label):
    row = rows(label, "solid")[-1]
    imbalance = summary(label)["largest_momentum_imbalance"]
    assert imbalance < 1e-10, "%s: momentum imbalance %g" % (label, imbalance)
    return [row[key] for key in ("broken joints", "fracture [J/m]", "v0 [m/s]", "t [s]")]
one, two = last("1-1-1"), last("1-2-2")
assert one[0] >= 3 and one[1] > 3 * 0.025 * 1.0 * 0.95, "%g joints broken, %g J/m" % (one[0], one[1])
assert abs(one[3] - 0.4) < 1e-9 and one[2] < -0.2, "at %g s it falls at %g m/s" % (one[3], -one[2])
assert one[0] == two[0] and abs(one[1] - two[1]) < 1e-6 * one[1], "one rank %s, two %s" % (one, two)
E2
