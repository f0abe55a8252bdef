// ranks: 1 2 3
/* The pressure's two solvers project alike, and the iterations of the one for a density that changes know neither its contrast
 * nor the size of the elements, in closed and open domains, with either solver of the linear functions. */
#include "tests/fluid/moving_layer.h"

#define ITERATIONS_MAX 20 /* 8 for one density, 13 for a contrast of 1000, which is solved more accurately */
#define ACCURACY 1e-5

/* The velocity that gravity makes, projected with the density of step k; revision 0: by the direct solver. */
static PetscErrorCode Project(const FluidDomain *d, const Layer *l, int k, int revision, ProjectionSolver s,
                              Vec u, int *iterations)
{
  SolidCoupling none;
  double *rho;
  Vec phi;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(d->mesh->ne, &rho));
  for (int e = 0; e < d->mesh->ne; e++) rho[e] = LayerDensity(l, d, e, k);
  PetscCall(SolidCouplingCreate(d->mesh->ne, &none));
  const ProjectionStep step = {0.0, DT, rho, revision, none, NULL, PETSC_FALSE, NULL, NULL};
  PetscCall(LayerFall(d->mesh, u));
  PetscCall(ProjectionSolverSolve(s, &step, u, &phi, iterations));
  PetscCall(ProjectionSolverSubtract(s, &step, u));
  PetscCall(SolidCouplingDestroy(&none));
  PetscCall(PetscFree(rho));
  PetscFunctionReturn(0);
}

/* A first solve, and one with the interface moved on by as much as a step does. */
static PetscErrorCode Compare(const FluidDomain *d, const Layer *l)
{
  Vec u, exact, p;
  ProjectionSolver s, direct;
  PetscReal error, size;
  int iterations, one;
  PetscFunctionBeginUser;
  PetscCall(LayerVectors(d, &u, &p));
  PetscCall(VecDuplicate(u, &exact));
  PetscCall(ProjectionSolverCreate(d, p, PETSC_FALSE, &s));
  for (int k = 0; k < 3; k++) {
    PetscCall(Project(d, l, k, k + 1, s, u, &iterations));
    PetscCall(ProjectionSolverCreate(d, p, PETSC_FALSE, &direct));
    PetscCall(Project(d, l, k, 0, direct, exact, &one));
    PetscCall(ProjectionSolverDestroy(&direct));
    PetscCall(VecAXPY(u, -1.0, exact));
    PetscCall(VecNorm(u, NORM_INFINITY, &error));
    PetscCall(VecNorm(exact, NORM_INFINITY, &size));
    PetscCheck(error <= ACCURACY * size, PETSC_COMM_SELF, PETSC_ERR_PLIB,
               "contrast %g, h %g: velocities differ by %g of %g", l->contrast, l->h, error, size);
    PetscCheck(one == 1 && iterations <= ITERATIONS_MAX, PETSC_COMM_SELF, PETSC_ERR_PLIB,
               "contrast %g, h %g: %d iterations", l->contrast, l->h, iterations);
  }
  PetscCall(ProjectionSolverDestroy(&s));
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&exact));
  PetscCall(VecDestroy(&p));
  PetscFunctionReturn(0);
}

/* All contrasts, or, with multigrid in place of the factor of the linear functions, the largest. */
static PetscErrorCode Contrasts(double h, PetscBool open, PetscBool multigrid)
{
  const double contrasts[] = {1000.0, 1.0, 30.0, 1e-3};
  FluidDomain domain;
  Mesh *mesh;
  PetscFunctionBeginUser;
  if (multigrid) PetscCall(PetscOptionsSetValue(NULL, "-pressure_coarse_pc_type", "hypre"));
  PetscCall(LayerDomain(h, open, &mesh, &domain));
  for (int k = 0; k < (multigrid ? 1 : 4); k++) {
    const Layer layer = {h, contrasts[k], (PetscBool)(k % 2)};
    PetscCall(Compare(&domain, &layer));
  }
  PetscCall(DomainDestroy(&domain));
  PetscCall(MeshDestroy(&mesh));
  if (multigrid) PetscCall(PetscOptionsClearValue(NULL, "-pressure_coarse_pc_type"));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int open = 0; open < 2; open++) {
    for (double h = 0.1; h > 0.02; h *= 0.4) PetscCall(Contrasts(h, (PetscBool)open, PETSC_FALSE));
#if defined(PETSC_HAVE_HYPRE)
    PetscCall(Contrasts(0.04, (PetscBool)open, PETSC_TRUE));
#endif
  }
  PetscCall(PetscFinalize());
  return 0;
}
