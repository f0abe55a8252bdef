#!/usr/bin/python3
"""A complete fluid in Python, in place of coracle-fluid: dust, a medium without pressure and viscosity that the solid takes along.
What a flow solver does more goes where u_star and u_projected are computed.

       2---1 2       the mesh is that of fluid.mesh: rectangles cut into two triangles, dealt to the ranks by rows; velocity is
       |  / /|       linear on each triangle and discontinuous between them, u[element][component][vertex]
       | / / |
       |/ /  |
       0 0---1
"""
import numpy as np

import coracle

MASS = (np.ones((3, 3)) + np.eye(3)) / 12  # int N_i N_j over the triangle's area


class Dust:
    def __init__(self, case, rank, size):
        self.lower, self.upper = case.vector("fluid.mesh.lower"), case.vector("fluid.mesh.upper")
        self.rho, self.mu = case.positive("fluid.density"), case.positive("fluid.viscosity")
        nx, ny = np.ceil((self.upper - self.lower) / case.positive("fluid.mesh.size_max") - 1e-9).astype(int)
        x, y = np.linspace(self.lower[0], self.upper[0], nx + 1), np.linspace(self.lower[1], self.upper[1], ny + 1)
        corners = [[(x[i], y[j]), (x[i + 1], y[j + 1]), (x[i], y[j + 1])] if upper else [(x[i], y[j]), (x[i + 1], y[j]), (x[i + 1], y[j + 1])]
                   for j in range(ny * rank // size, ny * (rank + 1) // size) for i in range(nx) for upper in (True, False)]
        self.x = np.array(corners).reshape(-1, 3, 2)
        self.area = 0.5 * np.prod((self.upper - self.lower) / (nx, ny))
        self.u = np.zeros((len(self.x), 2, 3))  # what a step changes; the library restores it when a step is redone
        self.near = np.zeros(0, int)  # the elements that the coupler knows, by its numbers

    def region(self, boxes):
        lower, upper = self.x.min(axis=1), self.x.max(axis=1)
        overlap = [np.all((lower <= box[1]) & (upper >= box[0]), axis=1) for box in boxes]
        self.near = np.flatnonzero(np.any(overlap, axis=0))
        n = len(self.near)
        return self.x[self.near], np.full(n, self.rho), np.full(n, self.mu)

    def begin(self, coupling):
        """In a run's first step the dust inside the solid moves with it."""
        e = self.near[coupling["element"]]
        self.u[e] += coupling["alpha"][:, None, None] * (coupling["velocity"][:, :, None] - self.u[e])

    def solve(self, dt, coupling):
        """rho M/dt (u* - u) + inertia (tensor u* - kept u) + a u* = s on the coupled elements, 0 for u where they are covered; elsewhere nothing acts."""
        u_star, n = self.u[self.near], len(coupling)
        u, mass, inertia = u_star[coupling["element"]], self.rho / dt * self.area * MASS, coupling["implicit_inertia"]
        load = coupling["s"] + coupling["kept"] @ u @ inertia
        free = (coupling["flags"] & coracle.IS_COVERED) == 0
        load[free] += u[free] @ mass
        matrix = np.kron(np.eye(2), mass) + coupling["a"].reshape(n, 6, 6)
        matrix += np.einsum("ncd,nij->ncidj", coupling["inertia_tensor"], inertia).reshape(n, 6, 6)
        u_star[coupling["element"]] = np.linalg.solve(matrix, load.reshape(n, 6, 1)).reshape(n, 2, 3)
        return u_star

    def correct(self, near, correction):
        """u += M^-1 r inside the solid; the elements are those that the step began with."""
        self.u[near[correction["element"]]] += correction["r"] @ np.linalg.inv(self.area * MASS)


def main():
    client = coracle.Client("fluid")
    case = client.case()
    dust, dt_max = Dust(case, client.comm.rank, client.comm.size), case.positive("time.dt_max")
    case.finish()
    client.set_region(dust.lower, dust.upper, dust.region)
    client.bind_state(dust.u)
    client.propose_step(dt_max)
    client.ready()
    for step in client.steps():
        near, n = dust.near, len(dust.near)
        coupling = client.get_coupling()
        if step.t == 0:
            dust.begin(coupling)
        u_star = dust.solve(step.dt, coupling)
        u_projected = u_star  # a projection has the bulk velocity u* + M^-1 (us - ms u*) and W = rho M/dt + implicit_inertia inertia_tensor
        p = np.zeros((n, 6)) if client.needs_pressure() else None
        client.set_flow(dust.u[near], u_star, u_projected, np.full(n, dust.rho), np.full(n, dust.mu), p)
        client.propose_step(dt_max)
        client.end()
        if client.step_accepted():
            dust.u[near] = u_projected
            dust.correct(near, client.get_correction())
    client.close()


main()
