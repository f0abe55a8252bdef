#!/usr/bin/env bash
# What a step costs.  Usage: scripts/bench.sh [--quick]
#   the fluid alone from 10 000 to 300 000 triangles, and two ranks against one at 50 000;
#   the falling cylinder's steps split into momentum, pressure, assembly, coupling, exchange and waiting.
# Built for this processor (preset native).  Times are of this machine, now: compare ratios within one run, or with the
# triad's bandwidth, which is printed first.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
scripts/setup.sh
cmake --preset native >/dev/null
cmake --build --preset native -- --quiet
export OPENBLAS_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

echo "-- memory"
echo "triad $(build-native/tests/bench_stream) GB/s"
echo "-- the fluid alone, one rank"
sizes="0.0141 0.01 0.0063 0.00258"
[ "${1:-}" = --quick ] && sizes="0.0141 0.0063"
for h in $sizes; do build-native/tests/bench_fluid -h "$h" -steps 10; done
echo "-- the same, two ranks"
mpirun --oversubscribe --bind-to none -n 2 build-native/tests/bench_fluid -h 0.0063 -steps 10

echo "-- the falling cylinder, 0.2 s, ranks 1:1:1"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
scripts/launch.sh --bin build-native --ranks 1:1:1 cases/falling_cylinder/case.yaml --set "output.folder=$out" --set time.end=0.2 >/dev/null
python=$(command -v /usr/bin/python3 || command -v python3)
"$python" - "$out/summary.json" <<'EOF'
import json, sys
s = json.load(open(sys.argv[1]))
f, c, d = (s["participants"][k] for k in ("fluid", "coupler", "solid"))
n = s["steps"]
coupling = c["seconds_overlap"] + c["seconds_force"]
solid = d["seconds_wall"] - d["seconds_waiting"]
step = {"momentum": f["seconds_momentum"], "pressure": f["seconds_pressure"],
        "assembly": f["seconds_assembly"], "coupling": coupling + f["seconds_correction"], "solid": solid,
        "exchange": max(f["seconds_waiting"] - coupling - solid, 0.0)}
total = sum(step.values())
print("%d triangles, %d steps" % (f["elements"], n))
for name, seconds in step.items():
    print("  %-10s %8.2f ms a step  %5.1f %%" % (name, 1e3 * seconds / n, 100 * seconds / total))
for name, p in s["participants"].items():
    print("  %-10s waiting %.1f s of %.1f s, %.1f s CPU" % (name, p["seconds_waiting"], p["seconds_wall"], p["seconds_cpu"]))
EOF
