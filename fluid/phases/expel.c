/* What has come into elements beyond their capacity is exchanged, volume for volume, for the filler of the nearest elements
 * that have some to spare.
 *
 *     excess_K = V_K - capacity_K        room_N = min(capacity_N - V_N, filler_N)
 *
 *     distance    3   2   1   0   0      the faces to the nearest element with room; an excess goes from face to face
 *               | # | ~ | ~ |   |   |    to neighbours of smaller distance, through elements that are full of the
 *               excess -> -> room        phase, around elements that the solid covers where there is a way around
 *
 * What arrives beyond the room of an element is an excess of the next pass, which goes farther.
 *
 * The first pass takes what has come into covered elements to the nearest others, which need no room: on the side where it came in.  (The nearest room may
 * be behind the solid: a wall leaked.) */
#include "fluid/phases/phases_impl.h"

enum { PASSES = 100, FAR = INT_MAX };

/* In units of an element's area: less excess is not moved, less room attracts none, with less capacity it is covered. */
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
  const char *covered;    /* [ne] or NULL */
  int uncovers;           /* the first pass */
  Balance *balance;       /* [nl] */
  int *distance;          /* [nl] */
  int around;             /* elements farther than this have no way around what the solid covers */
  int nactive, *active;   /* elements with an excess, of other ranks, too */
  int nfront, *front;     /* those of the largest distance so far; in a hop, owned ones that change */
  int *next;              /* [nl] scratch */
  double *come;           /* [ne] what a hop brings */
  int nchanged, *changed; /* owned elements that the hops of a pass have changed */
  char *is_changed;       /* [ne] */
  double room;            /* m2, of this rank's elements */
} Expel;

static double *VolumeOf(Phases f, int e)
{
  return &f->volume[(size_t)e * (size_t)f->np];
}

/* Element e, if it has an excess. */
static void AddActive(Expel *x, int e)
{
  if (x->balance[e].excess > 0.0) x->active[x->nactive++] = e;
}

/* What other ranks have of balances, and which of their elements have an excess. */
static PetscErrorCode ExchangeBalance(Expel *x)
{
  const Stars *s = x->f->stars;
  PetscFunctionBeginUser;
  PetscCall(StarsExchange(s, sizeof *x->balance, x->balance));
  for (int e = s->ne; e < s->nl; e++) AddActive(x, e);
  PetscFunctionReturn(0);
}

/* The balance of owned element e; what it changes is added to the sums of room and excess, and to that of excess in covered elements. */
static void SetElementBalance(Expel *x, int e, double *excess, double *inside)
{
  const double *v = VolumeOf(x->f, e), area = StarsArea(x->f->stars, e);
  const double over = v[x->phase] - x->capacity[e], room = fmin(-over, v[x->filler]);
  Balance *b = &x->balance[e];
  x->room -= b->room;
  *b = (Balance){over > EXCESS_TINY * area ? over : 0.0, room > ROOM_TINY * area ? room : 0.0,
                 x->covered ? x->covered[e] : x->capacity[e] < CAPACITY_TINY * area};
  x->room += b->room;
  *excess += b->excess;
  *inside += b->covered ? b->excess : 0.0;
}

/* After a pass those of elements that it has changed, among which are all with an excess.  *share: of the excess of all elements, what there is
 * room for; 0: nothing is to be moved, or nothing can be; *inside: that of covered ones, m2. */
static PetscErrorCode SetBalance(Expel *x, double *share, double *inside)
{
  const Stars *s = x->f->stars;
  double sum[3] = {0.0, 0.0, 0.0}; /* excess, that of covered ones, room */
  PetscFunctionBeginUser;
  for (int k = 0; k < x->nchanged; k++) SetElementBalance(x, x->changed[k], &sum[0], &sum[1]);
  sum[2] = x->room;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, s->mesh->comm));
  *share = sum[0] > 0.0 ? fmin(1.0, sum[2] / sum[0]) : 0.0;
  *inside = sum[1];
  x->nactive = 0;
  if (!(*share > 0.0)) PetscFunctionReturn(0);
  for (int k = 0; k < x->nchanged; k++) {
    x->balance[x->changed[k]].excess *= *share;
    AddActive(x, x->changed[k]);
  }
  PetscCall(ExchangeBalance(x));
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

/* Element e, if it is at this distance, has it from now on, but not yet as its neighbours see it. */
static void Visit(Expel *x, int e, int level, int *n)
{
  if (x->distance[e] < FAR || !Reached(x, e, level)) return;
  x->distance[e] = -level;
  x->next[(*n)++] = e;
}

/* The owned elements at this distance: beside the front, or anywhere, where there is no front or a way has been opened. */
static void SetLevel(Expel *x, int level, int anywhere, int *reached, int *missing)
{
  const Stars *s = x->f->stars;
  int n = 0;
  for (int e = 0; e < s->ne && anywhere; e++) Visit(x, e, level, &n);
  for (int k = 0; k < x->nfront && !anywhere; k++)
    for (int i = 0; i < 3; i++) {
      const int o = s->neighbor[x->front[k]][i];
      if (o >= 0 && o < s->ne) Visit(x, o, level, &n);
    }
  for (int k = 0; k < n; k++) x->distance[x->front[k] = x->next[k]] = level;
  x->nfront = n;
  *reached = n > 0;
  *missing = 0;
  for (int k = 0; k < x->nactive; k++)
    if (x->active[k] < s->ne) *missing |= x->distance[x->active[k]] == FAR;
}

/* An excess ends there. */
static int IsEnd(const Expel *x, int e)
{
  return x->uncovers ? !x->balance[e].covered : x->balance[e].room > 0.0;
}

/* Until every excess has a way.  *levels: the largest distance. */
static PetscErrorCode SetDistances(Expel *x, int *levels)
{
  const Stars *s = x->f->stars;
  int state[2] = {1, 1}; /* the last level has elements; an excess has no way yet */
  PetscFunctionBeginUser;
  for (int e = 0; e < s->nl; e++) x->distance[e] = IsEnd(x, e) ? 0 : FAR;
  x->around = FAR;
  for (*levels = 0; state[1] && (state[0] || x->around == FAR);) {
    const int stuck = !state[0];
    if (stuck) x->around = *levels;
    SetLevel(x, *levels + 1, *levels == 0 || stuck, &state[0], &state[1]);
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, state, 2, MPI_INT, MPI_LOR, s->mesh->comm));
    if (!state[0]) continue;
    ++*levels;
    PetscCall(StarsExchange(s, sizeof *x->distance, x->distance));
    for (int e = s->ne; e < s->nl; e++)
      if (x->distance[e] == *levels) x->front[x->nfront++] = e;
  }
  PetscFunctionReturn(0);
}

/* What part of the excess of element e goes through face i: by the room of neighbours that have some. */
static double Weight(const Expel *x, int e, int i)
{
  const int o = x->f->stars->neighbor[e][i];
  if (o < 0 || x->distance[o] >= x->distance[e] || !MayPass(x, e, x->distance[e], o)) return 0.0;
  return x->distance[e] == 1 && !x->uncovers ? x->balance[o].room : 1.0;
}

/* What element e passes on through face i. */
static double Pass(const Expel *x, int e, int i)
{
  if (!(x->balance[e].excess > 0.0) || x->distance[e] == FAR || x->distance[e] == 0) return 0.0;
  const double weight = Weight(x, e, i);
  if (!(weight > 0.0)) return 0.0;
  return x->balance[e].excess * (weight / (Weight(x, e, 0) + Weight(x, e, 1) + Weight(x, e, 2)));
}

/* The owned elements that have an excess or are beside one, into front; their number. */
static int ListChanging(Expel *x)
{
  const Stars *s = x->f->stars;
  int n = 0;
  for (int k = 0; k < x->nactive; k++)
    for (int i = -1; i < 3; i++) {
      const int e = i < 0 ? x->active[k] : s->neighbor[x->active[k]][i];
      if (e < 0 || e >= s->ne || x->next[e]) continue;
      x->next[e] = 1;
      x->front[n++] = e;
    }
  for (int k = 0; k < n; k++) x->next[x->front[k]] = 0;
  return n;
}

/* What comes to element e and leaves it. */
static void Exchange(Expel *x, int e, double swept[])
{
  const Stars *s = x->f->stars;
  double *v = VolumeOf(x->f, e);
  x->come[e] = 0.0;
  for (int i = 0; i < 3; i++) {
    const int o = s->neighbor[e][i];
    if (o < 0) continue;
    const double in = Pass(x, o, StarsFaceTo(s, o, e)), out = Pass(x, e, i) - in;
    const size_t face = (3 * (size_t)e + (size_t)i) * (size_t)x->f->np;
    x->come[e] += in;
    v[x->phase] -= out;
    v[x->filler] += out;
    swept[face + (size_t)x->phase] += out;
    swept[face + (size_t)x->filler] -= out;
  }
}

/* Every excess crosses one face. */
static PetscErrorCode Hop(Expel *x, double swept[])
{
  const int n = ListChanging(x);
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) {
    const int e = x->front[k];
    Exchange(x, e, swept);
    if (!x->is_changed[e]) x->changed[x->nchanged++] = e;
    x->is_changed[e] = 1;
  }
  x->nactive = 0;
  for (int k = 0; k < n; k++) {
    const int e = x->front[k];
    if (x->distance[e] != FAR) x->balance[e].excess = x->distance[e] ? x->come[e] : 0.0;
    AddActive(x, e);
  }
  PetscCall(ExchangeBalance(x));
  PetscFunctionReturn(0);
}

/* Every excess goes to the nearest element with room, or that is not covered. */
static PetscErrorCode MakePass(Expel *x, double swept[])
{
  int levels;
  PetscFunctionBeginUser;
  PetscCall(SetDistances(x, &levels));
  for (int k = 0; k < x->nchanged; k++) x->is_changed[x->changed[k]] = 0;
  x->nchanged = 0;
  PetscCall(PetscArrayzero(x->next, x->f->stars->nl));
  for (int hop = 0; hop < levels; hop++) PetscCall(Hop(x, swept));
  x->f->has_lines = PETSC_FALSE;
  PetscFunctionReturn(0);
}

PetscErrorCode PhasesExpel(Phases f, int phase, int filler, const double capacity[], const char covered[],
                           double swept[])
{
  const int ne = f->stars->ne, nl = f->stars->nl;
  Expel x = {.f = f, .phase = phase, .filler = filler, .capacity = capacity, .covered = covered};
  double share = 0.0, inside = 0.0;
  PetscFunctionBeginUser;
  PetscCall(
      PetscMalloc6(nl, &x.distance, nl, &x.active, nl, &x.front, nl, &x.next, ne, &x.come, ne, &x.changed));
  PetscCall(PetscCalloc2(nl, &x.balance, ne, &x.is_changed));
  for (int e = 0; e < ne; e++) x.changed[x.nchanged++] = e;
  for (int pass = 0; pass < PASSES; pass++) {
    PetscCall(SetBalance(&x, &share, &inside));
    if (!(share > 0.0)) break;
    x.uncovers = pass == 0 && share == 1.0 && inside > 0.0;
    PetscCall(MakePass(&x, swept));
  }
  PetscCall(PetscFree2(x.balance, x.is_changed));
  PetscCall(PetscFree6(x.distance, x.active, x.front, x.next, x.come, x.changed));
  PetscFunctionReturn(0);
}
