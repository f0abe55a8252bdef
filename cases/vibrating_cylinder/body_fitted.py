#!/usr/bin/python3
"""The case's reference: the same cylinder on a grid that fits it, in the frame that moves with it and without side walls.

    body_fitted.py --name NAME [--mass m*] [--stiffness k] [--modes M] [--points N] [--radius R] [--step dt] [--end T]

Vorticity w and stream function psi on a < r < R, a = 1/2 (D = U = rho = 1), with Fourier modes in the angle and second-order differences in s = log r:

    r^2 w_t + psi_theta w_s - psi_s w_theta = (w_ss + w_theta,theta)/Re,     psi_ss + psi_theta,theta = -r^2 w
    psi = psi_s = 0 at r = a;     psi = r sin theta + v r cos theta + what decays beyond R;     w is absorbed in the outer half of the grid

with backward differences of second order in time, the convection extrapolated.  The wall's vorticity of each mode is what makes psi_s = 0 there (of
mode 0: the pressure has one value).  The cylinder's velocity v acts on mode 1 alone, linearly, so that the step of both is solved at once:

    (m - pi a^2) dv/dt + k y = F,     F = (1/Re) a int (w - w_s) cos theta dtheta;     the force on the cylinder is F + pi a^2 dv/dt

Prints a row of reference/body_fitted.csv, over the whole periods of the last quarter.  Needs numpy and scipy.
"""
import argparse

import numpy as np
import scipy.fft
from scipy.linalg.lapack import dgttrf, dgttrs

A, RE = 0.5, 100.0
SLOPE = np.array([-11.0, 18.0, -9.0, 2.0]) / 6.0  # of the first four points, at the first, times the spacing


class Lines:
    """Tridiagonal equations along s, one for each mode, as one."""

    def __init__(self, low, middle, high):
        self.shape = middle.shape
        low, high = low.copy(), high.copy()
        low[:, 0] = high[:, -1] = 0.0
        self.factors = dgttrf(low.ravel()[1:], middle.ravel(), high.ravel()[:-1])[:-1]

    def solve(self, right):
        x = dgttrs(*self.factors, np.ascontiguousarray(right).ravel().view(float).reshape(-1, 2))[0]
        return np.ascontiguousarray(x).view(complex).reshape(self.shape)


class Wake:
    def __init__(self, modes, points, radius, dt):
        self.dt, self.n = dt, np.arange(modes)[:, None] * 1.0
        self.s = np.linspace(np.log(A), np.log(radius), points)
        self.h, self.r = self.s[1] - self.s[0], np.exp(self.s)
        self.raster = 3 * modes  # angles of products, so that they are free of aliases
        outer = np.clip((self.s - np.log(0.5 * radius)) / np.log(2.0), 0.0, 1.0)
        self.fast = self.n > 40.0 * np.maximum(1.0, self.r / 1.2)  # modes finer than those of the grid far out are not convected near the wall
        self.absorption = 2.0 * outer**2
        ones, zeros = np.ones((modes, points)), np.zeros((modes, points))
        # psi of modes 1 .. : 0 at the wall, what is beyond the free stream ~ r^-n at R; mode 0 is summed up from the wall
        middle, low, high = -2.0 * ones - (self.n * self.h)**2, ones.copy(), ones.copy()
        middle[:, 0], high[:, 0] = 1.0, 0.0
        low[:, -1], middle[:, -1] = 2.0, -2.0 - (self.n[:, 0] * self.h)**2 - 2.0 * self.h * self.n[:, 0]
        middle[0] = 1.0
        low[0], high[0] = 0.0, 0.0
        self.poisson = Lines(low, middle, high)
        # w: given at the wall (mode 0: no slope there), 0 at R
        k = 1.0 / (RE * self.h**2)
        middle = self.r**2 * (1.5 / dt + self.absorption) + 2.0 * k + (self.n**2) / RE
        low, high = zeros - k, zeros - k
        middle[:, 0], high[:, 0], middle[:, -1], low[:, -1] = 1.0, 0.0, 1.0, 0.0
        middle[0, 0], high[0, 0] = 1.0, -1.0  # with a right side that makes it of second order
        self.helmholtz = Lines(low, middle, high)
        wall = zeros.astype(complex)
        wall[1:, 0] = 1.0
        self.w_wall = self.helmholtz.solve(wall)
        self.slip_wall = self.slip(self.psi(self.w_wall, 0.0, 0.0))
        # the stream of v = 1 alone, with the wall's vorticity that it needs
        psi = self.psi(zeros.astype(complex), 0.0, 1.0)
        self.w_unit = -self.slip(psi)[1] / self.slip_wall[1] * self.w_wall[1]
        self.force_unit = self.force(self.w_unit)
        self.w = [zeros.astype(complex), zeros.astype(complex)]
        self.convection = [zeros.astype(complex), zeros.astype(complex)]

    def psi(self, w, u, v):
        right = -self.h**2 * self.r**2 * w
        right[:, 0] = 0.0
        # mode 1 coefficients c with values Re sum c exp(i n theta): sin -> -i, cos -> 1
        right[1, -1] += -4.0 * self.h * self.r[-1] * (v - 1j * u)
        psi = self.poisson.solve(right)
        f = -(self.r**2 * w[0].real)  # psi_ss of mode 0
        slope = np.concatenate([[0.0], np.cumsum(0.5 * (f[1:] + f[:-1]))]) * self.h
        psi[0] = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]))]) * self.h
        return psi

    def slip(self, psi):
        """psi_s at the wall."""
        return psi[:, :4] @ SLOPE / self.h

    def force(self, w1):
        """F of mode 1 of w."""
        return A * np.pi / RE * (w1[0] - w1[:4] @ SLOPE / self.h).real

    def drag(self, w1):
        """The same with -sin theta in place of cos theta."""
        return A * np.pi / RE * (w1[0] - w1[:4] @ SLOPE / self.h).imag

    def in_s(self, q):
        slope = np.zeros_like(q)
        slope[:, 1:-1] = (q[:, 2:] - q[:, :-2]) * (0.5 / self.h)
        return slope

    def convect(self, w, psi):
        """Modes of psi_theta w_s - psi_s w_theta, products on the raster; nothing at the wall, where psi does not vary, and at R, where w is 0."""
        c = np.zeros((4, self.raster // 2 + 1, w.shape[1]), complex)
        for k, q in enumerate((1j * self.n * psi, self.in_s(w), self.in_s(psi), 1j * self.n * w)):
            c[k, :len(q)] = (0.5 * self.raster) * q
            c[k, 0] *= 2.0
        a, b, d, e = scipy.fft.irfft(c, self.raster, axis=1)
        product = scipy.fft.rfft(a * b - d * e, axis=0)[:len(self.n)] * (2.0 / self.raster)
        product[0] *= 0.5
        product[self.fast] = 0.0
        return product

    def step(self, cylinder):
        w, before = self.w
        right = self.r**2 * (2.0 * w - 0.5 * before) / self.dt - 2.0 * self.convection[0] + self.convection[1]
        right[:, 0] = right[:, -1] = 0.0
        right[0, 0] = -(w[0, 2] - w[0, 1]) / 3.0  # w_1 - w_0 = (w_2 - w_1)/3: no slope at the wall, of second order
        new = self.helmholtz.solve(right)
        fixed = self.slip(self.psi(new, 1.0, 0.0))
        new[1:] -= (fixed[1:] / self.slip_wall[1:])[:, None] * self.w_wall[1:]
        v = cylinder.step(self.dt, self.force(new[1]), self.force_unit)
        new[1] += v * self.w_unit
        self.w = [new, w]
        self.convection = [self.convect(new, self.psi(new, 1.0, v)), self.convection[0]]
        return self.drag(new[1]), cylinder.force


class Cylinder:
    """y with two steps before; mass None: it is held."""

    def __init__(self, mass, stiffness, kick):
        self.mass, self.k, self.v, self.y, self.kick, self.t = mass, stiffness, [0.0, 0.0], [0.0, 0.0], kick, 0.0

    def step(self, dt, force, unit):
        self.t += dt
        displaced = np.pi * A**2
        begin = (4.0 * self.y[0] - self.y[1]) / 3.0  # y = begin + 2/3 dt v
        was = (4.0 * self.v[0] - self.v[1]) / (2.0 * dt)  # dv/dt = 1.5 v/dt - was
        if self.mass is None or self.t < 3.0:  # held, but for a push aside that the wake needs to begin with
            v = self.kick * np.sin(np.pi * self.t / 3.0)**2 * np.cos(np.pi * self.t / 3.0) if self.t < 3.0 else 0.0
        else:
            m = self.mass - displaced
            v = (force - self.k * begin + m * was) / (1.5 * m / dt - unit + 2.0 / 3.0 * dt * self.k)
        self.force = force + unit * v + displaced * (1.5 * v / dt - was)
        self.y, self.v = [begin + 2.0 / 3.0 * dt * v, self.y[0]], [v, self.v[0]]
        return v


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--name", required=True, help="of the cylinder, the row's first cell")
    parser.add_argument("--mass", type=float, help="over that of the displaced fluid; without it the cylinder is held")
    parser.add_argument("--stiffness", type=float, default=0.0)
    parser.add_argument("--modes", type=int, default=128)
    parser.add_argument("--points", type=int, default=161)
    parser.add_argument("--radius", type=float, default=60.0)
    parser.add_argument("--step", type=float, default=0.01)
    parser.add_argument("--end", type=float, default=150.0)
    o = parser.parse_args()
    wake = Wake(o.modes, o.points, o.radius, o.step)
    cylinder = Cylinder(None if o.mass is None else o.mass * np.pi * A**2, o.stiffness, 0.5)
    rows = []
    for k in range(round(o.end / o.step)):
        drag, lift = wake.step(cylinder)
        rows.append(((k + 1) * o.step, 2.0 * drag, 2.0 * lift, cylinder.y[0]))
    t, cd, cl, y = np.array(rows).T
    swing = cl if o.mass is None else y
    late = t > 0.75 * o.end
    ups = np.nonzero((swing[:-1] < 0) & (swing[1:] >= 0) & late[1:])[0]
    at = t[ups] - swing[ups] * o.step / (swing[ups + 1] - swing[ups])
    inside = slice(ups[0] + 1, ups[-1] + 1)
    half = lambda q: 0.5 * np.ptp(q[inside])
    frequency = (len(at) - 1) / (at[-1] - at[0])
    print("%s,%d,%.4f,%.5f,%.4f,%.4f" % (o.name, o.points, half(y), frequency, cd[inside].mean(), half(cl)))


if __name__ == "__main__":
    main()
