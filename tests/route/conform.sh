#!/usr/bin/env bash
# The conformance kit passes the template of a solid and finds each fault that is planted in it.  Usage: conform.sh ROOT BUILD
set -euo pipefail
root=$1 build=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
kit=("$root/scripts/conform.py" --bin "$build" --timeout 30 "$root/tests/coupled/disc.yaml" --solid)
"${kit[@]}" "$build/tests/route/rigid_disc" --ranks 1,2 >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
# a solid whose mesh changes within a step, which is made again
bar='{shape: rectangle, centre: [1.0, 1.1], width: 0.3, height: 0.1, size: 0.025, material: disc, joints: all, fixed: [left]}'
brittle='{density: 2000.0, youngs_modulus: 1.0e6, poisson_ratio: 0.3, damping: 0.2, tensile_strength: 6.0e3, shear_strength: 1.2e4, fracture_energy: 1.0}'
"${kit[@]}" "$build/solid/coracle-solid" --ranks 1,2 --set "solid.bodies[0]=$bar" --set "solid.materials.disc=$brittle" >"$scratch/log" 2>&1 ||
  { cat "$scratch/log"; exit 1; }
grep -q 'the mesh has changed' "$scratch/log" || { echo 'nothing has broken'; cat "$scratch/log"; exit 1; }

template=$root/cases/adapters/template_c/rigid_disc.c
plant() { # NAME SED_EXPRESSION MESSAGE
  sed "$2" "$template" >"$scratch/$1.c"
  ! cmp -s "$template" "$scratch/$1.c" || { echo "$1: nothing has been planted"; exit 1; }
  # shellcheck disable=SC2046 # the flags are words
  mpicc -I"$root/common/link" "$scratch/$1.c" -o "$scratch/$1" "$build/common/libcoracle_client.a" $(pkg-config --libs yaml-0.1) -lm
  if "${kit[@]}" "$scratch/$1" --ranks "${4:-1}" >"$scratch/log" 2>&1; then echo "$1: conforms"; cat "$scratch/log"; exit 1; fi
  grep -q "FAILED.*$3" "$scratch/log" || { echo "$1: expected '$3'"; cat "$scratch/log"; exit 1; }
}
plant unbound '/CoracleBindState(d.client, &d.now/d' 'from where they were before the step was redone (CoracleBindState)'
plant remembers 's/d->now.spin += dt/static double heat; heat += 1e-9; d->now.v[0] += heat; &/' 'step 2, redone .* has another position'
plant backwards 's/f\[\([01]\)\] += force/f[\1] -= force/; s/f\[\([01]\)\] += \(force.*\);/f[\1] -= \2;/' 'moves the solid against its direction'
plant half_step 's/CoracleSubstep(d.client, dt, u)/CoracleSubstep(d.client, 0.5 * dt, u)/' 'the substeps of step 1 sum up to'
plant no_close 's/return CoracleClose(&d.client);/return 0;/' 'the program exited in step 12'
plant everywhere 's/d->n = rank == 0 ? n : 0;/d->n = n;/' 'each must be given once' 1,2
plant stuck 's/^  d->now.angle += /  return;\n&/' 'does not move under any force'
