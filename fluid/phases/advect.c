/* Unsplit, flux-matched advection of the volumes.
 *
 *      a----------b     Face ab, outward to its right.  a' and b' are where its vertices were dt ago; m'
 *       \        /      moves out of the middle of a'b' until the area a b b' m' a' is flux dt.  The phases
 *        \      /       that lie in this polygon leave through the face.  It is taken as three signed
 *        a'--.b'        triangles at a, so that it may cross itself.
 *          m'
 *
 * Faces among elements of one phase, two rings deep, carry this phase and need no polygon. */
#include "fluid/phases/phases_impl.h"
#include "fluid/phases/trace.h"

#define OUTSIDE 1e-12 /* of the square of an edge: what round-off may leave uncovered of a swept area */

typedef struct {
  Phases f;
  const Stars *s;
  TraceFlow flow;
  const PhasesInflow *inflow;
  int *calm;          /* [nowned] phase of all elements two rings around, or -1 */
  double (*shift)[2]; /* [nowned] */
  int stamp, *mark;   /* [nl] */
  int n, *list;       /* elements that a face may sweep, by ascending global number */
  double lost;        /* largest swept area that is nowhere, over the square of its edge */
} Step;

/* A swept region: corners relative to its face's first vertex. */
typedef struct {
  double origin[2], corner[5][2]; /* a, b, b', m, a' */
  double low[2], high[2];
} Swept;

/* The tag of an open boundary face at vertex v, -1 if there is none. */
static int OpenTag(const Step *t, int v)
{
  const Stars *s = t->s;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3, c = s->around[k] % 3;
    for (int i = 1; i < 3; i++) {
      const int face = (c + i) % 3, tag = s->element[e].tag[face];
      if (tag >= 0 && t->flow.flux[e][face] != 0.0) return tag;
    }
  }
  return -1;
}

/* The fraction of phase p in what comes in at x through the boundary. */
static double Inflow(const Step *t, int tag, const double x[2], int p)
{
  const PhasesLevel *level = t->inflow->level ? &t->inflow->level[tag] : NULL;
  if (level && level->below.n[0] * x[0] + level->below.n[1] * x[1] < level->below.d) return p == level->phase;
  return t->inflow->fraction[tag][p];
}

/* The phase that all elements around v have to themselves, and that may flow in there, or -1. */
static int PureAt(const Step *t, int v, char on_boundary)
{
  const Stars *s = t->s;
  const int p = t->f->single[s->around[s->start[v]] / 3];
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    if (t->f->single[s->around[k] / 3] != p) return -1;
  }
  if (p < 0 || !on_boundary || !t->inflow) return p;
  const int tag = OpenTag(t, v);
  return tag >= 0 && Inflow(t, tag, s->point[v], p) != 1.0 ? -1 : p;
}

static PetscErrorCode FindCalm(Step *t)
{
  const Stars *s = t->s;
  int *pure, *around;
  char *boundary;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(s->nwhole, &pure, s->nl, &around, s->nv, &boundary));
  PetscCall(PetscArrayzero(boundary, s->nv));
  for (int k = 0; k < 3 * s->nl; k++) {
    if (s->element[k / 3].tag[k % 3] < 0) continue;
    boundary[s->vertex[k / 3][(k + 1) % 3]] = boundary[s->vertex[k / 3][(k + 2) % 3]] = 1;
  }
  for (int v = 0; v < s->nwhole; v++) pure[v] = PureAt(t, v, boundary[v]);
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
  PetscCall(PetscFree3(pure, around, boundary));
  PetscFunctionReturn(0);
}

static void ListVertex(Step *t, int v)
{
  const Stars *s = t->s;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3;
    if (t->mark[e] == t->stamp) continue;
    t->mark[e] = t->stamp;
    int at = t->n++;
    for (; at > 0 && s->element[t->list[at - 1]].egid > s->element[e].egid; at--)
      t->list[at] = t->list[at - 1];
    t->list[at] = e;
  }
}

/* Elements around the two vertices; with `wide` also those around the vertices of these. */
static void ListFace(Step *t, int a, int b, int wide)
{
  t->stamp++;
  t->n = 0;
  ListVertex(t, a);
  ListVertex(t, b);
  if (!wide) return;
  for (int v = 0; v < 2; v++) {
    const int center = v ? b : a;
    for (int k = t->s->start[center]; k < t->s->start[center + 1]; k++) {
      for (int i = 0; i < 3; i++) ListVertex(t, t->s->vertex[t->s->around[k] / 3][i]);
    }
  }
}

/* The swept region of area `swept` > 0 to the left of a -> b. */
static void MakeSwept(const Step *t, int a, int b, double swept, Swept *r)
{
  const double *xa = t->s->point[a], *xb = t->s->point[b];
  double twice = 0.0;
  for (int c = 0; c < 2; c++) {
    r->origin[c] = xa[c];
    r->corner[0][c] = 0.0;
    r->corner[1][c] = xb[c] - xa[c];
    r->corner[2][c] = r->corner[1][c] + t->shift[b][c];
    r->corner[4][c] = t->shift[a][c];
    r->corner[3][c] = 0.5 * (r->corner[2][c] + r->corner[4][c]);
  }
  const double(*x)[2] = (const double(*)[2])r->corner;
  twice = x[1][0] * x[2][1] - x[1][1] * x[2][0] + x[2][0] * x[4][1] - x[2][1] * x[4][0];
  const double edge[2] = {x[4][0] - x[2][0], x[4][1] - x[2][1]};
  const double push = (2.0 * swept - twice) / (edge[0] * edge[0] + edge[1] * edge[1]);
  r->corner[3][0] += push * edge[1];
  r->corner[3][1] -= push * edge[0];
  for (int c = 0; c < 2; c++) {
    r->low[c] = r->high[c] = 0.0;
    for (int k = 1; k < 5; k++) {
      r->low[c] = fmin(r->low[c], r->corner[k][c]);
      r->high[c] = fmax(r->high[c], r->corner[k][c]);
    }
  }
}

static int Apart(const Swept *r, const double x[3][2])
{
  for (int c = 0; c < 2; c++) {
    const double low = r->low[c] + r->origin[c], high = r->high[c] + r->origin[c];
    if (x[0][c] >= high && x[1][c] >= high && x[2][c] >= high) return 1;
    if (x[0][c] <= low && x[1][c] <= low && x[2][c] <= low) return 1;
  }
  return 0;
}

/* The signed area of p on the side of h, in p's coordinates; h NULL: 0. */
static double AreaBelow(const Polygon *p, const HalfPlane *h, double sign)
{
  Polygon below;
  if (!h) return 0.0;
  PolygonClip(p, h, &below);
  return below.n ? sign * PolygonArea(&below) : 0.0;
}

/* area[np] of the listed elements' phases in the region, and *below: what they leave of its part on the side of `level` (from the
 * region's origin, or NULL); returns what they do not cover of it, over the square of the edge. */
static double Collect(const Step *t, const Swept *r, const HalfPlane *level, double area[], double *below)
{
  Polygon triangle[3], moved, part;
  double sign[3], all = 0.0, covered = 0.0;
  *below = 0.0;
  for (int k = 0; k < 3; k++) {
    Polygon *q = &triangle[k];
    q->n = 3;
    for (int c = 0; c < 2; c++) {
      q->x[0][c] = 0.0;
      q->x[1][c] = r->corner[k + 1][c];
      q->x[2][c] = r->corner[k + 2][c];
    }
    const double signed_area = PolygonArea(q);
    sign[k] = signed_area < 0.0 ? -1.0 : 1.0;
    all += fabs(signed_area);
    for (int c = 0; c < 2 && signed_area < 0.0; c++) {
      const double swap = q->x[1][c];
      q->x[1][c] = q->x[2][c];
      q->x[2][c] = swap;
    }
    *below += AreaBelow(q, level, sign[k]);
  }
  for (int j = 0; j < t->n; j++) {
    const int e = t->list[j];
    const double(*x)[2] = (const double(*)[2])t->s->element[e].x;
    if (Apart(r, x)) continue;
    PolygonTriangle(x, r->origin, &moved);
    for (int k = 0; k < 3; k++) {
      PolygonClipTriangle(&triangle[k], (const double(*)[2])moved.x, &part);
      if (!part.n) continue;
      covered += PolygonArea(&part);
      *below -= AreaBelow(&part, level, sign[k]);
      PhasesSplit(t->f, e, &part, r->origin, sign[k], area);
    }
  }
  const double *edge = r->corner[1];
  return (all - covered) / (edge[0] * edge[0] + edge[1] * edge[1]);
}

/* What the elements leave of the swept area, `rest`, comes from outside of open boundaries, `below` of it from below their
 * level, or is round-off. */
static void Balance(Step *t, int tag, double uncovered, double swept, double below, double area[])
{
  double rest = swept;
  int largest = 0;
  for (int p = 0; p < t->f->np; p++) {
    rest -= area[p];
    if (fabs(area[p]) > fabs(area[largest])) largest = p;
  }
  if (uncovered > OUTSIDE) {
    if (tag >= 0 && t->inflow) {
      for (int p = 0; p < t->f->np; p++) area[p] += (rest - below) * t->inflow->fraction[tag][p];
      if (t->inflow->level) area[t->inflow->level[tag].phase] += below;
      return;
    }
    t->lost = fmax(t->lost, uncovered);
  }
  area[largest] += rest;
}

/* The level outside of boundary `tag`, seen from `origin`; NULL: it has none. */
static const HalfPlane *LevelFrom(const Step *t, int tag, const double origin[2], HalfPlane *h)
{
  if (tag < 0 || !t->inflow || !t->inflow->level) return NULL;
  *h = t->inflow->level[tag].below;
  if (h->n[0] == 0.0 && h->n[1] == 0.0) return NULL;
  h->d -= h->n[0] * origin[0] + h->n[1] * origin[1];
  return h;
}

/* area[np]: what leaves owned element e through face i. */
static void SweepFace(Step *t, int e, int i, double area[])
{
  const Stars *s = t->s;
  int a = s->vertex[e][(i + 1) % 3], b = s->vertex[e][(i + 2) % 3];
  const double sign = s->gid[a] < s->gid[b] ? 1.0 : -1.0, swept = sign * t->flow.flux[e][i] * t->flow.dt;
  const int np = t->f->np, tag = s->element[e].tag[i];
  for (int p = 0; p < np; p++) area[p] = 0.0;
  if (tag >= 0 && t->flow.flux[e][i] == 0.0) return;
  if (t->calm[a] >= 0 && t->calm[a] == t->calm[b]) {
    area[t->calm[a]] = sign * swept;
    return;
  }
  if (sign < 0.0) {
    const int other = a;
    a = b;
    b = other;
  }
  Swept region;
  double below;
  HalfPlane h;
  MakeSwept(t, a, b, swept, &region);
  const int from = tag >= 0 ? tag : OpenTag(t, a) >= 0 ? OpenTag(t, a) : OpenTag(t, b);
  const HalfPlane *level = LevelFrom(t, from, region.origin, &h);
  ListFace(t, a, b, 0);
  double uncovered = Collect(t, &region, level, area, &below);
  if (uncovered > OUTSIDE) {
    for (int p = 0; p < np; p++) area[p] = 0.0;
    ListFace(t, a, b, 1);
    uncovered = Collect(t, &region, level, area, &below);
  }
  Balance(t, from, uncovered, swept, below, area);
  for (int p = 0; p < np; p++) area[p] *= sign;
}

/* swept[ne][3][np]: faces between owned elements once, those to other ranks on both. */
static void SweepFaces(Step *t, double swept[])
{
  const Mesh *m = t->s->mesh;
  const size_t np = (size_t)t->f->np;
  for (int k = 0; k < 3 * m->ne; k++) {
    const int o = m->neighbor[k];
    double *area = &swept[(size_t)k * np];
    if (o >= 0 && o < k / 3) {
      const double *other = &swept[(size_t)(3 * o + m->neighbor_face[k]) * np];
      for (size_t p = 0; p < np; p++) area[p] = -other[p];
    } else {
      SweepFace(t, k / 3, k % 3, area);
    }
  }
}

static void Update(Step *t, const double swept[])
{
  const Stars *s = t->s;
  const size_t np = (size_t)t->f->np;
  t->f->courant = 0.0;
  for (int e = 0; e < s->ne; e++) {
    double *v = &t->f->volume[(size_t)e * np], out = 0.0;
    for (size_t k = 0; k < 3 * np; k++) v[k % np] -= swept[3 * (size_t)e * np + k];
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
  PetscCall(PetscCalloc1(s->nl, &t->mark));
  PetscCall(PetscMalloc1(s->nl, &t->list));
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
  PetscCall(PetscFree(t->mark));
  PetscCall(PetscFree(t->list));
  PetscFunctionReturn(0);
}

PetscErrorCode PhasesAdvect(Phases f, double dt, const double flux[], const double velocity[],
                            const PhasesInflow *inflow, double swept[])
{
  const size_t n = 3 * (size_t)f->stars->ne * (size_t)f->np;
  Step t = {.f = f, .s = f->stars, .inflow = inflow && inflow->fraction ? inflow : NULL};
  double *own = NULL, lost;
  PetscFunctionBeginUser;
  PetscCheck(f->has_lines, f->stars->mesh->comm, PETSC_ERR_ORDER,
             "PhasesAdvect needs the lines of the present volumes: call PhasesReconstruct before it");
  PetscCall(StepBegin(f, dt, flux, velocity, &t));
  if (!swept) PetscCall(PetscMalloc1(n, &own));
  SweepFaces(&t, swept ? swept : own);
  PetscCallMPI(MPI_Allreduce(&t.lost, &lost, 1, MPI_DOUBLE, MPI_MAX, f->stars->mesh->comm));
  if (!(lost > 0.0)) Update(&t, swept ? swept : own);
  f->has_lines = PETSC_FALSE;
  PetscCall(PetscFree(own));
  PetscCall(StepEnd(&t));
  PetscCheck(
      !(lost > 0.0), f->stars->mesh->comm, PETSC_ERR_ARG_OUTOFRANGE,
      "a step of %g s sweeps areas out of reach (%g of an edge squared): the fluid crosses more than an "
      "element a step",
      dt, lost);
  PetscFunctionReturn(0);
}
