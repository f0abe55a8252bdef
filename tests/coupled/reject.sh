#!/usr/bin/env bash
# Steps that a participant cannot make are made again over half of them: a solid that rejects those of more than 2 ms falls as in such steps, and a fluid whose
# equation converges in short steps alone goes on in those.  Where no step can be made the run ends with the participant's reason.  A boundary that is moved
# through its body ends the run on any ranks, after shorter and shorter steps, with the element that is crushed.  Usage: reject.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
disc=(--solid "$build/tests/coupled/reluctant_disc")
must short 1:1:1 --solid "$build/tests/route/rigid_disc" --set time.dt_max=0.002
must solid 1:2:2 "${disc[@]}"
must fluid 2:1:1 --set "fluid.petsc=-momentum_ksp_max_it 3" --set output.checkpoint=1e-9 # due in every step, also in those that the fluid rejects at first
[ -e "$scratch/fluid/checkpoint" ] && ! grep -q 'no checkpoints' "$scratch/fluid.log" || { cat "$scratch/fluid.log"; exit 1; }
TEST_LATE=1 must late 1:1:1 "${disc[@]}" --set output.checkpoint=1e-9 # not of steps that the solid rejects before it asks where to save
[ -e "$scratch/late/checkpoint" ] && ! grep -q 'no checkpoints' "$scratch/late.log" || { cat "$scratch/late.log"; exit 1; }
fails() { # LABEL REASON RANKS [launch.sh arguments]
  local label=$1 reason=$2
  shift 2
  if run "$label" "$@"; then echo "$label: the run went on"; exit 1; fi
  [ "$(grep -c "error: " "$scratch/$label.log")" = 1 ] && grep -q "error: $reason" "$scratch/$label.log" ||
    { echo "$label:"; cat "$scratch/$label.log"; exit 1; }
}
none='the step from t = 0 s cannot be made, not even over [0-9.]* s:'
fails never "$none solid: the disc makes steps of at most 2 ms" 1:2:2 "${disc[@]}" --set time.dt_max=1 --set time.end=10
fails diverges "$none fluid: the momentum equation did not converge at t = 0 s: DIVERGED_ITS after 1 iterations" 2:1:1 --set "fluid.petsc=-momentum_ksp_max_it 1"
bar='{shape: rectangle, centre: [1.0, 1.1], width: 0.3, height: 0.1, size: 0.025, material: disc, fixed: [left], prescribed: [{boundary: right, velocity: [-100, 0]}]}'
for ranks in 1:1:1 1:1:3; do
  fails "crosses-${ranks//:/-}" "at t = .* s the \(solid's velocity turns the element of node [0-9]* at .* inside out within\|steps that converge have become shorter than\)" "$ranks" --set "solid.bodies[0]=$bar"
  grep -q "note: .* cannot be made.* solid: body 0: element [0-9]* at .* has turned inside out at t = " "$scratch/crosses-${ranks//:/-}.log"
done
"$python" - "$scratch" <<'E2'
from results import column
short = column("short", "coupler", "u_y [m/s]")[-1]
for label, longest in (("solid", 0.002), ("fluid", 0.005)):
    steps, iterations = column(label, "coupler", "dt [s]"), column(label, "coupler", "iterations")
    assert max(steps) <= longest and max(iterations) > 1 and iterations.count(1) > 10, "%s: steps %s, iterations %s" % (label, steps, iterations)
    u = column(label, "coupler", "u_y [m/s]")[-1]
    assert abs(u / short - 1) < 0.01, "%s: %g m/s, in short steps %g" % (label, u, short)
    assert open("%s/%s.log" % (__import__("sys").argv[1], label)).read().count("cannot be made; it is made over half of that") == 1, "%s: notes" % label
E2
