#!/usr/bin/env python3
"""Runs an outside solid without a fluid, or an outside fluid without a solid, against the conformance kit's partners and says
what its author must mend.

Usage: scripts/conform.py --solid|--fluid PROGRAM [--bin DIR] [--ranks 1,2,3] CASE [--set key=value]...
  --bin    a build folder or an installation's bin (default: build beside this script)
  --ranks  on which the program is run; it may leave ranks empty
What is checked, and what a failure means: cases/adapters/CONFORMANCE.md.  Exit status 1 when something fails.
"""
import argparse
import csv
import os
import re
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
STEPS, SAVE = 12, 8
# of the solid's extent or of the fastest velocity: what other ranks may change; a fluid's solvers are iterative
SAME = {"solid": 1e-6, "fluid": 1e-4}


class Kit:
    def __init__(self, arguments, scratch):
        self.arguments, self.scratch, self.failed = arguments, scratch, 0
        self.role = "fluid" if arguments.fluid else "solid"
        self.partner = "solid" if arguments.fluid else "fluid"
        self.same = SAME[self.role]

    def program(self, name):
        for folder in (self.arguments.bin, self.arguments.bin + "/common", self.arguments.bin + "/bin"):
            if os.access(f"{folder}/{name}", os.X_OK):
                return f"{folder}/{name}"
        sys.exit(f"conform.py: no {name} under '{self.arguments.bin}'")

    def run(self, label, ranks, save=0, steps=STEPS, coupler_ranks=1):
        """(exit status, output, seconds) of one run; its rows go into the folder `label`."""
        folder = os.path.join(self.scratch, label)
        os.makedirs(folder, exist_ok=True)
        split = {self.role: ranks, self.partner: 1}
        command = [ROOT + "/scripts/launch.sh", "--ranks", f"{split['fluid']}:{coupler_ranks}:{split['solid']}", "--bin",
                   self.arguments.bin, "--" + self.partner, self.program("coracle-partner-" + self.partner), "--coupler",
                   self.program("coracle-partner-coupler"), "--" + self.role, getattr(self.arguments, self.role), self.arguments.case]
        given = {"of": self.role, "folder": folder, "steps": steps, "save": save}
        for item in [*self.arguments.set, *(f"coupler.conformance.{key}={value}" for key, value in given.items())]:
            command += ["--set", item]
        start = time.time()
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as launched:
            try:
                output = "".join(launched.communicate(timeout=self.arguments.timeout))
                return launched.returncode, output, time.time() - start
            except subprocess.TimeoutExpired:
                launched.terminate()  # mpirun ends its ranks then; killed it would leave them
                launched.communicate()
            return 1, f"error: it has not ended within {self.arguments.timeout} s", self.arguments.timeout

    def say(self, name, good, text):
        self.failed += not good
        print(f"{name:11} {'ok    ' if good else 'FAILED'} {text}", flush=True)
        return good

    def rows(self, label):
        with open(os.path.join(self.scratch, label, "rows.csv"), encoding="utf-8") as file:
            return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def why(output):
    lines = [line for line in output.splitlines() if ": error:" in line] or output.splitlines()[-1:]
    return re.sub(r"^coracle (\w+\[\d+\]): error: (conformance: )?", r"\1: ", lines[0]) if lines else "no message"


def velocities(row):
    return [key for key in row if key.endswith("[m/s]")]


def largest_difference(one, two):
    """Of a solid's positions over its extent, and of velocities over the fastest."""
    extent = max((r["x2 [m2]"] - r["x [m]"]**2 + r["y2 [m2]"] - r["y [m]"]**2)**0.5 for r in one) if "x [m]" in one[0] else 1.0
    positions = [key for key in one[0] if key in ("x [m]", "y [m]")]
    fastest = max(abs(r[key]) for r in one for key in velocities(r)) or 1.0
    return max(abs(a[key] - b[key]) / (extent or 1.0 if key in positions else fastest)
               for a, b in zip(one, two) for key in positions + velocities(a))


REPEATED = {"solid": "the same bits, and an additional force moves it along",
            "fluid": "the same bits; coupling and correction act as they must"}


def check_steps(kit):
    """Steps of several lengths, redone steps, what force or coupling does: all in one run, which the coupler checks."""
    status, output, seconds = kit.run("one", 1)
    notes = "".join(", " + note for note in re.findall(r"conformance: note: (.*)", output))
    text = f"{STEPS} steps of 4 lengths, {seconds:.1f} s{notes}"
    if not kit.say("steps", status == 0, text if status == 0 else why(output)):
        print(output, file=sys.stderr)
        return False
    rows = kit.rows("one")
    kit.say("redo", True, "steps 2, 5, 8, 11 made several times: " + REPEATED[kit.role])
    moved = max(abs(r[key]) for r in rows for key in velocities(r))
    return kit.say("motion", moved > 1e-12, f"fastest velocity {moved:.3g} m/s" if moved > 1e-12 else f"the {kit.role} does not move under any force")


def check_ranks(kit):
    for ranks in kit.arguments.ranks:
        for coupler in (1, 2):
            if (ranks, coupler) == (1, 1):
                continue
            label = f"{coupler}-{ranks}"
            status, output, _ = kit.run(label, ranks, coupler_ranks=coupler)
            difference = largest_difference(kit.rows("one"), kit.rows(label)) if status == 0 else 0
            kit.say("ranks", status == 0 and difference < kit.same,
                    why(output) if status else f"{kit.role} on {ranks}, coupler on {coupler}: differs by {difference:.2g}")


def check_stop(kit):
    status, output, _ = kit.run("none", 1, steps=0)
    kit.say("stop", status == 0, "a run without a step ends well" if status == 0 else why(output))


def check_checkpoint(kit):
    status, output, _ = kit.run("saved", 1, save=SAVE)
    if status:
        kit.say("checkpoint", False, why(output))
    elif "has not saved" in output:
        kit.say("checkpoint", True, f"none: the {kit.role} saves no state (bind buffers only, or use CoracleCheckpointPath)")
    else:
        kit.arguments.set.append(f"resume={kit.scratch}/saved/checkpoint")
        status, output, _ = kit.run("resumed", 1)
        kit.arguments.set.pop()
        if status:
            kit.say("checkpoint", False, why(output))
            return
        kept, again = ([r for r in kit.rows(label) if r["step"] >= SAVE] for label in ("saved", "resumed"))
        difference = largest_difference(kept, again)
        kit.say("checkpoint", difference < 1e-3 * kit.same, f"resumed at step {SAVE}: differs by {difference:.2g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0], usage=__doc__.split("Usage: ")[1].split("\n  ")[0])
    examined = parser.add_mutually_exclusive_group(required=True)
    examined.add_argument("--solid")
    examined.add_argument("--fluid")
    parser.add_argument("--bin", default=ROOT + "/build")
    parser.add_argument("--ranks", type=lambda text: [int(n) for n in text.split(",")], default=[1, 2, 3])
    parser.add_argument("--timeout", type=float, default=120)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("case")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        kit = Kit(arguments, scratch)
        if check_steps(kit):
            check_ranks(kit)
            check_stop(kit)
            check_checkpoint(kit)
    print("conforms" if not kit.failed else f"{kit.failed} checks failed")
    sys.exit(1 if kit.failed else 0)


main()
