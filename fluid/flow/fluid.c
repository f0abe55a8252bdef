/* The fluid's life. */
#include "fluid/discretization/solver_options.h"
#include "fluid/flow/fluid_impl.h"

static PetscErrorCode CreateVectors(Fluid f)
{
  const Mesh *m = f->domain.mesh;
  const P2Space *p2 = f->domain.p2;
  Vec *velocity[] = {&f->bulk,        &f->bulk_previous, &f->u_previous, &f->u_star,
                     &f->u_projected, &f->mass_flux,     &f->saved.u,    &f->saved.u_previous};
  PetscInt *ghosts;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(m->ng, &ghosts));
  for (int e = 0; e < m->ng; e++) ghosts[e] = m->egid[m->ne + e];
  PetscCall(VecCreateGhostBlock(m->comm, 6, 6 * m->ne, PETSC_DETERMINE, m->ng, ghosts, &f->u));
  if (f->phases) PetscCall(VecCreateGhost(m->comm, m->ne, PETSC_DETERMINE, m->ng, ghosts, &f->outside));
  PetscCall(PetscFree(ghosts));
  for (size_t k = f->phases ? 0 : 2; k < sizeof velocity / sizeof *velocity; k++)
    PetscCall(VecDuplicate(f->u, velocity[k]));
  PetscCall(
      VecCreateGhost(m->comm, p2->nowned, PETSC_DETERMINE, p2->n - p2->nowned, p2->gid + p2->nowned, &f->p));
  PetscCall(VecDuplicate(f->p, &f->saved.p));
  if (f->phases) PetscCall(VecDuplicate(f->p, &f->dynamic));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyVectors(Fluid f)
{
  Vec *all[] = {&f->bulk,        &f->bulk_previous, &f->u,       &f->u_previous,       &f->u_star,
                &f->u_projected, &f->mass_flux,     &f->saved.u, &f->saved.u_previous, &f->p,
                &f->saved.p,     &f->outside,       &f->dynamic};
  PetscFunctionBeginUser;
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) PetscCall(VecDestroy(all[k]));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCreate(const Mesh *mesh, const FluidSetup *setup, Fluid *fluid)
{
  const MomentumSetup momentum = {setup->source, setup->source_context};
  Fluid f;
  PetscFunctionBeginUser;
  /* PETSc from 3.21 on: products of several vectors by BLAS, which round by where the vectors lie, so that a step that is redone or resumed had
   * other bits */
  PetscCall(SolverDefaultOption("", "vec_mdot_use_gemv", "0"));
  PetscCall(PetscNew(&f));
  f->setup = *setup;
  PetscCall(DomainCreate(mesh, setup->boundary, &f->domain));
  f->setup.boundary = f->domain.boundary;
  PetscCall(MaterialCreate(mesh, setup->theta, setup->rho, setup->mu, &f->material));
  PetscCall(SolidCouplingCreate(mesh->ne, &f->solid));
  if (setup->phases.n) {
    /* what the solver leaves of the divergence becomes a gap between volumes and areas */
    PetscCall(SolverDefaultOption("pressure_varying_", "ksp_rtol", "1e-10"));
    PetscCall(
        SolverDefaultOption("momentum_", "ksp_rtol", "1e-6")); /* the norm hardly sees the lighter phase */
    PetscCall(PhaseTransportCreate(&f->domain, &setup->phases, setup->gravity, &f->phases));
  }
  /* one more: whether they are NULL is the same on all ranks, also where there are no elements */
  if (PhaseHasGas(&setup->phases)) PetscCall(PetscCalloc1((size_t)mesh->ne + 1, &f->compressible));
  if (f->phases) PetscCall(PetscCalloc1(2 * (size_t)mesh->ne + 1, &f->remainder));
  if (setup->absorption.n) PetscCall(PetscCalloc1((size_t)mesh->ne + 1, &f->absorption));
  PetscCall(CreateVectors(f));
  PetscCall(FluidBudgetCreate(f));
  PetscCall(MomentumSolverCreate(&f->domain, &momentum, f->u, &f->momentum));
  PetscCall(ProjectionSolverCreate(&f->domain, f->p, PhaseHasGas(&setup->phases), &f->projection));
  *fluid = f;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCreateLike(Fluid like, const Mesh *mesh, Fluid *fluid)
{
  const double start = MPI_Wtime();
  PetscFunctionBeginUser;
  PetscCall(FluidCreate(mesh, &like->setup, fluid));
  (*fluid)->stats.seconds[SETUP] = MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidDestroy(Fluid *fluid)
{
  Fluid f = *fluid;
  PetscFunctionBeginUser;
  if (!f) PetscFunctionReturn(0);
  PetscCall(TransferDestroy(&f->transfer));
  PetscCall(MomentumSolverDestroy(&f->momentum));
  PetscCall(ProjectionSolverDestroy(&f->projection));
  PetscCall(DestroyVectors(f));
  PetscCall(FluidBudgetDestroy(f));
  PetscCall(SolidCouplingDestroy(&f->solid));
  PetscCall(PhaseTransportDestroy(&f->phases));
  PetscCall(MaterialDestroy(&f->material));
  PetscCall(PetscFree(f->compressible));
  PetscCall(PetscFree(f->remainder));
  PetscCall(PetscFree(f->absorption));
  PetscCall(DomainDestroy(&f->domain));
  PetscCall(PetscFree(*fluid));
  PetscFunctionReturn(0);
}
