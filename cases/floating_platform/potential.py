"""Linear potential theory of a box that floats in waves, in two dimensions and finite depth, by matching eigenfunctions.

    phi e^{-i omega t}          region 1 | box | region 3        y = h: surface
                                         +-----+                 y = s: the box's bottom, s = h - d
                                  region 2, under it             y = 0: floor

    beside:  sum A_m e^{-k_m (x - b)} Z_m(y),   k_0 = -i k,   omega^2 = g k tanh k h;   Z_m orthonormal on 0 .. h
    under:   sum B_n f_n(x) Y_n(y),   f_n = cosh or sinh(n pi x/s) of value 1 at x = b;   Y_n orthonormal on 0 .. s
             and what a moving bottom makes, (y^2 - x^2)/2s of heave, (x y^2 - x^3/3)/2s of roll

Potential and flux are the same at x = b, in the mean of Y_n and Z_m; parts that are even and odd in x are solved on their own.
"""
import numpy as np

RHO, G = 1000.0, 9.81
TERMS, POINTS = 40, 400


def wave_numbers(omega, depth):
    """k_m, m = 0 .. TERMS - 1; the first is -i k, the others are between (m - 1/2) pi and m pi over the depth."""
    k = omega**2 / G
    for _ in range(1000):
        k = omega**2 / (G * np.tanh(k * depth))

    def residual(q):
        return omega**2 * np.cos(q * depth) + G * q * np.sin(q * depth)
    numbers = [-1j * k]
    for m in range(1, TERMS):
        low, high = (m - 0.5) * np.pi / depth, m * np.pi / depth
        for _ in range(100):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if residual(low) * residual(middle) <= 0.0 else (middle, high)
        numbers.append(0.5 * (low + high))
    return np.array(numbers)


def points(start, end):
    x, weight = np.polynomial.legendre.leggauss(POINTS)
    return start + 0.5 * (end - start) * (x + 1.0), 0.5 * (end - start) * weight


class Box:
    """Half its width b, draught d, depth h, the height of its centre of mass yc; forces are sway, heave, roll."""

    def __init__(self, b, d, h, yc, omega):
        self.b, self.s, self.yc, self.omega = b, h - d, yc, omega
        self.numbers = wave_numbers(omega, h)
        self.k = -self.numbers[0].imag
        self.size = np.sqrt(0.5 * (h + np.sin(2.0 * self.numbers * h) / (2.0 * self.numbers)))
        self.rates = np.arange(TERMS) * np.pi / self.s
        self.under, self.under_weight = points(0.0, self.s)
        self.side, self.side_weight = points(self.s, h)
        self.bottom, self.bottom_weight = points(0.0, b)
        self.match = (self.y_functions(self.under) * self.under_weight) @ self.z_functions(self.under).T
        self.slope = {"even": self.rates * np.tanh(self.rates * b),
                      "odd": np.append(1.0 / b, self.rates[1:] / np.tanh(self.rates[1:] * b))}
        self.incident = G / (1j * omega) / (np.cosh(self.k * h) / self.size[0])  # phi of a wave of amplitude 1 is that times e^{ikx} Z_0

    def z_functions(self, y):
        return np.cos(np.outer(self.numbers, y)) / self.size[:, None]

    def y_functions(self, y):
        size = np.sqrt(np.append(1.0, np.full(TERMS - 1, 2.0)) / self.s)
        return np.cos(np.outer(self.rates, y)) * size[:, None]

    def solve(self, parity, value, flux):
        """A, B of B = value + match A and -k_m A = match^T slope B + flux."""
        slope = self.slope[parity]
        a = np.linalg.solve(-np.diag(self.numbers) - self.match.T @ (slope[:, None] * self.match), flux + self.match.T @ (slope * value))
        return a, value + self.match @ a

    def integrals(self, parity, a, b, inside=None, outside=0.0):
        """Of phi times what presses the box, over its faces; inside: the moving bottom's part; outside: the incident wave's on the side."""
        x = self.bottom
        if parity == "even":
            shape = np.cosh(np.outer(self.rates, x)) / np.cosh(self.rates * self.b)[:, None]
        else:
            shape = np.vstack([x / self.b, np.sinh(np.outer(self.rates[1:], x)) / np.sinh(self.rates[1:] * self.b)[:, None]])
        below = (b * self.y_functions(np.array([self.s]))[:, 0]) @ shape + (inside(x, self.s) if inside else 0.0)
        beside = a @ self.z_functions(self.side) + outside
        if parity == "even":
            return np.array([0.0, 2.0 * self.bottom_weight @ below, 0.0])
        return np.array([-2.0 * self.side_weight @ beside, 0.0,
                         2.0 * (self.bottom_weight * x) @ below + 2.0 * (self.side_weight * (self.side - self.yc)) @ beside])

    def radiation(self):
        """[3][3]: forces for a velocity of 1 in sway, heave, roll (columns)."""
        b, s = self.b, self.s
        project_y, project_z = self.y_functions(self.under) * self.under_weight, self.z_functions(self.under) * self.under_weight
        project_side = self.z_functions(self.side) * self.side_weight

        def heave(x, y):
            return (y**2 - x**2) / (2.0 * s)

        def roll(x, y):
            return (x * y**2 - x**3 / 3.0) / (2.0 * s)
        columns = [self.integrals("odd", *self.solve("odd", np.zeros(TERMS), project_side.sum(axis=1))),
                   self.integrals("even", *self.solve("even", -project_y @ heave(b, self.under), project_z @ np.full(POINTS, -b / s)), heave),
                   self.integrals("odd", *self.solve("odd", -project_y @ roll(b, self.under),
                                                     project_z @ ((self.under**2 - b**2) / (2.0 * s)) - project_side @ (self.side - self.yc)), roll)]
        return 1j * self.omega * RHO * np.array(columns).T

    def excitation(self):
        """[3]: forces of a wave of amplitude 1, whose crest is at x = 0 at t = 0."""
        k, b, total = self.k, self.b, 0.0
        first = np.append(1.0, np.zeros(TERMS - 1))
        for parity, value, slope in (("even", np.cos(k * b), -k * np.sin(k * b)), ("odd", 1j * np.sin(k * b), 1j * k * np.cos(k * b))):
            solution = self.solve(parity, self.incident * value * self.match[:, 0], -self.incident * slope * first)
            total = total + self.integrals(parity, *solution, outside=self.incident * value * self.z_functions(self.side)[0])
        return 1j * self.omega * RHO * total


def motion(width, height, density, depth, omega, stiffness):
    """Sway, heave, roll [3] of a box of this density in waves of amplitude 1, held by a stiffness [3][3]; and k."""
    mass = density * width * height
    draught = mass / (RHO * width)
    metacentre = width**2 / (12.0 * draught) + 0.5 * draught - 0.5 * height
    box = Box(0.5 * width, draught, depth, depth - draught + 0.5 * height, omega)
    radiation = box.radiation()
    assert np.allclose(radiation, radiation.T, rtol=0.01, atol=1e-3 * abs(radiation).max()), "what is not reciprocal is not solved"
    restoring = np.diag([0.0, RHO * G * width, mass * G * metacentre]) + stiffness
    inertia = np.diag([mass, mass, mass * (width**2 + height**2) / 12.0])
    return np.linalg.solve(restoring - omega**2 * inertia + 1j * omega * radiation, box.excitation()), box.k
