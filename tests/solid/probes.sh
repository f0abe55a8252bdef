#!/usr/bin/env bash
# A disc that flies freely: its probes, one on the circle outside of its polygon, say where it is and how fast, on one rank and on two; a probe outside of all bodies is refused.  So for a spring, its length and its tension.
# Usage: probes.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
fly() {
  run_alone disc "$root/tests/solid/alone.yaml" --ranks "1:1:$1" \
    --set 'solid.bodies=[{shape: disc, centre: [0, 0], radius: 0.1, size: 0.02, material: m, velocity: [1.0, -0.5]}]' \
    --set 'solid.materials={m: {density: 1000.0, youngs_modulus: 1.0e6, poisson_ratio: 0.3}}' --set 'gravity=[0, 0]' --set 'solid.walls.lower=[-1, -1]' \
    --set time.end=0.1 --set time.dt_max=0.01 --set "solid.probes=[{name: middle, point: [0, 0]}, {name: rim, point: [0.0996195, 0.0087156]}]" "${@:2}"
}
for ranks in 1 2; do
  fly $ranks || { cat "$scratch/disc.log"; exit 1; }
  awk -F, 'NR > 1 { for (k = 0; k < 2; k++) { e = ($(2 + 4*k) - $1)^2 + ($(3 + 4*k) + 0.5*$1)^2 + ($(4 + 4*k) - 1)^2 + ($(5 + 4*k) + 0.5)^2
    if (e > 1e-16) { print FILENAME ": " $0; exit 1 } } } END { if (NR != 11) { print FILENAME ": " NR " rows"; exit 1 } }' "$scratch/disc/solid_probes.csv"
done
fly 2 --set 'solid.springs=[{name: line, point: [0.0, 0.1], anchor: [0.0, 0.4], stiffness: 0.001, length: 0.25}]' || { cat "$scratch/disc.log"; exit 1; }
awk -F, 'NR > 1 { l = sqrt($1^2 + (0.3 + 0.5*$1)^2); if (($10 - l)^2 > 1e-12 || ($11 - 0.001*(l - 0.25))^2 > 1e-16) { print FILENAME ": " $0; exit 1 } }
  END { if (NR != 11) { print FILENAME ": " NR " rows"; exit 1 } }' "$scratch/disc/solid_probes.csv"
if fly 1 --set 'solid.springs=[{name: line, point: [0.2, 0], anchor: [0, 1], stiffness: 1}]'; then echo 'a spring outside was accepted'; exit 1; fi
grep -q "key 'solid.springs\[0\].point': no body is at (0.2, 0); the nearest is 0.[01][0-9]* m away" "$scratch/disc.log" || { cat "$scratch/disc.log"; exit 1; }
if fly 1 --set 'solid.probes[1].point=[0.2, 0]'; then echo 'a probe outside was accepted'; exit 1; fi
grep -q "key 'solid.probes\[1\].point': no body is at (0.2, 0) at rest; the nearest is 0.[01][0-9]* m away" "$scratch/disc.log" || { cat "$scratch/disc.log"; exit 1; }
