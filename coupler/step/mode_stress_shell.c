/* Mode stress_shell, the paper to the letter: nothing in the volume; the wall term's coefficient from the
 * viscosity projected fluid -> shell -> surface and back; the force on the solid as the surface integral of
 * [43] with [44]; the fluid inside takes the solid's velocity at the step's end [5].
 *
 * On the way back surface -> shell -> fluid the coefficient is integrated over each pair (its mean there)
 * instead of projected to a P1DG field: the integral [41] of a is kept and a stays positive semidefinite.  u*
 * is the velocity in [44]: viscous forces from the projected velocity are unstable in an explicit exchange.
 * Not conservative: [44]'s wall term is evaluated from projected fields.  Without [5] a disc falls 30 % slow and the
 * flow inside of it runs away. */
#include "common/space/p1.h"
#include "common/space/p2.h"
#include "coupler/geometry/surface.h"
#include "coupler/step/coupler_impl.h"

/* Fields fluid -> surface. */
enum { PRESSURE, VELOCITY, STRESS = VELOCITY + 2, VISCOSITY = STRESS + 3, EXTENT, FIELDS };

static void Constant(double value, double f[3])
{
  for (int i = 0; i < 3; i++) f[i] = value;
}

/* mu and dxw alone: all that the coefficients need, before any flow is known. */
static void WallFields(void *context, const Overlap o, const SupermeshPair *pair, double f[][3])
{
  Constant(o->mu[pair->b], f[0]);
  Constant(WallExtent((const double(*)[2])o->x[pair->b], o->source[pair->a].normal), f[1]);
}

static void PressureField(void *context, const Overlap o, const SupermeshPair *pair, double f[][3])
{
  const Coupler c = context;
  P2ProjectP1(&c->flow.p[6 * pair->b], f[0]);
}

/* tau = mu (grad u + grad u^T - 2/3 div u I), constant on an element: xx, xy, yy. */
static void Stress(const double x[3][2], const double u[6], double mu, double tau[3])
{
  double g[3][2], d[2][2];
  P1Gradients(x, g);
  P1VelocityGradient((const double(*)[2])g, (const double(*)[3])u, d);
  const double divergence = d[0][0] + d[1][1];
  tau[0] = mu * (2.0 * d[0][0] - 2.0 / 3.0 * divergence);
  tau[1] = mu * (d[0][1] + d[1][0]);
  tau[2] = mu * (2.0 * d[1][1] - 2.0 / 3.0 * divergence);
}

static void FlowFields(void *context, const Overlap o, const SupermeshPair *pair, double f[][3])
{
  const Coupler c = context;
  const double *u = &c->flow.u_star[6 * pair->b];
  double tau[3];
  PressureField(context, o, pair, &f[PRESSURE]);
  for (int i = 0; i < 6; i++) f[VELOCITY + i / 3][i % 3] = u[i];
  Stress((const double(*)[2])o->x[pair->b], u, o->mu[pair->b], tau);
  for (int i = 0; i < 3; i++) Constant(tau[i], f[STRESS + i]);
  WallFields(context, o, pair, &f[VISCOSITY]);
}

/* mu / dxw at the two nodes of a facet; dxw is averaged over the facet, where it cannot undershoot. */
static void WallFactor(const double mu[2], const double dxw[2], double k[2])
{
  const double mean = 0.5 * (dxw[0] + dxw[1]);
  for (int i = 0; i < 2; i++) k[i] = mean > 0.0 ? fmax(mu[i], 0.0) / mean : 0.0;
}

/* Surface -> shell, whose outer nodes carry the surface's values -> source triangles. */
static PetscErrorCode WallFactorOnSources(Coupler c, double (*source)[3])
{
  const Overlap o = c->overlap;
  double(*surface)[2][2], (*owned)[3];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(c->shell->nfacets, &surface));
  PetscCall(PetscCalloc1(o->nowned, &owned));
  PetscCall(SurfaceFromFluid(o, 2, c->shell, WallFields, c, (double *)surface));
  for (int e = 0; e < c->shell->nfacets; e++) {
    double k[2];
    WallFactor(surface[e][0], surface[e][1], k);
    const double vertices[2][3] = {{k[0], k[0], k[1]}, {k[0], k[1], k[1]}};
    for (int t = 0; t < 2; t++) PetscCall(PetscArraycpy(owned[o->nvolume + 2 * e + t], vertices[t], 3));
  }
  PetscCall(OverlapForward(o, 3, (const double *)owned, (double *)source));
  PetscCall(PetscFree(owned));
  PetscCall(PetscFree(surface));
  PetscFunctionReturn(0);
}

static PetscErrorCode Coefficients(Coupler c, const SolidState *solid)
{
  const Overlap o = c->overlap;
  double(*k)[3];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(o->nsources, &k));
  PetscCall(WallFactorOnSources(c, k));
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    const double(*g)[2] = (const double(*)[2])o->source_basis[pair->a].gradient, *d = pair->centre;
    const double n1 = g[0][0] * d[0] + g[0][1] * d[1], n2 = g[1][0] * d[0] + g[1][1] * d[1];
    const double mean = (1.0 - n1 - n2) * k[pair->a][0] + n1 * k[pair->a][1] + n2 * k[pair->a][2];
    c->term[p].a = o->source[pair->a].is_shell
                       ? WallCoefficientOf(mean / c->options.thickness, o->source[pair->a].normal)
                       : WallCoefficientIsotropic(0.0);
  }
  PetscCall(PetscFree(k));
  PetscFunctionReturn(0);
}

/* node += int_e N_i t over the edge e of a traction t[2 nodes][2]; where = 0: reaction, 1: other. */
static void AddTraction(Coupler c, int e, int where, const double t[2][2])
{
  const int end[2] = {c->shell->node[2 * e][0], c->shell->node[2 * e][2]};
  for (int i = 0; i < 2; i++) {
    double *to = where ? c->node[end[i]].other : c->node[end[i]].reaction;
    for (int d = 0; d < 2; d++) to[d] += c->shell->length[e] / 6.0 * (2.0 * t[i][d] + t[1 - i][d]);
  }
}

/* [43], [44] on one facet: the wall term, which s_c gives the fluid, is the reaction; tau n - p n the
 * other part. */
static void AddFacetForce(Coupler c, int e, const double f[FIELDS][2])
{
  const double *n = c->shell->normal[e];
  double wall[2][2], other[2][2], k[2];
  WallFactor(f[VISCOSITY], f[EXTENT], k);
  for (int i = 0; i < 2; i++) {
    const double *us = &c->us[2 * c->shell->node[2 * e][2 * i]];
    const double slip[2] = {f[VELOCITY][i] - us[0], f[VELOCITY + 1][i] - us[1]};
    const WallCoefficient a = WallCoefficientOf(k[i], n);
    WallApply(&a, slip, wall[i]);
    other[i][0] = f[STRESS][i] * n[0] + f[STRESS + 1][i] * n[1] - f[PRESSURE][i] * n[0];
    other[i][1] = f[STRESS + 1][i] * n[0] + f[STRESS + 2][i] * n[1] - f[PRESSURE][i] * n[1];
  }
  AddTraction(c, e, 0, (const double(*)[2])wall);
  AddTraction(c, e, 1, (const double(*)[2])other);
}

static PetscErrorCode ComputeForce(Coupler c)
{
  double(*surface)[FIELDS][2];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(c->shell->nfacets, &surface));
  PetscCall(SurfaceFromFluid(c->overlap, FIELDS, c->shell, FlowFields, c, (double *)surface));
  PetscCall(PetscArrayzero(c->node, c->nnodes));
  for (int e = 0; e < c->shell->nfacets; e++) AddFacetForce(c, e, (const double(*)[2])surface[e]);
  PetscCall(PetscFree(surface));
  PetscFunctionReturn(0);
}

const CouplerModeTable COUPLER_MODE_STRESS_SHELL = {.velocity = COUPLER_VELOCITY_MEAN,
                                                    .needs_pressure = PETSC_TRUE,
                                                    .coefficients = Coefficients,
                                                    .force = ComputeForce};
