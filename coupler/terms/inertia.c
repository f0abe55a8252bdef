#include "coupler/terms/inertia.h"
#include "coupler/terms/outside.h"
#include "coupler/terms/slip.h"

/* An element is covered where its pairs add up to it to this part. */
#define COVERED 1e-10
/* Normals whose mean of sin^2 is below 0.1, s above 0.8, count as one (P of inertia.h). */
#define CORNER 1.25
/* Of s^SLIP_PLANE: below this D has no direction, and P is k D. */
#define CORNER_LEAST 1e-12
/* Terms of the series of a~ after the first. */
enum { NTERMS = 3 };

/* rho[nnodes]: the solid's density at its nodes now: mass over a third of the triangles around, of all ranks;
 * 0 where the node is held. */
static PetscErrorCode NodeDensities(const Overlap o, const SolidState *solid, double rho[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(rho, solid->nnodes));
  for (int t = 0; t < solid->nelements; t++) {
    const int *node = solid->element + 3 * t;
    double x[3][2];
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) x[i][c] = solid->x[2 * node[i] + c];
    const double third = GeometryArea((const double(*)[2])x) / 3.0;
    for (int i = 0; i < 3; i++) rho[node[i]] += third;
  }
  PetscCall(CopiesSum(o->nodes, 1, rho));
  for (int i = 0; i < solid->nnodes; i++)
    rho[i] = solid->mobility[i] > 0.0 && rho[i] > 0.0 ? 1.0 / (solid->mobility[i] * rho[i]) : 0.0;
  PetscFunctionReturn(0);
}

/* Mean over the vertices that are free, 0 if none is. */
static double TriangleDensity(const double rho[3])
{
  double sum = 0.0;
  int n = 0;
  for (int i = 0; i < 3; i++) {
    sum += rho[i];
    n += rho[i] > 0.0;
  }
  return n ? sum / n : 0.0;
}

PetscErrorCode InertiaCoefficients(Overlap o, const SolidState *solid, double dt, PetscBool capillary,
                                   PairTerm term[], SourceTerm source[])
{
  double *rho, (*vertex)[3];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(solid->nnodes, &rho, o->nsources, &vertex));
  PetscCall(NodeDensities(o, solid, rho));
  PetscCall(OverlapNodesToSources(o, 1, rho, (double *)vertex));
  const double fluid = o->pairs.n ? o->rho[o->pairs.pair[0].b] : HUGE_VAL, heaviest = INERTIA_MOST * fluid,
               heaviest_free = o->phases ? heaviest : INERTIA_FREE_MOST * fluid;
  for (int t = 0; t < o->nsources; t++) {
    const double density = TriangleDensity(vertex[t]);
    const PetscBool is_shell = o->source[t].is_shell ? PETSC_TRUE : PETSC_FALSE;
    source[t].held = (PetscBool)(density == 0.0);
    source[t].bulk = (PetscBool)(source[t].held && !is_shell && !o->phases);
    const PetscBool none = (PetscBool)(is_shell || (source[t].held && capillary));
    source[t].density = none ? 0.0 : source[t].held ? heaviest : fmin(density, heaviest_free);
  }
  for (int p = 0; p < o->pairs.n; p++) {
    const int t = o->pairs.pair[p].a;
    const double rho_f = o->rho[o->pairs.pair[p].b], rho_s = source[t].density;
    term[p].rho = rho_f;
    if (rho_s > 0.0)
      term[p].inertia = (source[t].bulk ? INERTIA_HELD * rho_f : fmax(rho_s, rho_f) - rho_f) / dt;
    else if (!o->source[t].is_shell)
      term[p].a = WallCoefficientIsotropic(HELD_PENALTY * rho_f / dt);
  }
  PetscCall(PetscFree2(rho, vertex));
  PetscFunctionReturn(0);
}

/* It is covered by pairs with nodes that are free: their areas and first moments are its own.  (At a crack's tip as much may lie twice as is open.) */
static PetscBool IsCovered(const Overlap o, const SourceTerm source[], int e)
{
  const int k = o->coupled_element[e];
  const double area = o->area[k], size = sqrt(area);
  double covered = 0.0, moment[2] = {0.0, 0.0};
  for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1]; i++) {
    const SupermeshPair *pair = &o->pairs.pair[o->of_element[i]];
    double d[2];
    if (source[pair->a].density == 0.0) continue;
    SupermeshCentreInB(pair, &o->source_basis[pair->a], &o->basis[k], d);
    covered += pair->area;
    for (int c = 0; c < 2; c++) moment[c] += pair->area * d[c];
  }
  for (int c = 0; c < 2; c++) {
    const double centre = (o->x[k][0][c] + o->x[k][1][c] + o->x[k][2][c]) / 3.0 - o->basis[k].origin[c];
    if (fabs(moment[c] - area * centre) > COVERED * area * size) return PETSC_FALSE;
  }
  return fabs(covered - area) < COVERED * area ? PETSC_TRUE : PETSC_FALSE;
}

double InertiaKept(const Overlap o, const SourceTerm source[], const ElementTerm *element, double ratio,
                   int e)
{
  const int k = o->coupled_element[e];
  double area = 0.0,
         excess =
             0.0; /* of pairs with inertia, and that times what the solid has beyond the fluid's density */
  for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1]; i++) {
    const SupermeshPair *pair = &o->pairs.pair[o->of_element[i]];
    const double density = source[pair->a].density;
    if (density == 0.0) continue;
    area += pair->area;
    excess += pair->area * fmax(density - o->rho[pair->b], 0.0);
  }
  if (excess == 0.0 || area > (1.0 - OUTSIDE_LEAST) * o->area[k]) return 1.0;
  return fmin(1.0, ratio * (o->rho[k] + element->outside) * area / excess);
}

static PetscBool IsHeld(const Overlap o, const SourceTerm source[], int e)
{
  for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1]; i++)
    if (IsHeldByInertia(&source[o->pairs.pair[o->of_element[i]].a])) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* P of D = q (I - s^SLIP_PLANE n n). */
static WallCoefficient Sharpened(const WallCoefficient *d, double k)
{
  const double normal = hypot(d->xx - d->yy, 2.0 * d->xy), q = 0.5 * (d->xx + d->yy + normal);
  if (k == 1.0 || normal <= CORNER_LEAST * q) return WallCoefficientScaled(d, k);
  const double plane = normal / q; /* s^SLIP_PLANE: what D lacks of q along n, over q */
  const double part = (1.0 - k) * fmin(1.0, CORNER * pow(plane, 1.0 / SLIP_PLANE)), share = k + part / plane,
               rest = -q * part * (1.0 - plane) / plane;
  return (WallCoefficient){share * d->xx + rest, share * d->xy, share * d->yy + rest};
}

void InertiaStart(Overlap o, const SourceTerm source[], double dt, ElementTerm element[], PairTerm term[])
{
  for (int e = 0; e < o->ncoupled; e++) {
    const PetscBool held = IsHeld(o, source, e);
    const double ratio = !held ? INERTIA_KEPT_RATIO : o->phases ? INERTIA_HELD_RATIO : 0.0;
    const double kept = InertiaKept(o, source, &element[e], ratio, e);
    const WallCoefficient along = Sharpened(held ? &element[e].along : &element[e].tangential, kept);
    element[e].covered =
        (PetscBool)(!o->phases && !held && WallIsZero(&element[e].tangential) && IsCovered(o, source, e));
    element[e].kept = o->phases && !held && !element[e].shared ? WallCoefficientIsotropic(kept)
                                                               : WallCoefficientScaled(&along, kept);
    element[e].freed = WallCoefficientScaled(&along, 1.0 - kept);
  }
  for (int p = 0; p < o->pairs.n; p++) {
    const ElementTerm *k = &element[o->coupled_index[p]];
    PairTerm *t = &term[p];
    if (source[o->pairs.pair[p].a].density == 0.0) continue;
    const double all = t->inertia + (k->covered ? t->rho / dt : 0.0);
    t->start = (WallCoefficient){all - t->inertia * (k->kept.xx + k->freed.xx),
                                 -t->inertia * (k->kept.xy + k->freed.xy),
                                 all - t->inertia * (k->kept.yy + k->freed.yy)};
  }
}

/* force[nnodes][2] = M a of the free nodes' densities rho. */
static PetscErrorCode ApplyMass(const Overlap o, const SolidState *solid, const double rho[],
                                const double a[], double force[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(force, 2 * solid->nnodes));
  for (int t = 0; t < solid->nelements; t++) {
    const int *node = solid->element + 3 * t;
    const double vertex[3] = {rho[node[0]], rho[node[1]], rho[node[2]]};
    double x[3][2];
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) x[i][c] = solid->x[2 * node[i] + c];
    const double mass = TriangleDensity(vertex) * GeometryArea((const double(*)[2])x) / 12.0;
    for (int c = 0; c < 2; c++) {
      const double sum = a[2 * node[0] + c] + a[2 * node[1] + c] + a[2 * node[2] + c];
      for (int i = 0; i < 3; i++) force[2 * node[i] + c] += mass * (sum + a[2 * node[i] + c]);
    }
  }
  PetscCall(CopiesSum(o->nodes, 2, force));
  PetscFunctionReturn(0);
}

PetscErrorCode InertiaNodalForces(Overlap o, const SolidState *solid, double acceleration[])
{
  const int n = solid->nnodes;
  double *rho, *a, *force;

  PetscFunctionBeginUser;
  if (!o->phases) PetscFunctionReturn(0);
  PetscCall(PetscMalloc3(n, &rho, 2 * n, &a, 2 * n, &force));
  PetscCall(NodeDensities(o, solid, rho));
  PetscCall(PetscArraycpy(a, acceleration, 2 * n));
  for (int term = 0; term < NTERMS; term++) {
    PetscCall(ApplyMass(o, solid, rho, acceleration, force));
    for (int k = 0; k < 2 * n; k++)
      if (rho[k / 2] > 0.0) acceleration[k] += a[k] - solid->mobility[k / 2] * force[k];
  }
  PetscCall(PetscFree3(rho, a, force));
  PetscFunctionReturn(0);
}

PetscErrorCode InertiaExplicitFraction(Overlap o, const SolidState *solid, const SourceTerm source[],
                                       double explicit_fraction[])
{
  enum { AREA, EXPLICIT, NSUMS };
  double(*vertex)[3][NSUMS], (*node)[NSUMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nsources, &vertex));
  PetscCall(PetscMalloc1(solid->nnodes, &node));
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (o->source[pair->a].is_shell) continue;
    const SourceTerm *s = &source[pair->a];
    const double fraction = s->bulk ? 1.0 : fmax(0.0, 1.0 - s->density / o->rho[pair->b]);
    for (int i = 0; i < 3; i++) {
      vertex[pair->a][i][AREA] += pair->area;
      vertex[pair->a][i][EXPLICIT] += fraction * pair->area;
    }
  }
  PetscCall(OverlapSourcesToNodes(o, NSUMS, (const double *)vertex, solid->nnodes, (double *)node));
  PetscCall(CopiesSum(o->nodes, NSUMS, (double *)node));
  for (int i = 0; i < solid->nnodes; i++)
    explicit_fraction[i] = node[i][AREA] > 0.0        ? node[i][EXPLICIT] / node[i][AREA]
                           : solid->mobility[i] > 0.0 ? 0.0
                                                      : 1.0;
  PetscCall(PetscFree(node));
  PetscCall(PetscFree(vertex));
  PetscFunctionReturn(0);
}
