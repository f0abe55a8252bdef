#include "coupler/terms/slip.h"
#include "coupler/terms/inertia.h"
#include "coupler/terms/outside.h"
#include <math.h>

#define DENSE_LEAST 0.1
/* Faces oppose each other where their mean normal is shorter: not the two of a corner of more than 74 degrees. */
#define OPPOSED 0.6
/* What is open of an element between such faces, if less, counts in part as open. */
#define CORNER_OPEN 0.3
/* Less than this of an element beside a solid among phases that is held, moved by a prescribed motion or at rest is nothing.  Its content, and with it the density of all of the element, would be that of a sliver
 * that the phases have not filled yet, and the flow along the surface that this drives, in an element that conducts as a whole, raised the water beside a block that was held, and where the
 * face of a piston passed a line of vertices stood out by 119 N for a step in a force of 46 N (tests/coupled/piston.sh; now by 4).
 * PHASES_LEAST_OPEN is the fluid's for the same elements.  A fluid so viscous that friction crosses the element within the step stays at rest without it, and with it kept a
 * jump of the pressure over a thin held ring, which drove 13 m/s beside the ring (tests/coupled/viscous.sh, rows). */
#define PHASES_LEAST 0.1

/* The part of the slip that an element among phases keeps over dt, of an area. */
static double PhasesKept(double gravity, double area, double dt)
{
  return gravity > 0.0 ? exp(-SLIP_RATE * dt * sqrt(gravity / sqrt(2.0 * area))) : 0.0;
}

/* All but DENSE_LEAST of what is open is of phases denser than what fills the solid. */
static PetscBool IsBesideDense(const Overlap o, const ElementTerm *element, int e)
{
  const int k = o->coupled_element[e];
  const double denser = o->rho_beside[k] - o->rho[k];
  return (PetscBool)(denser > 0.0 && element->outside > (1.0 - DENSE_LEAST) * denser);
}

/* Of the e-th coupled element: less of it beside the solid is nothing.  Where a free solid slides on one that is held it is the gap between them. */
static double LeastOpen(const Overlap o, const SourceTerm term[], double dt, int e)
{
  const int k = o->coupled_element[e];
  PetscBool covers = (PetscBool)(o->phases && o->mu[k] * dt < o->rho_mean[k] * o->area[k]);
  for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1] && covers; i++) {
    const int a = o->pairs.pair[o->of_element[i]].a;
    for (int v = 0; v < 3 && !term[a].held; v++)
      covers = (PetscBool)(covers && o->source[a].u[v][0] == 0.0 && o->source[a].u[v][1] == 0.0);
  }
  return covers ? PHASES_LEAST : OUTSIDE_LEAST;
}

/* Parts of the solid, over an element's area: no slip is kept at the corners of those up to SMALL, all of it from LARGE on. */
#define SMALL 4.0
#define LARGE 16.0

/* Area of an element's pairs of the shell, and the integrals of n and n n over it. */
typedef struct {
  double area, x, y, xx, xy, yy;
} NormalSums;

static void AddNormal(double area, const double n[2], NormalSums *sums)
{
  sums->area += area;
  sums->x += area * n[0];
  sums->y += area * n[1];
  sums->xx += area * n[0] * n[0];
  sums->xy += area * n[0] * n[1];
  sums->yy += area * n[1] * n[1];
}

/* s: 1 where the surface is plane. */
static double Planeness(const NormalSums *sums)
{
  return hypot(sums->xx - sums->yy, 2.0 * sums->xy) / sums->area;
}

/* I - s^SLIP_PLANE n n; 0 without a surface. */
static WallCoefficient SlipTensor(const NormalSums *sums)
{
  if (sums->area == 0.0) return WallCoefficientIsotropic(0.0);
  const double xx = sums->xx / sums->area, xy = sums->xy / sums->area, yy = sums->yy / sums->area;
  const double s = Planeness(sums), part = pow(s, SLIP_PLANE - 1.0), rest = 1.0 + 0.5 * part * (1.0 - s);
  return (WallCoefficient){rest - part * xx, -part * xy, rest - part * yy};
}

/* q of slip.h: the part of the slip that is kept between faces that oppose each other, some of which are held, `open` of the element being open. */
static double KeptBetween(const NormalSums *sums, const NormalSums *held, double open)
{
  if (sums->area == 0.0 || hypot(sums->x, sums->y) >= OPPOSED * sums->area) return 1.0;
  const double s = Planeness(sums);
  return fmin(1.0, open / CORNER_OPEN + (held->area < sums->area ? 2.0 * s * s : 0.0));
}

/* The part of the slip that is kept at a corner of a part of the solid, `size` over the element's area. */
static double KeptAtCorner(double size)
{
  return fmin(1.0, fmax(0.0, (size - SMALL) / (LARGE - SMALL)));
}

void SlipTensors(const Overlap o, const SourceTerm term[], const double gravity[2], double dt,
                 ElementTerm element[])
{
  const double g = hypot(gravity[0], gravity[1]);
  for (int e = 0; e < o->ncoupled; e++) {
    NormalSums all = {.area = 0.0}, held = {.area = 0.0};
    const double solid = o->solid_area[e];
    double part = HUGE_VAL;
    for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1]; i++) {
      const SupermeshPair *pair = &o->pairs.pair[o->of_element[i]];
      const SourceTriangle *source = &o->source[pair->a];
      if (!source->is_shell) continue;
      part = fmin(part, source->part);
      AddNormal(pair->area, source->normal, &all);
      if (term[pair->a].held) AddNormal(pair->area, source->normal, &held);
    }
    ElementTerm *k = &element[e];
    const double area = o->area[o->coupled_element[e]];
    const PetscBool shared =
        (PetscBool)(solid >= (1.0 - OUTSIDE_LEAST) * area && solid + all.area > (1.0 + OUTSIDE_LEAST) * area);
    k->open = (PetscBool)(solid < (1.0 - LeastOpen(o, term, dt, e)) * area);
    k->corner = (PetscBool)(all.area > 0.0 && Planeness(&all) < SLIP_CORNER);
    k->along = k->tangential = WallCoefficientIsotropic(0.0);
    k->shared = (PetscBool)(o->phases && shared && held.area > 0.0);
    if (!k->open && !shared) continue;
    k->along = SlipTensor(o->phases ? &held : &all);
    if (!o->phases) {
      double kept = k->open ? KeptBetween(&all, &held, 1.0 - solid / area) : 1.0;
      if (k->open && k->corner) kept *= KeptAtCorner(part / area);
      k->tangential = WallCoefficientScaled(&k->along, kept);
    }
    if (!o->phases || !k->open || held.area > 0.0 || !IsBesideDense(o, k, e)) continue;
    if (InertiaKept(o, term, k, INERTIA_KEPT_RATIO, e) < 1.0) continue;
    const WallCoefficient d = SlipTensor(&all);
    k->tangential = WallCoefficientScaled(&d, PhasesKept(g, area, dt));
  }
}

void SlipCoefficients(const Overlap o, const ElementTerm element[], PairTerm term[])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (o->source[pair->a].is_shell) continue;
    const WallCoefficient *d = &element[o->coupled_index[p]].tangential;
    if (WallIsZero(d)) continue;
    const double friction = SLIP_FRICTION * o->mu[pair->b] / o->area[pair->b];
    term[p].a = WallCoefficientScaled(d, friction);
  }
}

void SlipCorrection(const Overlap o, const ElementTerm element[], CoracleCorrection correction[])
{
  for (int e = 0; e < o->ncoupled; e++) {
    double(*r)[3] = correction[e].r;
    if (!element[e].open || WallIsZero(&element[e].tangential)) continue;
    for (int i = 0; i < 3; i++) {
      const double ri[2] = {r[0][i], r[1][i]};
      double kept[2];
      WallApply(&element[e].tangential, ri, kept);
      for (int c = 0; c < 2; c++) r[c][i] -= kept[c];
    }
  }
}

void SlipRetained(const Overlap o, const ElementTerm element[], const LinearField u[],
                  const double u_projected[], double retained[][3][2])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    const SupermeshBasis *basis = &o->basis[pair->b], *source = &o->source_basis[pair->a];
    const WallCoefficient *tangential = &element[o->coupled_index[p]].tangential;
    if (o->source[pair->a].is_shell || WallIsZero(tangential)) continue;
    const WallCoefficient kept = WallCoefficientScaled(tangential, o->rho[pair->b]);
    const LinearField flow = LinearFieldOnElement(basis, &u_projected[6 * pair->b]);
    LinearField slip, momentum = {{0.0}, {{0.0}}};
    VectorMoments sums = {{0.0}, {{0.0}}};
    double d[2], vertex[3][2];
    SupermeshCentreInB(pair, source, basis, d);
    slip = LinearFieldAt(&flow, d);
    const LinearField us = LinearFieldAt(&u[pair->a], pair->centre);
    LinearFieldAdd(-1.0, &us, &slip);
    WallAdd(&kept, &slip, &momentum);
    VectorMomentsAdd(pair, &momentum, pair->centre, &sums);
    VectorMomentsVertices(source, &sums, vertex);
    for (int i = 0; i < 6; i++) retained[pair->a][i / 2][i % 2] += vertex[i / 2][i % 2];
  }
}
