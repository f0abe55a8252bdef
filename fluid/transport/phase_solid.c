#include "fluid/transport/phase_solid.h"

/* Of an element's area: where less is free a solid covers it, where it has less of the element it is none. */
#define COVERED 1e-6

typedef struct {
  int n, order[PHASES_MAX]; /* from the heaviest to the lightest, the filler */
  const Stars *stars;
  Phases phases;
  const double *solid, *volume; /* [ne], [ne][n] */
  double *capacity;             /* [ne] scratch */
  char *covered;                /* [ne] */
  int *around;                  /* [ne]: the phase around an element that the surface crosses; else SEVERAL */
  double *swept;
} Leave;

/* The phases from the heaviest to the lightest: PhaseLightest is the last. */
static void SortByDensity(const PhaseProperties *p, int order[])
{
  for (int k = 0; k < p->n; k++) {
    int at = k;
    for (; at > 0 && p->rho[order[at - 1]] <= p->rho[k]; at--) order[at] = order[at - 1];
    order[at] = k;
  }
}

static double VolumeOf(const Leave *x, int e, int p)
{
  return x->volume[x->n * e + p];
}

/* m2 of element e, at most all of it. */
static double Solid(const Leave *x, int e)
{
  return fmin(fmax(x->solid[e], 0.0), 1.0) * StarsArea(x->stars, e);
}

/* --- what is around elements that the surface crosses ----------------------------------------------------- */

enum { NONE = -1, SEVERAL = -2 };

/* The phase that element e, without a solid, is full of, but for a cloud; SEVERAL; NONE with a solid. */
static int FullOf(const Leave *x, int e)
{
  if (x->solid[e] > COVERED) return NONE;
  for (int p = 0; p < x->n; p++)
    if (VolumeOf(x, e, p) > (1.0 - PHASES_CLOUD) * StarsArea(x->stars, e)) return p;
  return SEVERAL;
}

/* The phase that all elements without a solid around e are full of; full[nl]: FullOf. */
static int FullAround(const Leave *x, int e, const int full[])
{
  const Stars *s = x->stars;
  int found = NONE;
  for (int i = 0; i < 3; i++) {
    const int v = s->vertex[e][i];
    for (int k = s->start[v]; k < s->start[v + 1]; k++) {
      const int p = full[s->around[k] / 3];
      if (p != NONE) found = found == NONE || found == p ? p : SEVERAL;
    }
  }
  return found;
}

static PetscErrorCode FindAround(Leave *x)
{
  const Stars *s = x->stars;
  int *full;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->nl, &full));
  for (int e = 0; e < s->ne; e++) full[e] = FullOf(x, e);
  PetscCall(StarsExchange(s, sizeof *full, full));
  for (int e = 0; e < s->ne; e++) {
    const int crossed = full[e] == NONE && !x->covered[e], p = crossed ? FullAround(x, e, full) : SEVERAL;
    x->around[e] = p == NONE ? SEVERAL : p;
  }
  PetscCall(PetscFree(full));
  PetscFunctionReturn(0);
}

/* --- heavier phases leave the solid ---------------------------------------------------------------------- */

/* room[ne], m2, for phase p.  What is in excess of it goes first into gaps in the same phase beside the solid: most of what a step puts into some elements of
 * a surface it has taken from others.  (By way of the nearest room, often at the water's surface, floats among three phases swayed more and more.) */
static PetscErrorCode LeaveTo(Leave *x, int p, const double room[])
{
  const int filler = x->order[x->n - 1];
  PetscFunctionBeginUser;
  for (int e = 0; e < x->stars->ne; e++)
    x->capacity[e] = x->around[e] == p ? room[e] : fmin(room[e], VolumeOf(x, e, p));
  PetscCall(PhasesExpel(x->phases, p, filler, x->capacity, x->covered, x->swept));
  PetscCall(PhasesExpel(x->phases, p, filler, room, NULL, x->swept));
  PetscFunctionReturn(0);
}

static PetscErrorCode LeaveSolid(Leave *x)
{
  double *room;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(x->stars->ne, &room));
  for (int e = 0; e < x->stars->ne; e++) room[e] = StarsArea(x->stars, e) - Solid(x, e);
  for (int k = 0; k + 1 < x->n; k++) {
    PetscCall(LeaveTo(x, x->order[k], room));
    for (int e = 0; e < x->stars->ne; e++) room[e] = fmax(room[e] - VolumeOf(x, e, x->order[k]), 0.0);
  }
  PetscCall(PetscFree(room));
  PetscFunctionReturn(0);
}

/* --- gaps that are left ----------------------------------------------------------------------------------- */

/* What element e has beside the solid of phases lighter than order[k], m2. */
static double Lighter(const Leave *x, int e, int k)
{
  double lighter = -Solid(x, e);
  for (int j = k + 1; j < x->n; j++) lighter += VolumeOf(x, e, x->order[j]);
  return lighter;
}

/* A gap in phase order[0] goes up to the next lighter phase, from there to the one after it, and so on. */
static PetscErrorCode CloseGaps(Leave *x)
{
  const int filler = x->order[x->n - 1];
  double *kept; /* of the lightest phase, m2: no gap */
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(x->stars->ne, &kept));
  for (int e = 0; e < x->stars->ne; e++) kept[e] = VolumeOf(x, e, filler);
  for (int k = 0; k + 1 < x->n; k++) {
    const int p = x->order[k];
    for (int e = 0; e < x->stars->ne; e++) {
      const double all = VolumeOf(x, e, filler), least = PHASES_CLOUD * StarsArea(x->stars, e);
      if (x->around[e] == p)
        x->capacity[e] = Solid(x, e);
      else if (x->around[e] == SEVERAL && !x->covered[e] && Lighter(x, e, k) > least)
        x->capacity[e] = all + VolumeOf(x, e, p);
      else
        x->capacity[e] = x->around[e] == SEVERAL ? fmin(kept[e], all) : all;
    }
    PetscCall(PhasesExpel(x->phases, filler, p, x->capacity, x->covered, x->swept));
  }
  PetscCall(PetscFree(kept));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseLeaveSolid(const PhaseProperties *properties, const Stars *stars, Phases phases,
                               const double solid[], double swept[])
{
  Leave x = {.n = properties->n, .stars = stars, .phases = phases, .solid = solid, .swept = swept};
  PetscFunctionBeginUser;
  SortByDensity(properties, x.order);
  PetscCall(PhasesGetVolumes(phases, &x.volume));
  PetscCall(PetscMalloc3(stars->ne, &x.capacity, stars->ne, &x.covered, stars->ne, &x.around));
  for (int e = 0; e < stars->ne; e++) x.covered[e] = solid[e] > 1.0 - COVERED;
  PetscCall(FindAround(&x));
  PetscCall(LeaveSolid(&x));
  PetscCall(CloseGaps(&x));
  PetscCall(PetscFree3(x.capacity, x.covered, x.around));
  PetscFunctionReturn(0);
}
