#!/usr/bin/env bash
# Scripts that read what a run has left behind, on what they hardly ever meet: files that are empty, half written or none, gauges that are dry, blocks
# that do not crack, meshes of round numbers, jobs that need the same run.  No run.  Usage: readers.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/../coupled/run.sh"
"$python" -c 'import numpy, h5py, matplotlib' 2>/dev/null || { echo 'needs numpy, h5py and matplotlib'; exit 77; }
says() { # LINE COMMAND ...: it fails with this last line, and no trace of Python's
  if "${@:2}" >/dev/null 2>"$scratch/log"; then echo "accepted: ${*:2}"; exit 1; fi
  tail -1 "$scratch/log" | grep -qF -- "$1" && ! grep -q Traceback "$scratch/log" || { echo "${*:2}: expected '$1', got:"; cat "$scratch/log"; exit 1; }
}

odd="$scratch/a folder"
mkdir "$odd"
touch "$odd/solid.csv" "$odd/fluid.h5"
says 'there is no row yet' "$python" "$root/scripts/modes.py" "$odd"
says 'has no line with column names' "$python" "$root/scripts/plot_fall.py" "$odd"
says 'Unable to open file' "$root/scripts/view.sh" "$odd"
says 'Unable to open file' "$python" "$root/scripts/plot_field.py" "$odd"
says 'scaling.csv has no rows yet: expected --splits or --weak' "$python" "$root/scripts/scaling.py" "$here/disc.yaml" --out "$odd"
says 'the output folder is that of --out' "$root/scripts/run.sh" --bin "$build" "$root/tests/solid/alone.yaml" --alone --set "output.folder=$odd"

says 'nowhere/solid.csv: No such file' "$python" "$root/scripts/plot_fall.py" "$scratch/nowhere"
says "expected NAME=VALUE with a value in m/s, found '3'" "$python" "$root/scripts/plot_fall.py" "$odd" --terminal 3
says '--start inf: expected a number >= 0' "$python" "$root/scripts/wavemaker.py" solitary --height 0.06 --depth 0.4 --start inf

# a run without bodies
printf 't [s],weight_x [N/m],weight_y [N/m]\n0.1,0,0\n0.2,0,0\n' >"$odd/solid.csv"
"$python" - "$odd/solid.h5" <<'E2'
import sys
import h5py, numpy as np
with h5py.File(sys.argv[1], "w") as file:
    solid = file.create_group("snapshot/000000/solid")
    file["snapshot/000000"].attrs["time"] = 0.0
    solid["points"], solid["cells"] = np.zeros((0, 3)), np.zeros((0, 3), int)
    solid.create_group("cell")
    solid["node/displacement"] = np.zeros((0, 3))
E2
says 'the run has no bodies' "$python" "$root/scripts/energy.py" "$odd"
says 'the run has no bodies' "$python" "$root/scripts/fragments.py" "$odd"

# a row that is half written has numbers that are cut off
{ echo 't [s],v0 [m/s]'; for k in $(seq 10 40); do echo "0.$k,-0.$k"; done; printf '0.41,-0.4'; } >"$odd/solid.csv"
"$python" "$root/scripts/plot_fall.py" "$odd" >/dev/null
PYTHONPATH=$root/scripts "$python" - "$odd/solid.csv" <<'E2'
import sys
import modes, plot_fall
assert modes.read_column(sys.argv[1], "v0")[1][-1] == -0.40 and plot_fall.fall_speed(sys.argv[1])[1][-1] == 0.40
E2

# a gauge that is dry at the start, that never has water, and still water
PYTHONPATH=$root/scripts "$python" - "$odd" <<'E2'
import sys
import numpy as np
from phases import crossing
dry, t = np.nan, np.arange(4.0)
found = [crossing(t, np.array(v), 1.0) for v in ([dry] * 4, [dry, 0.0, 0.2, 0.4], [dry, dry, 2.0, 3.0], [0.0, 0.5, 1.5, 2.0], [1.0, 1.0, 1.0, 1.0])]
assert np.array_equal(found, [np.nan, np.nan, 2.0, 1.5, 0.0], equal_nan=True), found
t = np.linspace(0.0, 20.0, 400)
wave = np.where(t > 0.0, 0.5 + 0.01 * np.cos(5.0 * t), dry)
np.savetxt(sys.argv[1] + "/fluid_probes.csv", np.array([t, wave, 0.5 + 0.0 * t, 0.5 + 0.0 * t]).T, "%.9g", ",", header="t [s],dry_last [m],a_last [m],b_last [m]", comments="")
E2
says "gauge 'dry' has no surface in its first row: expected --level" "$python" "$root/scripts/waves.py" "$odd" --depth 0.5 dry=1 --from 1
"$python" "$root/scripts/waves.py" "$odd" --depth 0.5 dry=1 --from 1 --level 0.5 >/dev/null
says 'there are no waves at the gauges' "$python" "$root/scripts/waves.py" "$odd" --depth 0.5 a=1 b=1.3

# elements of a regular mesh are the same in all snapshots, wherever their nodes are
PYTHONPATH=$root/scripts "$python" - <<'E2'
import types
import numpy as np
from fragments import Elements
x, y = np.append(0.015 * np.arange(213), 3.2), 0.015 * np.arange(3)
rest, m = np.array([[a, b] for b in y for a in x]), len(x)
cells = np.array([t for j in range(2) for a in range(j * m, j * m + m - 1) for t in ((a, a + 1, a + m), (a + 1, a + m + 1, a + m))])
def at(displacement):
    field = {"fragment": np.zeros(len(cells)), "body": np.zeros(len(cells)), "damage": np.zeros(len(cells))}
    return Elements(types.SimpleNamespace(points=rest + displacement, cells=cells, node={"displacement": displacement, "velocity": displacement}, cell=field))
rng, first = np.random.default_rng(1), at(0.0 * rest)
assert all(at(rng.random(rest.shape)).same_as(first) for _ in range(5))
E2

# a membrane whose last snapshot is in the making
"$python" - "$root" "$odd" <<'E2'
import pathlib, sys
sys.path[:0] = [sys.argv[1] + "/cases/elastic_membrane", sys.argv[1] + "/scripts"]
import h5py, numpy as np
import membrane
angle = np.linspace(-3.0, 3.0, 20)
ring = np.concatenate([r * np.column_stack([np.cos(angle), np.sin(angle)]) for r in (0.49, 0.51)])
with h5py.File(sys.argv[2] + "/solid.h5", "w") as file:
    group = file.create_group("snapshot/000000")
    group.attrs["time"] = 0.0
    group["solid/points"], group["solid/node/displacement"] = ring, 0.0 * ring
    file.create_group("snapshot/000001")
assert list(membrane.history(pathlib.Path(sys.argv[2]))["t"]) == [0.0]
E2

# a cylinder that has not swung for a period
{ echo 't [s],centre_y [m]'; for k in 1 2 3 4; do echo "$k,0.01"; done; } >"$odd/solid_probes.csv"
{ echo 't [s],fx0 [N/m],fy0 [N/m],y0 [m],mass0 [kg/m]'; for k in 1 2 3 4; do echo "$k,1,0,0,1"; done; } >"$odd/solid.csv"
"$python" "$root/cases/vibrating_cylinder/cylinder.py" "$odd" | grep -c nan | grep -qx 2

# a block that has not cracked has its row, and its claims fail
"$python" - "$root" "$odd" <<'E2'
import sys, types
sys.path[:0] = [sys.argv[1] + "/cases/breaking_block", sys.argv[1] + "/scripts"]
import numpy as np
import validate, validation
from budget import Budget
names = "t mass0 u0 v0 fx0 fy0 y0 kinetic0 strain0 walls_x walls_y reaction_x reaction_y work".split() + ["reaction work", "cracks", "pieces", "broken joints", "fracture", "debonded", "substeps"]
rows = np.array([[t if name == "t" else 1.0 if name in ("mass0", "pieces", "u0", "fx0", "reaction work") else 0.0 for name in names] for t in np.linspace(0.0, 1.0, 20)])
np.savetxt(sys.argv[2] + "/solid.csv", rows, "%.9g", ",", header=",".join(names), comments="")
run = validate.Result.__new__(validate.Result)
run.name, run.budget, run.message, run.pieces, run.imbalance, run.triangles = "base", Budget(sys.argv[2]), "", np.array([1.0]), 0.0, 1
run.t, run.projectile, run.on_block, run.place = run.budget.t, run.budget.t, 1.0 + run.budget.t, run.budget.t
there = {"base": run, "solid-2": run, "ranks-2": run}
assert " inf " in list(validate.runs_table(there))[2]
claims = {what: measured <= bound for what, measured, bound in validate.claims(there)}
assert not claims["solid-2: first crack as in base, s"] and not claims["base: cracks cost G_f"] and claims["base: comes to its end"], claims
E2

# runs that resume from the same one, in several jobs at a time: it is run once
"$python" -B - "$root" "$scratch/jobs" <<'E2'
import concurrent.futures, importlib, pathlib, sys, time
sys.path.insert(0, sys.argv[1] + "/scripts")
import validation
begun = []
def launch_coupled(case, folder, keys, ranks, after=None):
    begun.append(folder.name)
    folder.mkdir(parents=True)
    time.sleep(0.2)
    (folder / "summary.json").touch()
validation.launch_coupled = launch_coupled
def case_of(name):
    sys.path.insert(0, "%s/cases/%s" % (sys.argv[1], name))
    sys.modules.pop("validate", None)
    validate = importlib.import_module("validate")
    validate.OUT = pathlib.Path(sys.argv[2]) / name
    validate.OUT.mkdir(parents=True)
    return validate
def run(validate, names):
    begun.clear()
    with concurrent.futures.ThreadPoolExecutor(len(names)) as pool:
        list(pool.map(validate.run, names))
cylinder, beam = case_of("vibrating_cylinder"), case_of("flexible_beam")
run(cylinder, ["u5-0.025", "u5-0.05"])
assert begun == ["u5-0.05", "u5-0.025"], "runs begun: %s" % begun
for row in beam.ROWS.values():
    beam.mesh(row.layers).touch()
run(beam, ["fsi1-0.004", "fsi1-0.002", "fsi1-0.004-corners"])
assert begun[0] == "fsi1-0.004" and len(begun) == 3, "runs begun: %s" % begun
E2

# a batch job of any length ends before it is over
mkdir -p "$scratch/coracle" "$scratch/bin"
ln -s "$root/scripts" "$scratch/coracle/scripts" && ln -s "$build" "$scratch/coracle/build"
printf '#!/bin/sh\n' >"$scratch/bin/srun" && chmod +x "$scratch/bin/srun"
for left in 3600:3300 600:300 200:100 1:1; do
  (cd "$scratch" && env HOME="$scratch" PATH="$scratch/bin:$PATH" SLURM_JOB_ID=7 SLURM_NTASKS=21 SLURM_JOB_END_TIME=$(($(date +%s) + ${left%:*})) \
    "$root/scripts/slurm.sh" "$here/disc.yaml" >"$scratch/log" 2>&1) || { cat "$scratch/log"; exit 1; }
  wall=$(sed -n 's/.*time.walltime=//p' "$scratch/coracle-7.conf" | sort -u)
  [ "$wall" -ge 1 ] && [ "$wall" -le "${left#*:}" ] && [ "$wall" -ge $((${left#*:} - 5)) ] || { echo "of a job of ${left%:*} s: time.walltime=$wall"; exit 1; }
done
