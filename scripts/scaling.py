#!/usr/bin/env python3
"""How a case's time changes with ranks: strong and weak sets of runs, what each participant computed, waited and sent, and a model of it.

Usage: scripts/scaling.py CASE [--splits 1:1:1,2:2:2,4:4:4] [--weak 1:1:1,2:2:2,4:4:4 --length KEY=VALUE...] [--skip SECONDS] [--readme FILE]

--splits  strong: the same case on each split (fluid:coupler:solid)
--weak    the mesh grows with the ranks: the keys of --length (sizes, time.dt_max, time.end, and --skip) shrink with the root of the ranks
--skip    time of the case whose cost does not count: each run is made up to there, too, and taken off; wall clock and waiting are of all steps
--readme  tables between <!-- scaling -->, <!-- model -->, <!-- paper --> and their ends in that file
DIR (--out) holds scaling.csv, scaling.png; rows of earlier calls stay, and the model (scaling_model.py) is of all rows.

Milliseconds are of a step and of the busiest rank of a participant, outside of MPI: what ranks that share cores take from each other, and waiting,
are not in them.  scripts/count_messages.c counts what is sent.  On fewer cores than ranks the wall clock says what ranks cost, not what they gain.
"""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import scaling_model
from scaling_model import PARTS
from validation import put_into_readme

ROOT = pathlib.Path(__file__).resolve().parent.parent
COUNTS = ("computed [s]", "messages", "bytes", "exchanged", "exchanged bytes", "reductions", "gathers")  # as count_messages.c writes them
COLUMNS = ("set", *PARTS, "elements", "near", "solid elements", "steps", "step [s]",
           *(f"{p} {c}" for p in PARTS for c in ("waited [s]", *COUNTS)))


def launch(arguments, split, sets, counter):
    """One run's summary, and of each participant the largest counts of a rank."""
    with tempfile.TemporaryDirectory() as folder:
        command = [ROOT / "scripts" / "launch.sh", "--bin", arguments.bin, "--ranks", split, arguments.case]
        for item in [*sets, f"output.folder={folder}/run", "output.checkpoint=0"]:
            command += ["--set", item]
        environment = dict(os.environ, LD_PRELOAD=counter, COUNT_MESSAGES=folder + "/counts")
        done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
        if done.returncode:
            sys.exit(f"scaling.py: {split}: {done.stdout}{done.stderr}")
        with open(folder + "/run/summary.json", encoding="utf-8") as file:
            summary = json.load(file)
        with open(folder + "/counts", encoding="utf-8") as file:
            lines = sorted([float(word) for word in line.split()] for line in file)
    counts, first = {}, 0
    for p, n in zip(PARTS, map(int, split.split(":"))):
        counts[p] = lines[first:first + n]
        first += n
    return summary, counts


def run(arguments, name, split, scale, counter):
    """A row of the table: per step, of the busiest rank."""
    lengths = [f"{key}={scale * value:.12g}" for key, value in arguments.length]
    sets = arguments.set + lengths
    summary, counts = launch(arguments, split, sets, counter)
    who, steps = summary["participants"], summary["steps"]
    row = dict(zip(PARTS, map(int, split.split(":"))), set=name, elements=int(who["fluid"]["elements"]),
               near=summary["elements"]["fluid_near_solid"], steps=steps)
    row["solid elements"] = summary["elements"]["solid"]
    row["step [s]"] = max(who[p]["seconds_wall"] for p in PARTS) / steps
    row.update((f"{p} waited [s]", who[p]["seconds_waiting"] / steps) for p in PARTS)
    if arguments.skip:
        before, less = launch(arguments, split, sets + [f"time.end={scale * arguments.skip:.12g}"], counter)
        row["steps"] = steps = steps - before["steps"]
        for p in PARTS:
            counts[p] = [[a - b for a, b in zip(of, off)] for of, off in zip(counts[p], less[p])]
    for p in PARTS:
        row.update((f"{p} {c}", max(of[k + 1] for of in counts[p]) / steps) for k, c in enumerate(COUNTS))
    return row


def write(path, rows):
    """Adds rows to the table, in place of those of the same set and split; returns all of it."""
    def key(row):
        return [str(row["set"]), *(int(float(row[p])) for p in PARTS)]
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            old = [{k: v if k == "set" else float(v) for k, v in row.items()} for row in csv.DictReader(file)]
        rows = [row for row in old if key(row) not in map(key, rows)] + rows
    with open(path, "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        table.writerows({k: v if k == "set" else f"{v:.6g}" for k, v in row.items()} for row in rows)
    return rows


def length(text):
    key, _, value = text.partition("=")
    return key, float(value)  # its ValueError is a message of argparse


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case")
    parser.add_argument("--splits", default="")
    parser.add_argument("--weak", default="")
    parser.add_argument("--length", action="append", type=length, default=[])
    parser.add_argument("--skip", type=float, default=0.0)
    parser.add_argument("--name", default="strong", help="of the set of --splits in the tables")
    parser.add_argument("--bin", default=ROOT / "build")
    parser.add_argument("--out", default="out/scaling")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--readme", type=pathlib.Path)
    arguments = parser.parse_args()
    os.makedirs(arguments.out, exist_ok=True)
    counter = os.path.abspath(os.path.join(arguments.out, "count_messages.so"))
    subprocess.run(["mpicc", "-O2", "-shared", "-fPIC", "-o", counter, ROOT / "scripts" / "count_messages.c"], check=True)
    print(f"{os.cpu_count()} cores here", flush=True)
    rows = []
    for name, splits in ((arguments.name, arguments.splits), ("weak", arguments.weak)):
        splits = [split for split in splits.split(",") if split]
        ranks = [sum(map(int, split.split(":"))) for split in splits]
        for split, n in zip(splits, ranks):
            rows.append(run(arguments, name, split, (ranks[0] / n) ** 0.5 if name == "weak" else 1.0, counter))
            print(scaling_model.describe(rows[-1]), flush=True)
    path = pathlib.Path(arguments.out)
    rows = write(path / "scaling.csv", rows)
    if not rows:
        sys.exit(f"scaling.py: {path}/scaling.csv has no rows yet: expected --splits or --weak")
    tables, models = scaling_model.tables(rows)
    for mark, lines in tables.items():
        print("\n".join(lines) + "\n")
        if arguments.readme:
            put_into_readme(arguments.readme, mark, lines)
    scaling_model.plot(path / "scaling.png", rows, models)
    print(f"{path}/scaling.csv, scaling.png")


main()
