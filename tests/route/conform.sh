#!/usr/bin/env bash
# The conformance kit passes Coracle's own participants and the templates in C and finds each fault that is planted in these.
# Usage: conform.sh solid|fluid ROOT BUILD
set -euo pipefail
role=$1 root=$2 build=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export OMPI_MCA_odls_base_sigkill_timeout=0 # s that mpirun waits for the other programs of one that failed
kit=("$root/scripts/conform.py" --bin "$build" --timeout 30 "$root/tests/coupled/disc.yaml" "--$role")

passes() { # PROGRAM [arguments of conform.py]
  "${kit[@]}" "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
}
plant() { # NAME SED_EXPRESSION MESSAGE [RANKS]
  sed "$2" "$template" >"$scratch/$1.c"
  ! cmp -s "$template" "$scratch/$1.c" || { echo "$1: nothing has been planted"; exit 1; }
  # shellcheck disable=SC2046 # the flags are words
  mpicc -I"$root/common/link" "$scratch/$1.c" -o "$scratch/$1" "$build/common/libcoracle_client.a" $(pkg-config --libs yaml-0.1) -lm
  if "${kit[@]}" "$scratch/$1" --ranks "${4:-1}" "${mesh[@]}" >"$scratch/log" 2>&1; then echo "$1: conforms"; cat "$scratch/log"; exit 1; fi
  grep -q "FAILED.*$3" "$scratch/log" || { echo "$1: expected '$3'"; cat "$scratch/log"; exit 1; }
}
if [ "$role" = fluid ]; then
  mesh=(--set "fluid.mesh={lower: [0.0, 0.0], upper: [2.0, 2.0], size_max: 0.05}")
  passes "$build/tests/route/dust" --ranks 1,2 "${mesh[@]}"
  # a fluid with pressure; with a mesh that changes, which depends on the ranks
  passes "$build/fluid/coracle-fluid" --ranks 2
  passes "$build/fluid/coracle-fluid" --ranks 1 --set 'fluid.adapt={size_min: 0.04, size_max: 0.2, velocity_error: 0.05, every: 4}'
  grep -q 'the mesh has changed' "$scratch/log" || { echo 'the mesh has not been adapted'; cat "$scratch/log"; exit 1; }

  template=$root/cases/adapters/template_fluid_c/dust.c
  plant unbound '/CoracleBindState/d; s/^  Advance(d, t, dt);/&\nfor (int e = 0; e < n; e++) memcpy(d->u[near[e]], d->u_star[e], sizeof *d->u);/' \
    'has another flow: bind all state'
  plant sign 's/load\[r\] = k/load[r] = -k/' 'does not take the fluid along'
  plant density 's/load\[r\] = k\(.*\);/load[r] = k\1 \/ 1000.0;/' 'the fluid does not gain dt s'
  plant inertia 's/= k\[m\].implicit_inertia.*;/= 0.0;/' 'the implicit inertia does not resist'
  plant kept 's/k\[m\].kept\[r \/ 3\]\[q \/ 3\]/(r \/ 3 == q \/ 3)/' 'or begin with what is kept'
  plant tensor 's/k\[m\].inertia_tensor\[r \/ 3\]\[q \/ 3\]/(r \/ 3 == q \/ 3)/' 'does not move by its tensor'
  plant covered 's/CORACLE_IS_COVERED/8/' 'where it is covered the fluid does not start'
  plant start 's/.u_start = &d->u_start/.u_start = \&d->u_star/' 'has not been added to the velocity'
  plant ignored 's/ + k\[m\].a\[.*\];/;/' 'does not lose dt a u\*'
  plant uncorrected 's/^    Correct(d, near);//' 'the correction of the step before has not been added'
  plant any_box 's/near |= Overlaps.*/near = true;/' 'is not in the box'
  plant clockwise 's/d->x\[e\]\[i\]\[c\] =/d->x[e][2 - i][c] =/' 'counter-clockwise'
  plant everywhere 's/MakeMesh(&d, cells, rank, size)/MakeMesh(\&d, cells, 0, 1)/' 'each must be given once' 2
  plant no_close 's/return CoracleClose(&d.client);/return 0;/' 'the program exited in step 12'
  exit
fi

mesh=()
passes "$build/tests/route/rigid_disc" --ranks 1,2
# a solid whose mesh changes within a step, which is made again
bar='{shape: rectangle, centre: [1.0, 1.1], width: 0.3, height: 0.1, size: 0.025, material: disc, joints: all, fixed: [left]}'
brittle='{density: 2000.0, youngs_modulus: 1.0e6, poisson_ratio: 0.3, damping: 0.2, tensile_strength: 6.0e3, shear_strength: 1.2e4, fracture_energy: 1.0}'
passes "$build/solid/coracle-solid" --ranks 1,2 --set "solid.bodies[0]=$bar" --set "solid.materials.disc=$brittle"
grep -q 'the mesh has changed' "$scratch/log" || { echo 'nothing has broken'; cat "$scratch/log"; exit 1; }

template=$root/cases/adapters/template_c/rigid_disc.c
plant unbound '/CoracleBindState(d.client, &d.now/d' 'from where they were before the step was redone (CoracleBindState)'
plant remembers 's/d->now.spin += dt/static double heat; heat += 1e-9; d->now.v[0] += heat; &/' 'step 2, redone .* has another position'
plant backwards 's/f\[\([01]\)\] += force/f[\1] -= force/; s/f\[\([01]\)\] += \(force.*\);/f[\1] -= \2;/' 'moves the solid against its direction'
plant half_step 's/CoracleSubstep(d.client, dt, u)/CoracleSubstep(d.client, 0.5 * dt, u)/' 'the substeps of step 1 sum up to'
plant no_close 's/return CoracleClose(&d.client);/return 0;/' 'the program exited in step 12'
plant everywhere 's/d->n = rank == 0 ? n : 0;/d->n = n;/' 'each must be given once' 2
plant stuck 's/^  d->now.angle += /  return;\n&/' 'does not move under any force'
