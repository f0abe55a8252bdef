/* Limited fluxes of the phases' shares.  Of phase p passes a face in a step
 *
 *     a_C F dt + r (a_f - a_C) F dt        a_f: face_share.h, over the sum of all phases';  r: one for all phases, as large as leaves
 *                                          each within the least and largest share in its element and around it (Zalesak 1979)
 *
 * so volumes are conserved, shares stay within [0, 1] and their sum is 1. */
#include "fluid/phases/face_share.h"
#include "fluid/phases/phases_impl.h"

/* Largest share of an element that leaves it in a step. */
#define COURANT_MAX 0.2

typedef struct {
  double share[PHASES_MAX];
} Shares;

/* The part of what may come to an element, and leave it, that keeps it between the least and the largest share around. */
typedef struct {
  Shares come, leave;
} Room;

typedef struct {
  Phases f;
  const Stars *s;
  double dt;
  const double *flux, *velocity; /* [ne][3], [ne][3][2] */
  const PhasesInflow *inflow;
  double *courant;       /* [nl] share that leaves an element in dt */
  Shares *now, *low;     /* [nl] at the start; after the step with what C has on every face */
  Shares *mean;          /* [nwhole] at vertices */
  Room *room;            /* [nl] */
  Shares *upwind, *more; /* [ne][3] volumes that leave through faces: a_C F dt, (a_f - a_C) F dt */
} Compressive;

/* Whether the shares of any phase differ. */
static int Differ(const Compressive *t, const Shares *a, const Shares *b)
{
  for (int p = 0; p < t->f->np; p++)
    if (fabs(a->share[p] - b->share[p]) > SHARE_TINY) return 1;
  return 0;
}

/* What is across face i of element e: on the boundary what comes in, or, where nothing does, what the element has. */
static Shares Beyond(const Compressive *t, int e, int i)
{
  const int o = t->s->neighbor[e][i];
  Shares inflow;
  if (o >= 0) return t->now[o];
  if (!t->inflow || !(t->flux[3 * e + i] < 0.0)) return t->now[e];
  InflowShares(t->inflow, &t->s->element[e], i, t->f->np, inflow.share);
  return inflow;
}

/* --- values on faces ------------------------------------------------------------------------------------ */

static void SetMeans(Compressive *t)
{
  const Stars *s = t->s;
  for (int v = 0; v < s->nwhole; v++) {
    double *mean = t->mean[v].share, area = 0.0;
    for (int p = 0; p < t->f->np; p++) mean[p] = 0.0;
    for (int k = s->start[v]; k < s->start[v + 1]; k++) {
      const double a = StarsArea(s, s->around[k] / 3), *share = t->now[s->around[k] / 3].share;
      area += a;
      for (int p = 0; p < t->f->np; p++) mean[p] += a * share[p];
    }
    for (int p = 0; p < t->f->np; p++) mean[p] /= area;
  }
}

/* += the gradient of phase p's means in element e, times weight. */
static void AddGradient(const Compressive *t, int e, int p, double weight, double g[2])
{
  const double(*x)[2] = (const double(*)[2])t->s->element[e].x;
  const double scale = weight / StarsTwiceArea(t->s, e);
  for (int i = 0; i < 3; i++) {
    const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3], value = t->mean[t->s->vertex[e][i]].share[p];
    g[0] += scale * value * (a[1] - b[1]);
    g[1] += scale * value * (b[0] - a[0]);
  }
}

static FaceFlow FlowThrough(const Compressive *t, int from, int i, int to, const double u[2])
{
  const double(*x)[2] = (const double(*)[2])t->s->element[from].x,
        (*y)[2] = (const double(*)[2])t->s->element[to].x;
  const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3], length = hypot(b[0] - a[0], b[1] - a[1]);
  double way[2];
  for (int c = 0; c < 2; c++) way[c] = (y[0][c] + y[1][c] + y[2][c] - x[0][c] - x[1][c] - x[2][c]) / 3.0;
  return (FaceFlow){.u = {u[0], u[1]},
                    .n = {(b[1] - a[1]) / length, (a[0] - b[0]) / length},
                    .h = hypot(way[0], way[1]),
                    .courant = t->courant[from]};
}

/* value[np]: of phases on face i of `from`, through which its content goes to `to`. */
static void FaceValues(const Compressive *t, int from, int i, int to, const double u[2], double value[])
{
  const FaceFlow face = FlowThrough(t, from, i, to, u);
  const int *v = t->s->vertex[from];
  double sum = 0.0;
  for (int p = 0; p < t->f->np; p++) {
    const double c = t->now[from].share[p], d = t->now[to].share[p];
    double g[2] = {0.0, 0.0};
    value[p] = c;
    if (fabs(c - d) > SHARE_TINY) {
      AddGradient(t, from, p, 0.5, g);
      AddGradient(t, to, p, 0.5, g);
      const double middle = 0.5 * (t->mean[v[(i + 1) % 3]].share[p] + t->mean[v[(i + 2) % 3]].share[p]);
      value[p] = FaceShare(FaceShareHighOrder(&face, middle, g), t->mean[v[i]].share[p], c, d, face.courant);
    }
    sum += value[p];
  }
  for (int p = 0; p < t->f->np; p++) value[p] /= sum;
}

static void SetFace(Compressive *t, int e, int i)
{
  const Stars *s = t->s;
  const int o = s->neighbor[e][i], np = t->f->np;
  const double swept = t->flux[3 * e + i] * t->dt, *ua = &t->velocity[2 * (3 * e + (i + 1) % 3)],
               *ub = &t->velocity[2 * (3 * e + (i + 2) % 3)];
  const double u[2] = {0.5 * (ua[0] + ub[0]), 0.5 * (ua[1] + ub[1])};
  double value[PHASES_MAX];
  Shares *upwind = &t->upwind[3 * e + i], *more = &t->more[3 * e + i];
  for (int p = 0; p < np; p++) upwind->share[p] = more->share[p] = 0.0;
  if (swept == 0.0) return;
  const Shares donor = swept > 0.0 ? t->now[e] : Beyond(t, e, i);
  for (int p = 0; p < np; p++) value[p] = donor.share[p];
  if (o >= 0 && Differ(t, &t->now[e], &t->now[o])) {
    if (swept > 0.0)
      FaceValues(t, e, i, o, u, value);
    else
      FaceValues(t, o, StarsFaceTo(s, o, e), e, u, value);
  }
  for (int p = 0; p < np; p++) {
    upwind->share[p] = swept * donor.share[p];
    more->share[p] = swept * (value[p] - donor.share[p]);
  }
}

/* --- limits --------------------------------------------------------------------------------------------- */

static void SetLow(Compressive *t)
{
  for (int e = 0; e < t->s->ne; e++) {
    const double *v = &t->f->volume[(size_t)e * (size_t)t->f->np];
    const Shares *out = &t->upwind[3 * e];
    for (int p = 0; p < t->f->np; p++)
      t->low[e].share[p] = (v[p] - out[0].share[p] - out[1].share[p] - out[2].share[p]) / StarsArea(t->s, e);
  }
}

/* Of phase p in owned element e. */
static void SetRoom(Compressive *t, int e, int p)
{
  const double area = StarsArea(t->s, e), low = t->low[e].share[p];
  double least = fmin(t->now[e].share[p], low), most = fmax(t->now[e].share[p], low), come = 0.0, leave = 0.0;
  for (int i = 0; i < 3; i++) {
    const int o = t->s->neighbor[e][i];
    const double more = t->more[3 * e + i].share[p] / area;
    come += fmax(-more, 0.0);
    leave += fmax(more, 0.0);
    if (o < 0) continue;
    least = fmin(least, fmin(t->now[o].share[p], t->low[o].share[p]));
    most = fmax(most, fmax(t->now[o].share[p], t->low[o].share[p]));
  }
  most = fmax(fmin(most, 1.0), low);
  least = fmin(fmax(least, 0.0), low);
  t->room[e].come.share[p] = come > 0.0 ? fmin(1.0, (most - low) / come) : 1.0;
  t->room[e].leave.share[p] = leave > 0.0 ? fmin(1.0, (low - least) / leave) : 1.0;
}

/* The part of `more` that passes face i of e. */
static double Part(const Compressive *t, int e, int i)
{
  const int o = t->s->neighbor[e][i];
  double part = 1.0;
  for (int p = 0; p < t->f->np && o >= 0; p++) {
    const double more = t->more[3 * e + i].share[p];
    if (more > 0.0) part = fmin(part, fmin(t->room[e].leave.share[p], t->room[o].come.share[p]));
    if (more < 0.0) part = fmin(part, fmin(t->room[e].come.share[p], t->room[o].leave.share[p]));
  }
  return part;
}

/* swept[np], mass[np] (or NULL) += what leaves owned element e through face i; the phase that has most of it takes round-off. */
static void Pass(Compressive *t, int e, int i, double swept[], double mass[])
{
  const Phases f = t->f;
  const int o = t->s->neighbor[e][i];
  const double all = t->flux[3 * e + i] * t->dt, part = Part(t, e, i);
  const int donor = all > 0.0 || o < 0 ? e : o;
  double passes[PHASES_MAX], rest = all;
  int largest = 0;
  for (int p = 0; p < f->np; p++) {
    passes[p] = t->upwind[3 * e + i].share[p] + part * t->more[3 * e + i].share[p];
    rest -= passes[p];
    if (fabs(passes[p]) > fabs(passes[largest])) largest = p;
  }
  passes[largest] += rest;
  for (int p = 0; p < f->np; p++) {
    const double density = !mass || f->state[p].pressure == 0.0 ? 0.0
                           : all < 0.0 && o < 0                 ? PhasesIncoming(f, t->inflow, e, p)
                                                : f->density[(size_t)donor * (size_t)f->np + (size_t)p];
    f->volume[(size_t)e * (size_t)f->np + (size_t)p] -= passes[p];
    swept[p] += passes[p];
    if (!mass) continue;
    f->mass[(size_t)e * (size_t)f->np + (size_t)p] -= density * passes[p];
    mass[p] += density * passes[p];
  }
}

/* --- steps ---------------------------------------------------------------------------------------------- */

static PetscErrorCode SetShares(Compressive *t)
{
  const Phases f = t->f;
  PetscFunctionBeginUser;
  for (int e = 0; e < t->s->ne; e++) {
    const double *v = &f->volume[(size_t)e * (size_t)f->np];
    double sum = 0.0;
    for (int p = 0; p < f->np; p++) sum += fmax(v[p], 0.0);
    for (int p = 0; p < f->np; p++) t->now[e].share[p] = fmax(v[p], 0.0) / sum;
  }
  PetscCall(StarsExchange(t->s, sizeof *t->now, t->now));
  SetMeans(t);
  PetscFunctionReturn(0);
}

static PetscErrorCode Substep(Compressive *t, double swept[], double mass[])
{
  const size_t np = (size_t)t->f->np;
  PetscFunctionBeginUser;
  for (int k = 0; k < 3 * t->s->ne; k++) SetFace(t, k / 3, k % 3);
  SetLow(t);
  PetscCall(StarsExchange(t->s, sizeof *t->low, t->low));
  for (int e = 0; e < t->s->ne; e++)
    for (int p = 0; p < t->f->np; p++) SetRoom(t, e, p);
  PetscCall(StarsExchange(t->s, sizeof *t->room, t->room));
  for (int k = 0; k < 3 * t->s->ne; k++)
    Pass(t, k / 3, k % 3, &swept[(size_t)k * np], mass ? &mass[(size_t)k * np] : NULL);
  PetscFunctionReturn(0);
}

/* Sets courant for the whole step; *largest: of elements that have beside them, or let in, other shares than theirs. */
static PetscErrorCode SetCourant(Compressive *t, double *largest)
{
  const Stars *s = t->s;
  PetscFunctionBeginUser;
  *largest = 0.0;
  for (int e = 0; e < s->ne; e++) {
    int mixed = 0;
    t->courant[e] = 0.0;
    for (int i = 0; i < 3; i++) {
      const Shares beyond = Beyond(t, e, i);
      t->courant[e] += fmax(t->flux[3 * e + i], 0.0) * t->dt / StarsArea(s, e);
      mixed |= Differ(t, &t->now[e], &beyond);
    }
    if (mixed) *largest = fmax(*largest, t->courant[e]);
  }
  t->f->courant = *largest;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPI_DOUBLE, MPI_MAX, s->mesh->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode CompressiveAdvect(Phases f, double dt, const double flux[], const double velocity[],
                                 const PhasesInflow *inflow, double swept[], double mass[])
{
  const Stars *s = f->stars;
  Compressive t = {.f = f, .s = s, .dt = dt, .flux = flux, .velocity = velocity, .inflow = inflow};
  double courant;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(s->nl, &t.courant, s->nl, &t.now, s->nl, &t.low, s->nl, &t.room));
  PetscCall(PetscMalloc3(s->nwhole, &t.mean, 3 * s->ne, &t.upwind, 3 * s->ne, &t.more));
  PetscCall(PetscArrayzero(swept, 3 * s->ne * f->np));
  if (mass) PetscCall(PetscArrayzero(mass, 3 * s->ne * f->np));
  PetscCall(SetShares(&t));
  PetscCall(SetCourant(&t, &courant));
  const int steps = (int)fmax(1.0, ceil(courant / COURANT_MAX));
  t.dt = dt / steps;
  for (int e = 0; e < s->ne; e++) t.courant[e] /= steps;
  PetscCall(StarsExchange(s, sizeof *t.courant, t.courant));
  for (int k = 0; k < steps; k++) {
    if (k) PetscCall(SetShares(&t));
    PetscCall(Substep(&t, swept, mass));
  }
  PetscCall(PetscFree4(t.courant, t.now, t.low, t.room));
  PetscCall(PetscFree3(t.mean, t.upwind, t.more));
  PetscFunctionReturn(0);
}
