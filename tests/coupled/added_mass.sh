#!/usr/bin/env bash
# The added mass that a solid feels, against potential flow (added_mass.py): the first acceleration of discs of 0.05, 0.5 and 2 times the
# fluid's density (D/le = 50), and the frequency of a rigid disc and of an elastic one on a spring (D/le = 25, Stokes number f D^2/nu = 6250).
# Usage: added_mass.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$root/cases/falling_cylinder/case.yaml
box=(--set fluid.viscosity=0.01 --set "fluid.mesh.upper=[0.75, 0.75]" --set fluid.mesh.size_max=0.05 --set fluid.adapt.size_max=0.05
  --set "solid.bodies[0].centre=[0.375, 0.375]")
for ratio in 0.05 0.5 2; do
  must fall-$ratio 1:1:1 "${box[@]}" --set fluid.adapt.size_min=0.005 --set "solid.bodies[0].size=0.0075" \
    --set "solid.materials.disc.density=$("$python" -c "print(1000 * $ratio)")" --set time.dt_max=0.002 --set time.end=0.002
done
for ratio in 0.5 2; do
  must spring-$ratio 1:1:1 "${box[@]}" --solid "$build/tests/route/rigid_disc" --set "solid.bodies[0].size=0.01" --set "gravity=[0.0, 0.0]" \
    --set "solid.materials.disc.density=$("$python" -c "print(1000 * $ratio)")" --set "solid.bodies[0].velocity=[0.0, 0.06]" \
    --set "solid.bodies[0].spring=$("$python" "$here/added_mass.py" --stiffness $ratio)" --set time.end=1.6
done
must elastic-2 1:1:1 "${box[@]}" --set "solid.bodies[0].size=0.01" --set "gravity=[0.0, 0.0]" --set solid.materials.disc.density=2000 \
  --set "solid.bodies[0].velocity=[0.0, 0.06]" --set time.end=1.6 \
  --set "solid.springs=[{name: s, point: [0.375, 0.375], anchor: [0.375, 0.375], stiffness: $("$python" "$here/added_mass.py" --stiffness 2)}]"
"$python" "$here/added_mass.py" "$scratch"
