/* A manufactured solution on the unit square and the set-up of a fluid that has it; its errors. */
#ifndef TEST_FLUID_EXACT_H
#define TEST_FLUID_EXACT_H
#include "fluid/flow/fluid.h"
#include "tests/fluid/box_mesh.h"
#include "tests/quadrature.h"
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

/* sum[4] += of an element: squared error of the velocity u; error of the pressure p, its square; area.  Exact at t[2]. */
static inline void AddErrors(double area, const double x[3][2], Exact *exact, const double t[2],
                             const double u[6], const double p[6], double sum[4])
{
  const Quadrature *rule = QuadratureOf(4);
  for (int q = 0; q < rule->n; q++) {
    const double *l = rule->point[q], w = rule->weight[q] * area;
    double at[2], v[2], d;
    for (int c = 0; c < 2; c++) at[c] = l[0] * x[0][c] + l[1] * x[1][c] + l[2] * x[2][c];
    ExactVelocity(exact, t[0], at, v);
    ExactPressure(exact, t[1], at, &d);
    for (int c = 0; c < 2; c++) v[c] -= l[0] * u[3 * c] + l[1] * u[3 * c + 1] + l[2] * u[3 * c + 2];
    for (int i = 0; i < 3; i++)
      d -= p[i] * l[i] * (2.0 * l[i] - 1.0) + p[3 + i] * 4.0 * l[(i + 1) % 3] * l[(i + 2) % 3];
    sum[0] += w * (v[0] * v[0] + v[1] * v[1]);
    sum[1] += w * d;
    sum[2] += w * d * d;
    sum[3] += w;
  }
}

/* L2 errors of the velocity and, up to a constant, of the pressure, against what they are at t[0] and t[1].  Collective. */
static inline PetscErrorCode ExactErrors(Fluid fluid, Exact *exact, const double t[2], double *velocity,
                                         double *pressure)
{
  const Mesh *m = FluidMesh(fluid);
  double sum[4] = {0.0};
  PetscFunctionBeginUser;
  for (int e = 0; e < m->ne; e++) {
    ElementGeometry g;
    double x[3][2], p[6];
    MeshCorners(m, e, x);
    ElementGeometryCompute(x[0], x[1], x[2], &g);
    for (int k = 0; k < 6; k++) p[k] = FluidPressure(fluid)[FluidPressureSpace(fluid)->node[6 * e + k]];
    AddErrors(g.area, (const double(*)[2])x, exact, t, FluidVelocity(fluid) + 6 * e, p, sum);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 4, MPI_DOUBLE, MPI_SUM, m->comm));
  *velocity = sqrt(sum[0]);
  *pressure = sqrt(fmax(sum[2] - sum[1] * sum[1] / sum[3], 0.0));
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
