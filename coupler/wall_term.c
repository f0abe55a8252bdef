#include "coupler/inertia.h"

/* Sums over the pairs of one element, with its basis as the origin. */
typedef struct {
  MassMoments xx, xy, yy; /* of a */
  MassMoments inertia, solid;
  VectorMoments s, us;
  double velocity[2], area;     /* int v, m2 */
  double alpha, shell, outside; /* m2; outside: of pairs that move weight to beside the solid */
  int flags;
} ElementSums;

/* d: the pair's centre from the origin of its element. */
static void AddPair(const SupermeshPair *pair, const PairTerm *term, const ElementTerm *element,
                    const SourceTerm *source, PetscBool is_shell, const double gravity[2], const double d[2],
                    ElementSums *k)
{
  const MassMoments mass = PairMass(pair, d);
  const LinearField start = LinearFieldAt(&source->start, pair->centre),
                    us = LinearFieldAt(&source->velocity, pair->centre);
  LinearField density = {{0.0}, {{0.0}}};
  if (!WallIsZero(&term->a)) {
    WallAdd(&term->a, &us, &density);
    MassMomentsAdd(term->a.xx, &mass, &k->xx);
    MassMomentsAdd(term->a.yy, &mass, &k->yy);
    if (term->a.xy != 0.0) MassMomentsAdd(term->a.xy, &mass, &k->xy);
  }
  if (source->density > 0.0) {
    const LinearField body = PairBodyForce(term, source, gravity, pair->centre);
    LinearFieldAdd(1.0, &body, &density);
    WallAdd(&term->start, &start, &density);
    MassMomentsAdd(term->inertia, &mass, &k->inertia);
    for (int c = 0; c < 2; c++) density.value[c] -= element->outside_weight[c];
    k->outside += pair->area;
    k->flags |= CORACLE_HAS_INERTIA;
  }
  VectorMomentsAdd(pair, &density, d, &k->s);
  for (int c = 0; c < 2; c++) k->velocity[c] += pair->area * start.value[c];
  if (is_shell) {
    k->flags |= CORACLE_HAS_SHELL;
    k->shell += pair->area;
  } else {
    k->alpha += pair->area;
    if (source->density > 0.0) return;
    MassMomentsAdd(1.0, &mass, &k->solid);
    VectorMomentsAdd(pair, &us, d, &k->us);
  }
}

/* int a N_i N_j of one component of a to a[c][i][d][j] */
static void SetTensor(const SupermeshBasis *basis, const MassMoments *m, int c, int d, CoracleCoupling *k)
{
  double matrix[3][3];
  if (m->zero == 0.0) return;
  MassMomentsMatrix(basis, m, matrix);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) k->a[c][i][d][j] = matrix[i][j];
}

static void SetVectors(const SupermeshBasis *basis, const VectorMoments *m, double to[2][3])
{
  double vertex[3][2];
  VectorMomentsVertices(basis, m, vertex);
  for (int i = 0; i < 6; i++) to[i / 3][i % 3] = vertex[i % 3][i / 3];
}

/* Of element K, whose coupling is 0 so far. */
static void SetCoupling(const Overlap o, const ElementSums *sums, const ElementTerm *element,
                        CoracleCoupling *k)
{
  const SupermeshBasis *basis = &o->basis[k->element];
  const double area = o->area[k->element], both = sums->alpha + sums->shell;
  k->flags = sums->flags | (element->covered ? CORACLE_IS_COVERED : 0);
  k->alpha = sums->alpha / area;
  k->shell = sums->shell / area;
  SetTensor(basis, &sums->xx, 0, 0, k);
  SetTensor(basis, &sums->yy, 1, 1, k);
  SetTensor(basis, &sums->xy, 0, 1, k);
  SetTensor(basis, &sums->xy, 1, 0, k);
  SetVectors(basis, &sums->s, k->s);
  for (int i = 0; i < 6; i++) k->s[i / 3][i % 3] += element->outside_weight[i / 3] * sums->outside / 3.0;
  for (int c = 0; c < 2; c++) k->velocity[c] = sums->velocity[c] / both;
  if (sums->solid.zero > 0.0) {
    MassMomentsMatrix(basis, &sums->solid, k->ms);
    SetVectors(basis, &sums->us, k->us);
  }
  if (!(sums->flags & CORACLE_HAS_INERTIA)) return;
  const WallCoefficient kept = InertiaKept(o, &element->tangential);
  memcpy(k->kept, (double[2][2]){{kept.xx, kept.xy}, {kept.xy, kept.yy}}, sizeof k->kept);
  MassMomentsMatrix(basis, &sums->inertia, k->implicit_inertia);
}

void WallTermAssemble(const Overlap o, const PairTerm term[], const ElementTerm element[],
                      const SourceTerm source[], const double gravity[2], CoracleCoupling coupling[])
{
  for (int e = 0; e < o->ncoupled; e++) {
    ElementSums sums = {.flags = 0};
    coupling[e] = (CoracleCoupling){.element = o->coupled_element[e]};
    for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1]; i++) {
      const int p = o->of_element[i];
      const SupermeshPair *pair = &o->pairs.pair[p];
      double d[2];
      SupermeshCentreInB(pair, &o->source_basis[pair->a], &o->basis[pair->b], d);
      AddPair(pair, &term[p], &element[e], &source[pair->a], (PetscBool)o->source[pair->a].is_shell, gravity,
              d, &sums);
    }
    SetCoupling(o, &sums, &element[e], &coupling[e]);
  }
}
