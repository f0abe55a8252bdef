#!/usr/bin/python3
"""A complete solid in Python: a rigid disc that falls, drifts and rolls, in place of coracle-solid in any case whose first body is a disc.

      2 ___ 1      nodes 0 .. n-1 on the circle, node n in the centre; facets i -> i + 1 run counter-clockwise, so that the
       /\\ /\\       disc lies on their left; triangles (n, i, i + 1) are the slices of the pie; rank 0 holds it all, other
    3 |--n--| 0    ranks are empty.
"""
import numpy as np

import coracle


class Disc:
    def __init__(self, case, empty):
        radius = case.positive("solid.bodies[0].radius")
        n = int(np.ceil(2 * np.pi * radius / case.positive("solid.bodies[0].size")))
        density = case.positive("solid.materials.%s.density" % case.string("solid.bodies[0].material"))
        # per metre of depth; mass and inertia are the polygon's, which is what displaces fluid
        self.mass = density * 0.5 * n * radius**2 * np.sin(2 * np.pi / n)
        self.moment_of_inertia = self.mass * radius**2 * (2 + np.cos(2 * np.pi / n)) / 6
        self.gravity = case.vector("gravity")
        # what a step changes; the library restores it when a step is redone: x, y, angle; their velocities
        self.state = np.concatenate([case.vector("solid.bodies[0].centre"), [0],
                                     case.vector("solid.bodies[0].velocity", default=[0, 0]), [0]])
        nodes = 0 if empty else n + 1
        self.facets = np.array([(i, (i + 1) % n) for i in range(0 if empty else n)], np.intc).reshape(-1, 2)
        self.slices = np.array([(n, i, (i + 1) % n) for i in range(0 if empty else n)], np.intc).reshape(-1, 3)
        self.reference = np.zeros((nodes, 2))
        self.mobility = np.full(nodes, 3 / self.mass)  # one over a node's mass, a third of its slices
        if nodes:
            phi = 2 * np.pi * np.arange(n) / n
            self.reference[:n] = radius * np.column_stack([np.cos(phi), np.sin(phi)])
            self.mobility[:n] *= n / 2
        self.own = np.tile(self.gravity, (nodes, 1))  # accelerations by all but the fluid

    def nodes(self):
        cos, sin = np.cos(self.state[2]), np.sin(self.state[2])
        return self.reference @ np.array([[cos, sin], [-sin, cos]]) + self.state[:2]

    def velocities(self, x):
        arm = x - self.state[:2]
        return self.state[3:5] + self.state[5] * np.column_stack([-arm[:, 1], arm[:, 0]])

    def advance(self, dt, x, force):
        """Newton and Euler over one step: m dv/dt = F + m g, I dw/dt = M."""
        arm = x - self.state[:2]
        moment = np.sum(arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0])
        self.state[3:5] += dt * (force.sum(axis=0) / self.mass + self.gravity)
        self.state[5] += dt * moment / self.moment_of_inertia
        self.state[:3] += dt * self.state[3:]


def main():
    client = coracle.Client("solid")
    case = client.case()
    disc = Disc(case, empty=client.comm.rank > 0)
    case.finish()
    client.bind_state(disc.state, disc.own)  # first: in a run that resumes the disc now is where it was
    x = disc.nodes()
    client.set_nodes(np.arange(len(x), dtype=np.longlong), x, disc.velocities(x))
    client.set_surface(disc.facets)
    client.set_volume(disc.slices)
    client.set_inertia(disc.mobility, disc.own)
    client.ready()
    for step in client.steps():
        force = client.get_force()
        before = disc.nodes()
        u = disc.velocities(before)
        disc.advance(step.dt, before, force)
        after = disc.nodes()
        w = disc.velocities(after)
        # the rest of the body moves a node beside the fluid: its acceleration less the fluid's force over its mass
        disc.own[:] = (w - u) / step.dt - disc.mobility[:, None] * force
        client.substep(step.dt, (after - before) / step.dt)
        client.set_velocity(w)
        client.set_inertia(disc.mobility, disc.own)
        client.end(after)
    if client.comm.rank == 0:
        client.report("centre_y", disc.state[1])
        client.report("velocity_y", disc.state[4])
    client.close()


main()
