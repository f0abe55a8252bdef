#!/usr/bin/env bash
# The level outside of an open side depends on time.  A small sudden rise makes a long wave, a slow tide with a drawdown is followed by the tank; both are
# those of potential theory (level.py).  A tide repeats itself, a run resumes as if nothing had happened, and layers move likewise.  Usage: level.sh ROOT BUILD [long]     long: the tide, too
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/level.yaml
step='[[0.0, 0.3], [0.4, 0.303]]'
tide='[[0.0, 0.3], [3.0, 0.36], [6.0, 0.24]]'
tank=(--set 'fluid.mesh.upper=[0.5, 0.5]' --set 'fluid.probes=[{name: near, surface: {from: [0.125, 0.0], to: [0.125, 0.5], phase: water}}, {name: far, surface: {from: [0.375, 0.0], to: [0.375, 0.5], phase: water}}]')
must step 1:1:1 --set "fluid.boundaries.left.level=$step"
"$python" "$here/level.py" "$scratch/step" 4.0 "$step" 0.1
if [[ ${1:-} == long ]]; then
  must tide 2:1:1 --set time.dt_max=0.02 "${tank[@]}" --set "fluid.boundaries.left.level=$tide" --set time.end=7
  "$python" "$here/level.py" "$scratch/tide" 0.5 "$tide" 0.1
fi
# steps that add up without round-off, to the same ones until the end of a run; one mesh
far=("${tank[@]}" --set time.cfl=2 --set time.dt_max=0.0078125 --set fluid.adapt.every=1000 --set "fluid.petsc=-pressure_varying_ksp_rtol 1e-12 -momentum_ksp_rtol 1e-9")
again=("${far[@]}" --set "fluid.boundaries.left={level: [[0.0, 0.3], [0.05, 0.305], [0.15, 0.295], [0.2, 0.3]], period: 0.2}")
must whole 1:1:1 "${again[@]}" --set time.end=0.390625
must resumed 1:1:1 "${again[@]}" --set time.end=0.25
must resumed 1:1:1 "${again[@]}" --set time.end=0.390625 --set resume=last
must rows 1:1:1 "${far[@]}" --set time.end=0.390625 --set "fluid.boundaries.left.level=[[0.0, 0.3], [0.05, 0.305], [0.15, 0.295], [0.25, 0.305], [0.35, 0.295], [0.4, 0.3]]"
must layers 1:1:1 "${again[@]}" --set time.end=0.390625 --set "fluid.boundaries.left.level=[{phase: water, height: [[0.0, 0.3], [0.05, 0.305], [0.15, 0.295], [0.2, 0.3]]}]"
"$python" - "$scratch" <<'E2'
import os, sys
from results import rows
for label in ("step", "tide", "whole"):
    if not os.path.exists(sys.argv[1] + "/" + label): continue
    made = max(abs(row["water made [m2]"]) + row["volume gap [m2]"] for row in rows(label, "fluid"))
    assert made < 1e-10, "%s: %g m2 of water from nothing" % (label, made)
for label, tolerance in ("resumed", 1e-9), ("rows", 1e-9), ("layers", 1e-12):
    for file, name in ("fluid", "kinetic energy [J/m]"), ("fluid", "water [m2]"), ("fluid_probes", "near_last [m]"):
        a, b = rows("whole", file), rows(label, file)
        assert len(a) == len(b), "%s: %d rows, %d" % (label, len(a), len(b))
        differ = max(abs(r[name] - s[name]) for r, s in zip(a, b)) / max(abs(r[name]) for r in a)
        print("%s: %s differs by %.1e" % (label, name, differ))
        assert differ < tolerance, "%s: %s differs by %g" % (label, name, differ)
E2
