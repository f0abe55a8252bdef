#!/usr/bin/env bash
# scripts/check.sh tells ten faults of a case at once, touches no output, and draws a good case.  Usage: check.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/../coupled/run.sh"
case=$root/tests/coupled/disc.yaml
fail() { echo "check: $1"; cat "$scratch/log"; exit 1; }

check() { (cd "$scratch" && "$root/scripts/check.sh" --bin "$build" "$@") >"$scratch/log" 2>&1; }

! check "$case" --set output.every=-1 --set time.end=soon --set coupler.mode=magic --set fluid.densty=1 --set fluid.viscosity=0 \
  --set fluid.theta=0.3 --set fluid.boundaries.top=slippery --set solid.materials.disc.poisson_ratio=0.5 --set 'solid.bodies[0].radius=0' \
  --set solid.colour=red || fail "a case of ten faults is accepted"
for key in output.every time.end coupler.mode fluid.densty fluid.viscosity fluid.theta fluid.boundaries.top \
  solid.materials.disc.poisson_ratio 'solid.bodies\[0\].radius' solid.colour; do
  [ "$(grep -c "key '$key'" "$scratch/log")" -eq 1 ] || fail "the fault of $key is not told once"
done
[ "$(wc -l <"$scratch/log")" -eq 10 ] || fail "not ten lines"

# what a run would refuse at its start: a body that reaches out of the fluid, of a box or of a mesh, and a probe outside of all bodies
body='solid.bodies\[0\].: the solid.s node [0-9]* at (.*) lies outside of the fluid domain \[0, 2\] x'
! check "$case" --set 'solid.bodies[0].centre=[1.95, 1.1]' || fail "a body outside of the fluid is accepted"
grep -q "$body \[0, 2\]" "$scratch/log" && [ "$(wc -l <"$scratch/log")" -eq 1 ] || fail "not where the body is outside"
square=(--set "fluid.mesh={file: $root/tests/solid/square.msh}" --set 'fluid.boundaries={boundary: no_slip, clamp: no_slip}')
! check "$case" "${square[@]}" || fail "a body outside of a mesh is accepted"
grep -q "${body/2/1} \[0, 1\]" "$scratch/log" && [ "$(wc -l <"$scratch/log")" -eq 1 ] || fail "not where the body is outside of a mesh"
check "$case" "${square[@]}" --set 'solid.bodies[0].centre=[0.5, 0.5]' || fail "a body in a mesh has faults"
! check "$case" --set 'solid.probes=[{name: a, point: [1.0, 1.1]}, {name: b, point: [1.2, 1.1]}]' || fail "a probe outside of all bodies is accepted"
grep -q "solid.probes\[1\].point.: no body is at (1.2, 1.1) at rest; the nearest is 0.07[0-9]* m away" "$scratch/log" && [ "$(wc -l <"$scratch/log")" -eq 1 ] ||
  fail "not where the probe is"

# likewise a gauge off the surface, a checkpoint that is not there, a budget of triangles below that of the largest edges
refuses() { ! check "$case" --set "$2" || fail "accepted: $2"; grep -q "$1" "$scratch/log" && [ "$(wc -l <"$scratch/log")" -eq 1 ] || fail "not '$1' alone"; }
refuses "fluid.probes\[0\].solid_point.: expected a point of the solid.s surface, (1, 1.3) is 0.07[0-9]* m away from it" 'fluid.probes=[{name: P, solid_point: [1.0, 1.3], distance: 0.1}]'
check "$case" --set 'fluid.probes=[{name: P, solid_point: [1.0, 1.225], distance: 0.1}]' || fail "a gauge on the surface has faults"
refuses "'resume': there is no checkpoint 'nowhere'" resume=nowhere
refuses "'output.folder': expected the name of a folder" output.folder=
check "$case" --set note= && check "$case" --set 'note= ' || fail "an empty value is not one"
check "$case" --set time.dt_max=1e-300 && grep -q 'in at least [0-9.]*e+298 steps\|in at least 1e+299 steps' "$scratch/log" || fail "numbers of hundreds of digits"
check "$case" --set time.walltime=9 --set output.checkpoint=0 && grep -q '^note: output.checkpoint is 0: ' "$scratch/log" || fail "not that a run that ends early is lost"
check "$case" --set resume=last || fail "a run that begins at the start has faults"
refuses "'fluid.adapt.elements_max': edges of fluid.adapt.size_max, 0.2 m, alone take 231 triangles" 'fluid.adapt={size_min: 0.1, size_max: 0.2, velocity_error: 0.1, elements_max: 100}'

# what depends on a refused mesh is not told: the keys of a box or a shape, names of boundaries
for set in 'fluid.mesh={file: nowhere.msh}' 'solid.bodies=[{mesh: nowhere.msh, material: disc, translate: [1.0, 1.1]}]'; do
  ! check "$case" --set "$set" || fail "a mesh that is not there is accepted"
  grep -q "key '.*': .*nowhere.msh" "$scratch/log" && grep -q "the rest can be checked when" "$scratch/log" && [ "$(wc -l <"$scratch/log")" -eq 2 ] ||
    fail "not the fault of the mesh alone"
done

! check "$scratch/nowhere.yaml" || fail "a case that is not there is accepted"
[ "$(wc -l <"$scratch/log")" -eq 1 ] && grep -q "nowhere.yaml.: No such file" "$scratch/log" || fail "not one line"

check "$case" --png "$scratch/case.png" || fail "a good case has faults"
for line in "coupler: to t = 0.1 s in at least 10 steps" "fluid: mesh of [0-9]* triangles" "fluid: memory about" "solid: 1 bodies of 54 triangles" \
  "solid: substeps of at most"; do
  grep -q "$line" "$scratch/log" || fail "it does not say '$line'"
done
check "$case" --set 'solid.bodies[0].order=2' && grep -q "solid: 1 bodies of 216 triangles (54 of six nodes, each counts as four)" "$scratch/log" ||
  fail "not how many triangles of six nodes there are"
[ "$(head -c 4 "$scratch/case.png" | tail -c 3)" = PNG ] || fail "there is no picture"
[ ! -e "$scratch/out" ] || fail "output was made"

# what is no fault but hardly meant: walls that hold no body, one step for all of a run, a shell of more than an element
notes() { [ "$(grep -c '^note: ' "$scratch/log")" -eq "$1" ] || fail "not $1 notes"; }
notes 1
grep -q 'no solid.walls: solid.bodies\[0\] may leave through the sides' "$scratch/log" || fail "not that the body may leave"
tank=(--set 'solid.walls={lower: [0, 0], upper: [2, 2]}')
check "$case" "${tank[@]}" && notes 0 || fail "notes of a good case"
for set in 'gravity=[0, 0]' 'solid.bodies[0].fixed=true' 'solid.bodies[0].prescribed=[{velocity: [0, 1]}]' \
  'solid.springs=[{name: line, point: [1.0, 1.1], anchor: [1.0, 2.0], stiffness: 1.0}]' \
  'solid.bodies[0].prescribed=[{velocity: [0, 1], release: 0.1}]'; do
  "$build/solid/coracle-solid" --check "$case" --set "$set" >"$scratch/log" 2>&1 && notes 0 || fail "a note with $set"
done
for set in 'fluid.boundaries={left: open, right: {pressure: 0}, bottom: open, top: open}' 'solid.bodies[0].prescribed=[{velocity: [0, 1], release: 0.05}]' \
  'solid.bodies[0].prescribed=[{velocity: [0, 0], component: x}]'; do
  "$build/solid/coracle-solid" --check "$case" --set "$set" >"$scratch/log" 2>&1 && notes 1 || fail "no note with $set"
done
# a body on a sloping side of the domain, or out of it, within its bounds and the walls
on_slope() {
  "$build/solid/coracle-solid" --check "$case" "${tank[@]}" --set 'fluid.mesh={corners: [[0, 2], [2, 0], [2, 2]], size_max: 0.2}' \
    --set "solid.bodies=[{shape: polygon, corners: [[$2, $3], [1.2, 0.8], [1.2, 1.2]], size: 0.1, material: disc${4:-}}]" >"$scratch/log" 2>&1 && notes "$1" || fail "not $1 notes of a body at ($2, $3)"
}
on_slope 1 0.8 1.2
grep -q 'solid.bodies\[0\] begins at a side of the fluid.s domain, at (.*), where there are no solid.walls' "$scratch/log" || fail "another note"
on_slope 0 0.8 1.2 ', fixed: true'
on_slope 0 1.1 1.1 ', fixed: true'
on_slope 1 0.7 1.1 ', fixed: true'
grep -q 'solid.bodies\[0\] reaches out of the fluid.s domain, at (0.7, 1.1) by 0.141 m' "$scratch/log" || fail "another note"
check "$case" "${tank[@]}" --set time.dt_max=0.2 --set 'fluid.adapt={size_min: 0.05, size_max: 0.2, velocity_error: 0.1}' --set coupler.shell_thickness=0.06 || fail "a good case has faults"
notes 2
grep -q 'time.dt_max, 0.2 s, is more than time.end, 0.1 s' "$scratch/log" && grep -q 'shell_thickness, 0.06 m, is more than fluid.adapt.size_min, 0.05 m' "$scratch/log" || fail "other notes"

grep -q 'fluid: starts from a mesh of [0-9]* triangles' "$scratch/log" || fail "not which mesh it names"
grep -q 'fluid: memory about [0-9]* MB, if it reaches fluid.adapt.elements_max$' "$scratch/log" || fail "not what the memory is of"

# levels that the domain does not have, and a phase that flows in unsaid
level() { "$build/fluid/coracle-fluid" --check "$root/tests/coupled/level.yaml" "${@:2}" >"$scratch/log" 2>&1 && notes "$1" || fail "not $1 notes with ${*:2}"; }
level 0
level 0 --set 'fluid.boundaries.left={level: [{phase: water, height: 0.2}, {phase: air, height: 9.0}]}'
level 1 --set 'fluid.boundaries.left={level: [[0, 0.3], [1, 0.6]]}'
grep -q 'boundaries.left: the level, 0.6 m, is above the top of the fluid.s domain, 0.5 m' "$scratch/log" || fail "another note"
level 1 --set 'fluid.boundaries.left={level: -0.1}'
grep -q 'boundaries.left: the level, -0.1 m, is below the bottom of the fluid.s domain, 0 m' "$scratch/log" || fail "another note"
level 1 --set 'fluid.boundaries.left={velocity: [0.1, 0]}'
grep -q 'boundaries.left: what flows in is air, the lightest phase' "$scratch/log" || fail "another note"
for set in 'velocity: [0.1, 0], phase: water' 'velocity: [-0.1, 0]' 'velocity: [0, 1]'; do level 0 --set "fluid.boundaries.left={$set}"; done
level 1 --set 'fluid.boundaries.left={velocity: [-0.1, 0], period: 1.0}'

far() { "$build/solid/coracle-solid" --check "$root/tests/solid/alone.yaml" --set "solid.bodies=[{shape: rectangle, centre: [$2, 0.5], width: 0.4, height: 0.2, size: 0.05, material: $3}]" "${@:4}" >"$scratch/log" 2>&1 && notes "$1" || fail "not $1 notes of a body at $2 m"; }
far 0 500.0 stone --set 'solid.walls={lower: [0, 0], upper: [1e6, 1]}'
far 1 500000.5 stone --set 'solid.walls={lower: [0, 0], upper: [1e6, 1]}'
grep -q 'bodies are up to 5e+05 m from the origin, with edges of 0.05 m' "$scratch/log" || fail "another note"

# the wrong way up
half='fluid.regions=[{phase: air}, {phase: water, point: [0, 0.2], normal: [0, 1]}]'
level 0 --set "$half"
level 1 --set "${half/, 1]/, -1]}"
grep -q 'fluid.regions\[1\]: the half plane of water lies above its edge' "$scratch/log" || fail "another note"

# which of two phases of the least density fills solids
third='fluid.phases=[{name: water, density: 1000.0, viscosity: 1.0e-3}, {name: air, density: 1.2, viscosity: 1.8e-5}, {name: gas, density: 1.2, viscosity: 1.8e-5}]'
somewhere='fluid.regions=[{phase: air}, {phase: water, lower: [-1.0, -1.0], upper: [9.0, 0.3]}, {phase: gas, centre: [2.0, 0.1], radius: 0.05}]'
level 1 --set "$third" --set "$somewhere"
grep -q 'air and gas have the same density, the least: air counts as the lightest' "$scratch/log" || fail "another note"
level 0 --set "${third/gas, density: 1.2/gas, density: 1.21}" --set "$somewhere"

# regions outside of the domain, a phase that is nowhere, a gas that is weaker than the water that may lie above it
for shape in 'lower: [5, 0], upper: [6, 1]' 'centre: [2, -1], radius: 0.9' 'point: [9, 0], normal: [-1, 0]' 'polygon: [[4.1, 0], [5, 0], [5, 1]]'; do
  level 1 --set "fluid.regions=[{phase: air}, {phase: water, lower: [-1.0, -1.0], upper: [9.0, 0.3]}, {phase: water, $shape}]"
  grep -qF 'fluid.regions[2], of water, lies outside of the domain, [0, 4] x [0, 0.5] m' "$scratch/log" || fail "another note"
done
level 0 --set 'fluid.regions=[{phase: air}, {phase: water, centre: [2, -1], radius: 1.1}, {phase: water, point: [0, 0.1], normal: [0, 1]}]'
oil='fluid.phases=[{name: air, density: 1.2, viscosity: 1.8e-5}, {name: water, density: 1000.0, viscosity: 1.0e-3}, {name: oil, density: 800.0, viscosity: 1.0e-3}]'
level 1 --set "$oil"
grep -q 'there is no oil: it is in none of fluid.regions and comes in at no boundary' "$scratch/log" || fail "another note"
level 0 --set "$oil" --set 'fluid.boundaries.left={level: [{phase: water, height: 0.2}, {phase: oil, height: 0.3}]}'
level 0 --set "$oil" --set 'fluid.boundaries.left={velocity: [0.1, 0], phase: oil}'
level 0 --set 'fluid.regions=[{phase: water}]'
gas='fluid.phases=[{name: air, density: 1.2, viscosity: 1.8e-5, gas: {pressure: 4900.0}}, {name: water, density: 1000.0, viscosity: 1.0e-3}]'
level 1 --set "$gas"
grep -q 'air has an absolute pressure of 4.9e+03 Pa at the start, and what the domain may hold above it weighs up to 4.9e+03 Pa' "$scratch/log" || fail "another note"
level 0 --set "${gas/4900.0/4900.0, initial_pressure: 10.0}"
level 0 --set "$gas" --set 'gravity=[0, 0]' --set fluid.boundaries.left=open

# walls that water passes through, beside air alone
wall() { "$build/solid/coracle-solid" --check "$root/tests/coupled/fixed.yaml" --set "solid.bodies[0].width=$2" "${@:3}" >"$scratch/log" 2>&1 && notes "$1" || fail "not $1 notes of a wall of $2 m"; }
wall 0 0.03
wall 1 0.02
grep -q 'solid.bodies\[0\] is about 0.02 m thick, fluid.adapt.size_min is 0.013 m' "$scratch/log" || fail "another note"
wall 0 0.02 --set fluid.adapt.size_min=0.01

# keys without an effect: friction of one side alone, strengths without joints, a zone that absorbs outside of the domain; and what bodies weigh
solid() { "$build/solid/coracle-solid" --check "$root/tests/coupled/fixed.yaml" "${@:2}" >"$scratch/log" 2>&1 && notes "$1" || fail "not $1 notes with ${*:2}"; }
solid 1 --set 'solid.walls={lower: [-9, -9], upper: [9, 9], friction: 0.5}'
grep -q "no friction between material '.*' and walls: one side has the coefficient 0.5" "$scratch/log" || fail "another note"
solid 0 --set 'solid.walls={lower: [-9, -9], upper: [9, 9], friction: 0.5}' --set 'solid.contact=[{between: [square, walls], friction: 0}]'
solid 1 --set solid.materials.square.tensile_strength=1e6 --set solid.materials.square.shear_strength=1e6 --set solid.materials.square.fracture_energy=1
grep -q "material 'square' has strengths, but no body has joints" "$scratch/log" || fail "another note"
grep -q '^solid: body 0: .* m2, .* kg/m, weight .* N/m, centre' "$scratch/log" || fail "bodies without weight"
for order in 1 2; do
  solid 0 --set "solid.bodies[0].order=$order"
  grep -q '^solid: body 0: 0.0036 m2, 1.8 kg/m, ' "$scratch/log" || fail "another area of triangles of order $order"
done
level 1 --set 'fluid.absorption=[{from: [1, 0], to: [99, 0], rate: 1}]'
grep -q 'fluid.absorption\[0\].to, (99, 0), lies outside of the domain' "$scratch/log" || fail "another note"

# from where to where prescribed motions get: one that swings begins at an end of its way
solid 0 --set 'solid.bodies[0].fixed=false' --set 'solid.bodies[0].prescribed=[{name: foil, velocity: [0, 3.14159265], angular_velocity: -1.57079633, pivot: [0.3, 0.1], period: 0.02}]'
grep -qF 'solid: body 0 is moved as foil by 0 to 0 m along x, by 0 to 0.02 m along y, turned by -0.01 to 0 rad about (0.3, 0.1) m, which moves with it' "$scratch/log" || fail "not where a motion gets"
solid 0 --set 'solid.bodies[0].fixed=false' --set 'solid.bodies[0].prescribed=[{velocity: [0, 0]}]'
! grep -q 'is moved' "$scratch/log" || fail "a body at rest is moved"
# one that turns by more than a radian in a step, which is 0.01 s
turns() { solid "$1" --set time.dt_max=0.01 --set 'solid.bodies[0].fixed=false' --set "solid.bodies[0].prescribed=[{angular_velocity: $2, pivot: [0.3, 0.1]}]"; }
turns 0 90
turns 1 110
grep -qF 'solid.bodies[0] is turned by up to 1.1 rad in time.dt_max, 0.01 s' "$scratch/log" || fail "another note"
turns 0 '110, period: 0.02'
turns 1 '[[0, 0], [0.01, -110]]'

# no bodies, or none that moves
png() { rm -f "$scratch/case.png"; check "$@" --png "$scratch/case.png" && [ -s "$scratch/case.png" ]; }
png "$case" --set 'solid.bodies=[]' && grep -qx 'solid: no bodies' "$scratch/log" || fail "a fluid alone"
sed '/^coupler:/d' "$case" >"$scratch/fluid.yaml"
check "$scratch/fluid.yaml" --set 'solid.bodies=[]' || fail "a fluid alone needs keys of the coupler"
! check "$scratch/fluid.yaml" && grep -q "key 'coupler.shell_thickness' is missing" "$scratch/log" || fail "a body needs no shell"
png "$case" --set 'solid.bodies[0].fixed=true' && grep -qx 'solid: all bodies are fixed' "$scratch/log" || fail "a fixed body"
! grep -qw inf "$scratch/log" || fail "substeps of a fixed body"
png "$case" --set 'solid.materials.disc.law=rigid' && grep -qx 'solid: all bodies are fixed or rigid: substeps are as contact asks for' "$scratch/log" || fail "a rigid body"

# the picture shows where the phases are: pixels of the water's colour, in 10 000
water() {
  png "$root/tests/coupled/level.yaml" --set "fluid.regions=[{phase: air}, {phase: water, lower: [0, 0], upper: [4, $1]}]" || fail "two phases have faults"
  PYTHONPATH=$root/scripts "$python" -c '
import sys, matplotlib.pyplot as plt
from phases import WATER
print(int(1e4 * (abs(plt.imread(sys.argv[1])[..., :3] - WATER).max(axis=2) < 0.02).mean()))' "$scratch/case.png"
}
shallow=$(water 0.1) deep=$(water 0.4)
[ "$shallow" -gt 50 ] && [ "$deep" -gt $((3 * shallow)) ] || fail "not where the water is: $shallow pixels of 0.1 m, $deep of 0.4 m"

# the solid alone needs no keys of the others, and is told whether its mesh resolves cracks
cat >"$scratch/alone.yaml" <<'E2'
gravity: [0, 0]
time: {end: 1.0, dt_max: 0.1}
solid:
  materials: {rock: {density: 1.0, youngs_modulus: 1.0e6, poisson_ratio: 0.2, tensile_strength: 1.0e4, shear_strength: 1.0e4, fracture_energy: 10.0}}
  bodies: [{shape: rectangle, centre: [0, 0], width: 0.2, height: 0.2, size: 0.1, material: rock, joints: all}]
output: {folder: out, every: 1.0}
E2
png --alone "$scratch/alone.yaml" || fail "a case of the solid alone has faults"
[ "$(wc -l <"$scratch/log")" -eq 5 ] || fail "not five lines"
grep -q 'these edges have few directions' "$scratch/log" || fail "not that cracks zigzag"
grep -q 'edges can crack; .* is 0.7[0-9]* edges long (less than one' "$scratch/log" || fail "not how long cracks are"
check --alone "$scratch/alone.yaml" --set solid.materials.rock.fracture_energy=100 || fail "a case of the solid alone has faults"
grep -q ' is 7.[0-9]* edges long$' "$scratch/log" || fail "warned of cracks that the mesh resolves"
check --alone "$scratch/alone.yaml" --set "solid.bodies=[{mesh: $root/cases/breaking_block/block.msh, material: rock, joints: all}]" || fail "a case of the solid alone has faults"
! grep -q 'few directions' "$scratch/log" || fail "warned of a mesh of all directions"
! check --alone "$scratch/alone.yaml" --set time.dt_max=-1 || fail "a step below 0 is accepted"
[ "$(wc -l <"$scratch/log")" -eq 1 ] && grep -q "key 'time.dt_max'" "$scratch/log" || fail "not one line"
! png --alone "$scratch/alone.yaml" --set 'solid.bodies=[]' || fail "a picture of nothing"
grep -q 'neither a fluid nor bodies' "$scratch/log" || fail "not why there is no picture"
! check --alone "$scratch/alone.yaml" --set 'solid.bodies[0].size=-1' || fail "a size below 0 is accepted"
[ "$(wc -l <"$scratch/log")" -eq 1 ] && grep -q "key 'solid.bodies\[0\].size'" "$scratch/log" || fail "not one line"

# keys of another program are its own
! check "$case" --set solid.colour=red || fail "a key that the solid does not know is accepted"
check "$case" --set solid.colour=red --solid ./my_solid || fail "a key of another solid is a fault"
! grep -q '^solid:' "$scratch/log" && grep -q '^fluid:' "$scratch/log" || fail "not of the fluid alone"
! check "$case" --set solid.colour=red --set time.end=soon --solid ./my_solid || fail "a fault beside another solid is accepted"
! check "$case" --alone --solid ./my_solid && grep -q 'nothing to check' "$scratch/log" || fail "nothing is checked"

for part in fluid coupler solid; do
  "$build/$part/coracle-$part" --version | grep -q "^coracle-$part [0-9.]*$" || fail "--version of $part"
  "$build/$part/coracle-$part" --help | grep -q -- "--set key=value" || fail "--help of $part"
done
