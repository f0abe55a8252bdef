"""Viscous flow through gaps: keys of the runs of gap.sh, references and what the runs have left.  mu/rho is 10 m2/s, Reynolds numbers are below 1.

    gap.py keys FOLDER CASE...     prints keys=values over gap.yaml, and writes the meshes that they name into FOLDER
    gap.py row FOLDER LABEL CASE...     prints and checks the row of the run in FOLDER/LABEL

    CASE   crack N WIDTH ANGLE   a slot 4 m long between two blocks, WIDTH m wide, N elements a metre, turned by ANGLE degrees
           wall N                the same, 1 m wide, between walls of the domain
           array C N             a row of three discs in a square array, solid fraction C, N elements a diameter
           piston N LENGTH       a block that is pushed along a closed channel, gaps of N elements beside it

A slot passes Q = G w^3/(12 mu): the hydraulic width is that w with the stream's Q and the measured gradient G of the pressure.  A disc in an array has the
drag of array_drag().  A piston of height h moves U h of fluid through two gaps w: G = 6 mu U (h + w)/w^3, and its force by length is G (h + w) + 2 mu U/w.
"""
import math
import sys

import numpy as np

from results import rows

MU, RHO, HEIGHT, LENGTH, CENTRE = 10.0, 1.0, 3.6, 6.0, (3.0, 1.8137)  # of the domain; the slot's centre
FLOW, GAP, SPEED = 1.0, 0.1, 1.0  # m2/s through a slot; gap of a piston, m; its speed, m/s
TOLERANCE = {"crack": 0.26, "wall": 0.1, "array": 0.1, "piston": 0.1}  # of an element; of the drag, of the force of a piston of 2 m, in which its ends have little part


def array_drag(c, terms=24):
    """F/(mu U) on a disc of a square array of solid fraction c in Stokes flow, U the mean velocity (Sangani and Acrivos, 1982).  Stream function
    psi = sum over odd k of sin(k theta) (combinations of r^k+2, r^2-k, for k = 1 r ln r, with r^k and r^-k so that psi and psi_r are 0 on the disc);
    least squares of psi_x = omega_x = 0 on x = 1/2, psi = 1/2, omega = 0 on y = 1/2 of a unit cell."""
    a = math.sqrt(c / math.pi)

    def function(k, m, r):  # R, R', and of the Laplacian of R sin(k theta): L, L'; m None: r ln r
        if m is None:
            at, slope, f, fr, w, wr = a * math.log(a), math.log(a) + 1.0, r * np.log(r), np.log(r) + 1.0, 2.0 / r, -2.0 / r**2
        else:
            at, slope, f, fr = a**m, m * a ** (m - 1.0), r**m, m * r ** (m - 1.0)
            w, wr = (m * m - k * k) * r ** (m - 2.0), (m * m - k * k) * (m - 2.0) * r ** (m - 3.0)
        p, q = np.linalg.solve([[a**k, a**-k], [k * a ** (k - 1.0), -k * a ** (-k - 1.0)]], [-at, -slope])
        return f + p * r**k + q * r**-k, fr + k * (p * r ** (k - 1.0) - q * r ** (-k - 1.0)), w, wr

    def columns(x, y):  # psi, psi_x, omega, omega_x of all functions
        r, angle = np.hypot(x, y), np.arctan2(y, x)
        all_columns = []
        for k in np.arange(1.0, 2.0 * terms, 2.0):
            sine, cosine = np.sin(k * angle), k * np.cos(k * angle) * np.sin(angle) / r
            for m in ((None, 3.0) if k == 1.0 else (k + 2.0, 2.0 - k)):
                f, fr, w, wr = function(k, m, r)
                all_columns.append((f * sine, fr * sine * np.cos(angle) - f * cosine, w * sine, wr * sine * np.cos(angle) - w * cosine))
        return [np.array(part).T for part in zip(*all_columns)]

    s = (np.arange(400) + 0.5) / 800.0
    side, top = columns(0.5 + 0.0 * s, s), columns(s, 0.5 + 0.0 * s)
    matrix = np.vstack([side[1], side[3], top[0], top[2]])
    right = np.concatenate([0.0 * s, 0.0 * s, 0.5 + 0.0 * s, 0.0 * s])
    scale = abs(matrix).max(0)
    return 4.0 * math.pi * (np.linalg.lstsq(matrix / scale, right, rcond=1e-14)[0] / scale)[0]


def block(path, corners):
    with open(path, "w") as file:
        file.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 "rock"\n$EndPhysicalNames\n$Nodes\n4\n')
        for i, corner in enumerate(corners):
            file.write("%d %.12g %.12g 0\n" % (i + 1, *corner))
        file.write("$EndNodes\n$Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n$EndElements\n")


def crack_keys(folder, n, width, angle):
    slope, half = math.tan(math.radians(angle)), width / 2.0 / math.cos(math.radians(angle))
    left, right = (CENTRE[1] + slope * (x - CENTRE[0]) for x in (1.0, 5.0))
    block(folder + "/lower.msh", [(1.0, 0.0), (5.0, 0.0), (5.0, right - half), (1.0, left - half)])
    block(folder + "/upper.msh", [(1.0, left + half), (5.0, right + half), (5.0, HEIGHT), (1.0, HEIGHT)])
    dt = RHO * max(width, 1.0 / n) ** 2 / (12.0 * MU)
    return ["solid.bodies=[{mesh: lower.msh, material: rock, fixed: true}, {mesh: upper.msh, material: rock, fixed: true}]",
            "time.dt_max=%g" % dt, "time.end=%g" % (60.0 * dt), *size_keys(1.0 / n)] + probe_keys(math.radians(angle))


def wall_keys(folder, n):
    return ["fluid.mesh.upper=[%g, 1.0]" % LENGTH, "fluid.boundaries.bottom=no_slip", "fluid.boundaries.top=no_slip", "fluid.adapt.size_max=%g" % (1.0 / n),
            "fluid.boundaries.left.velocity=[%g, 0.0]" % FLOW, *size_keys(1.0 / n)] + probe_keys(0.0, (CENTRE[0], 0.5))


def array_keys(folder, c, n):
    diameter, dt = math.sqrt(4.0 * c / math.pi), RHO / (array_drag(c) * MU)
    disc = "{shape: disc, centre: [%g, 0.5], radius: %.10g, size: %g, material: rock, fixed: true}"
    return ["fluid.mesh={lower: [0.0, 0.0], upper: [3.0, 1.0], size_max: 0.1}", "fluid.boundaries.left.velocity=[%g, 0.0]" % SPEED, "fluid.adapt.size_max=0.1",
            "fluid.adapt.velocity_error=0.001", "time.dt_max=%g" % dt, "time.end=%g" % ((100 if c < 0.2 else 60) * dt),
            "solid.bodies=[%s]" % ", ".join(disc % (x, diameter / 2.0, 0.75 * diameter / n) for x in (0.5, 1.5, 2.5)), *size_keys(diameter / n)]


def piston_keys(folder, n, length):
    return ["fluid.mesh={lower: [0.0, 0.0], upper: [4.0, 1.0], size_max: 0.25}",
            "fluid.boundaries={left: no_slip, right: no_slip, bottom: no_slip, top: no_slip}", "time.dt_max=1e-4", "time.end=8e-3",
            "fluid.adapt={size_min: %g, size_max: 0.25, velocity_error: 0.02, every: 20, growth: 2.0}" % (GAP / n), "coupler.shell_thickness=%g" % (GAP / n / 20.0),
            "solid.bodies=[{shape: rectangle, centre: [2.0, 0.5], width: %g, height: %g, size: 0.1, material: rock, prescribed: [{velocity: [%g, 0.0]}]}]" % (
                length, 1.0 - 2.0 * GAP, SPEED)]


def size_keys(le):
    return ["fluid.adapt.size_min=%.10g" % le, "coupler.shell_thickness=%.10g" % (le / 20.0)]


def probe_keys(angle, centre=CENTRE):
    ends = ["[%.10g, %.10g]" % (centre[0] + s * math.cos(angle), centre[1] + s * math.sin(angle)) for s in (-0.8, 0.8)]
    return ["fluid.probes=[{name: P, line: {from: %s, to: %s, points: 41}}]" % tuple(ends)]


def hydraulic_width(row):
    gradient = -np.polyfit(np.linspace(-0.8, 0.8, 41), [row["P%d_p [Pa]" % i] for i in range(41)], 1)[0]
    return (12.0 * MU * FLOW / gradient) ** (1.0 / 3.0)


def compare(kind, label, n, width=1.0, angle=0.0):
    """Prints the row; returns the error that TOLERANCE bounds."""
    if kind in ("crack", "wall"):
        series = rows(label, "fluid_probes")
        was, now = (n * (hydraulic_width(series[k]) - width) for k in (2 * len(series) // 3, -1))
        print("%s, %g m of %g elements, %g degrees: wider by %+.3f elements (a third earlier %+.3f)" % (kind, width, width * n, angle, now, was))
        return now
    series = rows(label, "solid")
    row, earlier = series[-1], series[2 * len(series) // 3]
    if kind == "array":
        c, n = n, width
        force, reference = row["fx1 [N/m]"] / (MU * SPEED), array_drag(c)
        print("array, c %g, %g elements a diameter: F/(mu U) %.2f of %.2f, %+.2f %% (a third earlier %+.2f %%)" % (
            c, n, force, reference, 100.0 * (force / reference - 1.0), 100.0 * (earlier["fx1 [N/m]"] / (MU * SPEED * reference) - 1.0)))
    else:
        height = 1.0 - 2.0 * GAP
        reference = width * (6.0 * MU * SPEED * (height + GAP) ** 2 / GAP**3 + 2.0 * MU * SPEED / GAP)
        force = -row["fx0 [N/m]"]
        print("piston %g m long, %g elements in a gap: %.0f N/m, theory without its ends %.0f: %+.2f %%" % (width, n, force, reference, 100.0 * (force / reference - 1.0)))
    return 0.0 if kind == "piston" and width < 2.0 else force / reference - 1.0


if __name__ == "__main__":
    if sys.argv[1] == "keys":
        folder, kind, numbers = sys.argv[2], sys.argv[3], [float(a) for a in sys.argv[4:]]
        print("\n".join(globals()[kind + "_keys"](folder, *numbers)))
    else:
        folder, label, kind, numbers = sys.argv[2], sys.argv[3], sys.argv[4], [float(a) for a in sys.argv[5:]]
        sys.argv[1] = folder  # results.py
        error = compare(kind, label, *numbers)
        sys.exit(not abs(error) < TOLERANCE[kind])
