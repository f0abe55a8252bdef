"""A half-immersed circular cylinder that is let go a little above where it floats, by linear potential theory: in a tank, by finite elements as in
roll_reference.py, and, to verify that, in deep water without end (Maskell and Ursell, 1970):

    e^(-i w t), K = w^2/g, y downwards from the surface, x = r sin a, y = r cos a; units of the radius, the water's density and g.
    phi = c_0 G + sum c_m (cos 2m a/r^2m + K/(2m - 1) cos (2m - 1)a/r^(2m - 1)),     dphi/dr = cos a on r = 1     (Ursell, 1949)

G: source on the surface with waves that go out.  From phi the added mass a and the damping b; with the mass m = pi/2 and the stiffness 2

    z(t)/z(0) = 2/pi int b s/|s - w^2 (m + a) - i w b|^2 cos w t dw,     s = 2

whose value at t = 0 must be 1, as b must be w pi^2 |c_0|^2, the energy of the waves.
"""
import numpy as np
from roll_reference import Motion, crossings

MASS, STIFFNESS = 0.5 * np.pi, 2.0


def exponential_integral(z, terms=160):
    """E1, by its series, for |z| up to 25."""
    total, power = -np.euler_gamma - np.log(z), np.ones_like(z)
    for n in range(1, terms):
        power = power * -z / n
        total = total - power / n
    return total


def heave(w, multipoles=12, points=96):
    """Added mass, damping, and damping from the waves' energy, at the frequency w."""
    angle = (np.arange(points) + 0.5) * 0.5 * np.pi / points
    k, z = w * w, np.exp(1j * angle)
    h = np.exp(-k * z) * (exponential_integral(-k * z) - 1j * np.pi)
    wave = np.pi * np.exp(-k * z)
    potential, slope = [h.real + 1j * wave.real], [((-k * h - 1.0 / z) * z).real + 1j * (-k * wave * z).real]
    for m in range(1, multipoles + 1):
        potential.append(np.cos(2 * m * angle) + k / (2 * m - 1) * np.cos((2 * m - 1) * angle))
        slope.append(-2 * m * np.cos(2 * m * angle) - k * np.cos((2 * m - 1) * angle))
    strength = np.linalg.lstsq(np.array(slope).T, np.cos(angle).astype(complex), rcond=None)[0]
    force = 2.0 * 0.5 * np.pi / points * np.cos(angle) @ (np.array(potential).T @ strength)
    return -force.real, -w * force.imag, w * np.pi ** 2 * abs(strength[0]) ** 2


def decay(t, n=450, most=4.5):
    """z(t)/z(0) at the times t[], in units of sqrt(radius/g)."""
    w = (np.arange(n) + 0.5) * most / n
    a, b, _ = np.array([heave(x) for x in w]).T
    spectrum = b * STIFFNESS / abs(STIFFNESS - w * w * (MASS + a) - 1j * w * b) ** 2
    return 2.0 / np.pi * most / n * np.cos(np.outer(t, w)) @ spectrum


def tank(t, half_length, depth, size):
    """The same in the middle of a tank: half of it, rays from the circle to floor and wall, elements of `size` at the circle and of eight times that far off."""
    n = int(np.ceil(0.25 * np.pi / size))
    part = np.arange(n + 1) / n
    wall = np.array([[half_length + 0.0 * part, -depth * part ** 1.5], [half_length * (1.0 - part), -depth + 0.0 * part]])
    outer = np.hstack([wall[0], wall[1][:, 1:]]).T
    angle = np.arange(2 * n + 1) * 0.25 * np.pi / n
    circle = np.array([np.cos(angle), -np.sin(angle)]).T
    steps = [size]
    while sum(steps) < half_length - 1.0:
        steps.append(min(1.1 * steps[-1], 8.0 * size))
    along = np.concatenate([[0.0], np.cumsum(steps)]) / sum(steps)
    points = (circle[None] + along[:, None, None] * (outer - circle)[None]).reshape(-1, 2)
    node = np.arange(len(points)).reshape(len(along), -1)
    corners = np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], -1).reshape(-1, 4)
    local = np.zeros((len(corners), 4, 4))
    for p in (-3.0 ** -0.5, 3.0 ** -0.5):
        for q in (-3.0 ** -0.5, 3.0 ** -0.5):
            slope = 0.25 * np.array([[q - 1.0, 1.0 - q, 1.0 + q, -1.0 - q], [p - 1.0, -1.0 - p, 1.0 + p, 1.0 - p]])
            jacobian = slope @ points[corners]
            slope = np.linalg.solve(jacobian, np.broadcast_to(slope, (len(corners), 2, 4)))
            local += abs(np.linalg.det(jacobian))[:, None, None] * (slope.transpose(0, 2, 1) @ slope)
    stiffness = np.zeros((len(points), len(points)))
    np.add.at(stiffness, (corners[:, :, None], corners[:, None, :]), local)
    surface, h = node[:, 0], np.diff(points[node[:, 0], 0])
    mass = np.diag(np.append(h, 0.0) + np.append(0.0, h)) / 3.0 + (np.diag(h, 1) + np.diag(h, -1)) / 6.0
    load = np.zeros((len(points), 1))
    load[node[0, :-1], 0] += 0.5 * -np.diff(circle[:, 0])  # n_y ds = - dx, n out of the water
    load[node[0, 1:], 0] += 0.5 * -np.diff(circle[:, 0])
    return Motion(stiffness, surface, mass, load, np.array([[0.5 * MASS]]), np.array([[0.5 * STIFFNESS]]), 1.0).released(t, 0)


def marks(t, z):
    """When z first is 0 and is 0 again; its first minimum and the maximum after it."""
    zero = crossings(t, z)[:2]
    return zero[0], zero[1], z.min(), z[t > zero[1]].max()


if __name__ == "__main__":
    for w in (0.1, 0.5, 0.8, 1.0, 1.2, 2.0, 3.0, 4.4):
        a, b, energy = heave(w)
        print("K %.3f  added mass/displaced %.4f  b %.5f  by the waves' energy %.5f, amplitude of the waves %.4f" % (
            w * w, a / MASS, b, energy, w * w * np.sqrt(energy / w)))
    t = np.linspace(0.0, 10.0, 1001)
    z = decay(t)
    print("z(0) %.5f; 0 at %.4f and %.4f, minimum %.4f, maximum %.4f" % (z[0], *marks(t, z)))
    for half, depth in ((80.0, 40.0), (20.0, 10.0), (15.0, 10.0), (10.0, 5.0)):
        for size in (0.1, 0.07, 0.05):
            print("%g %g %g: 0 at %.4f and %.4f, minimum %.4f, maximum %.4f" % (half, depth, size, *marks(t, tank(t, half, depth, size))))
