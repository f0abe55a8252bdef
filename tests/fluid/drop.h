/* Two phases with surface tension in the unit square, closed by free-slip walls, on a random mesh. */
#ifndef TEST_FLUID_DROP_H
#define TEST_FLUID_DROP_H
#include "fluid/flow/fluid.h"
#include "tests/check.h"
#include "tests/transfer/shaken.h"
#include <math.h>

typedef struct {
  int n; /* cells across */
  unsigned seed;
  double ratio;              /* of the densities; the first phase has 1 kg/m3 */
  double viscosity[2];       /* Pa s */
  double tension;            /* N/m */
  double gravity, cosine[4]; /* downwards, m/s2; of contact angles at left, right, bottom, top */
  BoundaryKind wall;         /* all four; at rest */
} DropSetup;

typedef struct {
  Mesh *mesh;
  Fluid fluid;
  double dt; /* the capillary limit at the start */
} Drop;

static inline PetscErrorCode DropCreate(const DropSetup *s, int nregions, const Region region[], Drop *d)
{
  const Shaken shaken = {.n = s->n, .seed = s->seed, .radius = 1.0};
  Boundary boundary[8] = {0};
  FluidSetup setup = {.theta = 1.0,
                      .rho = 1.0 / s->ratio,
                      .mu = s->viscosity[1],
                      .phases = {.n = 2,
                                 .rho = {1.0, 1.0 / s->ratio},
                                 .mu = {s->viscosity[0], s->viscosity[1]},
                                 .surface_tension = {{{0.0, s->tension}, {s->tension, 0.0}}}},
                      .gravity = {0.0, -s->gravity},
                      .cfl = 0.5,
                      .dt_max = 1.0,
                      .capillary_cfl = CAPILLARY_CFL,
                      .boundary = boundary};
  PetscFunctionBeginUser;
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &d->mesh));
  for (int b = 0; b < d->mesh->ntags; b++)
    boundary[b] =
        (Boundary){.kind = s->wall, .phases.contact_cosine = {{{0.0, s->cosine[b]}, {-s->cosine[b], 0.0}}}};
  PetscCall(FluidCreate(d->mesh, &setup, &d->fluid));
  PetscCall(FluidSetPhases(d->fluid, nregions, region));
  PetscCall(FluidSetInitial(d->fluid, 0.0, NULL, NULL, NULL));
  d->dt = FluidTimeStep(d->fluid);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &d->dt, 1, MPI_DOUBLE, MPI_MIN, d->mesh->comm));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode DropDestroy(Drop *d)
{
  PetscFunctionBeginUser;
  PetscCall(FluidDestroy(&d->fluid));
  PetscCall(MeshDestroy(&d->mesh));
  PetscFunctionReturn(0);
}

static inline Phases DropPhases(const Drop *d)
{
  return PhaseTransportPhases(FluidPhases(d->fluid));
}

/* Largest velocity component, m/s. */
static inline double DropSpeed(const Drop *d)
{
  const double *u = FluidVelocity(d->fluid);
  double speed = 0.0;
  for (int k = 0; k < 6 * d->mesh->ne; k++) speed = fmax(speed, fabs(u[k]));
  MPI_Allreduce(MPI_IN_PLACE, &speed, 1, MPI_DOUBLE, MPI_MAX, d->mesh->comm);
  return speed;
}

/* Mean pressure, Pa, of the elements that a phase has to itself. */
static inline double DropPressure(const Drop *d, int phase)
{
  const double *p = FluidPressure(d->fluid);
  double sum[2] = {0.0, 0.0};
  for (int e = 0; e < d->mesh->ne; e++) {
    if (PhasesSingle(DropPhases(d), e) != phase) continue;
    const double area = ElementArea(d->mesh, e);
    for (int i = 3; i < 6; i++) sum[0] += area / 3.0 * p[FluidPressureSpace(d->fluid)->node[6 * e + i]];
    sum[1] += area;
  }
  MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, d->mesh->comm);
  return sum[0] / sum[1];
}
#endif
