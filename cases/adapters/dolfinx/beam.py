#!/usr/bin/python3
"""An elastic beam by dolfinx in place of coracle-solid, in a case whose first body is a rectangle that is fixed at its bottom.

Find u with  int rho0 u'' . v + P(u) : grad v dX = sum over nodes of F . v + int rho0 g . v dX  for all v that vanish where the beam is held;
P = F (lambda tr(E) I + 2 mu E), E = (F^T F - I)/2 (St. Venant-Kirchhoff, plane strain), P1 triangles, lumped mass,

    (v1 - v0)/dt = u''(theta u1 + (1 - theta) u0),   (u1 - u0)/dt = theta v1 + (1 - theta) v0,   theta = 0.55.

All ranks have a part of the mesh; dolfinx's local numbering of nodes is the library's.
"""
import numpy as np
import petsc4py

import coracle

CLIENT = coracle.Client("solid")
petsc4py.init([], comm=CLIENT.comm)  # before dolfinx: PETSc lives on the solid's ranks alone
import ufl  # noqa: E402
from dolfinx import fem, mesh  # noqa: E402
from petsc4py import PETSc  # noqa: E402

# A force that is constant over a step feeds vibrations that the step does not resolve.  With 1/2, the midpoint rule, they
# grow; with this a step takes a sixth of them.  Newmark's average acceleration has half of a force in the step after.
THETA = 0.55


class Beam:
    def __init__(self, case):
        body = "solid.bodies[0]."
        material = "solid.materials.%s." % case.string(body + "material")
        self.density, youngs = case.positive(material + "density"), case.positive(material + "youngs_modulus")
        nu, size = case.number(material + "poisson_ratio", lower=0.0, upper=0.499), case.positive(body + "size")
        self.mu, self.lame = youngs / (2 * (1 + nu)), youngs * nu / ((1 + nu) * (1 - 2 * nu))
        extent = np.array([case.positive(body + "width"), case.positive(body + "height")])
        lower = case.vector(body + "centre") - extent / 2
        self.gravity = case.vector("gravity")
        self.domain = mesh.create_rectangle(CLIENT.comm, [lower, lower + extent], np.maximum(1, np.round(extent / size)).astype(int),
                                            diagonal=mesh.DiagonalType.left_right, ghost_mode=mesh.GhostMode.none)
        self.space = fem.VectorFunctionSpace(self.domain, ("CG", 1))
        self.number(lower, extent)
        self.build()

    def number(self, lower, extent):
        """Nodes, triangles and facets of this rank, in the library's sense."""
        space, topology = self.space, self.domain.topology
        self.x = np.clip(space.tabulate_dof_coordinates()[:, :2], lower, lower + extent)  # at rest; no round-off outside the tank
        index_map = space.dofmap.index_map
        self.gid = index_map.local_to_global(np.arange(len(self.x), dtype=np.int32)).astype(np.longlong)
        cells = space.dofmap.list.array.reshape(-1, 3)
        a, b, c = (self.x[cells[:, k]] for k in range(3))
        area = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
        self.triangles = np.where(area[:, None] > 0, cells, cells[:, [0, 2, 1]]).astype(np.intc)
        topology.create_connectivity(1, 2)
        topology.create_connectivity(2, 1)
        to_cell, to_facet = topology.connectivity(1, 2), topology.connectivity(2, 1)
        facets = []
        for f in mesh.exterior_facet_indices(topology):
            cell = to_cell.links(f)[0]
            opposite = cells[cell][list(to_facet.links(cell)).index(f)]  # a facet has the number of the vertex it lacks
            k = list(self.triangles[cell]).index(opposite)
            facets.append([self.triangles[cell][(k + 1) % 3], self.triangles[cell][(k + 2) % 3]])
        self.facets = np.array(facets, np.intc).reshape(-1, 2)
        self.held = np.abs(self.x[:, 1] - lower[1]) < 1e-9

    def build(self):
        """The weak form, its derivative, and what solves them."""
        self.u, self.start, self.free = fem.Function(self.space), fem.Function(self.space), fem.Function(self.space)
        self.theta_dt2 = fem.Constant(self.domain, 1.0)
        v, w = ufl.TestFunction(self.space), ufl.TrialFunction(self.space)
        gradient = ufl.Identity(2) + ufl.grad(THETA * self.u + (1 - THETA) * self.start)
        strain = (gradient.T * gradient - ufl.Identity(2)) / 2
        stress = gradient * (self.lame * ufl.tr(strain) * ufl.Identity(2) + 2 * self.mu * strain)
        lumped = ufl.dx(metadata={"quadrature_rule": "vertex", "quadrature_degree": 1})
        weight = fem.Constant(self.domain, tuple(self.density * self.gravity))
        inertia = self.density * ufl.inner((self.u - self.free) / self.theta_dt2, v) * lumped  # free: start + dt v0
        residual = inertia + ufl.inner(stress, ufl.grad(v)) * ufl.dx - ufl.inner(weight, v) * lumped
        self.residual, self.jacobian = fem.form(residual), fem.form(ufl.derivative(residual, self.u, w))
        zero = fem.Function(self.space)
        self.condition = fem.dirichletbc(zero, np.flatnonzero(self.held).astype(np.int32))
        self.matrix, self.right = fem.petsc.create_matrix(self.jacobian), fem.petsc.create_vector(self.residual)
        self.step = self.right.duplicate()
        self.solver = PETSc.KSP().create(CLIENT.comm)
        self.solver.setOperators(self.matrix)
        self.solver.setType("preonly")
        self.solver.getPC().setType("redundant")  # LU on each rank: MUMPS' sums depend on what arrives first, and a redone step needs the same bits
        mass = fem.petsc.assemble_vector(fem.form(self.density * ufl.inner(fem.Constant(self.domain, (1.0, 1.0)), v) * lumped))
        self.mobility = np.where(self.held, 0.0, 1.0 / self.complete(mass)[:, 0])

    def complete(self, vector):
        """Sums what ranks have of shared nodes; [n][2] with the copies."""
        vector.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
        vector.ghostUpdate(addv=PETSc.InsertMode.INSERT, mode=PETSc.ScatterMode.FORWARD)
        with vector.localForm() as local:
            return local.array.reshape(-1, 2).copy()

    def solve(self, force):
        """Newton's method; force[n][2] from this rank's part."""
        for _ in range(20):
            with self.right.localForm() as local:
                local.set(0.0)
            fem.petsc.assemble_vector(self.right, self.residual)
            with self.right.localForm() as local:
                local.array[:] -= force.ravel()
            self.complete(self.right)
            fem.petsc.set_bc(self.right, [self.condition], self.u.vector, -1.0)
            self.matrix.zeroEntries()
            fem.petsc.assemble_matrix(self.matrix, self.jacobian, bcs=[self.condition])
            self.matrix.assemble()
            self.solver.solve(self.right, self.step)
            self.u.vector.axpy(-1.0, self.step)
            self.u.x.scatter_forward()
            if self.step.norm() <= 1e-10 * (1e-6 + self.u.vector.norm()):
                return
        CLIENT.reject_step("Newton's method has not converged in 20 iterations")
        self.u.x.array[:] = self.start.x.array

    def advance(self, dt, force, state, own):
        """state: displacement, velocity [2][n][2], own: acceleration by all but the fluid; both in place."""
        u, v = state
        self.theta_dt2.value = THETA * dt**2
        self.u.x.array[:] = self.start.x.array[:] = u.ravel()
        self.free.x.array[:] = (u + dt * v).ravel()
        self.solve(force)
        with self.right.localForm() as local:
            local.array[:] = force.ravel()
        whole = self.complete(self.right)
        acceleration = (self.u.x.array - self.free.x.array).reshape(-1, 2) / self.theta_dt2.value
        own[:] = np.where(self.held[:, None], 0.0, acceleration - self.mobility[:, None] * whole)
        u[:], v[:] = self.u.x.array.reshape(-1, 2), v + dt * acceleration


def main():
    case = CLIENT.case()
    beam = Beam(case)
    case.finish()
    n = len(beam.x)
    state, own = np.zeros((2, n, 2)), np.where(beam.held[:, None], 0.0, np.tile(beam.gravity, (n, 1)))
    CLIENT.bind_state(state, own)
    CLIENT.set_nodes(beam.gid, beam.x + state[0], state[1].copy())
    CLIENT.set_surface(beam.facets)
    CLIENT.set_volume(beam.triangles)
    CLIENT.set_inertia(beam.mobility, own)
    CLIENT.ready()
    for step in CLIENT.steps():
        before = beam.x + state[0]
        beam.advance(step.dt, CLIENT.get_force(), state, own)
        after = beam.x + state[0]
        CLIENT.substep(step.dt, (after - before) / step.dt)
        CLIENT.set_velocity(state[1])
        CLIENT.set_inertia(beam.mobility, own)
        CLIENT.end(after)
    CLIENT.report("tip_x", state[0, :, 0].max(initial=0.0))
    CLIENT.close()


main()
