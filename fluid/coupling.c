/* The solid in the fluid: which element carries which coupling data, and the correction that ends a step. */
#include "fluid/fluid_impl.h"

PetscErrorCode FluidSetCoupling(Fluid f, int n, const CoracleCoupling coupling[])
{
  int has_solid = n > 0;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &has_solid, 1, MPI_INT, MPI_MAX, f->mesh->comm));
  f->has_solid = (PetscBool)has_solid;
  for (int k = 0; k < f->ncoupling; k++) {
    f->coupling_of[f->coupling[k].element] = -1;
    f->alpha[f->coupling[k].element] = 0.0;
  }
  if (n > f->capacity) {
    PetscCall(PetscFree(f->coupling));
    PetscCall(PetscMalloc1(n + n / 4, &f->coupling));
    f->capacity = n + n / 4;
  }
  if (n > 0) PetscCall(PetscArraycpy(f->coupling, coupling, n));
  f->ncoupling = n;
  for (int k = 0; k < n; k++) {
    f->coupling_of[coupling[k].element] = k;
    f->alpha[coupling[k].element] = coupling[k].alpha;
  }
  PetscFunctionReturn(0);
}

/* u += M^-1 r on one element */
static void CorrectElement(double area, const CoracleCorrection *correction, double u[6])
{
  for (int c = 0; c < 2; c++) {
    double du[3];
    P1MassSolve(area, correction->r[c], du);
    for (int i = 0; i < 3; i++) u[3 * c + i] += du[i];
  }
}

PetscErrorCode FluidCorrect(Fluid f, double dt, const CoracleCorrection correction[])
{
  const double start = MPI_Wtime();
  const Vec oldest = f->u_previous;
  PetscFunctionBeginUser;
  if (correction) {
    PetscScalar *u;
    PetscCall(VecGetArray(f->u_next, &u));
    for (int k = 0; k < f->ncoupling; k++) {
      const int e = f->coupling[k].element;
      CorrectElement(f->geometry[e].area, correction + k, u + 6 * e);
    }
    PetscCall(VecRestoreArray(f->u_next, &u));
  }
  f->u_previous = f->u;
  f->u = f->u_next;
  f->u_next = oldest;
  f->dt_previous = dt;
  f->t += dt;
  f->stats.t = f->t;
  f->stats.seconds[COUPLING] += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidStep(Fluid f, double dt)
{
  PetscFunctionBeginUser;
  PetscCall(FluidMomentum(f, dt));
  PetscCall(FluidProject(f, dt));
  PetscCall(FluidCorrect(f, dt, NULL));
  PetscFunctionReturn(0);
}
