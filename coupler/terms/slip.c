#include "coupler/terms/slip.h"
#include "coupler/terms/outside.h"
#include <math.h>

/* D of M, a mean of n n. */
static WallCoefficient SlipTensor(double xx, double xy, double yy)
{
  const double s = hypot(xx - yy, 2.0 * xy), part = pow(s, SLIP_PLANE - 1.0),
               rest = 1.0 + 0.5 * part * (1.0 - s);
  return (WallCoefficient){rest - part * xx, -part * xy, rest - part * yy};
}

void SlipTensors(const Overlap o, const SourceTerm term[], ElementTerm element[])
{
  for (int e = 0; e < o->ncoupled; e++) {
    double solid = 0.0, all = 0.0, shell = 0.0, xx = 0.0, xy = 0.0, yy = 0.0; /* areas */
    for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1]; i++) {
      const SupermeshPair *pair = &o->pairs.pair[o->of_element[i]];
      const SourceTriangle *source = &o->source[pair->a];
      const double *n = source->normal;
      if (!source->is_shell) solid += pair->area;
      if (!source->is_shell) continue;
      all += pair->area;
      if (o->phases && !term[pair->a].held) continue;
      shell += pair->area;
      xx += pair->area * n[0] * n[0];
      xy += pair->area * n[0] * n[1];
      yy += pair->area * n[1] * n[1];
    }
    const double area = o->area[o->coupled_element[e]];
    const PetscBool open = element[e].open = (PetscBool)(solid < (1.0 - OUTSIDE_LEAST) * area),
                    shared = (PetscBool)(!open && solid + all > (1.0 + OUTSIDE_LEAST) * area);
    element[e].along = element[e].tangential = WallCoefficientIsotropic(0.0);
    if (shell > 0.0 && (open || shared)) element[e].along = SlipTensor(xx / shell, xy / shell, yy / shell);
    if (!o->phases) element[e].tangential = element[e].along;
    element[e].shared = (PetscBool)(o->phases && shared && shell > 0.0);
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
