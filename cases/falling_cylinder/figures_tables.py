#!/usr/bin/env python3
"""Counterparts of the paper's Figs. 4 to 7 from the rows that validate.py has run, and the motion of the discs.

    cases/falling_cylinder/figures_tables.py [--validation DIR] [--only FIGURE ...]

Writes into DIR/figures (DIR: out/validation): figure4.png (errors of the terminal speed), figure5.png and figure6.png (fields of
Y020-200 and Y040-200), figure7.png (Af20-200 beside Yf20-200, or both at le 0.005 m), speed.png (U(t)), sway.png (u_x(t)).  Draws what is there and says
what is missing: figure4 takes finished rows only, the others also rows still running.  Needs numpy, h5py and matplotlib.
"""
import argparse
import pathlib
import sys

import rows
import validate

sys.path.insert(0, str(validate.ROOT / "scripts"))
from plot_fall import read_table
from snapshot import Window, centred, paint, paint_mesh, read_run, without_hydrostatic

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MultipleLocator

DIAMETER, WEIGHT = 2.0 * rows.RADIUS, rows.RHO_F * rows.GRAVITY  # m, N/m3
AHEAD, WAKE, ASIDE = 2.5, 12.0, 2.4  # diameters from the disc's centre to the window's sides
MEASURES = (("a", (("Yc20", "le 0.01", "C2", "o"), ("Y020", "le 0.005", "C0", "s"), ("Yf20", "le 0.0025", "C3", "^"))),
            ("b", (("Y020", "dr 0.0005", "C0", "s"), ("Yr20", "dr 0.001", "C4", "D"))))


class Missing(LookupError):
    """No row that this figure shows has been run."""


def motion(folder, name):
    """t, u_x, u_y of the disc, finished or not; None where there is nothing."""
    path = folder / name / "coupler.csv"
    if not path.exists() or path.stat().st_size < 1000:
        return None
    table = read_table(path)
    return table["t [s]"], table["u_x [m/s]"], table["u_y [m/s]"]


def reference_motion(re):
    """t, u_x, u_y of the body-fitted reference, closed sides, density ratio 2."""
    table = read_table(validate.HERE / "reference" / (validate.CURVES[re] + ".csv"))
    return table["t[s]"], table["v_lateral"], -table["U_fall"]


def tell_missing(figure, names, there):
    gone = [name for name in names if name not in there]
    if gone:
        print(f"{figure}: no {', '.join(gone)}", file=sys.stderr)
    if len(gone) == len(names):
        raise Missing


# ---- Fig. 4: errors of the terminal speed ----

def paper_points(series, against):
    """Reynolds numbers and errors, %, of the paper's own speeds: Er, or against body-fitted open sides."""
    found = []
    for re in (20, 100, 200):
        row = validate.TABLES[f"{series}-{re:03d}"]
        speed, semi_empirical = row.paper
        compared = semi_empirical if against == "correlation" else validate.TABLES[f"Y020-{re:03d}-open"].expected
        found.append((row.reynolds(speed), 100.0 * (speed / compared - 1.0)))
    return np.array(found).T


def our_points(there, series, sides, against):
    """The same of our finished rows: Er at their own Re, or against the body-fitted speed of the same disc, free or held."""
    found = []
    for name, result in there.items():
        row = validate.TABLES[name]
        re = row.reynolds(result.speed)
        compared = row.reference if against == "body-fitted" else None if row.held else row.correlation(re)
        if name.startswith(series) and row.sides == sides and compared:
            found.append((re, 100.0 * (result.speed / compared - 1.0)))
    return np.array(sorted(found)).T if found else np.empty((2, 0))


def errors_panel(axes, there, measures, against):
    axes.axhline(0.0, color="0.5", linewidth=0.8)
    for series, label, colour, marker in measures:
        axes.plot(*paper_points(series, against), marker, color=colour, markerfacecolor="none", markersize=8,
                  label=f"paper, {label}")
    axes.plot(*our_points(there, "Y020", "open", against), "P--", color="k", linewidth=0.8, markersize=7,
              label="Coracle, le 0.005, open sides")
    for k, (series, label, colour, marker) in enumerate(measures):  # ever smaller, for they may lie on each other
        axes.plot(*our_points(there, series, "closed", against), marker + "-", color=colour, linewidth=0.8, markersize=9.5 - 3 * k,
                  label=f"Coracle, {label}, closed sides")
    axes.set(xlim=(0.0, 230.0), xlabel="Reynolds number")
    axes.grid(alpha=0.25)


def figure4(folder):
    names = [f"{series}-{re:03d}" for series in ("Yc20", "Y020", "Yf20", "Yr20") for re in (20, 100, 200)]
    names += [f"Y020-{re:03d}-open" for re in (20, 100, 200)] + [f"Y020-{re}-open-held" for re in (100, 200)]
    there = validate.results(names)
    tell_missing("figure4", names, there)
    figure, axes = plt.subplots(3, 2, figsize=(12, 11), height_ratios=[1, 1, 0.22], sharey="row", layout="constrained")
    for k, (letter, measures) in enumerate(MEASURES):
        errors_panel(axes[0, k], there, measures, "correlation")
        errors_panel(axes[1, k], there, measures, "body-fitted")
        what = "fluid mesh size" if letter == "a" else "shell thickness"
        axes[0, k].set_title(f"({letter}) {what}, against the correlation at the same Re", fontsize=10)
        axes[1, k].set_title(f"({letter}) {what}, against body-fitted elements (open at Re 100, 200: held discs)", fontsize=10)
        axes[2, k].axis("off")
        axes[2, k].legend(*axes[0, k].get_legend_handles_labels(), loc="center", ncol=2, fontsize=9, frameon=False)
    axes[0, 0].set_ylabel("Er [%]")
    axes[1, 0].set_ylabel("error of the terminal speed [%]")
    figure.suptitle("Fig. 4: errors of the terminal speed, density ratio 2\n"
                    "(below: Coracle against body-fitted elements with its own sides, the paper against them with open sides)",
                    fontsize=10)
    return figure


# ---- Figs. 5 to 7: fields ----

class Fields:
    """What the pictures show of one row's snapshot."""

    def __init__(self, folder, name, time=None):
        self.row, self.name = validate.TABLES[name], name
        self.time, grids, self.body = read_run(folder / name, time)
        self.velocity, self.pressure = grids["velocity"], grids["pressure"]
        centre = Window.around(self.body.points).centre
        self.window = Window(centre - DIAMETER * np.array([ASIDE, AHEAD]), centre + DIAMETER * np.array([ASIDE, WAKE]))
        self.v = self.velocity.node["velocity"][:, 1]
        self.speed = np.hypot(*self.velocity.node["velocity"][:, :2].T)
        self.title = f"{name}, le {self.row.le:g} m, {self.row.sides} sides, t = {self.time:.2f} s"

    def excess_pressure(self):
        """p + rho g y, Pa, less its value in the fluid at rest at the tank's floor, far ahead."""
        p, _ = without_hydrostatic(self.pressure, WEIGHT)
        y = self.pressure.points[:, 1]
        return p - p[y < y.min() + 1e-6].mean()

    def paint_velocity(self, axes, limits, ticks):
        paint(axes, self.velocity, self.v, self.window, limits, centred(*limits, even=False), "vertical velocity [m/s]",
              self.body, ticks)


def snapshot_there(folder, name):
    try:
        read_run(folder / name)
        return True
    except (LookupError, OSError):
        return False


def side_by_side(count):
    figure, axes = plt.subplots(1, count, figsize=(3.4 * count + 0.3, 10.2), sharey=count == 4, layout="constrained")
    for axis in axes:
        axis.set(xlabel="x [m]", anchor="S")
        axis.xaxis.set_major_locator(MultipleLocator(0.4))
    axes[0].set_ylabel("y [m]")
    return figure, axes


def fields_figure(folder, label, name, speed_max, velocity, pressure):
    """Mesh, speed, vertical velocity, excess pressure; (low, high, step) of the colours of the last two.

    The paper's, but for the upward end of the velocity's: between closed sides the fluid beside the wake rises faster,
    at 0.7 m/s for Y020-200.  Inside the disc the pressure is the constraint's, not a stress: covered."""
    tell_missing(label, [name], [name] if snapshot_there(folder, name) else [])
    f = Fields(folder, name)
    figure, axes = side_by_side(4)
    paint_mesh(axes[0], f.velocity, f.window, f.body, linewidth=0.25)
    axes[0].set_title("mesh", fontsize=10)
    paint(axes[1], f.velocity, f.speed, f.window, (0.0, speed_max), "viridis", "speed |u| [m/s]", f.body)
    f.paint_velocity(axes[2], velocity[:2], np.arange(velocity[0], velocity[1] + 1e-9, velocity[2]))
    paint(axes[3], f.pressure, f.excess_pressure(), f.window, pressure[:2], centred(*pressure[:2]),
          "non-hydrostatic pressure [Pa]", f.body, np.arange(pressure[0], pressure[1] + 1, pressure[2]), cover=True)
    figure.suptitle(f"{label.replace('figure', 'Fig. ')}: {f.title}")
    return figure


def figure5(folder):
    return fields_figure(folder, "figure5", "Y020-200", 2.0, (-1.8, 0.6, 0.6), (-1400.0, 1400.0, 700.0))


def figure6(folder):
    return fields_figure(folder, "figure6", "Y040-200", 3.0, (-3.0, 1.0, 1.0), (-2500.0, 5000.0, 2500.0))


def figure7(folder):
    names = ["Af20-200", "Yf20-200"] if snapshot_there(folder, "Af20-200") else ["Af20-200-le-0.005", "Y020-200"]
    there = [name for name in names if snapshot_there(folder, name)]
    tell_missing("figure7", names, there)
    figure, axes = side_by_side(2)
    for axis, name in zip(axes, names):
        if name not in there:
            axis.set_axis_off()
            continue
        f = Fields(folder, name)
        f.paint_velocity(axis, (-1.8, 0.6), np.arange(-1.8, 0.61, 0.6))
        axis.set_title(f"{name}, t = {f.time:.2f} s\n{f.row.mode}", fontsize=10)
    figure.suptitle("Fig. 7")
    return figure


# ---- motion ----

def speed(folder):
    """U(t) of the rows Y020 over the reference's."""
    names = [f"Y020-{re:03d}{sides}" for re in (20, 100, 200) for sides in ("", "-open")]
    curves = {name: motion(folder, name) for name in names}
    tell_missing("speed", names, [name for name in names if curves[name]])
    figure, axes = plt.subplots(1, 3, figsize=(15, 5), layout="constrained")
    for axis, re in zip(axes, (20, 100, 200)):
        for sides, suffix, colour in (("closed", "", "C0"), ("open", "-open", "C1")):
            curve = curves[f"Y020-{re:03d}{suffix}"]
            if curve:
                axis.plot(curve[0], -curve[2], color=colour, label=f"Coracle, {sides} sides")
            terminal = validate.TABLES[f"Y020-{re:03d}{suffix}"].expected
            axis.axhline(terminal, color=colour, linestyle=":", linewidth=1.2,
                         label=f"body-fitted, {sides}: terminal {terminal:g} m/s")
        t, _, v = reference_motion(re)
        axis.plot(t, -v, "k--", linewidth=1.0, label="body-fitted, closed sides")
        axis.axhline(rows.PAPER[f"Y020-{re:03d}"][0], color="0.6", linewidth=0.8,
                     label=f"paper: {rows.PAPER[f'Y020-{re:03d}'][0]:g} m/s")
        axis.set(title=f"Y020-{re:03d}", xlabel="t [s]", xlim=(0.0, None), ylim=(0.0, None))
        axis.legend(loc="lower right", frameon=False, fontsize=9)
    axes[0].set_ylabel("fall speed [m/s]")
    return figure


def lateral(folder, name, re):
    """t and u_x over the body-fitted terminal speed, of a row or of the reference; None where there is nothing."""
    found = reference_motion(re) if name == "body-fitted" else motion(folder, name)
    row = validate.TABLES.get(name, validate.TABLES[f"Y020-{re}"])
    return found and (found[0], found[1] / row.expected)


def sway(folder):
    """u_x(t): one strip a row at Re 100 and 200, the reference on top."""
    kinds = ("Yc20-%d", "Y020-%d", "Yf20-%d", "Af20-%d", "Yr20-%d", "Y020-%d-open", "Y040-%d", "Y060-%d")
    names = [kind % re for kind in kinds for re in (100, 200) if kind % re in validate.TABLES]
    there = [name for name in names if motion(folder, name)]
    tell_missing("sway", names, there)
    strips = ["body-fitted"] + [kind for kind in kinds if kind % 100 in there or kind % 200 in there]
    figure, axes = plt.subplots(len(strips), 2, figsize=(13, 1.0 + 1.15 * len(strips)), sharex=True, sharey=True,
                                layout="constrained")
    for (j, k), axis in np.ndenumerate(axes):
        re = (100, 200)[k]
        name = strips[j] % re if j else strips[j]
        if j and name not in validate.TABLES:
            axis.set_axis_off()
            continue
        curve = lateral(folder, name, re)
        if curve:
            axis.plot(*curve, color="C0" if j else "k", linewidth=0.9)
        axis.text(0.01, 0.94, name if curve else f"{name}: not there", transform=axis.transAxes, va="top", fontsize=9)
        axis.grid(alpha=0.25)
    for axis, re in zip(axes[0], (100, 200)):
        axis.set_title(f"Re about {re}", fontsize=10)
    axes[-1, 0].set(xlim=(0.0, None))
    for axis in axes[-1]:
        axis.set_xlabel("t [s]")
    figure.supylabel("lateral velocity / body-fitted terminal speed")
    return figure


FIGURES = {f.__name__: f for f in (figure4, figure5, figure6, figure7, speed, sway)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--validation", type=pathlib.Path, default=validate.OUT, metavar="DIR", help="where the rows are")
    parser.add_argument("--only", nargs="*", choices=FIGURES, default=list(FIGURES), metavar="FIGURE")
    arguments = parser.parse_args()
    validate.OUT = arguments.validation  # where its Result reads
    pictures = arguments.validation / "figures"
    pictures.mkdir(parents=True, exist_ok=True)
    for name in arguments.only:
        try:
            figure = FIGURES[name](arguments.validation)
        except Missing:
            continue
        figure.savefig(pictures / (name + ".png"), dpi=150)
        plt.close(figure)
        print(pictures / (name + ".png"))


if __name__ == "__main__":
    main()
