#!/usr/bin/env bash
# A case that cannot run ends at once with one message that names the participant, the file and key or mesh entity, and what was expected.
# Usage: bad_case.sh ROOT BUILD SCENARIO
set -uo pipefail
source "$(dirname "$0")/run.sh"
scenario=$1 sets=() case=$here/disc.yaml
with() { sets+=(--set "$1"); }
copy() { case=$scratch/case.yaml; cp "$here/disc.yaml" "$case"; }

msh() { # a square of two triangles; $1: the second triangle's vertices
  cat >"$scratch/mesh.msh" <<EOF
\$MeshFormat
2.2 0 8
\$EndMeshFormat
\$Nodes
4
1 0.9 1.0 0
2 1.1 1.0 0
3 1.1 1.2 0
4 0.9 1.2 0
\$EndNodes
\$Elements
2
1 2 2 1 1 1 2 3
2 2 2 1 1 $1
\$EndElements
EOF
}

case $scenario in
  missing_key) copy; sed -i '/viscosity/d' "$case"; expect="fluid.*case.yaml.*'fluid.viscosity'" ;;
  unknown_key) with fluid.densty=1; expect="fluid.0.: error: .*unknown key 'fluid.densty'" ;;
  wrong_type) with fluid.density=heavy; expect="key 'fluid.density': expected a number" ;;
  zero_viscosity) with fluid.viscosity=0; expect="key 'fluid.viscosity': expected a number > 0" ;;
  negative_density) with 'solid.materials.disc.density=-1'; expect="solid.*density': expected a number > 0" ;;
  bad_mode) with coupler.mode=magic; expect="coupler.*'coupler.mode'.*reaction" ;;
  old_key) with coupler.tries=30; expect="'coupler.tries' is now called 'coupler.max_iterations'" ;;
  no_shell) with coupler.shell_thickness=0; expect="'coupler.shell_thickness'" ;;
  bad_theta) with fluid.theta=0.3; expect="'fluid.theta'" ;;
  bad_end) with time.end=-1; expect="'time.end'" ;;
  no_boundary) copy; sed -i 's/, top: no_slip//' "$case"; expect="'fluid.boundaries.top'" ;;
  other_boundary) with fluid.boundaries.lid=no_slip; expect="boundaries.lid.*no boundary of this name.*left, right" ;;
  bad_boundary) with fluid.boundaries.top=slippery; expect="'fluid.boundaries.top'.*no_slip" ;;
  upside_down) with 'fluid.mesh.upper=[-1, 2]'; expect="'fluid.mesh.upper'" ;;
  fluid_mesh) with fluid.mesh.file=nowhere.msh; expect="fluid.*nowhere.msh" ;;
  solid_mesh) with 'solid.bodies[0]={mesh: nowhere.msh, material: disc}'; expect="solid.*nowhere.msh" ;;
  flat_element) msh '1 3 3'; with "solid.bodies[0]={mesh: $scratch/mesh.msh, material: disc}"; expect="mesh.msh.*2" ;;
  missing_vertex) msh '1 3 9'; with "solid.bodies[0]={mesh: $scratch/mesh.msh, material: disc}"; expect="mesh.msh.*2" ;;
  outside) with 'solid.bodies[0].centre=[1.95, 1.1]'; expect="coupler.*node [0-9]* at .* outside of the fluid domain" ;;
  unknown_material) with 'solid.bodies[0].material=cheese'; expect="solid.*cheese" ;;
  bad_poisson) with 'solid.materials.disc.poisson_ratio=0.5'; expect="poisson_ratio" ;;
  bad_shape) with 'solid.bodies[0].shape=potato'; expect="'solid.bodies\[0\].shape'" ;;
  overlapping) with 'solid.bodies[1]={shape: disc, centre: [1.05, 1.1], radius: 0.1, size: 0.05, material: disc}'
    expect="solid.*overlap" ;;
  bad_option) with 'fluid.petsc=-momentum_ksp_type nonsense'; expect="fluid.*nonsense" ;;
  unused_option) with 'fluid.petsc=-momentum_kps_type gmres'; expect="'fluid.petsc'.*-momentum_kps_type: theirs begin with -momentum_, .*-pressure_" ;;
  adapt_sizes) with 'fluid.adapt={size_min: 0.1, size_max: 0.05, velocity_error: 0.01}'; expect="'fluid.adapt.size_max'" ;;
  adapt_nothing) with 'fluid.adapt={size_min: 0.1, size_max: 0.2}'; expect="'fluid.adapt.velocity_error'" ;;
  adapt_budget) with 'fluid.adapt={size_min: 0.01, size_max: 0.2, velocity_error: 0.1, elements_max: 500}'
    expect="fluid.adapt.elements_max.*500.*the bands of solid and interface" ;;
  first_budget) with 'fluid.adapt={size_min: 1.0e-5, size_max: 0.2, velocity_error: 0.1}'
    expect="fluid.adapt.elements_max.*200000.*fluid.adapt.size_min" ;;
  bad_folder) with output.folder=/proc/nowhere; sets+=(--set output.folder=/proc/nowhere); expect="/proc/nowhere" ;;
  load_joints) with solid.pressure_load=true; with 'solid.bodies[0].joints=all'
    with 'solid.materials.disc={density: 2000, youngs_modulus: 1.0e6, poisson_ratio: 0.3, tensile_strength: 6.0e3, shear_strength: 1.2e4, fracture_energy: 1}'
    expect="solid.*'solid.pressure_load': not possible with joints" ;;
  load_phases) case=$here/floating.yaml; with solid.pressure_load=true; expect='coupler.*solid.pressure_load.*the fluid has phases' ;;
  load_mode) with solid.pressure_load=true; with coupler.mode=stress_shell; expect='coupler.*solid.pressure_load.*coupler.mode: reaction' ;;
  *) echo "no scenario '$scenario'" >&2; exit 2 ;;
esac

start=$SECONDS
run bad 1:1:1 "${sets[@]}"
status=$?
log=$scratch/bad.log
fail() { echo "$scenario: $1; expected '$expect', the run said:"; cat "$log"; exit 1; }
[ $status -ne 0 ] || fail 'the run ended as if all were well'
[ $((SECONDS - start)) -le 20 ] || fail "the run took $((SECONDS - start)) s"
[ "$(grep -c 'error:' "$log")" -eq 1 ] || fail 'not exactly one error'
grep 'error:' "$log" | grep -q "$expect" || fail 'another error'
