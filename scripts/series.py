"""Series of a run (fluid.csv, solid.csv, ...), and what is periodic in them; needs numpy."""
import csv
import sys

import numpy as np

HARMONICS = 8  # of its frequency, that what is periodic is made of; what is faster is noise from step to step


def read_series(path):
    """Columns of a CSV by their names without units; without the last row of a running case, if it is half written."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if line.endswith("\n")))
    if not rows:
        sys.exit(f"{path}: there is no row yet")
    values = np.array(rows[1:], float).reshape(-1, len(rows[0]))
    return {name.split(" [")[0]: values[:, k] for k, name in enumerate(rows[0])}


def bodies_of(solid):
    """The numbers of the bodies that solid.csv has: of the first 1000."""
    return [k for k in range(len(solid)) if f"mass{k}" in solid]


def has_every_step(t, dt):
    """Whether output.series_every has left out no step; dt[k]: the length of the one that ends at t[k]."""
    return not (np.diff(t) > 1.001 * dt[1:]).any()


def of_same_steps(folder, *series):
    """The series, of the steps that all have: of a run that was stopped some have a row more.  Ends the program if they are not of the same
    steps."""
    n = min(len(one["t"]) for one in series)
    shared = [{name: values[:n] for name, values in one.items()} for one in series]
    if n == 0 or any(abs(one["t"] - shared[0]["t"]).max() > 1e-9 * shared[0]["t"][-1] for one in shared):
        sys.exit(f"{folder}: the series are not of the same steps")
    return shared


def upward(t, values):
    """When the values pass the middle of their range upwards, linear between rows.  A crossing counts once they have been in the lower
    fifth of the range, so that noise makes none."""
    low, high = values.min(), values.max()
    middle, crossings, below = 0.5 * (low + high), [], False
    for k in range(1, len(t)):
        below |= values[k] < low + 0.2 * (high - low)
        if below and values[k - 1] < middle <= values[k]:
            crossings.append(t[k - 1] + (middle - values[k - 1]) / (values[k] - values[k - 1]) * (t[k] - t[k - 1]))
            below = False
    return np.array(crossings)


def harmonics(t, values, frequency, n=HARMONICS):
    """Complex amplitudes c_0 .. c_n with values = Re sum c_k exp(2 pi i k frequency t), least squares."""
    phase = 2.0 * np.pi * frequency * np.outer(t, np.arange(1, n + 1))
    a = np.linalg.lstsq(np.hstack([np.ones((len(t), 1)), np.cos(phase), np.sin(phase)]), values, rcond=None)[0]
    return np.concatenate([a[:1], a[1:n + 1] - 1j * a[n + 1:]])


def curve(t, amplitudes, frequency):
    """The values at t of what harmonics() found."""
    return np.real(np.exp(2j * np.pi * frequency * np.outer(t, np.arange(len(amplitudes)))) @ amplitudes)


def periodic(t, values, frequency):
    """Mean and half of the range of the harmonics over a period."""
    q = curve(np.linspace(0.0, 1.0 / frequency, 721), harmonics(t, values, frequency), frequency)
    return 0.5 * (q.max() + q.min()), 0.5 * (q.max() - q.min())
