#include "coupler/inertia.h"

/* c[j] = int over the pair of N_K,j u, from u at the source triangle's vertices: by component, then vertex of
 * K. */
static void CrossVelocity(const SupermeshPair *pair, const double u[3][2], double c[2][3])
{
  for (int d = 0; d < 2; d++) {
    for (int j = 0; j < 3; j++)
      c[d][j] = pair->ab[0][j] * u[0][d] + pair->ab[1][j] * u[1][d] + pair->ab[2][j] * u[2][d];
  }
}

static void AddMass(double factor, const double bb[3][3], double to[3][2][3], int c)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) to[i][c][j] += factor * bb[i][j];
}

/* to += a N_i N_j */
static void AddTensor(const WallCoefficient *a, const double bb[3][3], double to[2][3][2][3])
{
  if (WallIsZero(a)) return;
  AddMass(a->xx, bb, to[0], 0);
  AddMass(a->yy, bb, to[1], 1);
  if (a->xy == 0.0) return;
  AddMass(a->xy, bb, to[0], 1);
  AddMass(a->xy, bb, to[1], 0);
}

static void AddSource(const WallCoefficient *a, const double cu[2][3], double s[2][3])
{
  for (int i = 0; i < 3; i++) {
    s[0][i] += a->xx * cu[0][i] + a->xy * cu[1][i];
    s[1][i] += a->xy * cu[0][i] + a->yy * cu[1][i];
  }
}

static void AddSolidMass(const double bb[3][3], const double cu[2][3], CoracleCoupling *k)
{
  for (int i = 0; i < 3; i++) {
    for (int d = 0; d < 2; d++) k->us[d][i] += cu[d][i];
    for (int j = 0; j < 3; j++) k->ms[i][j] += bb[i][j];
  }
}

/* The fluid's weight from inside the solid to beside it. */
static void AddOutsideWeight(const SupermeshPair *pair, const double weight[2], double s[2][3])
{
  for (int i = 0; i < 3; i++) {
    const double moved = pair->area / 3.0 - (pair->ab[0][i] + pair->ab[1][i] + pair->ab[2][i]);
    for (int c = 0; c < 2; c++) s[c][i] += weight[c] * moved;
  }
}

/* One pair's part of its element; velocity is the integral of v over the pairs, divided by |K|, so far. */
static void AddPair(const Overlap o, const SupermeshPair *pair, const PairTerm *term, PetscBool held,
                    const double start[3][2], CoracleCoupling *k)
{
  const SourceTriangle *source = &o->source[pair->a];
  const double fraction = pair->area / o->area[pair->b];
  double cu[2][3], cq[2][3], cv[2][3];
  CrossVelocity(pair, source->u, cu);
  CrossVelocity(pair, start, cv);
  if (term->covered) k->flags |= CORACLE_IS_COVERED;
  AddSource(&term->start, (const double(*)[3])cv, k->s);
  CrossVelocity(pair, term->q, cq);
  AddTensor(&term->a, pair->bb, k->a);
  if (!held) {
    for (int i = 0; i < 9; i++) k->implicit_inertia[i / 3][i % 3] += term->inertia * pair->bb[i / 3][i % 3];
    k->flags |= CORACLE_HAS_INERTIA;
  }
  AddSource(&term->a, (const double(*)[3])cu, k->s);
  if (o->phases) AddOutsideWeight(pair, term->outside_weight, k->s);
  for (int i = 0; i < 6; i++) k->s[i / 3][i % 3] += cq[i / 3][i % 3];
  for (int d = 0; d < 2; d++) k->velocity[d] += (cv[d][0] + cv[d][1] + cv[d][2]) / o->area[pair->b];
  if (source->is_shell) {
    k->flags |= CORACLE_HAS_SHELL;
    k->shell += fraction;
  } else {
    k->alpha += fraction;
    if (held) AddSolidMass(pair->bb, (const double(*)[3])cu, k);
  }
}

void WallTermAssemble(const Overlap o, const PairTerm term[], const double density[],
                      const WallCoefficient tangential[], const double start_velocity[][3][2],
                      CoracleCoupling coupling[])
{
  for (int e = 0; e < o->ncoupled; e++) coupling[e] = (CoracleCoupling){.element = o->coupled_element[e]};
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    AddPair(o, pair, &term[p], density[pair->a] == 0.0 ? PETSC_TRUE : PETSC_FALSE, start_velocity[pair->a],
            &coupling[o->coupled_index[p]]);
  }
  for (int e = 0; e < o->ncoupled; e++) {
    const WallCoefficient kept = InertiaKept(o, &tangential[e]);
    if (!(coupling[e].flags & CORACLE_HAS_INERTIA)) continue;
    memcpy(coupling[e].kept, (double[2][2]){{kept.xx, kept.xy}, {kept.xy, kept.yy}}, sizeof coupling[e].kept);
  }
  for (int e = 0; e < o->ncoupled; e++)
    for (int d = 0; d < 2; d++) coupling[e].velocity[d] /= coupling[e].alpha + coupling[e].shell;
}
