/* A manufactured solution on the unit square and the set-up of a fluid that has it. */
#ifndef TEST_FLUID_EXACT_H
#define TEST_FLUID_EXACT_H
#include "fluid/flow/fluid.h"
#include "tests/fluid/box_mesh.h"
#include <math.h>

#define RHO 2.0
#define MU 0.005

/* u = f(t) (sin pi x cos pi y, -cos pi x sin pi y), p = f(t) cos(pi x) sin(2 pi y), f = 1 + sin(omega t)/2 */
typedef struct {
  double omega;
} Exact;

static inline double Amplitude(const Exact *e, double t)
{
  return 1.0 + 0.5 * sin(e->omega * t);
}

static inline void ExactVelocity(void *context, double t, const double x[2], double v[])
{
  const double f = Amplitude(context, t);
  v[0] = f * sin(M_PI * x[0]) * cos(M_PI * x[1]);
  v[1] = -f * cos(M_PI * x[0]) * sin(M_PI * x[1]);
}

static inline void ExactPressure(void *context, double t, const double x[2], double p[])
{
  p[0] = Amplitude(context, t) * cos(M_PI * x[0]) * sin(2.0 * M_PI * x[1]);
}

/* rho (u_t + u.grad u) + grad p - mu lap u */
static inline void ExactSource(void *context, double t, const double x[2], double s[])
{
  const Exact *e = context;
  const double f = Amplitude(e, t), df = 0.5 * e->omega * cos(e->omega * t);
  double u[2];
  ExactVelocity(context, t, x, u);
  for (int c = 0; c < 2; c++)
    s[c] = (RHO * df / f + 2.0 * M_PI * M_PI * MU) * u[c] + RHO * f * f * 0.5 * M_PI * sin(2.0 * M_PI * x[c]);
  s[0] -= f * M_PI * sin(M_PI * x[0]) * sin(2.0 * M_PI * x[1]);
  s[1] += f * 2.0 * M_PI * cos(M_PI * x[0]) * cos(2.0 * M_PI * x[1]);
}

/* source and mu: ExactSource and MU, or NULL and any for a flow that is left to itself */
static inline PetscErrorCode ExactFluid(const Mesh *mesh, Exact *exact, FieldFunction source, double mu,
                                        Fluid *fluid)
{
  Boundary boundary[8] = {0};
  FluidSetup setup = {.theta = 0.5, .rho = RHO, .mu = mu, .cfl = 0.5, .dt_max = 1.0, .boundary = boundary};
  PetscFunctionBeginUser;
  setup.source = source;
  setup.source_context = exact;
  for (int b = 0; b < mesh->ntags; b++) {
    boundary[b].kind = BOUNDARY_VELOCITY;
    boundary[b].function = ExactVelocity;
    boundary[b].context = exact;
  }
  PetscCall(FluidCreate(mesh, &setup, fluid));
  PetscCall(FluidSetInitial(*fluid, 0.0, ExactVelocity, ExactPressure, exact));
  PetscFunctionReturn(0);
}

/* Largest velocity component, m/s, or difference to another fluid's on the same mesh; other may be NULL. */
static inline double LargestVelocity(Fluid fluid, Fluid other)
{
  double largest = 0.0;
  for (int k = 0; k < 6 * FluidMesh(fluid)->ne; k++)
    largest = fmax(largest, fabs(FluidVelocity(fluid)[k] - (other ? FluidVelocity(other)[k] : 0.0)));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return largest;
}
#endif
