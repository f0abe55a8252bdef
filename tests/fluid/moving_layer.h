/* A square in which a heavy disc, or a heavy layer under a light one, moves through the mesh; the pressure's solve for the
 * velocity that gravity makes in one step from rest. */
#ifndef TEST_FLUID_MOVING_LAYER_H
#define TEST_FLUID_MOVING_LAYER_H
#include "fluid/pressure/projection.h"
#include "tests/fluid/exact.h"

#define DT 0.01

typedef struct {
  double h, contrast;
  PetscBool flat;
} Layer;

/* The density of element e after a step: the heavy one's fraction from the distance to the interface. */
static inline double LayerDensity(const Layer *l, const FluidDomain *d, int e, int step)
{
  double x[2] = {0.0, 0.0};
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 2; c++) x[c] += ElementVertex(d->mesh, e, i)[c] / 3.0;
  const double moved = 0.3 + 0.5 * l->h * step;
  const double distance = l->flat ? moved - x[1] - 0.1 * x[0] : 0.15 - hypot(x[0] - 0.5, x[1] - moved);
  return 1.0 + (l->contrast - 1.0) * fmin(1.0, fmax(0.0, 0.5 + distance / l->h));
}

/* The velocity that gravity and an uneven force make in a step from rest. */
static inline PetscErrorCode LayerFall(const Mesh *m, Vec velocity)
{
  PetscScalar *u;
  PetscFunctionBeginUser;
  PetscCall(VecGetArray(velocity, &u));
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      const double *x = ElementVertex(m, e, i);
      u[6 * e + i] = DT * sin(3.0 * x[1]) * cos(2.0 * x[0]);
      u[6 * e + 3 + i] = DT * (x[0] * x[1] - 9.81);
    }
  PetscCall(VecRestoreArray(velocity, &u));
  PetscFunctionReturn(0);
}

/* A closed square, or one open at its top. */
static inline PetscErrorCode LayerDomain(double h, PetscBool open, Mesh **mesh, FluidDomain *domain)
{
  Boundary boundary[8] = {0};
  PetscFunctionBeginUser;
  PetscCall(SquareMesh(h, mesh));
  for (int b = 0; b < (*mesh)->ntags; b++)
    boundary[b].kind = open && !strcmp((*mesh)->tag_name[b], "top") ? BOUNDARY_OPEN : BOUNDARY_FREE_SLIP;
  PetscCall(DomainCreate(*mesh, boundary, domain));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode LayerVectors(const FluidDomain *d, Vec *velocity, Vec *pressure)
{
  const P2Space *p2 = d->p2;
  PetscFunctionBeginUser;
  PetscCall(VecCreateMPI(d->mesh->comm, 6 * d->mesh->ne, PETSC_DETERMINE, velocity));
  PetscCall(VecCreateGhost(d->mesh->comm, p2->nowned, PETSC_DETERMINE, p2->n - p2->nowned,
                           p2->gid + p2->nowned, pressure));
  PetscFunctionReturn(0);
}
#endif
