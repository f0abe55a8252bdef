#!/usr/bin/env bash
# A trace of a run whose steps are redone: JSON, of all ranks, spans nest and fill the steps; waits add up to what the summary says;
# and one line of advice on ranks.  Usage: trace.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
must trace 2:2:2 --set output.trace=true --set time.end=0.05 --set solid.materials.disc.density=500
grep -q 'coracle: ranks 2:2:2: fluid [0-9]* %, coupler [0-9]* %, solid [0-9]* % of ' "$scratch/trace.log" ||
  { echo 'no line on ranks:'; cat "$scratch/trace.log"; exit 1; }
"$python" - "$scratch/trace" <<'E2'
import collections, csv, json, sys
folder = sys.argv[1]
events = json.load(open(folder + "/trace.json"))["traceEvents"]
process = {e["pid"]: e["args"]["name"] for e in events if e["ph"] == "M"}
assert sorted(process.values()) == ["coupler", "fluid", "solid"], process
ranks = collections.defaultdict(list)
for e in events:
    if e["ph"] == "X":
        start = round(1e3 * e["ts"])  # whole nanoseconds
        ranks[process[e["pid"]], e["tid"]].append((start, start + round(1e3 * e["dur"]), e["name"], e["args"]["step"]))
assert len(ranks) == 6, sorted(ranks)
steps = len(list(csv.DictReader(open(folder + "/coupler.csv"))))
for rank, spans in ranks.items():
    outer = [s for s in spans if s[2].split()[0] in ("start", "step")]
    assert [s[3] for s in outer] == list(range(steps + 1)), f"{rank}: steps {[s[3] for s in outer]} of {steps}"
    assert all(a[1] == b[0] for a, b in zip(outer, outer[1:])), f"{rank}: steps do not follow one another"
    for step in outer:
        inner = sorted(s for s in spans if s[3] == step[3] and s is not step)
        assert all(step[0] <= s[0] <= s[1] <= step[1] for s in inner), f"{rank}: a span leaves {step}"
        assert all(a[1] <= b[0] for a, b in zip(inner, inner[1:])), f"{rank}: spans overlap in {step}"
        left = step[1] - step[0] - sum(s[1] - s[0] for s in inner)
        assert left < 1e6 + 0.05 * (step[1] - step[0]), f"{rank}: {left} ns of {step} are not in a span"
names = {s[2] for spans in ranks.values() for s in spans}
for name in ("momentum", "pressure", "substeps", "overlap", "force", "output", "compute", "wait for fluid 0: FLOW", "wait for solid 1: MOTION",
             "wait for coupler 1: COUPLING", "wait for coupler 0: FORCE"):
    assert name in names, f"no '{name}' in {sorted(names)}"
participants = json.load(open(folder + "/summary.json"))["participants"]
for role in ("fluid", "solid"):  # the summary has the rank that waited most, and the shortest waits
    waited = max(sum(s[1] - s[0] for s in spans if s[2].startswith("wait")) for rank, spans in ranks.items() if rank[0] == role) * 1e-9
    said = participants[role]["seconds_waiting"]
    assert abs(waited - said) < 0.05 * said + 0.01, f"{role}: {waited} s in the trace, {said} in the summary"
assert participants["coupler"]["seconds_waiting_for_fluid"] > 0 and participants["coupler"]["seconds_waiting_for_solid"] > 0
E2
must none 1:1:1 --set time.end=0.02
[ ! -e "$scratch/none/trace.json" ] || { echo 'a trace that nobody has asked for'; exit 1; }
