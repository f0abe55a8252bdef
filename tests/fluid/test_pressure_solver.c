// ranks: 1 2 3
/* The pressure's two solvers project alike, and the iterations of the one for a density that changes know neither its contrast
 * nor the size of the elements, in closed and open domains, with either solver of the linear functions.  Nor do they know a
 * plate that is held, a million times as heavy, whose surface goes through elements (patch_correction.h; without it: 31 to 81).  Where
 * nothing but the length of the step changes the matrix and its factor stay. */
#include "tests/fluid/moving_layer.h"

#define ITERATIONS_MAX 20 /* 8 for one density, 13 for a contrast of 1000, which is solved more accurately */
#define PLATE_MAX 28      /* 16 on one rank, 21 on three */
#define ACCURACY 1e-5

/* Density of a plate, over that of the lightest phase, and how far it reaches from its middle. */
#define HEAVY 1e6
#define REACH 0.07

/* The plate's inertia on the elements that it overlaps, also in part, by points: across the plate alone where its surface is, as the coupler has it. */
static PetscErrorCode SetPlate(const FluidDomain *d, double heavy, double dt, SolidCoupling plate)
{
  enum { N = 20 }; /* points along an edge */
  const double normal[2] = {0.6, 0.8};
  CoracleCoupling *entry;
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(d->mesh->ne, &entry));
  for (int e = 0; e < d->mesh->ne; e++) {
    CoracleCoupling *k = entry + n;
    int inside = 0;
    for (int p = 0; p < N * N; p++) {
      const double l[3] = {(p / N + 1.0 / 3.0) / N, (p % N + 1.0 / 3.0) / N,
                           1.0 - (p / N + p % N + 2.0 / 3.0) / N};
      double distance = -0.7;
      if (l[2] < 0.0) continue;
      for (int i = 0; i < 3; i++)
        for (int c = 0; c < 2; c++) distance += l[i] * normal[c] * ElementVertex(d->mesh, e, i)[c];
      if (fabs(distance) > REACH) continue;
      inside++;
      for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
          k->implicit_inertia[i][j] += heavy / dt * 2.0 * d->geometry[e].area / (N * (N + 1)) * l[i] * l[j];
    }
    if (inside == 0) continue;
    const double along = inside == N * (N + 1) / 2 ? 1.0 : 20.0 / HEAVY;
    for (int i = 0; i < 2; i++)
      for (int j = 0; j < 2; j++)
        k->inertia_tensor[i][j] = (i == j) * along + (1.0 - along) * normal[i] * normal[j];
    k->element = e;
    k->flags = CORACLE_HAS_INERTIA | CORACLE_IS_HELD;
    n++;
  }
  PetscCall(SolidCouplingSet(plate, n, entry));
  PetscCall(PetscFree(entry));
  PetscFunctionReturn(0);
}

/* The velocity that gravity makes, projected with the density of step k; revision 0: by the direct solver. */
static PetscErrorCode Project(const FluidDomain *d, const Layer *l, PetscBool plate, int k, int revision,
                              double dt, ProjectionSolver s, Vec u, int *iterations)
{
  SolidCoupling solid;
  SolverReport report;
  double *rho;
  Vec phi;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(d->mesh->ne, &rho));
  for (int e = 0; e < d->mesh->ne; e++) rho[e] = LayerDensity(l, d, e, k);
  PetscCall(SolidCouplingCreate(d->mesh->ne, &solid));
  if (plate) PetscCall(SetPlate(d, HEAVY * fmin(1.0, l->contrast), dt, solid));
  const ProjectionStep step = {0.0, dt, rho, revision, solid, NULL, plate, NULL, NULL};
  PetscCall(LayerFall(d->mesh, u));
  PetscCall(ProjectionSolverSolve(s, &step, u, &phi, &report));
  PetscCheck(!report.failure[0], PETSC_COMM_SELF, PETSC_ERR_NOT_CONVERGED, "%s", report.failure);
  *iterations = report.iterations;
  PetscCall(ProjectionSolverSubtract(s, &step, u));
  PetscCall(SolidCouplingDestroy(&solid));
  PetscCall(PetscFree(rho));
  PetscFunctionReturn(0);
}

/* u is `exact`, which becomes the difference. */
static PetscErrorCode AreEqual(const Layer *l, PetscBool plate, Vec u, Vec exact)
{
  PetscReal error, size;
  PetscFunctionBeginUser;
  PetscCall(VecNorm(exact, NORM_INFINITY, &size));
  PetscCall(VecAXPY(exact, -1.0, u));
  PetscCall(VecNorm(exact, NORM_INFINITY, &error));
  PetscCheck(error <= ACCURACY * size, PETSC_COMM_SELF, PETSC_ERR_PLIB,
             "contrast %g, h %g%s: velocities differ by %g of %g", l->contrast, l->h, plate ? ", plate" : "",
             error, size);
  PetscFunctionReturn(0);
}

/* A first solve, and one with the interface moved on by as much as a step does. */
static PetscErrorCode Compare(const FluidDomain *d, const Layer *l, PetscBool plate)
{
  Vec u, exact, p;
  ProjectionSolver s, direct;
  int iterations, one;
  PetscFunctionBeginUser;
  PetscCall(LayerVectors(d, &u, &p));
  PetscCall(VecDuplicate(u, &exact));
  PetscCall(ProjectionSolverCreate(d, p, PETSC_FALSE, &s));
  for (int k = 0; k < 3; k++) {
    PetscCall(Project(d, l, plate, k, k + 1, DT, s, u, &iterations));
    PetscCall(ProjectionSolverCreate(d, p, PETSC_FALSE, &direct));
    PetscCall(Project(d, l, plate, k, 0, DT, direct, exact, &one));
    PetscCall(ProjectionSolverDestroy(&direct));
    PetscCall(AreEqual(l, plate, u, exact));
    PetscCheck(one == 1 && iterations <= (plate ? PLATE_MAX : ITERATIONS_MAX), PETSC_COMM_SELF,
               PETSC_ERR_PLIB, "contrast %g, h %g%s: %d iterations", l->contrast, l->h,
               plate ? ", plate" : "", iterations);
  }
  PetscCall(ProjectionSolverDestroy(&s));
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&exact));
  PetscCall(VecDestroy(&p));
  PetscFunctionReturn(0);
}

/* Another step beside the plate is solved with the factor of the first: as by a new solver. */
static PetscErrorCode CheckStays(const FluidDomain *d, const Layer *l)
{
  Vec u, exact, p;
  ProjectionSolver s, new;
  int iterations;
  PetscFunctionBeginUser;
  PetscCall(LayerVectors(d, &u, &p));
  PetscCall(VecDuplicate(u, &exact));
  PetscCall(ProjectionSolverCreate(d, p, PETSC_FALSE, &s));
  PetscCall(ProjectionSolverCreate(d, p, PETSC_FALSE, &new));
  PetscCall(Project(d, l, PETSC_TRUE, 0, 0, DT, s, u, &iterations));
  PetscCall(Project(d, l, PETSC_TRUE, 0, 0, 0.3 * DT, s, u, &iterations));
  PetscCall(Project(d, l, PETSC_TRUE, 0, 0, 0.3 * DT, new, exact, &iterations));
  PetscCall(AreEqual(l, PETSC_TRUE, u, exact));
  PetscCall(ProjectionSolverDestroy(&s));
  PetscCall(ProjectionSolverDestroy(&new));
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
    PetscCall(Compare(&domain, &layer, PETSC_FALSE));
    if (layer.contrast != 1.0) PetscCall(Compare(&domain, &layer, PETSC_TRUE));
    PetscCall(CheckStays(&domain, &layer));
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
