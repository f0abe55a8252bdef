#!/usr/bin/env python3
"""The first three bending frequencies of a clamped beam, from a run of the solid alone, against Timoshenko's beam
within 2 %.  beam_modes.py PROGRAM FOLDER"""
import math
import os
import subprocess
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, "../../scripts"))
import modes  # noqa: E402

LENGTH, HEIGHT, DENSITY, YOUNG, POISSON = 1.0, 0.1, 1000.0, 1.0e6, 0.3


def slopes(w, y):
    """Of deflection, rotation, moment and shear force of a beam that vibrates with w; plane stress, shear factor
    10 (1 + nu)/(12 + 11 nu) (Cowper 1966)."""
    inertia = HEIGHT**3 / 12.0
    factor = 10.0 * (1.0 + POISSON) / (12.0 + 11.0 * POISSON)
    shear = factor * YOUNG / (2.0 * (1.0 + POISSON)) * HEIGHT
    return [y[1] + y[3] / shear, y[2] / (YOUNG * inertia), -y[3] - DENSITY * inertia * w * w * y[1],
            -DENSITY * HEIGHT * w * w * y[0]]


def determinant(w, steps=200):
    """Of moment and shear force at the free end, for a unit moment and a unit shear force at the clamp: 0 at a
    natural frequency."""
    h, ends = LENGTH / steps, []
    for column in range(2):
        y = [0.0, 0.0, float(column == 0), float(column == 1)]
        for _ in range(steps):  # Runge-Kutta 4
            k1 = slopes(w, y)
            k2 = slopes(w, [a + 0.5 * h * b for a, b in zip(y, k1)])
            k3 = slopes(w, [a + 0.5 * h * b for a, b in zip(y, k2)])
            k4 = slopes(w, [a + h * b for a, b in zip(y, k3)])
            y = [a + h / 6.0 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(y, k1, k2, k3, k4)]
        ends.append(y)
    return ends[0][2] * ends[1][3] - ends[1][2] * ends[0][3]


def timoshenko(count):
    """The first natural frequencies, Hz."""
    found, step, w = [], 0.2, 0.2
    while len(found) < count:
        if determinant(w) * determinant(w + step) < 0.0:
            low, high = w, w + step
            for _ in range(40):
                middle = 0.5 * (low + high)
                if determinant(low) * determinant(middle) <= 0.0:
                    high = middle
                else:
                    low = middle
            found.append(low / (2.0 * math.pi))
        w += step
    return found


def main():
    program, folder = sys.argv[1:3]
    case = os.path.join(here, "beam.yaml")
    subprocess.run([program, "--alone", case, "--set", f"output.folder={folder}"], check=True,
                   stdout=subprocess.DEVNULL)
    t, v = modes.read_column(os.path.join(folder, "solid.csv"), "v0")
    bad = 0
    for k, ((frequency, size), exact) in enumerate(zip(modes.find_modes(t, v, 3), timoshenko(3))):
        error = frequency / exact - 1.0
        bad += abs(error) > 0.02
        print(f"mode {k + 1}: {frequency:.5f} Hz (amplitude {size:.2e}), Timoshenko {exact:.5f}, {100 * error:+.2f} %")
    sys.exit(f"beam_modes: {bad} of 3 frequencies are off by more than 2 %" if bad else 0)


if __name__ == "__main__":
    main()
