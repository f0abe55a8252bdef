/* Unsplit, flux-matched advection of the volumes: what leaves an element through a face is what lies in the region that the face
 * sweeps (swept.h).  Faces among elements of one phase, two rings deep, carry this phase and need no polygon. */
#include "fluid/phases/outside.h"
#include "fluid/phases/trace.h"

#define OUTSIDE 1e-12 /* of the square of an edge: what round-off may leave uncovered of a swept area */

typedef struct {
  Phases f;
  const Stars *s;
  TraceFlow flow;
  Outside outside;
  char *on_boundary;  /* [nv] */
  int *calm;          /* [nowned] phase of all elements two rings around, or -1 */
  double (*shift)[2]; /* [nowned] */
  SweptSearch search;
  double lost; /* largest swept area that is nowhere, over the square of its edge */
} Step;

/* The phase that all elements around v have to themselves, and that may flow in there, or -1. */
static int PureAt(const Step *t, int v)
{
  const Stars *s = t->s;
  const int p = t->f->single[s->around[s->start[v]] / 3];
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    if (t->f->single[s->around[k] / 3] != p) return -1;
  }
  return p < 0 || !t->on_boundary[v] || OutsideIsOnly(&t->outside, v, p) ? p : -1;
}

static void MarkBoundary(Step *t)
{
  const Stars *s = t->s;
  for (int k = 0; k < 3 * s->nl; k++) {
    if (s->element[k / 3].tag[k % 3] < 0) continue;
    t->on_boundary[s->vertex[k / 3][(k + 1) % 3]] = t->on_boundary[s->vertex[k / 3][(k + 2) % 3]] = 1;
  }
}

static PetscErrorCode FindCalm(Step *t)
{
  const Stars *s = t->s;
  int *pure, *around;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(s->nwhole, &pure, s->nl, &around));
  for (int v = 0; v < s->nwhole; v++) pure[v] = PureAt(t, v);
  for (int e = 0; e < s->nl; e++) {
    const int *v = s->vertex[e];
    if (s->element[e].ring > 1) continue;
    around[e] = pure[v[0]] == pure[v[1]] && pure[v[1]] == pure[v[2]] ? pure[v[0]] : -1;
  }
  for (int v = 0; v < s->nowned; v++) {
    t->calm[v] = around[s->around[s->start[v]] / 3];
    for (int k = s->start[v]; k < s->start[v + 1]; k++) {
      if (around[s->around[k] / 3] != t->calm[v]) t->calm[v] = -1;
    }
  }
  PetscCall(PetscFree2(pure, around));
  PetscFunctionReturn(0);
}

/* Of each phase: area, m2, and, if phases have masses, mass, kg. */
typedef struct {
  double area[PHASES_MAX], mass[PHASES_MAX];
} Content;

static void Add(Content *c, int p, double area, double density)
{
  c->area[p] += area;
  c->mass[p] += area * density;
}

/* What the elements leave of the swept area, `rest`, comes from outside of open boundaries, or is round-off of element e. */
static void Balance(Step *t, int e, double uncovered, double swept, const SweptOutside *parts, Content *c)
{
  const Phases f = t->f;
  double rest = swept;
  int largest = 0;
  for (int p = 0; p < f->np; p++) {
    rest -= c->area[p];
    if (fabs(c->area[p]) > fabs(c->area[largest])) largest = p;
  }
  if (uncovered > OUTSIDE) {
    if (parts->n) {
      double inside[PHASES_MAX];
      memcpy(inside, c->area, sizeof inside);
      OutsideShare(&t->outside, f->np, rest, parts, c->area);
      for (int p = 0; p < f->np && f->mass; p++)
        c->mass[p] += (c->area[p] - inside[p]) * PhasesIncoming(f, t->outside.inflow, e, p);
      return;
    }
    t->lost = fmax(t->lost, uncovered);
  }
  Add(c, largest, rest, f->mass ? f->density[(size_t)e * (size_t)f->np + (size_t)largest] : 0.0);
}

/* Through face i of element e, among elements of phase p. */
static void SweepCalm(const Step *t, int e, int i, int p, double swept, Content *c)
{
  const Phases f = t->f;
  const int donor = swept > 0.0 ? e : t->s->neighbor[e][i];
  const double density = !f->mass    ? 0.0
                         : donor < 0 ? PhasesIncoming(f, t->outside.inflow, e, p)
                                     : f->density[(size_t)donor * (size_t)f->np + (size_t)p];
  Add(c, p, swept, density);
}

/* What leaves owned element e through face i. */
static void SweepFace(Step *t, int e, int i, Content *c)
{
  const Stars *s = t->s;
  int a = s->vertex[e][(i + 1) % 3], b = s->vertex[e][(i + 2) % 3];
  const double sign = s->gid[a] < s->gid[b] ? 1.0 : -1.0, swept = sign * t->flow.flux[e][i] * t->flow.dt;
  *c = (Content){{0.0}, {0.0}};
  if (s->element[e].tag[i] >= 0 && t->flow.flux[e][i] == 0.0) return;
  if (t->calm[a] >= 0 && t->calm[a] == t->calm[b]) {
    SweepCalm(t, e, i, t->calm[a], sign * swept, c);
    return;
  }
  if (sign < 0.0) {
    const int other = a;
    a = b;
    b = other;
  }
  const int owner = sign > 0.0 || s->neighbor[e][i] < 0 ? e : s->neighbor[e][i];
  Swept region;
  SweptMake(s, a, b, (const double(*)[2])t->shift, swept, &region);
  SweptOutside parts;
  parts.n = 0;
  if (t->on_boundary[a] || t->on_boundary[b]) OutsideDivide(&t->outside, a, b, region.origin, &parts);
  double uncovered = SweptCollect(&t->search, a, b, 0, &region, &parts, c->area, c->mass);
  if (uncovered > OUTSIDE) {
    *c = (Content){{0.0}, {0.0}};
    uncovered = SweptCollect(&t->search, a, b, 1, &region, &parts, c->area, c->mass);
  }
  Balance(t, owner, uncovered, swept, &parts, c);
  for (int p = 0; p < t->f->np; p++) {
    c->area[p] *= sign;
    c->mass[p] *= sign;
  }
}

/* swept[ne][3][np], mass likewise or NULL: faces between owned elements once, those to other ranks on both. */
static void SweepFaces(Step *t, double swept[], double mass[])
{
  const Mesh *m = t->s->mesh;
  const size_t np = (size_t)t->f->np;
  for (int k = 0; k < 3 * m->ne; k++) {
    const int o = m->neighbor[k];
    const size_t at = (size_t)k * np, other = (size_t)(3 * o + m->neighbor_face[k]) * np;
    Content c;
    if (o < 0 || o >= k / 3) SweepFace(t, k / 3, k % 3, &c);
    for (size_t p = 0; p < np; p++) swept[at + p] = o >= 0 && o < k / 3 ? -swept[other + p] : c.area[p];
    for (size_t p = 0; p < np && mass; p++)
      mass[at + p] = t->f->state[p].pressure == 0.0 ? 0.0
                     : o >= 0 && o < k / 3          ? -mass[other + p]
                                                    : c.mass[p];
  }
}

static void Update(Step *t, const double swept[], const double mass[])
{
  const Stars *s = t->s;
  const size_t np = (size_t)t->f->np;
  t->f->courant = 0.0;
  for (int e = 0; e < s->ne; e++) {
    double *v = &t->f->volume[(size_t)e * np], out = 0.0;
    for (size_t k = 0; k < 3 * np; k++) v[k % np] -= swept[3 * (size_t)e * np + k];
    for (size_t k = 0; k < 3 * np && mass; k++)
      t->f->mass[(size_t)e * np + k % np] -= mass[3 * (size_t)e * np + k];
    for (int i = 0; i < 3; i++) out += fmax(t->flow.flux[e][i], 0.0);
    if (t->calm[s->vertex[e][0]] < 0)
      t->f->courant = fmax(t->f->courant, 2.0 * out * t->flow.dt / StarsTwiceArea(s, e));
  }
}

/* A vertex of a face that is not among elements of one phase. */
static int NearInterface(const Step *t, int v)
{
  const Stars *s = t->s;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    for (int i = 0; i < 3; i++) {
      const int w = s->vertex[s->around[k] / 3][i];
      if (w >= s->nowned || t->calm[w] < 0 || t->calm[w] != t->calm[v]) return 1;
    }
  }
  return 0;
}

static PetscErrorCode StepBegin(Phases f, double dt, const double flux[], const double velocity[], Step *t)
{
  const Stars *s = f->stars;
  double(*all_flux)[3], (*all_velocity)[3][2];
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(s->nl, &all_flux, s->nl, &all_velocity));
  if (s->ne) {
    PetscCall(PetscArraycpy(&all_flux[0][0], flux, 3 * s->ne));
    PetscCall(PetscArraycpy(&all_velocity[0][0][0], velocity, 6 * s->ne));
  }
  PetscCall(StarsExchange(s, sizeof *all_flux, all_flux));
  PetscCall(StarsExchange(s, sizeof *all_velocity, all_velocity));
  t->flow = (TraceFlow){s, dt, (const double(*)[3])all_flux, (const double(*)[3][2])all_velocity};
  PetscCall(PetscMalloc2(s->nowned, &t->calm, s->nowned, &t->shift));
  PetscCall(PetscCalloc1(s->nv, &t->on_boundary));
  t->outside.flux = t->flow.flux;
  t->outside.shift = (const double(*)[2])t->shift;
  PetscCall(SweptSearchCreate(f, &t->search));
  MarkBoundary(t);
  PetscCall(FindCalm(t));
  for (int v = 0; v < s->nowned; v++) {
    t->shift[v][0] = t->shift[v][1] = 0.0;
    if (NearInterface(t, v)) TraceVertex(&t->flow, v, t->shift[v]);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode StepEnd(Step *t)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(t->flow.flux, t->flow.velocity));
  PetscCall(PetscFree2(t->calm, t->shift));
  PetscCall(PetscFree(t->on_boundary));
  PetscCall(SweptSearchDestroy(&t->search));
  PetscFunctionReturn(0);
}

PetscErrorCode GeometricAdvect(Phases f, double dt, const double flux[], const double velocity[],
                               const PhasesInflow *inflow, double swept[], double mass[])
{
  Step t = {.f = f, .s = f->stars, .outside = {.stars = f->stars, .inflow = inflow}};
  double lost;
  PetscFunctionBeginUser;
  PetscCall(StepBegin(f, dt, flux, velocity, &t));
  SweepFaces(&t, swept, mass);
  PetscCallMPI(MPI_Allreduce(&t.lost, &lost, 1, MPI_DOUBLE, MPI_MAX, f->stars->mesh->comm));
  if (!(lost > 0.0)) Update(&t, swept, mass);
  PetscCall(StepEnd(&t));
  PetscCheck(
      !(lost > 0.0), f->stars->mesh->comm, PETSC_ERR_ARG_OUTOFRANGE,
      "a step of %g s sweeps areas out of reach (%g of an edge squared): the fluid crosses more than an "
      "element a step",
      dt, lost);
  PetscFunctionReturn(0);
}
