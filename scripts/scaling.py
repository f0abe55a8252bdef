#!/usr/bin/env python3
"""How a case's time changes with ranks: runs it on several splits, a table and a plot.

Usage: scripts/scaling.py CASE [--splits 1:1:1,2:1:1,4:1:1] [--bin DIR] [--out DIR] [--set key=value]...
Strong scaling: the same case on each split (fluid:coupler:solid).  For weak scaling run it on sizes of your own, one split each, into one
--out: rows are added to DIR/scaling.csv, and the plot is of all.  Seconds are of a step: wall clock, and of each participant what it computed,
waiting for others left out.  On fewer cores than ranks the times say what the ranks cost, not what they gain.
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PARTS = ("fluid", "coupler", "solid")
COLUMNS = ("fluid", "coupler", "solid", "elements", "steps", "step [s]", *(f"{p} [s]" for p in PARTS), *(f"{p} waiting [s]" for p in PARTS))


def run(arguments, split):
    """A row of the table."""
    with tempfile.TemporaryDirectory() as folder:
        command = [ROOT + "/scripts/launch.sh", "--bin", arguments.bin, "--ranks", split, arguments.case]
        for item in [*arguments.set, f"output.folder={folder}", "output.checkpoint=0"]:
            command += ["--set", item]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(f"scaling.py: {split}: {done.stdout}{done.stderr}")
        with open(folder + "/summary.json", encoding="utf-8") as file:
            summary = json.load(file)
    who, steps = summary["participants"], summary["steps"]
    row = dict(zip(PARTS, map(int, split.split(":"))), elements=int(who["fluid"]["elements"]), steps=steps)
    row["step [s]"] = max(who[p]["seconds_wall"] for p in PARTS) / steps
    for p in PARTS:
        row[f"{p} waiting [s]"] = who[p]["seconds_waiting"] / steps
        row[f"{p} [s]"] = (who[p]["seconds_wall"] - who[p]["seconds_waiting"]) / steps
    return row


def write(path, rows):
    """Adds rows to the table; returns all of it."""
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)] + rows
    with open(path, "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        table.writerows({k: f"{v:.6g}" for k, v in row.items()} for row in rows)
    return rows


def plot(path, rows):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    rows = sorted(rows, key=lambda row: sum(row[p] for p in PARTS))
    ranks = [sum(row[p] for p in PARTS) for row in rows]
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    axes.loglog(ranks, [row["step [s]"] for row in rows], "ko-", label="a step")
    for p in PARTS:
        axes.loglog(ranks, [row[f"{p} [s]"] for row in rows], "o--", label=f"{p} computes")
    axes.loglog(ranks, [rows[0]["step [s]"] * ranks[0] / n for n in ranks], color="0.7", label="1/ranks")
    for n, row in zip(ranks, rows):
        axes.annotate(":".join(f"{row[p]:.0f}" for p in PARTS), (n, row["step [s]"]), textcoords="offset points", xytext=(4, 6))
    axes.set(xlabel="ranks", ylabel="seconds a step")
    axes.legend()
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case")
    parser.add_argument("--splits", default="1:1:1,2:1:1,4:1:1")
    parser.add_argument("--bin", default=ROOT + "/build")
    parser.add_argument("--out", default="out/scaling")
    parser.add_argument("--set", action="append", default=[])
    arguments = parser.parse_args()
    os.makedirs(arguments.out, exist_ok=True)
    print(f"{os.cpu_count()} cores here")
    print("  ".join(f"{name:>19}" for name in ("split", *COLUMNS[3:9])))
    rows = []
    for split in arguments.splits.split(","):
        rows.append(run(arguments, split))
        print("  ".join(f"{value:>19.4g}" if not isinstance(value, str) else f"{value:>19}" for value in (split, *list(rows[-1][c] for c in COLUMNS[3:9]))),
              flush=True)
    rows = write(os.path.join(arguments.out, "scaling.csv"), rows)
    plot(os.path.join(arguments.out, "scaling.png"), rows)
    print(f"{arguments.out}/scaling.csv, scaling.png")


main()
