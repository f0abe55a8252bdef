#!/usr/bin/env bash
# What a step costs.  Usage: scripts/bench.sh [--quick]
#   the fluid alone from 5 000 to 1 000 000 triangles (--quick: to 51 000) on one rank and on two: each phase in seconds and, in
#   brackets, the fraction of them that its bytes would take at the memory's speed (tests/fluid/step_bytes.h);
#   the falling cylinder's steps split into the fluid's phases and its waiting for the others, and what each program waits and takes of the processor.
# Built for this processor (preset native).  Times are of this machine, now: compare ratios within one run, or with the
# triad's bandwidth, which is printed first and which the fractions are of.
set -euo pipefail
unset CDPATH # with it cd prints where it goes
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
scripts/setup.sh
cmake --preset native >/dev/null
cmake --build --preset native --target bench_stream bench_fluid coracle-fluid coracle-coupler coracle-solid -- --quiet
export OPENBLAS_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

echo "-- $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -1), $(nproc) cores, $(uptime | sed 's/.*load/load/')"
triad=$(build-native/tests/bench_stream)
echo "triad $triad GB/s on one core"
sizes="0.02 0.0063 0.00258 0.00141"
[ "${1:-}" = --quick ] && sizes="0.02 0.0063"
for ranks in 1 2; do
  echo "-- the fluid alone, ranks: $ranks"
  for h in $sizes; do
    mpirun --oversubscribe --bind-to none -n "$ranks" build-native/tests/bench_fluid -h "$h" -steps 10 -triad "$triad"
  done
done

echo "-- the falling cylinder, 0.2 s, ranks 1:1:1"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
scripts/launch.sh --bin build-native --ranks 1:1:1 cases/falling_cylinder/case.yaml --set "output.folder=$out" --set time.end=0.2 >/dev/null
python=$(command -v /usr/bin/python3 || command -v python3)
"$python" - "$out/summary.json" <<'EOF'
import json, sys
s = json.load(open(sys.argv[1]))
f = s["participants"]["fluid"]
n = s["steps"]
step = {"momentum": f["seconds_momentum"], "pressure": f["seconds_pressure"],
        "assembly": f["seconds_assembly"], "correction": f["seconds_correction"], "waiting": f["seconds_waiting"]}
total = sum(step.values())
print("%d triangles, %d steps" % (f["elements"], n))
for name, seconds in step.items():
    print("  %-10s %8.2f ms a step  %5.1f %%" % (name, 1e3 * seconds / n, 100 * seconds / total))
for name, p in s["participants"].items():
    print("  %-10s waiting %.1f s of %.1f s, %.1f s CPU" % (name, p["seconds_waiting"], p["seconds_wall"], p["seconds_cpu"]))
EOF
