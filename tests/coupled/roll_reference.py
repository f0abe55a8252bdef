"""Small motions of a rectangular body in a tank by linear potential theory, in time.

    The water 0 < y < D between walls 0 and L, less the body's part below the surface; velocity grad phi, div grad phi = 0, no flow through
    walls and floor.  Bilinear finite elements on a grid that has the body's edges among its lines.

        on the surface       d eta/dt = dphi/dy          dphi/dt = - g eta
        on the body          dphi/dn = velocity . n      M dV/dt = - K X - int rho dphi/dt n      n out of the water

    X: sway, heave, roll about the centre of mass; K: hydrostatic stiffness.  With phi = phi_s + phi_b, both harmonic, the first with its
    values on the free surface and none through the body, the second 0 on the surface: a system of ordinary differential equations for
    (phi on the surface, eta, X, V), which its exponential solves.
"""
import numpy as np


def lines(breaks, size):
    """Grid lines through all breaks, at most `size` apart."""
    parts = [np.linspace(a, b, int(np.ceil((b - a) / size)) + 1)[:-1] for a, b in zip(breaks, breaks[1:])]
    return np.concatenate([*parts, [breaks[-1]]])


class Tank:
    """Length and depth of the water, the body's centre, width, height and draught, m; density over the water's; g; size of the grid."""

    def __init__(self, length, depth, centre, width, height, draught, density, g, size):
        left, right, bottom = centre - 0.5 * width, centre + 0.5 * width, depth - draught
        x, y = lines([0.0, left, right, length], size), lines([0.0, bottom, depth], size)
        nx, ny = len(x), len(y)
        node = np.arange(nx * ny).reshape(nx, ny)
        middle_x, middle_y = 0.5 * (x[1:] + x[:-1]), 0.5 * (y[1:] + y[:-1])
        water = ~((middle_x[:, None] > left) & (middle_x[:, None] < right) & (middle_y[None, :] > bottom))
        stiffness = np.zeros((nx * ny, nx * ny))
        for i, j in zip(*np.nonzero(water)):
            a, b = x[i + 1] - x[i], y[j + 1] - y[j]
            k, m = np.array([[1, -1], [-1, 1]]), np.array([[2, 1], [1, 2]]) / 6.0
            n = [node[i, j], node[i, j + 1], node[i + 1, j], node[i + 1, j + 1]]
            stiffness[np.ix_(n, n)] += np.kron(k / a, b * m) + np.kron(a * m, k / b)
        surface = np.array([node[i, -1] for i in range(nx) if x[i] <= left + 1e-12 or x[i] >= right - 1e-12])
        mass = np.zeros((nx * ny, nx * ny))
        for i in range(nx - 1):
            if not (left < middle_x[i] < right):
                n = [node[i, -1], node[i + 1, -1]]
                mass[np.ix_(n, n)] += (x[i + 1] - x[i]) * np.array([[2, 1], [1, 2]]) / 6.0
        mass = mass[np.ix_(surface, surface)]
        # normals, out of the water: load[:, k] = int N n_k over the body's wetted faces
        load = np.zeros((nx * ny, 3))
        height_of_centre = bottom + 0.5 * height
        faces = [((i, np.searchsorted(y, bottom - 1e-12)), (i + 1, np.searchsorted(y, bottom - 1e-12)), (0.0, 1.0)) for i in range(nx - 1)
                 if left < middle_x[i] < right]
        for at, n in ((left, (1.0, 0.0)), (right, (-1.0, 0.0))):
            i = np.searchsorted(x, at - 1e-12)
            faces += [((i, j), (i, j + 1), n) for j in range(ny - 1) if middle_y[j] > bottom]
        for p, q, n in faces:
            ends = np.array([[x[p[0]], y[p[1]]], [x[q[0]], y[q[1]]]])
            h = np.linalg.norm(ends[1] - ends[0])
            arm = ends - [centre, height_of_centre]
            turn = arm[:, 0] * n[1] - arm[:, 1] * n[0]
            for r, v in enumerate((p, q)):
                load[node[v]] += [0.5 * h * n[0], 0.5 * h * n[1], h * (2.0 * turn[r] + turn[1 - r]) / 6.0]
        m_body = density * width * height * np.diag([1.0, 1.0, (width**2 + height**2) / 12.0])
        metacentre = width**2 / (12.0 * draught) - 0.5 * (height - draught)
        restore = g * width * np.diag([0.0, 1.0, draught * metacentre])
        self.motion = Motion(stiffness, surface, mass, load, m_body, restore, g)

    def roll(self, t):
        """The angle at the times t of a body let go at rest at the angle 1."""
        return self.motion.released(t, 2)


class Motion:
    """The system of a body's motions: the water's stiffness (0 at nodes that are not in it), its nodes on the surface and their mass, int N n over the body's
    wetted faces for each motion; mass and hydrostatic stiffness of the body over the water's density."""

    def __init__(self, stiffness, surface, mass, load, body, restore, g):
        inner = np.setdiff1d(np.nonzero(np.diag(stiffness))[0], surface)
        lower = stiffness[np.ix_(inner, inner)]
        solved = np.linalg.solve(lower, np.hstack([stiffness[np.ix_(inner, surface)], load[inner]]))
        spread, response = -solved[:, :len(surface)], solved[:, len(surface):]  # phi inside of phi on the surface, of V
        # flux through the surface: A phi_s + B V; int phi n over the body: C phi_s + E V
        a = stiffness[np.ix_(surface, surface)] + stiffness[np.ix_(surface, inner)] @ spread
        b = stiffness[np.ix_(surface, inner)] @ response - load[surface]
        c = load[surface].T + load[inner].T @ spread
        added = load[inner].T @ response
        ns = len(surface)
        # state: phi_s, eta, X, V.  (M + E) dV/dt = -K X + g C eta, for dphi_s/dt = -g eta
        k = len(body)
        system = np.zeros((2 * ns + 2 * k, 2 * ns + 2 * k))
        system[:ns, ns:2 * ns] = -g * np.eye(ns)
        system[ns:2 * ns, :ns] = np.linalg.solve(mass, a)
        system[ns:2 * ns, 2 * ns + k:] = np.linalg.solve(mass, b)
        system[2 * ns:2 * ns + k, 2 * ns + k:] = np.eye(k)
        total = np.linalg.inv(body + added)
        system[2 * ns + k:, 2 * ns:2 * ns + k] = -total @ restore
        system[2 * ns + k:, ns:2 * ns] = g * total @ c
        self.ns, self.system = ns, system

    def released(self, t, which):
        """A motion at the times t, from 0 on in equal steps, of a body let go at rest where it is 1 and the others are 0."""
        step = term = np.eye(len(self.system))
        for k in range(1, 20):  # the exponential; eigenvectors would not do, of the water's level and the potential two are one
            term = term @ self.system * (t[1] / k)
            step = step + term
        state, motion = np.zeros(len(self.system)), np.zeros(len(t))
        state[2 * self.ns + which] = 1.0
        for i in range(len(t)):
            motion[i] = state[2 * self.ns + which]
            state = step @ state
        return motion


def crossings(t, angle):
    """When the angle changes sign."""
    k = np.nonzero(angle[:-1] * angle[1:] < 0.0)[0]
    return t[k] + (t[k + 1] - t[k]) * angle[k] / (angle[k] - angle[k + 1])


if __name__ == "__main__":
    t = np.linspace(0.0, 2.0, 2001)
    for size in (0.02, 0.01, 0.0075):
        tank = Tank(0.6, 0.2, 0.3, 0.12, 0.06, 0.03, 0.5, 9.81, size)
        print(size, crossings(t, tank.roll(t))[:5])
