#!/usr/bin/env bash
# What would be silent, absurd or endless is refused by one line, before any work.  Usage: refused.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/../coupled/run.sh"
case=$here/../coupled/disc.yaml

# refused PART EXPECTED --set key=value ...
refused() {
  local part=$1 expect=$2
  shift 2
  ! timeout -k 5 60 "$build/$part/coracle-$part" --check "$case" "$@" >"$scratch/log" 2>&1 || { echo "accepted: $*"; exit 1; }
  grep -q "$expect" "$scratch/log" || { echo "$*: expected '$expect', got:"; cat "$scratch/log"; exit 1; }
}
accepted() {
  local part=$1
  shift
  timeout -k 5 60 "$build/$part/coracle-$part" --check "$case" "$@" >"$scratch/log" 2>&1 || { echo "refused: $*"; cat "$scratch/log"; exit 1; }
}

for part in fluid coupler; do refused $part "'time.cfl': expected a number > 0" --set time.cfl=0; done

# counts are made before the work, and in doubles
for size in 3.5e-6 1e-11 1e-300; do refused solid "'solid.bodies\[0\].size': .* elements" --set "solid.bodies[0].size=$size"; done
rectangle='{shape: rectangle, centre: [1, 1], width: 0.2, height: 0.1, material: disc, size: '
refused solid "'solid.bodies\[0\].size': .* elements" --set "solid.bodies[0]=${rectangle} 1e-7}"
refused solid "'solid.bodies\[0\].angle': expected a number from -6.28" --set "solid.bodies[0]=${rectangle} 0.05, angle: 30}" # degrees
accepted solid --set "solid.bodies[0]=${rectangle} 0.05, angle: -6.28}"
rock='{density: 1, youngs_modulus: 1, poisson_ratio: 0, tensile_strength: 1, shear_strength: 1, fracture_energy: 1}'
thin="${rectangle} 0.05, joints: [{lower: [0.999, 0], upper: [1.001, 2]}]}" # between the centres
refused solid "'solid.bodies\[0\]': no element's centre is in the joints' box \[0.999, 1.001\] x \[0, 2\]" --set "solid.bodies[0]=$thin" --set "solid.materials.disc=$rock"
refused solid "'solid.bodies\[0\].prescribed\[1\]': an item before this one" --set "solid.bodies[0]=${rectangle} 0.05, prescribed: [{velocity: [1, 0], component: x}, {velocity: [0, 1]}]}"
polygon() { refused "$1" "$2" --set "$3"; }
polygon solid "'solid.bodies\[0\].corners': the polygon meets itself: side 0" 'solid.bodies[0]={shape: polygon, corners: [[0.9, 0.9], [1.1, 1.1], [1.1, 0.9], [0.9, 1.1]], size: 0.05, material: disc}'
polygon solid "'solid.bodies\[0\].corners': the polygon has no area" 'solid.bodies[0]={shape: polygon, corners: [[0.9, 0.9], [1.1, 0.9], [1.0, 0.9]], size: 0.05, material: disc}'
polygon solid "'solid.bodies\[0\].size': .* elements" 'solid.bodies[0]={shape: polygon, corners: [[0.9, 0.9], [1.1, 0.9], [0.9, 1.1]], size: 1e-6, material: disc}'
polygon fluid "'fluid.mesh.sides': expected a name of each of the 3 sides, found 2" 'fluid.mesh={corners: [[0, 0], [2, 0], [0, 2]], sides: [a, b], size_max: 0.1}'
polygon fluid "'fluid.mesh.corners': expected at least three corners" 'fluid.mesh={corners: [[0, 0], [2, 0]], size_max: 0.1}'
polygon fluid "'fluid.mesh.*lower" 'fluid.mesh={corners: [[0, 0], [2, 0], [0, 2]], lower: [0, 0], size_max: 0.1}'
loads() { refused solid "$1" --set "solid.bodies[0]=${rectangle} 0.05, loads: $2}"; } # expected, loads
loads "'solid.bodies\[0\]': the body has no boundary 'roof'; it has " '[{boundary: roof, pressure: 1}]'
loads "'solid.bodies\[0\].loads\[0\].boundary' is missing" '[{pressure: 1}]'
loads "'solid.bodies\[0\].loads\[0\]': expected a pressure or a traction" '[{boundary: left}]'
loads "'solid.bodies\[0\].loads\[0\].pressure': expected a number, found 'high'" '[{boundary: left, pressure: high}]'
loads "'solid.bodies\[0\].loads\[1\].pressure\[1\]': the first numbers of the rows must rise" '[{boundary: left, pressure: 1}, {boundary: left, pressure: [[1, 0], [1, 2]]}]'
loads "'solid.bodies\[0\].loads\[0\].traction': expected a list of 2 numbers, found '1'" '[{boundary: left, traction: 1}]'
loads "'solid.bodies\[0\].loads': expected a list, found a map" '{boundary: left, pressure: 1}'
accepted solid --set "solid.bodies[0]=${rectangle} 0.05, loads: [{boundary: left, pressure: [[0, 1], [1, 2]], traction: [1, 2]}]}"
refused solid "'solid.contact\[1\].between': an item before this one" --set 'solid.contact=[{between: [disc, walls], friction: 0.1}, {between: [walls, disc], friction: 0.2}]'
refused solid "'solid.bodies\[0\].prescribed': a fixed body has no prescribed motion" --set "solid.bodies[0]=${rectangle} 0.05, fixed: true, prescribed: [{velocity: [1, 0]}]}"
ring='{shape: ring, centre: [1, 1], radius: 0.2, thickness: 0.1, material: disc, size: '
refused solid "'solid.bodies\[0\].size': .* elements" --set "solid.bodies[0]=${ring} 1e-7}"
refused solid "'solid.bodies\[0\].repeat.n': 9e+06 bodies" --set 'solid.bodies[0].repeat={n: [3000, 3000], step: [1, 1]}'
refused fluid "'fluid.mesh.refine\[0\].size': .* triangles" --set 'fluid.mesh.refine[0].size=1e-5'
refused fluid "'fluid.mesh.size_max': .* triangles" --set fluid.mesh.size_max=1e-6
refused fluid "'fluid.mesh.refine': with a growth of 0 m a metre" --set fluid.mesh.growth=0 --set 'fluid.mesh.refine[0].size=4e-4'
refused fluid "'fluid.mesh.refine\[0\].upper': the box is empty" --set 'fluid.mesh.refine[0].upper=[0, 0]'

# what is prescribed all around must balance
left='fluid.boundaries.left={velocity: [1, 0]}'
refused fluid "'fluid.boundaries': .* 2 m2/s more into the domain" --set "$left"
refused fluid "'fluid.boundaries': .* 1 m2/s more into the domain" --set "$left" --set 'fluid.boundaries.right={velocity: [0.5, 0]}'
refused fluid "'fluid.boundaries': .* at 0 s .* more into the domain" --set "$left" --set 'fluid.boundaries.right={velocity: [1, 0], rise: 1}'
refused fluid "'fluid.boundaries.left.factor': expected times from 0 to the period, 1 s, found 0 to 2 s" --set 'fluid.boundaries.left={velocity: [1, 0], period: 1, factor: [[0, 1], [2, 1]]}' --set fluid.boundaries.right=open
refused fluid "'fluid.boundaries.left.factor\[1\]': the first numbers of the rows must rise" --set 'fluid.boundaries.left={velocity: [1, 0], factor: [[0, 1], [0, 2]]}' --set fluid.boundaries.right=open
refused fluid "'fluid.boundaries.left.profile\[1\]': the first numbers of the rows must rise" --set 'fluid.boundaries.left={velocity: [1, 0], profile: [[0, 1], [0, 2]]}' --set fluid.boundaries.right=open
refused fluid "'fluid.boundaries': .* at 0.25 s .* m2/s more into the domain\|'fluid.boundaries': .* at 0.25 s .* m2/s less into the domain" \
  --set 'fluid.boundaries.left={velocity: [1, 0], rise: 1}' --set 'fluid.boundaries.right={velocity: [1, 0], factor: [[0, 0], [1, 1]]}'
refused fluid "'fluid.boundaries': .* at 1.1 s .* 2 m2/s more into the domain" --set 'fluid.boundaries.left={velocity: [1, 0], rise: 0.5, factor: [[0, 0], [1, 0], [1.1, 1], [1.2, 0]]}'
refused fluid "'fluid.boundaries': .* at 0.82 s .* 2 m2/s more into the domain" --set 'fluid.boundaries.left={velocity: [1, 0], rise: 0.5, period: 0.4, factor: [[0, 0], [0.01, 0], [0.02, 1], [0.03, 0]]}'
accepted fluid --set "$left" --set 'fluid.boundaries.right={velocity: [1.5, 0], profile: parabolic}'
accepted fluid --set "$left" --set fluid.boundaries.right=open
accepted fluid --set 'fluid.boundaries.top={velocity: [1, 0]}'

# gravity in time
for part in fluid solid coupler; do
  refused $part "'gravity\[1\]': the first numbers of the rows must rise" --set 'gravity=[[0, 0, -9.81], [0, 1, -9.81]]'
  refused $part "'gravity\[0\]': expected a list of 3 numbers, found a list of 2" --set 'gravity=[[0, 0], [1, 1]]'
  accepted $part --set 'gravity=[[0, 0, -9.81], [1, 1, -9.81]]'
done
case=$here/../coupled/level.yaml refused fluid "'fluid.boundaries.left.level': with a gravity that depends on time levels outside would slope" --set 'gravity=[[0, 0, -9.81], [1, 1, -9.81]]'
! grep -q "'fluid.boundaries.left':" "$scratch/log" || { echo "a fault is told again of the map that it is in:"; cat "$scratch/log"; exit 1; }

refused fluid "unknown key 'fluid.initial.pressure'" --set 'fluid.initial={pressure: 100.0}'

# options that nobody reads, folders that are none
for part in solid coupler; do refused $part "'$part.petsc': nothing in the $part has the option -nonsense" --set "$part.petsc=-nonsense 1"; done
for part in fluid solid coupler; do refused $part "'output.folder': expected a string, found 'null'" --set output.folder=null; done

# phases and where they are
water='fluid.phases=[{name: water, density: 1000, viscosity: 1.0e-3}, {name: air, density: 1.2, viscosity: 1.8e-5}]'
phases() { local expect=$1; shift; refused fluid "$expect" --set "$water" "$@"; }
sed '/^  \(density\|viscosity\):/d' "$case" >"$scratch/phases.yaml"
case=$scratch/phases.yaml
phases "'fluid.regions': expected a list of where" 
phases "'fluid.phases\[0\].name': expected a name of at most" --set 'fluid.phases[0].name="oil (crude)"'
phases "'fluid.phases\[0\].name': fluid.h5 has another field of the name 'density'" --set 'fluid.phases[0].name=density'
phases "'fluid.regions': the first region is everywhere" --set 'fluid.regions=[{phase: water, lower: [0, 0], upper: [1, 1]}]'
phases "'fluid.regions\[0\].phase': expected a phase (water, air), found 'oil'" --set 'fluid.regions=[{phase: oil}]'
phases "'fluid.regions\[1\].upper': the box is empty" --set 'fluid.regions=[{phase: air}, {phase: water, lower: [0, 0], upper: [0, 1]}]'
polygon() { phases "'fluid.regions\[1\].polygon': the polygon meets itself: side $1" --set "fluid.regions=[{phase: air}, {phase: water, polygon: $2}]"; } # sides, corners
polygon '0, from (0, 0), and side 2, from (1, 0)' '[[0, 0], [1, 1], [1, 0], [0, 1]]'
polygon '1, from (1, 0), and side 3, from (0, 1)' '[[0, 0], [1, 0], [1, 1], [0, 1], [1, 0.5], [0, 0.5]]'
polygon '0, from (0, 0), and side 3, from (0, 1)' '[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]' # closed twice
accepted fluid --set "$water" --set 'fluid.regions=[{phase: air}, {phase: water, polygon: [[0, 0], [2, 0], [2, 1], [1, 0.5], [0.5, 1]]}]' --set 'solid.bodies=[]'
refused fluid "'fluid.boundaries.left.level': there are no phases" --set 'fluid.boundaries.left={level: 1}' --set fluid.density=1 --set fluid.viscosity=1
phases "'fluid.boundaries.left.level': expected a number" --set 'fluid.regions=[{phase: air}]' --set 'fluid.boundaries.left={level: high}'
level() { phases "$1" --set 'fluid.regions=[{phase: air}]' --set "fluid.boundaries.left={$2}"; } # expected, keys
level "left={level: \[\[0, 1\], \[2, 1\], \[2, 3\]\]}: key 'fluid.boundaries.left.level\[2\]': the first numbers of the rows must rise" 'level: [[0, 1], [2, 1], [2, 3]]'
level "'fluid.boundaries.left.level': expected a number, found a list of 0" 'level: []'
level "'fluid.boundaries.left.level\[0\]': expected a list of 2 numbers, found '0'" 'level: [0, 1]'
level "'fluid.boundaries.left.level\[1\]': expected a list of 2 numbers, found 'high'" 'level: [[0, 1], [1, high]]'
level "'fluid.boundaries.left.level': expected times from 0 to the period, 2 s, found 0 to 3 s" 'level: [[0, 1], [3, 1]], period: 2'
level "'fluid.boundaries.left.period': the level is constant" 'level: 1, period: 2'
phases "'fluid.boundaries.left.level': without gravity no side is up" --set 'fluid.regions=[{phase: air}]' --set 'fluid.boundaries.left={level: 1}' --set 'gravity=[0, 0]'
phases "'fluid.phases_advection': expected one of geometric, compressive, found 'sharp'" --set 'fluid.regions=[{phase: air}]' --set fluid.phases_advection=sharp
phases "'fluid.phases\[1\].name': expected a name" --set 'fluid.regions=[{phase: water}]' --set 'fluid.phases[1].name="a, b"'
# more than two, and what is said of pairs of them
three='fluid.phases=[{name: water, density: 1000, viscosity: 1.0e-3}, {name: oil, density: 800, viscosity: 1.0e-3}, {name: air, density: 1.2, viscosity: 1.8e-5}]'
liquids() { local expect=$1; shift; refused fluid "$expect" --set "$three" --set 'fluid.regions=[{phase: air}]' "$@"; }
phases "'fluid.phases': expected from 2 to 8 phases, found 1" --set 'fluid.phases=[{name: water, density: 1000, viscosity: 1.0e-3}]' --set 'fluid.regions=[{phase: water}]'
liquids "'fluid.surface_tension\[0\].between': expected the names of two phases" --set 'fluid.surface_tension=[{between: [oil], value: 1}]'
liquids "'fluid.surface_tension\[0\].between\[1\]': expected a phase (water, oil, air), found 'gas'" --set 'fluid.surface_tension=[{between: [oil, gas], value: 1}]'
liquids "'fluid.surface_tension\[0\].between\[1\]': expected another phase" --set 'fluid.surface_tension=[{between: [oil, oil], value: 1}]'
liquids "'fluid.surface_tension\[1\].between\[1\]': an item before this one" --set 'fluid.surface_tension=[{between: [oil, air], value: 1}, {between: [air, oil], value: 1}]'
liquids "'fluid.surface_tension\[0\].value': expected a number >= 0" --set 'fluid.surface_tension=[{between: [oil, air], value: -1}]'
liquids "'fluid.boundaries.left.contact_angle\[0\].value': expected a number from 0 to 180" --set fluid.surface_tension=1 --set 'fluid.boundaries.left={wall: no_slip, contact_angle: [{between: [oil, air], value: 190}]}'
liquids "'fluid.contact_angle': expected a number from 0 to 180" --set fluid.surface_tension=1 --set fluid.contact_angle=190
liquids "'fluid.contact_angle': without fluid.surface_tension" --set fluid.contact_angle=90
liquids "'fluid.boundaries.left.level\[1\].height': expected layers from below: more than 2, found 1.5 at 3 s" --set 'fluid.boundaries.left={level: [{phase: water, height: [[0, 1], [3, 2]]}, {phase: oil, height: 1.5}]}'
liquids "'fluid.boundaries.left.level\[1\].height': expected layers from below: more than 2, found 1" --set 'fluid.boundaries.left={level: [{phase: water, height: 2}, {phase: oil, height: 1}]}'
liquids "'fluid.boundaries.left.fractions': expected fractions whose sum is 1, found 0.9" --set 'fluid.boundaries.left={velocity: [0, 0], fractions: [{phase: water, value: 0.4}, {phase: oil, value: 0.5}]}'
liquids "'fluid.boundaries.left.fractions\[1\].phase': an item before this one" --set 'fluid.boundaries.left={velocity: [0, 0], fractions: [{phase: oil, value: 0.4}, {phase: oil, value: 0.6}]}'
liquids "'fluid.boundaries.left.fractions': expected phase or fractions, not both" --set 'fluid.boundaries.left={velocity: [0, 0], phase: oil, fractions: [{phase: oil, value: 1}]}'
gas='{name: air, density: 1.2, viscosity: 1.8e-5'
liquids "'fluid.phases\[2\].sound_speed': expected a number > 0" --set "fluid.phases[2]=$gas, sound_speed: 0}"
liquids "'fluid.phases\[2\].sound_speed': expected gas or sound_speed, not both" --set "fluid.phases[2]=$gas, sound_speed: 340, gas: {pressure: 1.0e5}}"
liquids "'fluid.phases\[2\].gas.pressure' is missing" --set "fluid.phases[2]=$gas, gas: {exponent: 1.4}}"
liquids "'fluid.phases\[2\].gas.exponent': expected a number from 1 to 10" --set "fluid.phases[2]=$gas, gas: {pressure: 1.0e5, exponent: 0.9}}"
# keys that exclude each other
phases "'fluid.density': expected phases or density, not both" --set 'fluid.regions=[{phase: air}]' --set fluid.density=1
phases "'fluid.boundaries.left.level': expected velocity or level, not both" --set 'fluid.regions=[{phase: air}]' --set 'fluid.boundaries.left={velocity: [0, 0], level: 1}'
phases "'fluid.boundaries.left.wall': expected pressure or wall, not both" --set 'fluid.regions=[{phase: air}]' --set 'fluid.boundaries.left={wall: no_slip, pressure: 1}'
phases "'fluid.regions\[1\].centre': expected lower or centre, not both" --set 'fluid.regions=[{phase: air}, {phase: water, lower: [0, 0], upper: [1, 1], centre: [0, 0]}]'
refused solid "'solid.bodies\[0\].shape': expected mesh or shape, not both" --set 'solid.bodies[0].mesh=nowhere.msh'
refused solid "'solid.bodies\[0\].inner_radius': expected radius or inner_radius, not both" --set "solid.bodies[0]=$ring 0.05, inner_radius: 0.1}"

# what has nothing to hold or to measure
refused solid "'solid.springs\[0\].other_point': there is no other body" --set 'solid.springs=[{point: [1, 1.1], other_point: [1, 1.5], stiffness: 1}]'
refused solid "'solid.contact_probes\[0\].other': there are no solid.walls" --set 'solid.contact_probes=[{name: base, body: 0, other: bottom}]'
for other in 0 7 -1 floor 0.5; do
  refused solid "'solid.contact_probes\[0\].other': expected left, right, bottom, top or the number of another body" --set "solid.contact_probes=[{name: base, body: 0, other: $other}]"
done
refused solid "'solid.contact_probes\[0\].body'" --set 'solid.contact_probes=[{name: base, body: 3}]'
for what in line surface flow; do
  phases "'fluid.probes\[0\].$what.to': expected another point than from, (1, 1)" --set 'fluid.regions=[{phase: air}]' --set "fluid.probes=[{name: P, $what: {from: [1, 1], to: [1, 1]}}]"
done

# a gauge outside, a body across a wall
phases "'fluid.probes\[0\].point': expected what lies in the mesh, (9, 1) does not" --set 'fluid.regions=[{phase: air}]' --set 'fluid.probes=[{name: P, point: [9, 1]}]'
# point 1 of a line a has the columns of a point a1
line='{name: a, line: {from: [0.5, 0.5], to: [1, 1], points: 2}}'
phases "'fluid.probes': two columns are called 'a1_" --set 'fluid.regions=[{phase: air}]' --set "fluid.probes=[$line, {name: a1, point: [0.5, 0.5]}]"
accepted fluid --set "$water" --set 'fluid.regions=[{phase: air}]' --set 'solid.bodies=[]' --set "fluid.probes=[$line, {name: a2, point: [0.5, 0.5]}]"
refused solid "'solid.bodies\[0\]': the body reaches through solid.walls at" --set 'solid.walls={lower: [1, 0], upper: [2, 4]}'
accepted fluid --set "$water" --set 'fluid.regions=[{phase: air}, {phase: water, lower: [0, 0], upper: [1, 1]}]' --set 'solid.bodies=[]'
