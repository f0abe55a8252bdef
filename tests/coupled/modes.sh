#!/usr/bin/env bash
# The published couplings: the disc of cases/falling_cylinder with le 0.02 m falls after a second within a tenth as fast as the body-fitted one
# (1.0716 m/s), on one rank and on two alike; the reaction to penalty_shell keeps momentum.  With the fluid inside left free stress_shell's disc falls
# at 0.75 m/s.  Usage: modes.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$root/cases/falling_cylinder/case.yaml
coarse="--set fluid.adapt.size_min=0.02 --set solid.bodies[0].size=0.03 --set coupler.shell_thickness=0.001 --set fluid.adapt.velocity_error=0.025"
for mode in stress_shell penalty_shell; do
  published="$coarse --set coupler.mode=$mode --set coupler.max_iterations=1 --set time.cfl=0.5 --set output.every=1"
  must "$mode-1" 1:1:1 $published --set time.end=1
  must "$mode-2" 2:2:2 $published --set time.end=0.3
done
"$python" - "$scratch" <<'E2'
import numpy as np
from results import column, summary
def fall(run, t):
    return -np.interp(t, column(run, "solid", "t [s]"), column(run, "solid", "v0 [m/s]"))
for mode in "stress_shell", "penalty_shell":
    last, one, two = fall(mode + "-1", 1.0), fall(mode + "-1", 0.3), fall(mode + "-2", 0.3)
    print("%s: %.4f m/s; after 0.3 s %.4f and %.4f" % (mode, last, one, two))
    assert abs(last / 1.0716 - 1.0) < 0.1, "%s: the disc falls at %.4f m/s" % (mode, last)
    assert abs(two / one - 1.0) < 0.02, "%s: the disc falls at %.4f m/s, on two ranks at %.4f" % (mode, one, two)
imbalance = summary("penalty_shell-1")["largest_momentum_imbalance"]
assert imbalance < 1e-10, "penalty_shell: momentum imbalance %g" % imbalance
E2
