#!/usr/bin/env python3
"""The front of the column if the water were free of viscosity and the floor of friction: potential flow.

    cases/dam_break/potential.py [NODES]     writes reference/potential.csv: T = t sqrt(2 g/a), Z = x/a

    div grad phi = 0 in the water, dphi/dn = 0 on floor and wall; on the surface, whose nodes move with the water,

        Dx/Dt = grad phi,    Dphi/Dt = |grad phi|^2/2 - g (y - 2 a)

phi is that of sources outside the water, one beside each node, REACH spacings off, and of their images in floor and wall (a
desingularised boundary integral method); time by the fourth-order Runge-Kutta method; nodes are spread along cubic splines after each
step, more of them at the front, and smoothed in every fifth (Longuet-Higgins and Cokelet 1976).  The column's upper corner is
rounded.  Lengths in a, times in sqrt(a/(2 g)), so that g = 1/2.  Needs numpy.

Z at T = 1, 2 .. 6 of 100, 130 and 160 nodes: 1.562 2.678 4.121 5.765 7.532 9.373; 1.557 2.679 4.122 5.769 7.542 9.399; 1.555 2.679
4.123 5.772 7.551 9.420.  Later the tongue is thinner than the distance of its nodes.
"""
import pathlib
import sys

import numpy as np

NODES, REACH, CROWDING, ROUNDING, END = 160, 2.0, 0.5, 0.02, 6.0


def length(points):
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])


def spline(s, values, at):
    """Cubic spline through values[len(s), ...], its third derivative continuous at the second and last but one place, too."""
    h = np.diff(s)
    matrix, right = np.zeros((len(s), len(s))), np.zeros_like(values)
    k = np.arange(1, len(s) - 1)
    matrix[k, k - 1], matrix[k, k], matrix[k, k + 1] = h[:-1], 2.0 * (h[:-1] + h[1:]), h[1:]
    for row, e, places in ((0, h[:2], (0, 1, 2)), (-1, h[:-3:-1], (-1, -2, -3))):
        matrix[row, places] = e[1], -e[0] - e[1], e[0]
    slope = np.diff(values, axis=0) / h[:, None]
    right[1:-1] = 6.0 * np.diff(slope, axis=0)
    bend = np.linalg.solve(matrix, right)
    j = np.clip(np.searchsorted(s, at, side="right") - 1, 0, len(h) - 1)
    t, d = (at - s[j])[:, None], h[j][:, None]
    return (values[j] + t * (slope[j] - d * (2.0 * bend[j] + bend[j + 1]) / 6.0) + 0.5 * t ** 2 * bend[j]
            + t ** 3 * (bend[j + 1] - bend[j]) / (6.0 * d))


def spread(surface, nodes):
    """surface[:, 3]: x, y, phi, from the wall to the front."""
    s = length(surface[:, :2])
    u = np.linspace(0.0, 1.0, nodes)
    at = s[-1] * (1.0 - np.exp(-CROWDING * u)) / (1.0 - np.exp(-CROWDING))
    return pin(spline(s, surface, at))


def pin(surface):
    surface[0, 0] = surface[-1, 1] = 0.0
    return surface


def column(nodes):
    angle = np.linspace(0.0, 0.5 * np.pi, 60)
    corner = np.stack([1.0 - ROUNDING + ROUNDING * np.sin(angle), 2.0 - ROUNDING + ROUNDING * np.cos(angle)], 1)
    top = np.stack([np.linspace(0.0, 1.0 - ROUNDING, 200, endpoint=False), np.full(200, 2.0)], 1)
    face = np.stack([np.full(400, 1.0), np.linspace(2.0 - ROUNDING, 0.0, 401)[1:]], 1)
    points = np.concatenate([top, corner, face])
    return spread(np.column_stack([points, np.zeros(len(points))]), nodes)


def rate(surface):
    x, phi = surface[:, :2], surface[:, 2]
    s = length(x)
    tangent = np.gradient(x, s, axis=0)
    normal = np.stack([-tangent[:, 1], tangent[:, 0]], 1) / np.hypot(*tangent.T)[:, None]
    source = x + REACH * np.gradient(s)[:, None] * normal
    potential, u, v = (np.zeros((len(x), len(x))) for _ in range(3))
    for sign in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        dx, dy = (x[:, None, c] - sign[c] * source[None, :, c] for c in range(2))
        square = dx ** 2 + dy ** 2
        potential += 0.5 * np.log(square)
        u += dx / square
        v += dy / square
    strength = np.linalg.solve(potential, phi)
    u, v = u @ strength, v @ strength
    return np.column_stack([u, v, 0.5 * (u ** 2 + v ** 2) - 0.5 * (x[:, 1] - 2.0)])


def march(nodes):
    """T and Z of every step."""
    surface, t, front, step = column(nodes), 0.0, [(0.0, 1.0)], 0
    while t < END:
        first = rate(surface)
        spacing = np.diff(length(surface[:, :2])).min()
        dt = min(0.3 * spacing / max(np.hypot(*first[:, :2].T).max(), 1e-9), 0.0075)
        second = rate(surface + 0.5 * dt * first)
        third = rate(surface + 0.5 * dt * second)
        surface = pin(surface + dt / 6.0 * (first + 2.0 * second + 2.0 * third + rate(surface + dt * third)))
        surface = spread(surface, nodes)
        t, step = t + dt, step + 1
        if step % 5 == 0:
            b = surface.copy()
            surface[2:-2] = (-b[:-4] + 4.0 * b[1:-3] + 10.0 * b[2:-2] + 4.0 * b[3:-1] - b[4:]) / 16.0
        front.append((t, surface[-1, 0]))
    return np.array(front).T


if __name__ == "__main__":
    t, z = march(int(sys.argv[1]) if len(sys.argv) > 1 else NODES)
    path = pathlib.Path(__file__).resolve().parent / "reference" / "potential.csv"
    with open(path, "w") as file:
        file.write("# Front of a column of n^2 = 2 in potential flow, by potential.py: T = t sqrt(2 g/a), Z = x/a\nT,Z\n")
        for at in np.arange(0.0, END + 1e-9, 0.25):
            file.write("%.2f,%.4f\n" % (at, np.interp(at, t, z)))
