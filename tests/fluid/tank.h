/* Water below air, or other phases, in a box with free-slip walls, on a mesh that knows nothing of the surface. */
#ifndef TEST_FLUID_TANK_H
#define TEST_FLUID_TANK_H
#include "fluid/flow/fluid.h"
#include "tests/check.h"
#include "tests/transfer/shaken.h"
#include <math.h>

#define WATER 1060.0
#define AIR 1.2

typedef struct {
  Mesh *mesh;
  Fluid fluid;
} Tank;

/* How the phases of the tanks to come move. */
static PhasesAdvection tank_advection = PHASES_GEOMETRIC;

/* Sides open to these layers outside, and an open top; NULL: walls. */
typedef BoundaryPhases TankOutside;

/* The unit square of n x n shaken cells, with these phases. */
static inline PetscErrorCode TankCreatePhases(int n, unsigned seed, const PhaseProperties *phases,
                                              int nregions, const Region region[], const TankOutside *outside,
                                              Tank *t)
{
  const Shaken shaken = {.n = n, .seed = seed, .radius = 1.0};
  const int lightest = PhaseLightest(phases);
  Boundary boundary[8] = {0};
  FluidSetup setup = {.theta = PhaseHasTension(phases) ? 1.0 : 0.5,
                      .rho = phases->rho[lightest],
                      .mu = phases->mu[lightest],
                      .phases = *phases,
                      .gravity = {0.0, -9.81},
                      .cfl = 0.5,
                      .dt_max = 1.0,
                      .capillary_cfl = CAPILLARY_CFL,
                      .gravity_cfl = GRAVITY_CFL,
                      .boundary = boundary};
  PetscFunctionBeginUser;
  setup.phases.advection = tank_advection;
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &t->mesh));
  for (int b = 0; b < t->mesh->ntags; b++) {
    const char *name = t->mesh->tag_name[b];
    const PetscBool side = (PetscBool)(!strcmp(name, "left") || !strcmp(name, "right"));
    boundary[b].kind = BOUNDARY_FREE_SLIP;
    if (!outside || (!side && strcmp(name, "top") != 0)) continue;
    boundary[b].kind = BOUNDARY_OPEN;
    if (side) boundary[b].phases = *outside;
  }
  PetscCall(FluidCreate(t->mesh, &setup, &t->fluid));
  PetscCall(FluidSetPhases(t->fluid, nregions, region));
  PetscCall(FluidSetInitial(t->fluid, 0.0, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/* Water below air; between walls, or open at the top and, up to this level of water outside, at the sides. */
static inline PetscErrorCode TankCreateOpen(int n, unsigned seed, double viscosity, int nregions,
                                            const Region region[], PetscBool open, double level, Tank *t)
{
  const PhaseProperties phases = {.n = 2, .rho = {WATER, AIR}, .mu = {viscosity, 0.018 * viscosity}};
  const TankOutside outside = {.nlevels = 1, .level = {level}};
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(n, seed, &phases, nregions, region, open ? &outside : NULL, t));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode TankCreate(int n, unsigned seed, double viscosity, int nregions,
                                        const Region region[], Tank *t)
{
  return TankCreateOpen(n, seed, viscosity, nregions, region, PETSC_FALSE, 0.0, t);
}

static inline PetscErrorCode TankDestroy(Tank *t)
{
  PetscFunctionBeginUser;
  PetscCall(FluidDestroy(&t->fluid));
  PetscCall(MeshDestroy(&t->mesh));
  PetscFunctionReturn(0);
}

/* Largest velocity component, m/s, of all elements, or of those that are at least half water. */
static inline double TankSpeed(const Tank *t, int water)
{
  const double *u = FluidVelocity(t->fluid), *rho = FluidDensity(t->fluid);
  double speed = 0.0;
  for (int k = 0; k < 6 * t->mesh->ne; k++)
    if (!water || rho[k / 6] > 0.5 * WATER) speed = fmax(speed, fabs(u[k]));
  MPI_Allreduce(MPI_IN_PLACE, &speed, 1, MPI_DOUBLE, MPI_MAX, t->mesh->comm);
  return speed;
}
#endif
