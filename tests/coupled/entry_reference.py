"""A wedge that enters calm water with constant velocity, without gravity and viscosity: the self-similar potential flow.

With lengths in V t and velocities in V, W = u - i v as a function of z: sqrt(dW/dz) dz has constant direction along the wedge and the axis below it, and
45 degrees to that along the surface, where the acceleration is normal to it (Wagner, Dobrovol'skaya).  On the lower half plane with the axis at q < 0,
the wedge at 0 < q < 1 and the surface at q > 1, of direction T(q) from T = contact angle - pi + deadrise at the jet's tip to 0 far off,

    dz/dq = K e^(i deadrise) q^(deadrise/pi - 1/2) (1 - q)^(contact/pi - 1) exp(1/pi int ln(1 - q/t) dT(t)),     dW/dq dz/dq = C/(q (1 - q)^(3/2))

and the velocity relative to z is along the surface, as large as the way to the tip: dT/dq = |dW/dq|/(way from the tip).  W = i at the apex and 0 far
below, and the tip moves with the water there: these are C and K.
"""
import sys
import numpy as np


def running(y, x):
    return np.concatenate([[0.0], np.cumsum(0.5 * (y[1:] + y[:-1]) * np.diff(x))])


class Entry:
    """Of a wedge of this deadrise angle (rad), T in steps of `step` in ln(q - 1): s, pressure: along its face from the apex, in V t and rho V^2; force:
    vertical, of the whole wedge, over rho V^3 t; peak, height: the largest pressure over rho V^2/2, and where it is above the water at rest over V t;
    contact: angle of the jet's tip; tip: its way from the apex.  Checks: far: height of the surface far off, 0; apex: pressure[0], but along the axis."""

    def __init__(self, deadrise, step=0.2):
        self.deadrise, self.step = deadrise, step
        self.edge = np.arange(-14.0, 50.0, step)  # x of q = 1 + exp(-x), from far off to the tip; T jumps at the edges
        x = 0.5 * (self.edge[1:] + self.edge[:-1])
        self.face = np.arange(-50.0, 50.0, 0.25 * step)  # q = 1/(1 + exp(-x))
        self.axis = np.arange(-50.0, 30.0, 0.5 * step)  # q = - exp(x)
        a = np.exp(-self.edge)
        self.q = 1.0 + np.exp(-x), 1.0 / (1.0 + np.exp(-self.face)), -np.exp(self.axis)
        self.gap = np.exp(-x), 1.0 / (1.0 + np.exp(self.face)), 1.0 + np.exp(self.axis)  # |1 - q|, without cancellation
        self.dq = np.exp(-x), self.q[1] * self.gap[1], np.exp(self.axis)  # |dq/dx|
        self.log = [np.log(abs(a - sign * g[:, None])) - np.log1p(a) for g, sign in zip(self.gap, (1.0, -1.0, -1.0))]
        for m in range(len(x)):
            self.log[0][m, m:m + 2] -= 0.5 * np.log(2.0)  # of the logarithm's integral less the sum over jumps half a step to both sides
        jump = np.exp(-0.1 * (self.edge - 4.0) ** 2)
        jump *= (np.pi - deadrise - 0.2) / jump.sum()
        def lacks(jump):
            return self.turns(jump) - jump
        for _ in range(60):  # Newton's method
            change = lacks(jump)
            if abs(change).sum() < 1e-9: break
            slope = np.array([(lacks(jump + 1e-7 * e) - change) / 1e-7 for e in np.eye(len(jump))]).T
            move, part = np.linalg.solve(slope, -change), 1.0
            while jump.sum() + part * move.sum() > np.pi - deadrise - 1e-3 or abs(lacks(jump + part * move)).sum() > abs(change).sum():
                part *= 0.5
                assert part > 1e-6, "no solution for %g rad" % deadrise
            jump = jump + part * move
        self.results(jump)

    def turns(self, jump):
        """The jumps of T that the velocities along the surface of these ones are."""
        self.contact = contact = np.pi - self.deadrise - jump.sum()
        power, z, w = self.deadrise / np.pi, [], []
        for q, gap, log, dq in zip(self.q, self.gap, self.log, self.dq):
            slope = abs(q) ** (power - 0.5) * gap ** (contact / np.pi - 1.0) * np.exp(log @ jump / np.pi)
            z.append(slope * dq)
            w.append(dq / (abs(q) * gap ** 1.5 * slope))
        way = running(z[1], self.face) + z[1][0] / (0.5 + power)
        speed = running(w[1], self.face) + w[1][0] / (0.5 - power)
        self.length = way[-1] + z[1][-1] * np.pi / contact
        c = self.length / (speed[-1] + w[1][-1] / (0.5 - contact / np.pi))
        self.tail = z[0][-1] * np.exp(-0.5 * self.step * contact / np.pi) * np.pi / contact  # of the surface's length, from the last edge to the tip
        along = z[0][::-1].cumsum()[::-1] * self.step - 0.5 * self.step * z[0] + self.tail
        self.z, self.w, self.c, self.way, self.speed = z, w, c, way, speed
        turn = np.concatenate([[0.0], c * w[0] / along * self.step, [0.0]])
        return 0.5 * (turn[1:] + turn[:-1])

    def results(self, jump):
        z, w, c, way, speed = self.z, self.w, self.c, self.way, self.speed
        speed_below = running(w[2], self.axis) + w[2][0] / (0.5 - self.deadrise / np.pi)
        k = 1.0 / (c * speed_below[-1])
        self.apex = 0.5 + running((1.0 - k * c * speed_below) * k * z[2], self.axis)[-1]  # Bernoulli's equation from far below
        self.s, self.tip = k * way, k * self.length
        relative = k * (c * speed - way)  # of the water on the face
        p = self.pressure = running((k * c * w[1] * relative)[::-1], self.face)[::-1]  # dp/ds = - dspeed/ds relative
        self.force = 2.0 * np.cos(self.deadrise) * (running(p * k * z[1], self.face)[-1] + p[0] * self.s[0])
        i = p.argmax()
        self.peak, self.height = 2.0 * p[i], self.s[i] * np.sin(self.deadrise) - 1.0
        down = np.sin(np.cumsum(jump)[:-1])
        self.far = self.tip * np.sin(self.deadrise) - 1.0 - k * ((down * z[0]).sum() * self.step + down[-1] * self.tail)


if __name__ == "__main__":
    for degrees in map(float, sys.argv[1:] or ("20", "30", "40", "45", "60")):
        for step in (0.4, 0.2):
            e = Entry(np.radians(degrees), step)
            print("%g: Cp_max %.3f at z %.4f, F %.3f (Wagner %.3f), contact angle %.2f, tip at %.4f; surface far off %.4f, pressure at the apex %.4f, %.4f" % (
                degrees, e.peak, e.height, e.force, np.pi ** 3 / (4.0 * np.tan(np.radians(degrees)) ** 2), np.degrees(e.contact), e.tip, e.far, e.pressure[0], e.apex))
