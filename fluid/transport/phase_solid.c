#include "fluid/transport/phase_solid.h"

/* Of an element's area: where less is free a solid covers it, where it has less of the element it is none. */
#define COVERED 1e-6

typedef struct {
  int n, order[PHASES_MAX]; /* from the heaviest to the lightest, the filler */
  const Stars *stars;
  Phases phases;
  const double *solid, *volume; /* [ne], [ne][n] */
  double *capacity;             /* [ne] */
  char *covered;                /* [ne] */
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

/* --- heavier phases leave the solid ---------------------------------------------------------------------- */

static PetscErrorCode LeaveSolid(Leave *x)
{
  PetscFunctionBeginUser;
  for (int e = 0; e < x->stars->ne; e++) x->capacity[e] = StarsArea(x->stars, e) - Solid(x, e);
  for (int k = 0; k + 1 < x->n; k++) {
    PetscCall(PhasesExpel(x->phases, x->order[k], x->order[x->n - 1], x->capacity, NULL, x->swept));
    for (int e = 0; e < x->stars->ne; e++)
      x->capacity[e] = fmax(x->capacity[e] - VolumeOf(x, e, x->order[k]), 0.0);
  }
  PetscFunctionReturn(0);
}

/* --- gaps beside it -------------------------------------------------------------------------------------- */

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

/* What element e has beside the solid of phases lighter than order[k], m2. */
static double Lighter(const Leave *x, int e, int k)
{
  double lighter = -Solid(x, e);
  for (int j = k + 1; j < x->n; j++) lighter += VolumeOf(x, e, x->order[j]);
  return lighter;
}

/* around[ne]: the phase around elements that the surface crosses, else SEVERAL.  A gap in phase order[0] goes up to the next lighter phase, from there to
 * the one after it, and so on: kept[ne], m2, of the lightest phase is not part of it. */
static PetscErrorCode CloseGaps(Leave *x, const int around[], const double kept[])
{
  const int filler = x->order[x->n - 1];
  PetscFunctionBeginUser;
  for (int e = 0; e < x->stars->ne; e++) x->covered[e] = x->solid[e] > 1.0 - COVERED;
  for (int k = 0; k + 1 < x->n; k++) {
    const int p = x->order[k];
    for (int e = 0; e < x->stars->ne; e++) {
      const double area = StarsArea(x->stars, e);
      if (around[e] == p)
        x->capacity[e] = Solid(x, e);
      else if (around[e] == SEVERAL && !x->covered[e] && Lighter(x, e, k) > PHASES_CLOUD * area)
        x->capacity[e] = VolumeOf(x, e, filler) + VolumeOf(x, e, p);
      else
        x->capacity[e] =
            around[e] == SEVERAL ? fmin(kept[e], VolumeOf(x, e, filler)) : VolumeOf(x, e, filler);
    }
    PetscCall(PhasesExpel(x->phases, filler, p, x->capacity, x->covered, x->swept));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode FindGaps(Leave *x)
{
  const Stars *s = x->stars;
  int *full, *around;
  double *kept;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(s->nl, &full, s->ne, &around, s->ne, &kept));
  for (int e = 0; e < s->ne; e++) full[e] = FullOf(x, e);
  PetscCall(StarsExchange(s, sizeof *full, full));
  for (int e = 0; e < s->ne; e++) {
    const int crossed = full[e] == NONE && x->solid[e] < 1.0 - COVERED,
              p = crossed ? FullAround(x, e, full) : SEVERAL;
    around[e] = p == NONE ? SEVERAL : p;
    kept[e] = VolumeOf(x, e, x->order[x->n - 1]);
  }
  PetscCall(CloseGaps(x, around, kept));
  PetscCall(PetscFree3(full, around, kept));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseLeaveSolid(const PhaseProperties *properties, const Stars *stars, Phases phases,
                               const double solid[], double swept[])
{
  Leave x = {.n = properties->n, .stars = stars, .phases = phases, .solid = solid, .swept = swept};
  PetscFunctionBeginUser;
  SortByDensity(properties, x.order);
  PetscCall(PhasesGetVolumes(phases, &x.volume));
  PetscCall(PetscMalloc2(stars->ne, &x.capacity, stars->ne, &x.covered));
  PetscCall(LeaveSolid(&x));
  PetscCall(FindGaps(&x));
  PetscCall(PetscFree2(x.capacity, x.covered));
  PetscFunctionReturn(0);
}
