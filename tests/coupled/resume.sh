#!/usr/bin/env bash
# A run that is killed resumes from its last checkpoint as if nothing had happened: the same steps, motion, cracks and files, also on other ranks and with
# another solid; and what cannot go on says so.  Usage: resume.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"

# kill_and_resume LABEL RANKS RANKS_AFTER [launch.sh arguments]: LABEL is killed after some steps and resumed.
kill_and_resume() {
  local label=$1 ranks=$2 after=$3
  shift 3
  run "$label" "$ranks" "$@" --set output.checkpoint=1e-9 &
  for _ in $(seq 600); do
    [ ! -e "$scratch/$label/coupler.csv" ] || [ "$(wc -l <"$scratch/$label/coupler.csv")" -le 12 ] || break
    sleep 0.05
  done
  pkill -9 -f "^[^ ]*coracle-coupler .*output.folder=$scratch/$label( |$)" || { echo "$label has ended before it could be killed"; exit 1; }
  wait $! && { echo "$label has survived"; exit 1; }
  cp "$scratch/$label.log" "$scratch/$label.killed.log"
  must "$label" "$after" "$@" --set resume=last
  grep -q "resumes from t" "$scratch/$label.log" || { echo "$label has begun anew:"; cat "$scratch/$label.log"; exit 1; }
}

# what preconditions the pressure is not in a checkpoint: the equations are solved as far as the digits that are compared
far=(--set "fluid.petsc=-pressure_varying_ksp_rtol 1e-12 -momentum_ksp_rtol 1e-9")
adapt=("${far[@]}" --set time.end=0.14 --set time.dt_max=0.004 --set fluid.adapt.size_min=0.02 --set fluid.adapt.size_max=0.25 --set fluid.adapt.velocity_error=0.005
  --set fluid.adapt.every=7 --set "solid.bodies[0].size=0.03" --set output.every=0.02 --set "solid.probes=[{name: top, point: [1.0, 1.2]}]")
cracks=(--set "solid.materials.disc=$brittle" --set "solid.bodies[0]=$bar" --set time.end=0.4)
other=("${far[@]}" --set time.end=0.3 --solid "$build/tests/route/rigid_disc")

strong=(--set time.end=0.3 --set solid.materials.disc.density=300 --set coupler.max_iterations=30)

must disc 1:1:1 "${adapt[@]}"
must cracks 1:1:1 "${cracks[@]}"
must other 1:1:1 "${other[@]}"
must strong 1:1:1 "${strong[@]}"
# a light block that floats, with surface tension: attempts at a step, the interface and its curvature at the solid (at 0.174 s a choice at the
# contact line is left to round-off: runs of other tolerances differ from then on, too)
wet=("${far[@]}" --set time.end=0.16 --set output.every=0.02 --set fluid.surface_tension=0.5 --set fluid.contact_angle=70 --set solid.materials.block.density=300)
case=$here/floating.yaml must wet 1:1:1 "${wet[@]}"
kill_and_resume disc-again 1:1:1 1:1:1 "${adapt[@]}"
kill_and_resume disc-spread 2:1:1 1:2:2 "${adapt[@]}"
kill_and_resume cracks-again 1:1:2 1:1:1 "${cracks[@]}"
kill_and_resume other-again 1:1:1 1:1:1 "${other[@]}"
kill_and_resume strong-again 1:1:1 1:2:1 "${strong[@]}"
case=$here/floating.yaml kill_and_resume wet-again 1:1:1 1:1:1 "${wet[@]}"

# a run that has ended goes on to a later end, for a run of any length leaves a checkpoint
probes=("${far[@]}" --set 'solid.probes=[{name: middle, point: [1.0, 1.1]}]') # a second series beside solid.csv
must longer 1:1:1 --set time.end=0.05 "${probes[@]}"
cp -r "$scratch/longer" "$scratch/longer-spread"
must longer 1:1:1 --set time.end=0.1 --set resume=last "${probes[@]}"
cp -r "$scratch/longer" "$scratch/longer-kept"
must whole 1:1:1 --set time.end=0.1 "${probes[@]}"
# ... with snapshots as the case says now, from the last one on
cp -r "$scratch/longer-kept" "$scratch/oftener"
must oftener 1:1:1 --set time.end=0.13 --set resume=last --set output.every=0.01 "${probes[@]}"
"$python" - "$scratch" <<'E9'
import sys
import h5py
file = h5py.File(sys.argv[1] + "/oftener/fluid.h5")["snapshot"]
times = sorted(float(file[key].attrs["time"]) for key in file)
assert sum(t > 0.1001 for t in times) == 3, times
E9
# ... on more ranks of the solid than of the coupler, which then has nodes twice
must longer-spread 1:1:3 --set time.end=0.1 --set resume=last "${probes[@]}"

# ... and one that ends before time.end: its time by the clock has passed after a step (fluid and solid, the solid alone), or somebody makes a file
ends_early() {
  grep -q "ends at t = .* s, before time.end: $2" "$scratch/$1.log" || { echo "$1 has not ended early:"; cat "$scratch/$1.log"; exit 1; }
}
must late 1:1:1 --set time.end=0.1 --set time.walltime=1e-6 "${probes[@]}"
ends_early late "time.walltime has passed"
must late 1:2:1 --set time.end=0.1 --set resume=last "${probes[@]}"
without=(--alone --set fluid=null --set coupler=null)
must alone 1:1:1 "${without[@]}" --set time.end=0.1
must alone-late 1:1:2 "${without[@]}" --set time.end=0.1 --set time.walltime=1e-6
ends_early alone-late "time.walltime has passed"
must alone-late 1:1:1 "${without[@]}" --set time.end=0.1 --set resume=last
run asked 1:1:1 --set time.end=1000 &
for _ in $(seq 600); do
  [ ! -e "$scratch/asked/coupler.csv" ] || [ "$(wc -l <"$scratch/asked/coupler.csv")" -le 2 ] || break
  sleep 0.05
done
touch "$scratch/asked/stop"
wait $! || { echo "asked to end it has failed:"; cat "$scratch/asked.log"; exit 1; }
ends_early asked "asked to by a file"
[ -e "$scratch/asked/checkpoint/coupler.h5" ] && [ ! -e "$scratch/asked/stop" ] || { ls "$scratch/asked"; exit 1; }

# fails LABEL MESSAGE [launch.sh arguments]: LABEL ends with an error.
fails() {
  local label=$1 message=$2
  shift 2
  run "$label" 1:1:1 "$@" && { echo "$label has run: $message was expected"; exit 1; }
  grep -q "error:.*$message" "$scratch/$label.log" || { cat "$scratch/$label.log"; exit 1; }
}
fails nothing "resume.*there is no checkpoint" --set resume="$scratch/nothing"
fails longer "checkpoint to resume from is at t = 0.1 s already, time.end is 0.09 s" --set time.end=0.09 --set resume=last
cp -r "$scratch/longer" "$scratch/broken"
truncate -s 1000 "$scratch/broken/checkpoint/fluid.h5"
fails broken "go on .*checkpoint/fluid.h5" --set time.end=0.2 --set resume=last
cmp "$scratch/longer/coupler.csv" "$scratch/broken/coupler.csv" || { echo "a run that could not go on has changed the files"; exit 1; }
rm -r "$scratch"/broken/checkpoint.*
fails broken "resume.*there is no checkpoint" --set resume=last
must other-folder 1:1:1 --set time.end=0.15 --set resume="$scratch/longer/checkpoint"
must longer 1:1:1 --set time.end=0.02 --set output.checkpoint=0 # between two snapshots
[ ! -e "$scratch/longer/checkpoint" ] || { echo "a new run has left the checkpoint of the one before"; exit 1; }

"$python" - "$scratch" <<'E2'
import re, sys
from results import column, rows, summary
def times(label, name):
    return [float(t) for t in re.findall('Time Value="(.*)"', open("%s/%s/%s.xdmf" % (sys.argv[1], label, name)).read())]
def compare(one, two, columns, tolerance):
    for name, keys in columns.items():
        a, b = rows(one, name), rows(two, name)
        assert len(a) == len(b), "%s.csv has %d rows, after resuming %d" % (name, len(a), len(b))
        for key in keys:
            largest = max(abs(r[key]) for r in a)
            for r, s in zip(a, b):
                assert abs(r[key] - s[key]) <= tolerance * largest, "%s, %s at %s s: %s, after resuming %s" % (
                    two, key, r["t [s]"], r[key], s[key])
    for name in ("fluid", "coupler", "solid"):
        at = [times(label, name) for label in (one, two)] if name in columns else []
        assert not at or len(at[0]) > 2 and len(at[0]) == len(at[1]), "%s.xdmf: %s, after resuming %s" % (name, *at)
    a, b = summary(one), summary(two)
    assert a["steps"] == b["steps"] and b["resumed_at"] > 0 and b["largest_momentum_imbalance"] < 1e-10, (a, b)
motion = {"coupler": ["t [s]", "u_y [m/s]"], "fluid": ["t [s]", "kinetic energy [J/m]", "triangles"], "solid": ["t [s]", "y0 [m]", "v0 [m/s]"]}
compare("disc", "disc-again", dict(motion, solid_probes=["t [s]", "top_y [m]"]), 1e-9)
u = [column(label, "coupler", "u_y [m/s]")[-1] for label in ("disc", "disc-spread")]
assert abs(u[0] / u[1] - 1) < 0.002, "resumed on other ranks it falls at %g m/s instead of %g" % (u[1], u[0])
compare("cracks", "cracks-again", {"coupler": ["t [s]"], "solid": ["t [s]", "v0 [m/s]", "broken joints", "fracture [J/m]"]}, 1e-5)
compare("other", "other-again", {"coupler": ["t [s]", "u_y [m/s]"]}, 1e-7)  # what solvers leave, 1e-11, grows to 1e-9 within 12 steps
compare("strong", "strong-again", {"coupler": ["t [s]", "u_y [m/s]"]}, 1e-3)  # quasi-Newton columns are not saved
compare("wet", "wet-again", {"coupler": ["t [s]", "u_y [m/s]", "F_y [N]"], "fluid": ["t [s]", "kinetic energy [J/m]"], "solid": ["t [s]", "omega0 [rad/s]"]}, 1e-6)
compare("whole", "longer-kept", {"solid_probes": ["t [s]", "middle_y [m]", "middle_v [m/s]"]}, 1e-9)
compare("whole", "late", dict(motion, solid_probes=["t [s]", "middle_y [m]", "middle_v [m/s]"]), 1e-7)
for key in ("t [s]", "y0 [m]", "v0 [m/s]"):
    a, b = (column(label, "solid", key) for label in ("alone", "alone-late"))
    assert len(a) == len(b) and all(abs(p - q) <= 1e-12 for p, q in zip(a, b)), "the solid alone, %s: %s, after resuming %s" % (key, a, b)
compare("whole", "longer-spread", {"solid_probes": ["t [s]", "middle_y [m]", "middle_v [m/s]"]}, 1e-7)
t = column("other-folder", "coupler", "t [s]")
assert abs(t[0] - 0.11) < 1e-9 and abs(t[-1] - 0.15) < 1e-9, "in another folder: %s" % t
# all participants have snapshots at the multiples of 0.05 s and at the end, at which there is one where it is a multiple, too
for label, expected in {"whole": [0, 0.05, 0.1], "longer-kept": [0, 0.05, 0.1], "other-folder": [0.15], "longer": [0, 0.02]}.items():
    for name in ("fluid.velocity", "coupler", "solid.solid"):
        at = times(label, name)
        assert len(at) == len(expected) and all(abs(a - b) < 1e-9 for a, b in zip(at, expected)), "%s of %s: snapshots at %s s" % (name, label, at)
assert abs(column("whole", "coupler", "u_y [m/s]")[-1] + 0.2419) < 0.01
E2
