#include "coupler/slip.h"

PetscErrorCode SlipTensors(const Overlap o, WallCoefficient tangential[])
{
  typedef struct {
    double solid, shell, xx, xy, yy; /* areas */
  } Sums;
  Sums *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->ncoupled, &sums));
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    const SourceTriangle *source = &o->source[pair->a];
    const double *n = source->normal;
    Sums *k = &sums[o->coupled_index[p]];
    if (!source->is_shell) {
      k->solid += pair->area;
      continue;
    }
    k->shell += pair->area;
    k->xx += pair->area * n[0] * n[0];
    k->xy += pair->area * n[0] * n[1];
    k->yy += pair->area * n[1] * n[1];
  }
  for (int e = 0; e < o->ncoupled; e++) {
    const Sums *k = &sums[e];
    tangential[e] = WallCoefficientIsotropic(0.0);
    if (!o->phases && k->shell > 0.0 && k->solid < 0.999 * o->area[o->coupled_element[e]])
      tangential[e] = (WallCoefficient){1.0 - k->xx / k->shell, -k->xy / k->shell, 1.0 - k->yy / k->shell};
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

void SlipCoefficients(const Overlap o, const WallCoefficient tangential[], PairTerm term[])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (o->source[pair->a].is_shell) continue;
    const WallCoefficient *d = &tangential[o->coupled_index[p]];
    if (WallIsZero(d)) continue;
    const double friction = SLIP_FRICTION * o->mu[pair->b] / o->area[pair->b];
    WallCoefficient *a = &term[p].a;
    const double difference = friction - a->xx; /* a is isotropic */
    *a = (WallCoefficient){a->xx + difference * d->xx, difference * d->xy, a->yy + difference * d->yy};
  }
}

void SlipCorrection(const Overlap o, const WallCoefficient tangential[], CoracleCorrection correction[])
{
  for (int e = 0; e < o->ncoupled; e++) {
    double(*r)[3] = correction[e].r;
    if (WallIsZero(&tangential[e])) continue;
    for (int i = 0; i < 3; i++) {
      const double ri[2] = {r[0][i], r[1][i]};
      double kept[2];
      WallApply(&tangential[e], ri, kept);
      for (int c = 0; c < 2; c++) r[c][i] -= kept[c];
    }
  }
}

void SlipRetained(const Overlap o, const WallCoefficient tangential[], const double u[][3][2],
                  const double u_projected[], double retained[][3][2])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    const WallCoefficient *d = &tangential[o->coupled_index[p]];
    if (o->source[pair->a].is_shell || WallIsZero(d)) continue;
    double slip[3][2], kept[2];
    PairSlip(pair, &u_projected[6 * pair->b], u[pair->a], slip);
    for (int i = 0; i < 3; i++) {
      WallApply(d, slip[i], kept);
      for (int c = 0; c < 2; c++) retained[pair->a][i][c] += o->rho[pair->b] * kept[c];
    }
  }
}
