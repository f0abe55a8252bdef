#!/usr/bin/env bash
# Scripts beside a run do what their usage says, on small cases: pictures of fields and phases, animations, scaling, options before the case.  Usage: scripts.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/../coupled/run.sh"
"$python" -c 'import numpy, h5py, matplotlib' 2>/dev/null || { echo 'needs numpy, h5py and matplotlib'; exit 77; }
must x 1:1:1 --set time.end=0.02 --set output.every=0.01
for field in velocity.y solid:stress; do
  "$root/scripts/view.sh" "$scratch/x" --field $field --time 0.01 --out "$scratch/$field.png" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
  [ -s "$scratch/$field.png" ] || { echo "no picture of $field"; exit 1; }
done
# components by their names, a folder that is made, corners of a window in any order
"$root/scripts/view.sh" "$scratch/x" --field solid:stress.xy --window 1.2 1.2 0.8 0.8 --out "$scratch/new/xy.png" >"$scratch/log" 2>&1 && [ -s "$scratch/new/xy.png" ] || { cat "$scratch/log"; exit 1; }
no_picture() { # EXPECTED RUN options: one line
  if "$root/scripts/view.sh" "${@:2}" >/dev/null 2>"$scratch/log"; then echo "a picture of ${*:2}"; exit 1; fi
  [ "$(wc -l <"$scratch/log")" -eq 1 ] && grep -q "$1" "$scratch/log" || { cat "$scratch/log"; exit 1; }
}
no_picture 'stress has the components xx, yy, xy' "$scratch/x" --field solid:stress.z
no_picture 'velocity has the components x, y' "$scratch/x" --field velocity.z
no_picture 'pressure has no components' "$scratch/x" --field pressure.x
no_picture 'nothing in the window (3.0, 3.0, 4.0, 4.0): all lies from (0, 0) to (2, 2)' "$scratch/x" --window 3 3 4 4
no_picture "Format 'none' is not supported" "$scratch/x" --out "$scratch/x.none"
sed '/^coupler:/d' "$here/disc.yaml" >"$scratch/bodiless.yaml"
case=$scratch/bodiless.yaml must bodiless 1:1:1 --set 'solid.bodies=[]' --set time.end=0.02
no_picture "nothing to draw of 'solid:stress': the run has no bodies" "$scratch/bodiless" --field solid:stress
"$python" "$root/scripts/plot_field.py" "$scratch/bodiless" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
# colours of both signs only where there are both
PYTHONPATH=$root/scripts "$python" - <<'E2'
from snapshot import colours
assert colours(-2e-15, 1.0) == colours(0.0, 1.0) == colours(-1.0, 0.0) == colours(-1.0, 1e-12) == "viridis" and colours(-1e-3, 1.0) != "viridis"
E2
"$python" "$root/scripts/plot_field.py" "$scratch/x" >"$scratch/log" 2>&1 && [ -s "$scratch/x/field.png" ] || { cat "$scratch/log"; exit 1; }
# phases: the lightest first whatever the case's order, drawn by both; an animation has a frame a snapshot
case=$here/phases.yaml must phases 1:1:1 --set time.end=0.02 --set output.every=0.01
for options in '--field phases --out phases.png' '--field phases --animate' '--animate --range 0 1 --out speed.gif'; do
  (cd "$scratch/phases" && "$root/scripts/view.sh" . $options) >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
done
"$python" "$root/scripts/plot_field.py" "$scratch/phases" >"$scratch/log" 2>&1 && [ -s "$scratch/phases/field.png" ] || { cat "$scratch/log"; exit 1; }
PYTHONPATH=$root/scripts "$python" - "$scratch/phases" <<'E3'
import sys
from PIL import Image
from phases import Phases, snapshot_times
from snapshot import read_snapshot
folder = sys.argv[1]
phases = Phases(read_snapshot(folder + "/fluid.h5")[1]["velocity"])
assert phases.names == ["air", "water"] and phases.dense()[0] == ["water"] and abs(phases.shades().min()) < 1e-9 and abs(phases.shades().max() - 1.0) < 1e-9
frames = [Image.open(f"{folder}/{name}.gif").n_frames for name in ("view", "speed")]
assert frames == [len(snapshot_times(folder))] * 2 == [3, 3] and Image.open(folder + "/phases.png").width > 900, frames
E3
# of a run whose fluid has written a snapshot more those that the solid has, too
mkdir "$scratch/ahead" && cp "$scratch/phases/"*.h5 "$scratch/ahead"
"$python" -c 'import h5py, sys; file = h5py.File(sys.argv[1], "a"); del file["snapshot"][max(file["snapshot"])]' "$scratch/ahead/solid.h5"
"$root/scripts/view.sh" "$scratch/ahead" --animate >"$scratch/log" 2>&1 && "$python" "$root/scripts/plot_field.py" "$scratch/ahead" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
PYTHONPATH=$root/scripts "$python" - "$scratch/ahead" <<'E3'
import sys
from PIL import Image
import phases
phases.animate(sys.argv[1], "water", sys.argv[1] + "/phases.gif")
phases.draw_times(sys.argv[1], [9.0], "water", sys.argv[1] + "/phases.png")
frames = [Image.open(f"{sys.argv[1]}/{name}.gif").n_frames for name in ("view", "phases")]
assert frames == [2, 2], frames
E3
no_picture 'has no fluid.h5 and no solid.h5' "$scratch" --animate
if "$root/scripts/view.sh" "$scratch/x" --field colour 2>"$scratch/log"; then echo 'a field that is not there was drawn'; exit 1; fi
grep -q "there is no field 'colour': .*solid:stress" "$scratch/log" || { cat "$scratch/log"; exit 1; }
"$python" "$root/scripts/scaling.py" "$here/disc.yaml" --bin "$build" --splits 1:1:1,2:1:1 --out "$scratch/scaling" --set time.end=0.02 >"$scratch/log" 2>&1 ||
  { cat "$scratch/log"; exit 1; }
[ "$(wc -l <"$scratch/scaling/scaling.csv")" -eq 3 ] && [ -s "$scratch/scaling/scaling.png" ] || { cat "$scratch/log"; exit 1; }
# options stand before the case or after it; what is not one is told as such, and a usage ends with its last line
for order in "--alone $root/tests/solid/alone.yaml" "$root/tests/solid/alone.yaml --alone"; do
  "$root/scripts/run.sh" --bin "$build" --out "$scratch/alone" --set time.end=0.001 $order >"$scratch/log" 2>&1 && [ -s "$scratch/alone/summary.json" ] || { cat "$scratch/log"; exit 1; }
  tail -1 "$scratch/log" | grep -q '^results: .*alone (summary.json, \*.csv, \*.xdmf for ParaView)$' || { cat "$scratch/log"; exit 1; }
  "$python" "$root/scripts/momentum.py" "$scratch/alone" --bound 1e-11 >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; } # of one step
  rm -r "$scratch/alone"
done
# folders of any name, also where the shell's cd prints
odd="$scratch/it's #1: x"
(cd "$root" && CDPATH=$root:/ "scripts/run.sh" --bin "$build" --out "$odd" --set time.end=0.001 --alone tests/solid/alone.yaml) >"$scratch/log" 2>&1 && [ -s "$odd/summary.json" ] || { cat "$scratch/log"; exit 1; }
rm -r "$odd"
# the default output folder has the case file's name, wherever that lies
mkdir "$scratch/my.cases" && cp "$root/tests/solid/alone.yaml" "$scratch/my.cases/block"
(cd "$scratch" && "$root/scripts/run.sh" --bin "$build" --set time.end=0.001 --alone my.cases/block) >"$scratch/log" 2>&1 && [ -s "$scratch/out/block/summary.json" ] || { cat "$scratch/log"; exit 1; }
if "$python" "$root/scripts/energy.py" "$scratch" 2>"$scratch/log"; then echo 'an energy of no run'; exit 1; fi
[ "$(cat "$scratch/log")" = "$scratch: there is no solid.csv" ] || { cat "$scratch/log"; exit 1; }
"$python" "$root/scripts/energy.py" "$scratch/x" --from 0.01 >"$scratch/log" && grep -q '^body 0: at most' "$scratch/log" && ! grep -q '^all' "$scratch/log" || { cat "$scratch/log"; exit 1; }
# of a run that was stopped in a step some series have a row more; of one that goes on the last may be half written
mkdir "$scratch/stopped" && cp "$scratch/x/"*.csv "$scratch/stopped"
for series in fluid fluid_forces coupler; do tail -1 "$scratch/x/$series.csv" | sed 's/^[^,]*/9/' >>"$scratch/stopped/$series.csv"; done
printf '0.1,0.0' >>"$scratch/stopped/solid.csv"
for script in energy momentum; do
  "$python" "$root/scripts/$script.py" "$scratch/stopped" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
done
if "$python" "$root/scripts/momentum.py" "$scratch" 2>"$scratch/log"; then echo 'a budget of no run'; exit 1; fi
[ "$(wc -l <"$scratch/log")" -eq 1 ] && grep -q 'there is no fluid_forces.csv, solid.csv, coupler.csv;' "$scratch/log" || { cat "$scratch/log"; exit 1; }
if "$root/scripts/run.sh" --bin "$build" --allone "$root/tests/solid/alone.yaml" 2>"$scratch/log"; then echo 'an unknown option was taken'; exit 1; fi
grep -q "^run.sh: unknown option '--allone'" "$scratch/log" || { cat "$scratch/log"; exit 1; }
if "$root/scripts/check.sh" --help | grep '^t '; then echo 'more than the usage is shown'; exit 1; fi
# fragments: of a beam that breaks, on any ranks, as many as the solver counts; together they are where the body is, and those there were go on
for ranks in 1:1:1 1:1:2; do
  must "cracks-${ranks//:/-}" "$ranks" --set "solid.materials.disc=$brittle" --set "solid.bodies[0]=$bar" --set time.end=0.4 --set output.every=0.1 --set solid.rebalance=1
  "$python" "$root/scripts/fragments.py" "$scratch/cracks-${ranks//:/-}" --png >"$scratch/log" && [ -s "$scratch/cracks-${ranks//:/-}/fragments.png" ] || { cat "$scratch/log"; exit 1; }
done
"$python" - "$scratch" <<'E4'
from results import rows
area, tables = 0.03, [rows(label, "fragments") for label in ("cracks-1-1-1", "cracks-1-1-2")]
for label, table in zip(("cracks-1-1-1", "cracks-1-1-2"), tables):
    solid = {row["t [s]"]: row for row in rows(label, "solid")}
    before = {0.0}
    for t in sorted({row["t [s]"] for row in table}):
        mine = [row for row in table if row["t [s]"] == t]
        now = {row["fragment"] for row in mine}
        assert len(now) == len(mine) and before <= now and {row["parent"] for row in mine} <= before, "%s: %s after %s" % (label, mine, before)
        assert abs(sum(row["area [m2]"] for row in mine) / area - 1) < 1e-9
        row = solid.get(min(solid, key=lambda s: abs(s - t)))
        for name, key in (("x0 [m]", "x [m]"), ("y0 [m]", "y [m]")):
            centre = sum(r["area [m2]"] * r[key] for r in mine) / area
            assert t == 0.0 or abs(centre - row[name]) < 1e-9, "%s: %g at %g s, in solid.csv %g" % (label, centre, t, row[name])
        before = now
    assert len(before) == solid[max(solid)]["pieces"] >= 2
assert [[row[key] for key in ("t [s]", "fragment", "parent", "elements")] for row in tables[0]] == [[row[key] for key in ("t [s]", "fragment", "parent", "elements")] for row in tables[1]]
E4
# an outside solid that does not end is ended with its run
printf '#!/bin/sh\necho $$ >%q\nexec sleep 600\n' "$scratch/pid" >"$scratch/endless" && chmod +x "$scratch/endless"
if "$python" "$root/scripts/conform.py" --solid "$scratch/endless" --bin "$build" --ranks 1 --timeout 10 "$here/disc.yaml" >"$scratch/log" 2>&1; then echo 'a solid that does not end conforms'; exit 1; fi
grep -q 'it has not ended within 10' "$scratch/log" || { cat "$scratch/log"; exit 1; }
for try in $(seq 100); do kill -0 "$(cat "$scratch/pid")" 2>/dev/null || break; sleep 0.1; done
[ "$try" -lt 100 ] || { kill "$(cat "$scratch/pid")"; echo 'a solid that does not end was left'; exit 1; }
