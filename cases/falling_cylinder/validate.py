#!/usr/bin/env python3
"""Runs the validation of the falling cylinder and writes its table.

    cases/falling_cylinder/validate.py [--ranks F:C:S] [--only NAME ...] [--table] [--check]

Each run is scripts/run.sh with a few keys set; it is skipped when its summary.json exists already (delete
out/validation/<name> to run it again).  --table only prints the table of what has been run, --check exits with 1 when a number is out of its bounds.  References are those of
body-fitted finite elements (reference/*.csv and the terminal speeds below), errors are against them.
"""
import argparse
import csv
import json
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
OUT = ROOT / "out" / "validation"

# lateral sides open: traction-free
OPEN = ["fluid.boundaries.left=open", "fluid.boundaries.right=open"]
# the approach to the terminal speed takes 6 s there
TALL = ["fluid.mesh.upper=[2.5, 10]", "fluid.mesh.refine[0].lower=[1.08, 0.9]", "fluid.mesh.refine[0].upper=[1.42, 9.45]",
        "solid.bodies[0].centre=[1.25, 9.25]", "time.end=6"]
FINE = ["fluid.mesh.refine[0].size=0.005", "solid.bodies[0].size=0.0075"]
# the tank of the runs at Re 200: the disc falls 1.9 m/s
LONG = ["fluid.mesh.upper=[2.5, 7.5]", "fluid.mesh.refine[0].lower=[1.05, 0.9]", "fluid.mesh.refine[0].upper=[1.45, 6.95]",
        "solid.bodies[0].centre=[1.25, 6.75]", "fluid.viscosity=2.278"]


def density(rho):
    return ["solid.materials.disc.density=%g" % rho]


# name: (reference curve, terminal reference or None, settings)
RUNS = {
    "closed-0.02": ("nu0.017173", 1.2326, ["fluid.mesh.refine[0].size=0.02", "solid.bodies[0].size=0.025"]),
    "closed-0.01": ("nu0.017173", 1.2326, []),
    "closed-0.005": ("nu0.017173", 1.2326, FINE),
    "open-0.01": (None, 1.426, OPEN + TALL),
    "dr-0.001": ("nu0.017173", 1.2326, ["coupler.shell_thickness=0.001"]),
    "dt-half": ("nu0.017173", 1.2326, ["time.cfl=0.25", "time.dt_max=0.005"]),
    "stress_shell": ("nu0.017173", 1.2326, ["coupler.mode=stress_shell"]),
    "penalty_shell": ("nu0.017173", 1.2326, ["coupler.mode=penalty_shell"]),
    "re200-0.01": ("nu0.002278", None, LONG),
    "re200-0.005": ("nu0.002278", None, LONG + FINE),
    "ratio-0.5": (None, None, density(500) + ["solid.bodies[0].centre=[1.25, 1.5]", "time.end=1.0"]),
    "ratio-1.05": (None, None, density(1050) + ["time.end=1.0"]),
    "ratio-4": (None, None, density(4000) + ["fluid.viscosity=29.673", "time.end=1.6"]),
    "ratio-6": (None, None, density(6000) + ["fluid.viscosity=38.404", "time.end=1.3"]),
}
TIMES = [0.2, 0.5, 1.0, 2.0, 3.0]


def interpolate(curve, t):
    for (t0, u0), (t1, u1) in zip(curve, curve[1:]):
        if t0 <= t <= t1 + 1e-9:
            return u0 + (u1 - u0) * (t - t0) / (t1 - t0)
    return None


def reference_curve(name):
    rows = [line for line in open(HERE / "reference" / (name + ".csv")) if not line.startswith("#")]
    return [(float(r["t[s]"]), float(r["U_fall"])) for r in csv.DictReader(rows)]


def fall_curve(folder):
    with open(folder / "coupler.csv") as f:
        return [(float(r["t [s]"]), -float(r["u_y [m/s]"])) for r in csv.DictReader(f)]


def run(name, ranks):
    folder = OUT / name
    if (folder / "summary.json").exists():
        return
    command = [str(ROOT / "scripts" / "run.sh"), "falling_cylinder", "--out", str(folder), "--ranks", ranks]
    for key in RUNS[name][2]:
        command += ["--set", key]
    print("==", name, " ".join(command), flush=True)
    subprocess.run(command, check=True)


def row(name):
    curve_name, terminal, _ = RUNS[name]
    folder = OUT / name
    summary = json.load(open(folder / "summary.json"))
    curve = fall_curve(folder)
    cells = [name, "%.4f" % summary["terminal_velocity"]]
    cells.append("%+.2f %%" % (100 * (summary["terminal_velocity"] / terminal - 1)) if terminal else "")
    reference = reference_curve(curve_name) if curve_name else None
    for t in TIMES:
        u = interpolate(curve, t)
        r = interpolate(reference, t) if reference else None
        cells.append("" if u is None else "%.4f" % u if r is None else "%.4f (%+.1f %%)" % (u, 100 * (u / r - 1)))
    cells += ["%.0e" % summary["largest_momentum_imbalance"], str(summary["steps"]),
              str(summary["participants"]["fluid"]["elements"]),
              "%.0f" % sum(p["seconds_cpu"] for p in summary["participants"].values())]
    return "| " + " | ".join(cells) + " |"


def table():
    print("| run | U at the end | error | " + " | ".join("U(%g)" % t for t in TIMES) + " | imbalance | steps | triangles | CPU s |")
    print("|" + "---|" * (7 + len(TIMES)))
    for name in RUNS:
        if (OUT / name / "summary.json").exists():
            print(row(name))


def terminal(name):
    return json.load(open(OUT / name / "summary.json"))["terminal_velocity"]


def check():
    """What must hold: (statement, measured, bound) of every run that is there."""
    there = [name for name in RUNS if (OUT / name / "summary.json").exists()]
    claims = []
    for name, bound in (("closed-0.01", 0.015), ("closed-0.005", 0.01), ("open-0.01", 0.02)):
        if name in there:
            claims.append((name + ": terminal speed", abs(terminal(name) / RUNS[name][1] - 1), bound))
    for name in ("closed-0.01", "closed-0.005", "re200-0.01"):
        if name in there:
            curve, reference = fall_curve(OUT / name), reference_curve(RUNS[name][0])
            worst = max(abs(u / interpolate(reference, t) - 1) for t, u in curve if t >= 0.5)
            claims.append((name + ": U(t) from 0.5 s on", worst, 0.03))
    for name, what, bound in (("dr-0.001", "dr twice as large", 0.003), ("dt-half", "dt halved", 0.01)):
        if name in there and "closed-0.01" in there:
            claims.append((what, abs(terminal(name) / terminal("closed-0.01") - 1), bound))
    for name in there:
        summary = json.load(open(OUT / name / "summary.json"))
        if summary["mode"] == "stress_shell":
            continue  # its force is sampled on the surface, not the reaction: the paper's form does not conserve
        imbalance = summary["largest_momentum_imbalance"]
        claims.append((name + ": momentum imbalance", imbalance, 1e-10))
    for what, measured, bound in claims:
        print("%-45s %8.2g  bound %g%s" % (what, measured, bound, "" if measured <= bound else "  FAILED"))
    return all(measured <= bound for _, measured, bound in claims)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ranks", default="1:1:1")
    parser.add_argument("--only", nargs="*", default=list(RUNS), choices=list(RUNS))
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    for name in [] if arguments.table else arguments.only:
        run(name, arguments.ranks)
    table()
    if arguments.check and not check():
        raise SystemExit(1)


if __name__ == "__main__":
    main()
