#!/usr/bin/env bash
# Elastic solids without damping.  A plate in a stream bends as far with a tenth of the fluid's density as with the fluid's, in a few coupling
# iterations a step: its vibrations, which neither the step nor damping takes away, do not feed on the fluid's inertia (solid/interface_motion.c;
# before, the light one failed at 1.7 s).  A block adrift in a fluid at rest, with steps of one length, has less and less energy (before, its
# vibrations grew from 1e-10 to 1e-2 J/m).  Usage: plate.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/plate.yaml
must light 1:1:1 --set solid.materials.sheet.density=0.1
must dense 1:1:1
must adrift 1:1:1 --set time.end=2.4 --set time.dt_max=0.006 --set "fluid={density: 1.0, viscosity: 0.005, mesh: {lower: [0.0, 0.0], upper: [1.0, 1.0], size_max: 0.1}, boundaries: {left: no_slip, right: no_slip, bottom: no_slip, top: no_slip}}" \
  --set "solid.bodies=[{shape: rectangle, centre: [0.5, 0.5], width: 0.3, height: 0.3, size: 0.03, material: sheet, order: 2, velocity: [0.1, 0.0]}]" \
  --set "solid.probes=[]" --set coupler.shell_thickness=0.005
"$python" - "$scratch" <<'E2'
from results import column
tip = {run: column(run, "solid_probes", "tip_x [m]")[-1] for run in ("light", "dense")}
iterations = column("light", "coupler", "iterations")
mean = sum(iterations) / len(iterations)
print("tip %.3f and %.3f m aside; %.2f iterations a step" % (tip["light"], tip["dense"], mean))
# its own inertia makes the dense one swing farther
assert 0.7 < tip["light"] / tip["dense"] < 1.1, "the plates bend by %g and %g m" % (tip["light"], tip["dense"])
assert mean < 6.0, "%g coupling iterations a step" % mean
energy = [k + s for k, s in zip(column("adrift", "solid", "kinetic0 [J/m]"), column("adrift", "solid", "strain0 [J/m]"))]
third = len(energy) // 3
assert max(energy[2 * third:]) < max(energy[third:2 * third]), "the block's energy is %g J/m, later %g" % (
    max(energy[third:2 * third]), max(energy[2 * third:]))
assert max(column("adrift", "solid", "strain0 [J/m]")[third:]) < 1e-7
E2
