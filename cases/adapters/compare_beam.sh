#!/usr/bin/env bash
# An adapter's beam bends as FEMDEM's in the same stream, on two ranks as on one, and swings without vibrations that grow.  Usage: compare_beam.sh NAME ROOT BUILD
set -euo pipefail
name=$1
shift
source "$1/tests/coupled/run.sh"
program=$("$root/cases/adapters/build.sh" "$name" "$build")
case=$root/cases/adapters/$name/case.yaml
"$root/scripts/conform.py" --bin "$build" --ranks 1,2 --solid "$program" "$case"
# the corner that moves most, which is what the adapters report
must femdem 1:1:1 --set time.end=0.4 --set 'solid.probes=[{name: tip, point: [0.57, 0.4]}]'
must one 1:1:1 --set time.end=0.4 --solid "$program"
must two 1:1:2 --set time.end=0.4 --solid "$program"
"$root/cases/adapters/compare.py" "$scratch/two" "$scratch/one" 1e-6 "u_x [m/s]" "u_y [m/s]" "F_x [N]"
"$root/cases/adapters/compare.py" "$scratch/one" "$scratch/femdem" 0.04 "u_x [m/s]" "F_x [N]"
for run in "femdem" "one --solid $program"; do # a midpoint rule without damping breaks at 1.6 s
  read -ra words <<<"$run"
  must "long-${words[0]}" 1:1:1 --set time.end=2.0 "${words[@]:1}"
done
"$root/cases/adapters/compare.py" "$scratch/long-one" "$scratch/long-femdem" 0.04 "F_x [N]"
"$python" - "$scratch" <<'E2'
import csv, json, sys
tip = json.load(open(sys.argv[1] + "/one/summary.json"))["participants"]["solid"]["tip_x"]
reference = float(list(csv.DictReader(open(sys.argv[1] + "/femdem/solid_probes.csv")))[-1]["tip_x [m]"])
print(f"tip_x [m]: {tip:g}, reference {reference:g}, difference {abs(tip / reference - 1):.2g}")
assert abs(tip / reference - 1) < 0.02
E2
