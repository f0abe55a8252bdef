#!/usr/bin/env python3
"""Vibration modes from a time series: the strongest frequencies in a column of solid.csv.

    scripts/modes.py out/beam --column v0 --modes 3       # its solid.csv, or another file: out/beam/solid_probes.csv --column tip_y

Rows need not be equally spaced (they are brought to equal steps by linear interpolation).  The mean is taken off,
a Hann window laid over the series, its spectrum searched for the highest peaks, and each peak refined where the
windowed transform itself is largest, to far less than the spacing 1/T of the spectrum's lines.  Two peaks closer than
4/T cannot be told apart.  Needs nothing but Python.
"""
import argparse
import cmath
import csv
import math
import os
import sys


def read_column(path, wanted):
    """Times and values; wanted with or without its unit."""
    try:
        with open(path) as lines:
            # the last row of a running case may be half written
            rows = list(csv.reader(line.lstrip("#") for line in lines if line.strip() and line.endswith("\n")))
    except OSError as error:
        sys.exit(f"modes: {path}: {error.strerror}")
    if not rows:
        sys.exit(f"modes: {path}: there is no row yet")
    names = [name.strip() for name in rows[0]]
    places = [k for k, name in enumerate(names) if wanted in (name, name.split("[")[0].strip())]
    if not places:
        sys.exit(f"modes: {path} has no column {wanted}: it has {', '.join(names)}")
    return [float(row[0]) for row in rows[1:]], [float(row[places[0]]) for row in rows[1:]]


def resample(t, values):
    """The series at equal steps, as many as it has rows."""
    n, k, result = len(t), 0, []
    step = (t[-1] - t[0]) / (n - 1)
    for i in range(n):
        at = t[0] + i * step
        while k < n - 2 and t[k + 1] < at:
            k += 1
        result.append(values[k] + (values[k + 1] - values[k]) * (at - t[k]) / (t[k + 1] - t[k]))
    return step, result


def fft(x):
    """Discrete Fourier transform of 2^k numbers (Cooley and Tukey)."""
    n = len(x)
    if n == 1:
        return x
    even, odd = fft(x[::2]), fft(x[1::2])
    turned = [cmath.exp(-2j * math.pi * k / n) * odd[k] for k in range(n // 2)]
    return [e + o for e, o in zip(even, turned)] + [e - o for e, o in zip(even, turned)]


def amplitude(windowed, step, frequency):
    """The windowed transform's size at any frequency."""
    turn, factor, total = cmath.exp(-2j * math.pi * frequency * step), 1.0, 0.0
    for value in windowed:
        total += value * factor
        factor *= turn
    return abs(total)


def refine(windowed, step, low, high):
    """Where the transform is largest between two frequencies (golden section)."""
    ratio = (math.sqrt(5.0) - 1.0) / 2.0
    for _ in range(30):
        a, b = high - ratio * (high - low), low + ratio * (high - low)
        if amplitude(windowed, step, a) > amplitude(windowed, step, b):
            high = b
        else:
            low = a
    return 0.5 * (low + high)


def find_modes(t, values, count):
    """The count strongest (frequency in Hz, amplitude), by frequency."""
    step, values = resample(t, values)
    n, mean = len(values), sum(values) / len(values)
    windowed = [(v - mean) * (0.5 - 0.5 * math.cos(2.0 * math.pi * (i + 0.5) / n)) for i, v in enumerate(values)]
    size = 2 ** (n - 1).bit_length() * 4
    lines = [abs(z) for z in fft([complex(v) for v in windowed] + [0j] * (size - n))[: size // 2]]
    spacing, apart = 1.0 / (size * step), int(2 * size / n)  # a Hann peak is 2/T wide to each side
    peaks = [k for k in range(apart, size // 2 - 1) if lines[k] == max(lines[max(0, k - apart) : k + apart + 1])]
    peaks = sorted(sorted(peaks, key=lambda k: -lines[k])[:count])
    refined = [refine(windowed, step, (k - 1) * spacing, (k + 1) * spacing) for k in peaks]
    return [(f, 4.0 / n * amplitude(windowed, step, f)) for f in refined]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("series", help="a run's folder, or a CSV file whose first column is the time, s")
    parser.add_argument("--column", default="v0", help="default v0: velocity across of the first body's mass centre")
    parser.add_argument("--modes", type=int, default=3)
    parser.add_argument("--start", type=float, default=0.0, help="leave out what is before, s")
    arguments = parser.parse_args()
    path = os.path.join(arguments.series, "solid.csv") if os.path.isdir(arguments.series) else arguments.series
    t, values = read_column(path, arguments.column)
    kept = [(a, b) for a, b in zip(t, values) if a >= arguments.start]
    if len(kept) < 16:
        sys.exit(f"modes: {len(kept)} rows are too few")
    print("frequency [Hz],amplitude")
    for frequency, size in find_modes([a for a, _ in kept], [b for _, b in kept], arguments.modes):
        print(f"{frequency:.6g},{size:.4g}")


if __name__ == "__main__":
    main()
