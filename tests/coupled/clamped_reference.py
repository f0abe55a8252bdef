"""A thin plate, clamped at the floor, with water on one side of it: bending waves of a beam and linear potential theory.

The plate bends as w = sum q_i m_i(y), m_i the modes of a dry cantilever; D = E b^3/(12 (1 - nu^2)).  The water, of depth h in a tank of the length T, moves at
frequencies far above those of its surface, so that the pressure there is 0 (Westergaard, 1933):

    phi = sum a_n cos k_n y cosh k_n (x + T),  k_n = (n + 1/2) pi/h,     dphi/dx = dw/dt at x = 0, 0 at x = - T
    added mass_ij = rho 2/h sum_n (int m_i cos k_n y dy) (int m_j cos k_n y dy)/(k_n tanh k_n T)
"""
import numpy as np


def cantilever(number):
    """The first roots of cos x cosh x = - 1, by bisection."""
    low = (np.arange(number) + 0.5) * np.pi - 1.0
    high = low + 2.0
    value = lambda x: np.cos(x) * np.cosh(x) + 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        same = np.sign(value(middle)) == np.sign(value(low))
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return 0.5 * (low + high)


def plate(length, thickness, density, youngs, poisson, water, depth, tank, gravity, modes=6, waves=150):
    """Frequency (Hz) of the first mode, dry and with the water, and the deflection of the tip under the water's weight."""
    roots = cantilever(modes)
    ratio = (np.cosh(roots) + np.cos(roots)) / (np.sinh(roots) + np.sin(roots))

    def shape(y):
        x = np.outer(roots / length, y)
        return np.cosh(x) - np.cos(x) - ratio[:, None] * (np.sinh(x) - np.sin(x))

    point, weight = np.polynomial.legendre.leggauss(400)
    whole, wet = 0.5 * length * (point + 1.0), 0.5 * depth * (point + 1.0)
    mass = density * thickness * (shape(whole) * 0.5 * length * weight) @ shape(whole).T
    bending = youngs * thickness ** 3 / (12.0 * (1.0 - poisson ** 2))
    stiffness = np.diag(bending * (roots / length) ** 4 * np.diag(mass) / (density * thickness))
    wave = (np.arange(waves) + 0.5) * np.pi / depth
    part = (shape(wet) * 0.5 * depth * weight) @ np.cos(np.outer(wet, wave))
    added = water * 2.0 / depth * (part / (wave * np.tanh(wave * tank))) @ part.T
    load = (shape(wet) * 0.5 * depth * weight) @ (water * gravity * (depth - wet))
    first = lambda m: np.sqrt(min(np.linalg.eigvals(np.linalg.solve(m, stiffness)).real)) / (2.0 * np.pi)
    return first(mass), first(mass + added), shape(np.array([length]))[:, 0] @ np.linalg.solve(stiffness, load)


if __name__ == "__main__":
    print("dry %.4f Hz, with water %.4f Hz, tip %.4e m" % plate(0.2, 0.01, 1100.0, 3.3e8, 0.3, 1000.0, 0.15, 0.45, 9.81))
