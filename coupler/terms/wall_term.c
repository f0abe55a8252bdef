#include "coupler/terms/inertia.h"

/* Sums over the pairs of one element, with its basis as the origin: of all elements, and of those with an a or what is held. */
typedef struct {
  VectorMoments s;
  MassMoments inertia;
  double velocity[2];           /* int v */
  double alpha, shell, outside; /* m2; outside: of pairs that move weight to beside the solid */
  int flags, has_wall;
} ElementSums;
typedef struct {
  MassMoments xx, xy, yy; /* of a */
  MassMoments solid;      /* held */
  VectorMoments us;       /* held */
} WallSums;

/* a of one pair, and what is held; density += a u_s. */
static void AddWall(const SupermeshPair *pair, const WallCoefficient *a, const SourceTerm *source,
                    PetscBool held, const MassMoments *mass, const double d[2], LinearField *density,
                    WallSums *w)
{
  const LinearField us = LinearFieldAt(&source->velocity, pair->centre);
  WallAdd(a, &us, density);
  MassMomentsAdd(a->xx, mass, &w->xx);
  MassMomentsAdd(a->xy, mass, &w->xy);
  MassMomentsAdd(a->yy, mass, &w->yy);
  if (!held) return;
  MassMomentsAdd(1.0, mass, &w->solid);
  VectorMomentsAdd(pair, &us, d, &w->us);
}

/* The solid's inertia of one pair; density += what it begins with and the body force. */
static void AddInertia(const SupermeshPair *pair, const PairTerm *term, const ElementTerm *element,
                       const SourceTerm *source, const double gravity[2], const MassMoments *mass,
                       LinearField *density, ElementSums *k)
{
  const LinearField body = PairBodyForce(term, element, source, gravity, pair->centre);
  LinearFieldAdd(1.0, &body, density);
  for (int c = 0; c < 2; c++) density->value[c] -= element->outside * gravity[c];
  if (!WallIsZero(&term->start)) {
    const LinearField start = LinearFieldAt(InertiaBegins(source), pair->centre);
    WallAdd(&term->start, &start, density);
  }
  MassMomentsAdd(term->inertia, mass, &k->inertia);
  k->outside += pair->area;
  k->flags |= CORACLE_HAS_INERTIA;
}

/* d: the pair's centre from the origin of its element. */
static void AddPair(const SupermeshPair *pair, const PairTerm *term, const ElementTerm *element,
                    const SourceTerm *source, PetscBool is_shell, const double gravity[2], const double d[2],
                    ElementSums *k, WallSums *w)
{
  const PetscBool is_free = source->density > 0.0 ? PETSC_TRUE : PETSC_FALSE,
                  held = (PetscBool)(!is_shell && (!is_free || source->bulk));
  if (source->held && !is_shell) k->flags |= CORACLE_IS_HELD;
  const MassMoments mass = PairMass(pair, d);
  LinearField density = {{0.0}, {{0.0}}};
  double v[2];
  LinearFieldValue(&source->start, pair->centre, v);
  for (int c = 0; c < 2; c++) k->velocity[c] += pair->area * v[c];
  *(is_shell ? &k->shell : &k->alpha) += pair->area;
  if (is_shell) k->flags |= CORACLE_HAS_SHELL;
  if (is_free) AddInertia(pair, term, element, source, gravity, &mass, &density, k);
  if (held || !WallIsZero(&term->a)) {
    if (!k->has_wall) *w = (WallSums){.us = {{0.0}, {{0.0}}}};
    k->has_wall = 1;
    AddWall(pair, &term->a, source, held, &mass, d, &density, w);
  }
  VectorMomentsAdd(pair, &density, d, &k->s);
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
static void SetCoupling(const Overlap o, const ElementSums *sums, const WallSums *w,
                        const ElementTerm *element, const double gravity[2], CoracleCoupling *k)
{
  const SupermeshBasis *basis = &o->basis[k->element];
  const double area = o->area[k->element];
  k->flags =
      sums->flags | (element->covered ? CORACLE_IS_COVERED : 0) | (element->corner ? CORACLE_HAS_CORNER : 0);
  k->alpha = sums->alpha / area;
  k->shell = sums->shell / area;
  for (int c = 0; c < 2; c++) k->velocity[c] = sums->velocity[c] / (sums->alpha + sums->shell);
  SetVectors(basis, &sums->s, k->s);
  for (int i = 0; i < 6; i++) k->s[i / 3][i % 3] += element->outside * gravity[i / 3] * sums->outside / 3.0;
  if (sums->flags & CORACLE_HAS_INERTIA) {
    const WallCoefficient kept = element->kept, freed = element->freed;
    memcpy(k->kept, (double[2][2]){{kept.xx, kept.xy}, {kept.xy, kept.yy}}, sizeof k->kept);
    memcpy(k->inertia_tensor, (double[2][2]){{1.0 - freed.xx, -freed.xy}, {-freed.xy, 1.0 - freed.yy}},
           sizeof k->inertia_tensor);
    MassMomentsMatrix(basis, &sums->inertia, k->implicit_inertia);
  }
  if (!sums->has_wall) return;
  SetTensor(basis, &w->xx, 0, 0, k);
  SetTensor(basis, &w->yy, 1, 1, k);
  SetTensor(basis, &w->xy, 0, 1, k);
  SetTensor(basis, &w->xy, 1, 0, k);
  MassMomentsMatrix(basis, &w->solid, k->ms);
  SetVectors(basis, &w->us, k->us);
  if (WallIsZero(&element->along)) return;
  const double part = fmin(1.0, (1.0 - BULK_LEAST) * area / w->solid.zero);
  for (int i = 0; i < 9; i++) k->ms[i / 3][i % 3] *= part;
  for (int i = 0; i < 6; i++) k->us[i / 3][i % 3] *= part;
}

PetscErrorCode WallTermAssemble(const Overlap o, const PairTerm term[], const ElementTerm element[],
                                const SourceTerm source[], const double gravity[2],
                                CoracleCoupling coupling[])
{
  WallSums w;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(coupling, o->ncoupled));
  for (int e = 0; e < o->ncoupled; e++) {
    ElementSums sums = {.flags = 0};
    coupling[e].element = o->coupled_element[e];
    for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1]; i++) {
      const int p = o->of_element[i];
      const SupermeshPair *pair = &o->pairs.pair[p];
      double d[2];
      SupermeshCentreInB(pair, &o->source_basis[pair->a], &o->basis[pair->b], d);
      AddPair(pair, &term[p], &element[e], &source[pair->a], (PetscBool)o->source[pair->a].is_shell, gravity,
              d, &sums, &w);
    }
    SetCoupling(o, &sums, &w, &element[e], gravity, &coupling[e]);
  }
  PetscFunctionReturn(0);
}
