#include "fluid/transport/phase_solid.h"

/* Of an element's area: where less is free a solid covers it, where it has less of the element it is none. */
#define COVERED 1e-6
/* Of what fills the solid, at most, in an element beside the surface that had it from there; more was there before. */
#define LEAK_MOST 0.05

/* CROSSED by the surface, or it lies along their faces or vertices: what fills covered elements comes into those beside them.  BESIDE: shares a vertex
 * with these. */
typedef enum { AWAY, BESIDE, CROSSED, INSIDE } Where;

/* Of some elements, by the places of phases in order; heavier than all others and lighter: none. */
typedef struct {
  int heaviest, lightest;
} Content;
#define NOTHING ((Content){PHASES_MAX, -1})

typedef struct {
  int n, order[PHASES_MAX]; /* from the heaviest to the lightest, the filler */
  const Stars *stars;
  Phases phases;
  const double *solid, *volume; /* [ne], [ne][n] */
  double *capacity;             /* [ne] scratch */
  char *covered, *beside;       /* [ne]; beside: scratch */
  char *where;                  /* [nl] Where */
  Content *around; /* [ne] of all elements around that are farther from the solid; of others all phases */
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

/* --- what is around elements of the surface --------------------------------------------------------------- */

/* Whether an element around e is at this place. */
static int Touches(const Leave *x, int e, Where where)
{
  const Stars *s = x->stars;
  for (int i = 0; i < 3; i++) {
    const int v = s->vertex[e][i];
    for (int k = s->start[v]; k < s->start[v + 1]; k++)
      if (x->where[s->around[k] / 3] == (char)where) return 1;
  }
  return 0;
}

/* Of elements that are away from the solid, those around ones at `where` become the place before it. */
static PetscErrorCode MarkAround(Leave *x, Where where)
{
  const Stars *s = x->stars;
  PetscFunctionBeginUser;
  for (int e = 0; e < s->ne; e++) x->beside[e] = x->where[e] == AWAY && Touches(x, e, where);
  for (int e = 0; e < s->ne; e++)
    if (x->beside[e]) x->where[e] = (char)(where - 1);
  PetscCall(StarsExchange(s, sizeof *x->where, x->where));
  PetscFunctionReturn(0);
}

static PetscErrorCode FindPlaces(Leave *x)
{
  const Stars *s = x->stars;
  PetscFunctionBeginUser;
  for (int e = 0; e < s->ne; e++) {
    x->covered[e] = x->solid[e] > 1.0 - COVERED;
    x->where[e] = x->covered[e] ? INSIDE : x->solid[e] > COVERED ? CROSSED : AWAY;
  }
  PetscCall(StarsExchange(s, sizeof *x->where, x->where));
  PetscCall(MarkAround(x, INSIDE));
  PetscCall(MarkAround(x, CROSSED));
  PetscFunctionReturn(0);
}

/* Places in order: what element e has, but for a cloud. */
static Content ContentOf(const Leave *x, int e)
{
  Content c = NOTHING;
  for (int k = 0; k < x->n; k++) {
    if (!(VolumeOf(x, e, x->order[k]) > PHASES_CLOUD * StarsArea(x->stars, e))) continue;
    if (c.lightest < 0) c.heaviest = k;
    c.lightest = k;
  }
  return c;
}

/* content[nl]: ContentOf. */
static Content ContentAround(const Leave *x, int e, const Content content[])
{
  const Stars *s = x->stars;
  Content found = NOTHING;
  for (int i = 0; i < 3; i++) {
    const int v = s->vertex[e][i];
    for (int k = s->start[v]; k < s->start[v + 1]; k++) {
      const int o = s->around[k] / 3;
      if (x->where[o] >= x->where[e]) continue;
      if (content[o].heaviest < found.heaviest) found.heaviest = content[o].heaviest;
      if (content[o].lightest > found.lightest) found.lightest = content[o].lightest;
    }
  }
  return found;
}

static PetscErrorCode FindAround(Leave *x)
{
  const Stars *s = x->stars;
  Content *content;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->nl, &content));
  for (int e = 0; e < s->ne; e++) content[e] = ContentOf(x, e);
  PetscCall(StarsExchange(s, sizeof *content, content));
  for (int e = 0; e < s->ne; e++) {
    x->around[e] = x->where[e] == CROSSED || x->where[e] == BESIDE ? ContentAround(x, e, content) : NOTHING;
    if (x->around[e].lightest < 0) x->around[e] = (Content){0, x->n - 1};
  }
  PetscCall(PetscFree(content));
  PetscFunctionReturn(0);
}

/* What element e has of the lightest phase beside the solid is a gap: around it that is not. */
static int HasGap(const Leave *x, int e)
{
  return x->where[e] == CROSSED && x->around[e].lightest < x->n - 1;
}

/* --- heavier phases leave the solid ---------------------------------------------------------------------- */

/* room[ne], m2, for phase order[k].  What is in excess of it goes first into gaps beside the solid where that phase is alone: most of what a step puts into
 * some elements of a surface it has taken from others.  (By way of the nearest room, often at the water's surface, floats among three phases swayed more and
 * more; so they did with gaps at the surface of two phases, which raised the heavier one there.) */
static PetscErrorCode LeaveTo(Leave *x, int k, const double room[])
{
  const int p = x->order[k], filler = x->order[x->n - 1];
  PetscFunctionBeginUser;
  for (int e = 0; e < x->stars->ne; e++) {
    const int leaks = x->where[e] != BESIDE || VolumeOf(x, e, filler) < LEAK_MOST * StarsArea(x->stars, e);
    const int alone = leaks && x->around[e].heaviest == k && x->around[e].lightest == k;
    x->capacity[e] = alone ? room[e] : fmin(room[e], VolumeOf(x, e, p));
  }
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
    PetscCall(LeaveTo(x, k, room));
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

/* A gap in phase order[0] goes up to the next lighter phase, from there to the one after it, and so on; one beside several phases is the lightest one's. */
static PetscErrorCode CloseGaps(Leave *x)
{
  const int filler = x->order[x->n - 1];
  double *kept; /* of the lightest phase, m2: no gap */
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(x->stars->ne, &kept));
  for (int e = 0; e < x->stars->ne; e++) kept[e] = HasGap(x, e) ? Solid(x, e) : VolumeOf(x, e, filler);
  for (int k = 0; k + 1 < x->n; k++) {
    const int p = x->order[k];
    for (int e = 0; e < x->stars->ne; e++) {
      const double all = VolumeOf(x, e, filler), least = PHASES_CLOUD * StarsArea(x->stars, e);
      const Content around = x->where[e] == CROSSED ? x->around[e] : (Content){0, x->n - 1};
      const int is_around = around.heaviest <= k && k <= around.lightest;
      const int meets_lighter =
          is_around && k < around.lightest && !x->covered[e] && Lighter(x, e, k) > least;
      x->capacity[e] = meets_lighter ? all + VolumeOf(x, e, p) : is_around ? fmin(kept[e], all) : all;
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
  PetscCall(PetscMalloc5(stars->ne, &x.capacity, stars->ne, &x.covered, stars->ne, &x.beside, stars->nl,
                         &x.where, stars->ne, &x.around));
  PetscCall(FindPlaces(&x));
  PetscCall(FindAround(&x));
  PetscCall(LeaveSolid(&x));
  PetscCall(CloseGaps(&x));
  PetscCall(PetscFree5(x.capacity, x.covered, x.beside, x.where, x.around));
  PetscFunctionReturn(0);
}
