/* What has come into elements beyond their capacity is exchanged, volume for volume, for the filler of the nearest elements
 * that have some to spare.
 *
 *     excess_K = V_K - capacity_K        room_N = min(capacity_N - V_N, filler_N)
 *
 *     distance    3   2   1   0   0      the faces to the nearest element with room; an excess goes from face to face
 *               | # | ~ | ~ |   |   |    to neighbours of smaller distance, through elements that are full of the
 *               excess -> -> room        phase, around elements that the solid covers where there is a way around
 *
 * What arrives beyond the room of an element is an excess of the next pass, which goes farther. */
#include "fluid/phases/phases_impl.h"

enum { PASSES = 100, FAR = INT_MAX };

/* In units of an element's area: less excess is not moved, less room attracts none, with less capacity a solid covers it. */
#define EXCESS_TINY 1e-13
#define ROOM_TINY 1e-6
#define CAPACITY_TINY 1e-6

typedef struct {
  double excess, room; /* m2 */
  int covered;
} Balance;

typedef struct {
  Phases f;
  int phase, filler;
  const double *capacity; /* [ne] */
  Balance *balance;       /* [nl] */
  int *distance;          /* [nl] */
  int around;             /* elements farther than this have no way around what the solid covers */
} Expel;

static double *VolumeOf(Phases f, int e)
{
  return &f->volume[(size_t)e * (size_t)f->np];
}

/* *share: of the excess of all elements, what there is room for; 0: nothing is to be moved, or nothing can be. */
static PetscErrorCode SetBalance(Expel *x, double *share)
{
  const Stars *s = x->f->stars;
  double sum[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  for (int e = 0; e < s->ne; e++) {
    const double *v = VolumeOf(x->f, e), area = StarsArea(s, e);
    const double over = v[x->phase] - x->capacity[e], room = fmin(-over, v[x->filler]);
    x->balance[e] = (Balance){over > EXCESS_TINY * area ? over : 0.0, room > ROOM_TINY * area ? room : 0.0,
                              x->capacity[e] < CAPACITY_TINY * area};
    sum[0] += x->balance[e].excess;
    sum[1] += x->balance[e].room;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->mesh->comm));
  *share = sum[0] > 0.0 ? fmin(1.0, sum[1] / sum[0]) : 0.0;
  for (int e = 0; e < s->ne; e++) x->balance[e].excess *= *share;
  if (*share > 0.0) PetscCall(StarsExchange(s, sizeof *x->balance, x->balance));
  PetscFunctionReturn(0);
}

/* An excess of element e, at this distance, may go into o. */
static int MayPass(const Expel *x, int e, int distance, int o)
{
  return distance > x->around || x->balance[e].covered || !x->balance[o].covered;
}

/* Element e is at this distance. */
static int Reached(const Expel *x, int e, int distance)
{
  for (int i = 0; i < 3; i++) {
    const int o = x->f->stars->neighbor[e][i];
    if (o < 0 || x->distance[o] < 0 || x->distance[o] == FAR) continue;
    if (MayPass(x, e, distance, o)) return 1;
  }
  return 0;
}

/* The elements at this distance, known to this rank's own only. */
static void SetLevel(Expel *x, int level, int *reached, int *missing)
{
  *reached = *missing = 0;
  for (int e = 0; e < x->f->stars->ne; e++) {
    if (x->distance[e] < FAR) continue;
    if (Reached(x, e, level)) {
      x->distance[e] = -level; /* not yet seen by its neighbours */
      *reached = 1;
    } else if (x->balance[e].excess > 0.0) {
      *missing = 1;
    }
  }
  for (int e = 0; e < x->f->stars->ne; e++) x->distance[e] = abs(x->distance[e]);
}

/* Until every excess has a way.  *levels: the largest distance. */
static PetscErrorCode SetDistances(Expel *x, int *levels)
{
  const Stars *s = x->f->stars;
  int state[2] = {1, 1}; /* the last level has elements; an excess has no way yet */
  PetscFunctionBeginUser;
  for (int e = 0; e < s->nl; e++) x->distance[e] = x->balance[e].room > 0.0 ? 0 : FAR;
  x->around = FAR;
  for (*levels = 0; state[1] && (state[0] || x->around == FAR);) {
    if (!state[0]) x->around = *levels;
    SetLevel(x, *levels + 1, &state[0], &state[1]);
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, state, 2, MPI_INT, MPI_LOR, s->mesh->comm));
    if (!state[0]) continue;
    ++*levels;
    PetscCall(StarsExchange(s, sizeof *x->distance, x->distance));
  }
  PetscFunctionReturn(0);
}

/* What part of the excess of element e goes through face i: by the room of neighbours that have some. */
static double Weight(const Expel *x, int e, int i)
{
  const int o = x->f->stars->neighbor[e][i];
  if (o < 0 || x->distance[o] >= x->distance[e] || !MayPass(x, e, x->distance[e], o)) return 0.0;
  return x->distance[e] == 1 ? x->balance[o].room : 1.0;
}

/* What element e passes on through face i. */
static double Pass(const Expel *x, int e, int i)
{
  if (!(x->balance[e].excess > 0.0) || x->distance[e] == FAR || x->distance[e] == 0) return 0.0;
  const double weight = Weight(x, e, i);
  if (!(weight > 0.0)) return 0.0;
  return x->balance[e].excess * (weight / (Weight(x, e, 0) + Weight(x, e, 1) + Weight(x, e, 2)));
}

/* Every excess crosses one face; come[ne]: what comes to each element. */
static PetscErrorCode Hop(Expel *x, double come[], double swept[])
{
  const Stars *s = x->f->stars;
  PetscFunctionBeginUser;
  for (int e = 0; e < s->ne; e++) {
    double *v = VolumeOf(x->f, e);
    come[e] = 0.0;
    for (int i = 0; i < 3; i++) {
      const int o = s->neighbor[e][i];
      if (o < 0) continue;
      const double in = Pass(x, o, StarsFaceTo(s, o, e)), out = Pass(x, e, i) - in;
      const size_t face = (3 * (size_t)e + (size_t)i) * (size_t)x->f->np;
      come[e] += in;
      v[x->phase] -= out;
      v[x->filler] += out;
      swept[face + (size_t)x->phase] += out;
      swept[face + (size_t)x->filler] -= out;
    }
  }
  for (int e = 0; e < s->ne; e++)
    if (x->distance[e] != FAR) x->balance[e].excess = x->distance[e] ? come[e] : 0.0;
  PetscCall(StarsExchange(s, sizeof *x->balance, x->balance));
  PetscFunctionReturn(0);
}

PetscErrorCode PhasesExpel(Phases f, int phase, int filler, const double capacity[], double swept[])
{
  Expel x = {.f = f, .phase = phase, .filler = filler, .capacity = capacity};
  double share = 0.0, *come;
  int levels;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(f->stars->nl, &x.balance, f->stars->nl, &x.distance, f->stars->ne, &come));
  for (int pass = 0; pass < PASSES; pass++) {
    PetscCall(SetBalance(&x, &share));
    if (!(share > 0.0)) break;
    PetscCall(SetDistances(&x, &levels));
    for (int hop = 0; hop < levels; hop++) PetscCall(Hop(&x, come, swept));
    f->has_lines = PETSC_FALSE;
  }
  PetscCall(PetscFree3(x.balance, x.distance, come));
  PetscFunctionReturn(0);
}
