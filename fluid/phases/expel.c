/* What has come into elements beyond their capacity is exchanged, volume for volume, for the filler of neighbours.
 *
 *     excess_K = V_K - capacity_K        room_N = min(capacity_N - V_N, filler_N)
 *     K offers its excess to its neighbours in proportion to their room; N accepts of all offers what it has room for */
#include "fluid/phases/phases_impl.h"

enum { ROUNDS = 4 };

/* Less than this of an element is not moved. */
#define EXCESS_TINY 1e-13

typedef struct {
  double excess, room; /* m2 */
} Balance;

typedef struct {
  Phases f;
  int phase, filler;
  const double *capacity; /* [ne] */
  Balance *balance;       /* [nl] */
  double *accepted;       /* [nl] share of the offers that an element takes */
} Expel;

static double *VolumeOf(Phases f, int e)
{
  return &f->volume[(size_t)e * (size_t)f->np];
}

/* *any: some element of any rank has an excess. */
static PetscErrorCode SetBalance(Expel *x, int *any)
{
  const Stars *s = x->f->stars;
  PetscFunctionBeginUser;
  *any = 0;
  for (int e = 0; e < s->ne; e++) {
    const double *v = VolumeOf(x->f, e), over = v[x->phase] - x->capacity[e];
    const int has = over > EXCESS_TINY * 0.5 * StarsTwiceArea(s, e);
    x->balance[e] = (Balance){has ? over : 0.0, fmax(fmin(-over, v[x->filler]), 0.0)};
    *any |= has;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPI_INT, MPI_LOR, s->mesh->comm));
  if (*any) PetscCall(StarsExchange(s, sizeof *x->balance, x->balance));
  PetscFunctionReturn(0);
}

/* What element e offers to its neighbour across face i. */
static double Offer(const Expel *x, int e, int i)
{
  const int *neighbor = x->f->stars->neighbor[e];
  double all = 0.0;
  if (neighbor[i] < 0 || !(x->balance[e].excess > 0.0)) return 0.0;
  for (int k = 0; k < 3; k++)
    if (neighbor[k] >= 0) all += x->balance[neighbor[k]].room;
  return all > 0.0 ? x->balance[e].excess * fmin(x->balance[neighbor[i]].room / all, 1.0) : 0.0;
}

/* The face of o at which e lies. */
static int FaceTo(const Stars *s, int o, int e)
{
  return s->neighbor[o][0] == e ? 0 : s->neighbor[o][1] == e ? 1 : 2;
}

static PetscErrorCode Accept(Expel *x)
{
  const Stars *s = x->f->stars;
  PetscFunctionBeginUser;
  for (int e = 0; e < s->ne; e++) {
    double offered = 0.0;
    for (int i = 0; i < 3; i++) {
      const int o = s->neighbor[e][i];
      if (o >= 0) offered += Offer(x, o, FaceTo(s, o, e));
    }
    x->accepted[e] = offered > x->balance[e].room ? x->balance[e].room / offered : 1.0;
  }
  PetscCall(StarsExchange(s, sizeof *x->accepted, x->accepted));
  PetscFunctionReturn(0);
}

static void Move(Expel *x, double swept[])
{
  const Stars *s = x->f->stars;
  for (int k = 0; k < 3 * s->ne; k++) {
    const int e = k / 3, o = s->neighbor[e][k % 3];
    if (o < 0) continue;
    const double out = Offer(x, e, k % 3) * x->accepted[o] - Offer(x, o, FaceTo(s, o, e)) * x->accepted[e];
    VolumeOf(x->f, e)[x->phase] -= out;
    VolumeOf(x->f, e)[x->filler] += out;
    swept[k * x->f->np + x->phase] += out;
    swept[k * x->f->np + x->filler] -= out;
  }
}

PetscErrorCode PhasesExpel(Phases f, int phase, int filler, const double capacity[], double swept[])
{
  Expel x = {.f = f, .phase = phase, .filler = filler, .capacity = capacity};
  int any;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(f->stars->nl, &x.balance, f->stars->nl, &x.accepted));
  for (int round = 0; round < ROUNDS; round++) {
    PetscCall(SetBalance(&x, &any));
    if (!any) break;
    PetscCall(Accept(&x));
    Move(&x, swept);
    f->has_lines = PETSC_FALSE;
  }
  PetscCall(PetscFree2(x.balance, x.accepted));
  PetscFunctionReturn(0);
}
