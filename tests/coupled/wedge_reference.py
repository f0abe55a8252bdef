"""The wedge of wedge.sh by potential flow: it slides without friction on a slope of 45 degrees, in units of SI, turned so that the slope is level.

    div grad f = 0,   df/dn = n_x on the wedge, 0 on slope and sides,   f = 0 on the water's surface, if there is one
    p = -rho (u' f + u^2 (df/ds - df/dx + |grad f|^2/2)),    m u' = W + int p n_x ds,    contact = W - int p n_y ds,    n into the wedge

m: mass; u: speed; s: its way, df/ds at a place that stays; W: weight less the displaced water's, as much along the slope as across it.  Under the wedge p is linear between its values at both ends of the gap (uplift.h).  The surface stays where it is:
right for as long as waves take to rise.  Flow that separates at the upper edge sucks less: there contact bears more the farther the wedge has come.
Usage: wedge_reference.py WATER TIME...   WATER: depth above the slope's foot, m, or tank"""
import subprocess
import sys
import tempfile

import numpy as np

RHO, MASS, LENGTH, FINEST = 1000.0, 250.0, 0.5 ** 0.5, 0.002
WEIGHT = (MASS - RHO * 0.125) * 9.81 * LENGTH  # less the displaced water's, along the slope and across it
TURN = LENGTH * np.array([[1.0, 1.0], [-1.0, 1.0]])  # to the level frame: row vectors times this


def corners(water, s):
    """Of the fluid, counter-clockwise: those at sides and surface, and the wedge's, from its rear over its upper edge to its front."""
    rear, front = 0.41 / LENGTH + s, 0.91 / LENGTH + s
    wedge = [(rear, 0.0), (0.5 * (rear + front), 0.5 * (front - rear)), (front, 0.0)]
    if water == "tank":
        return [(2.6, 0.0), (2.6, 1.6), (-0.4, 1.6), (-0.4, 0.0)], wedge
    depth = float(water)
    shore = [(0.0, depth), (0.0, 1.4)] if depth > 1.4 else [(1.4 - depth, depth)]
    return (np.array([(1.4, 0.0), (5.0, 0.0), (5.0, depth)] + shore) - [0.0, 1.4]) @ TURN, wedge


def mesh(water, s):
    """Points, triangles and the edges of the wedge, from gmsh."""
    outer, wedge = corners(water, s)
    points = np.vstack([outer, wedge])
    n = len(points)
    lines = ["Point(%d) = {%.15g, %.15g, 0};" % (i + 1, *points[i]) for i in range(n)]
    lines += ["Line(%d) = {%d, %d};" % (i + 1, i + 1, (i + 1) % n + 1) for i in range(n)]
    lines += ["Curve Loop(1) = {1:%d}; Plane Surface(1) = {1};" % n, "Field[1] = Distance; Field[1].PointsList = {%d:%d};" % (n - 2, n),
              'Field[2] = MathEval; Field[2].F = "%g + 0.15*F1"; Background Field = 2;' % FINEST,
              "Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeMax = 0.1;"]
    with tempfile.TemporaryDirectory() as folder:
        open(folder + "/m.geo", "w").write("\n".join(lines))
        subprocess.run(["gmsh", "-2", "-format", "msh22", folder + "/m.geo", "-o", folder + "/m.msh"], check=True, stdout=subprocess.DEVNULL)
        words = [line.split() for line in open(folder + "/m.msh")]
    at = {word[0]: i for i, word in enumerate(words) if word[0].startswith("$")}
    nodes = np.array(words[at["$Nodes"] + 2:at["$EndNodes"]], float)[:, 1:3]
    elements = [list(map(int, word)) for word in words[at["$Elements"] + 2:at["$EndElements"]]]
    triangles = np.array([e[-3:] for e in elements if e[1] == 2]) - 1
    return nodes, triangles, np.array([e[-2:] for e in elements if e[1] == 1 and e[4] in (n - 2, n - 1)]) - 1


class Flow:
    """f with the wedge at s: x along the wedge, less s, f and grad f along its faces, from rear to front."""

    def __init__(self, water, s):
        x, triangles, edges = mesh(water, s)
        corner = x[triangles]
        opposite = corner[:, [2, 0, 1]] - corner[:, [1, 2, 0]]
        area = 0.5 * abs(opposite[:, 0, 0] * opposite[:, 1, 1] - opposite[:, 0, 1] * opposite[:, 1, 0])
        local = np.einsum("tic,tjc->tij", opposite, opposite) / (4.0 * area)[:, None, None]
        stiffness, load = np.zeros((len(x), len(x))), np.zeros(len(x))
        np.add.at(stiffness, (triangles[:, :, None], triangles[:, None, :]), local)
        edges = edges[np.argsort(x[edges].mean(1)[:, 0])]
        along = x[edges[:, 1]] - x[edges[:, 0]]
        self.length = np.hypot(*along.T)
        rear = x[edges].mean(1)[:, 0] < s + 0.66 / LENGTH
        self.normal = LENGTH * np.where(rear[:, None], [1.0, -1.0], [-1.0, -1.0])  # into the wedge
        np.add.at(load, edges, 0.5 * (self.length * self.normal[:, 0])[:, None])
        height = (x @ TURN.T)[:, 1] + 1.4
        fixed = height > float(water) - 1e-9 if water != "tank" else np.arange(len(x)) == 0
        stiffness[fixed] = np.eye(len(x))[fixed]
        f = np.linalg.solve(stiffness, np.where(fixed, 0.0, load))
        slope = (f[edges[:, 1]] - f[edges[:, 0]]) / self.length ** 2
        self.grad = slope[:, None] * along + self.normal[:, :1] * self.normal
        on = np.unique(edges)
        on = on[np.argsort(x[on, 0])]
        self.x, self.f, self.middle = x[on, 0] - s, f[on], x[edges].mean(1)[:, 0] - s


def coefficients(water, s, step=0.01):
    """(along, across) of u' and of u^2: the wedge's forces by p, N/m."""
    before, here, after = (Flow(water, s + d) for d in (-step, 0.0, step))
    force = []
    ends = [here.x[0], here.x[-1]]

    def at(x):
        a, b, c = (np.interp(x, flow.x, flow.f) for flow in (before, here, after))
        return -RHO * b, -RHO * (c - a) / (2.0 * step)

    faces = at(here.middle)
    square = faces[1] + RHO * (here.grad[:, 0] - 0.5 * (here.grad ** 2).sum(1))
    for p, end in ((faces[0], at(ends)[0]), (square, at(ends)[1] + 0.5 * RHO)):
        total = (p * here.length) @ here.normal
        force.append((total[0], total[1] + 0.5 * sum(end) * (ends[1] - ends[0])))
    return force


def contact(water, times, step=1e-4):
    """[speed, contact] at the times, m/s and N/m."""
    ways = np.linspace(0.0, 0.12, 4)
    (added, across), (drag, lift) = np.array([coefficients(water, s) for s in ways]).transpose(1, 2, 0)
    s, u, rows = 0.0, 0.0, []
    for k in range(1, int(round(max(times) / step)) + 1):
        m, d, a, l = (np.interp(s, ways, c) for c in (added, drag, across, lift))
        acceleration = (WEIGHT + d * u * u) / (MASS - m)
        u += step * acceleration
        s += step * u
        rows.append((u, WEIGHT - a * acceleration - l * u * u))
    return [rows[int(round(t / step)) - 1] for t in times]


if __name__ == "__main__":
    for time, (u, n) in zip(sys.argv[2:], contact(sys.argv[1], [float(t) for t in sys.argv[2:]])):
        print("%s s: %.4f m/s, contact %.0f N/m" % (time, u, n))
