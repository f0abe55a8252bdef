/* Contact between bodies and with the walls: which pairs, and their forces. */
#include "cell_grid.h"
#include "contact_halo.h"
#include "contact_kernel.h"
#include "solid_impl.h"

/* An edge that may touch a target before the next search. */
typedef struct {
  int facet, target;
  double strength; /* p times the target's rest area doubled: over its area now, that is p/J */
} Candidate;

/* An edge that may touch a wall. */
typedef struct {
  int facet, axis;
  double outward, at; /* -1 or 1, and the wall's coordinate */
} WallCandidate;

struct Contact_s {
  int ntargets, nall; /* this rank's; with those of the halo */
  Target *target;     /* [nall] */
  int ncandidates, candidate_capacity, nwalls, wall_capacity;
  Candidate *candidate;
  WallCandidate *wall;
  Halo halo;        /* NULL on one rank or with one body */
  double *height;   /* [nbodies] smallest height of the surface elements at rest, m */
  double *softness; /* [nbodies] largest (half the edges' lengths at a node)/(its mass), m/kg */
  double *searched; /* [nnodes][2] positions of the last search */
  double buffer, shortest_buffer;
  double rate[2]; /* bounds of omega^2 by bodies and by walls, 1/s2 */
};

/* --- what never changes
 * ------------------------------------------------------------------------------------- */

static PetscErrorCode FindTargets(Contact c, Solid s)
{
  const Elements *e = &s->elements;
  PetscFunctionBeginUser;
  for (int k = 0; k < e->n; k++)
    c->ntargets += s->surface[e->node[0][k]] || s->surface[e->node[1][k]] || s->surface[e->node[2][k]];
  PetscCall(PetscMalloc1((size_t)c->ntargets, &c->target));
  c->ntargets = 0;
  for (int k = 0; k < e->n; k++) {
    const int node[3] = {e->node[0][k], e->node[1][k], e->node[2][k]};
    if (!s->surface[node[0]] && !s->surface[node[1]] && !s->surface[node[2]]) continue;
    const double twice = 1.0 / (e->inverse[0][k] * e->inverse[3][k] - e->inverse[1][k] * e->inverse[2][k]);
    c->target[c->ntargets++] = (Target){{node[0], node[1], node[2]}, e->body[k], twice};
  }
  PetscFunctionReturn(0);
}

static double FacetLength(const Solid s, int k)
{
  const Point d = PointMinus(PointAt(s->rest, s->facet[2 * k + 1]), PointAt(s->rest, s->facet[2 * k]));
  return hypot(d.x, d.y);
}

static double TargetHeight(const Solid s, const Target *t)
{
  double longest = 0.0;
  for (int i = 0; i < 3; i++) {
    const Point d = PointMinus(PointAt(s->rest, t->node[(i + 1) % 3]), PointAt(s->rest, t->node[i]));
    longest = fmax(longest, hypot(d.x, d.y));
  }
  return t->twice_area / longest;
}

/* height, softness and the shortest buffer, over all ranks. */
static PetscErrorCode Measure(Contact c, Solid s)
{
  double sum[2] = {0.0, s->nfacets}, *half;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(2 * (size_t)s->nnodes, &half));
  for (int b = 0; b < s->nbodies; b++) c->height[b] = HUGE_VAL;
  for (int k = 0; k < c->ntargets; k++) {
    const int b = c->target[k].body;
    c->height[b] = fmin(c->height[b], TargetHeight(s, &c->target[k]));
  }
  for (int k = 0; k < s->nfacets; k++) {
    const double length = FacetLength(s, k);
    sum[0] += length;
    for (int i = 0; i < 2; i++) half[2 * s->facet[2 * k + i]] += 0.5 * length;
  }
  PetscCall(ShareSum(s->share, half));
  for (int n = 0; n < s->nnodes; n++) {
    double *softness = &c->softness[s->node_body[n]];
    *softness = fmax(*softness, half[2 * n] / s->mass[n]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, c->height, s->nbodies, MPI_DOUBLE, MPI_MIN, s->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, c->softness, s->nbodies, MPI_DOUBLE, MPI_MAX, s->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->comm));
  c->shortest_buffer = 0.5 * sum[0] / sum[1];
  PetscCall(PetscFree(half));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactCreate(Solid s, Contact *contact)
{
  Contact c;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&c));
  if (s->nbodies > 1 && s->size > 1) PetscCall(HaloCreate(s->comm, &c->halo));
  PetscCall(PetscCalloc3((size_t)s->nbodies, &c->height, (size_t)s->nbodies, &c->softness,
                         2 * (size_t)s->nnodes, &c->searched));
  PetscCall(FindTargets(c, s));
  PetscCall(Measure(c, s));
  *contact = c;
  PetscFunctionReturn(0);
}

/* --- search
 * ------------------------------------------------------------------------------------------------- */

typedef struct {
  Contact c;
  Solid s;
  char *keep; /* [halo targets] */
} SearchContext;

static double Penalty(const Solid s, int one, int other)
{
  return fmin(s->body[one].material.penalty, s->body[other].material.penalty);
}

static PetscErrorCode AddCandidate(void *context, int facet, int target)
{
  const SearchContext *x = context;
  Contact c = x->c;
  const Solid s = x->s;
  const Target *t = &c->target[target];
  const int body = s->elements.body[s->facet_element[facet]];
  PetscFunctionBeginUser;
  if (t->body == body) PetscFunctionReturn(0);
  if (c->ncandidates == c->candidate_capacity) {
    c->candidate_capacity = 2 * c->candidate_capacity + 64;
    PetscCall(PetscRealloc((size_t)c->candidate_capacity * sizeof *c->candidate, &c->candidate));
  }
  const double penalty = Penalty(s, body, t->body);
  c->candidate[c->ncandidates++] = (Candidate){facet, target, penalty * t->twice_area};
  if (target >= c->ntargets) x->keep[target - c->ntargets] = 1;
  /* d(p phi)/dx = 3 p/height; a node takes half of its edges, |u_c - u_t|^2 <= 2 |u_c|^2 + 2 |u_t|^2, and
   * both bodies are contactor and target */
  c->rate[0] = fmax(c->rate[0], 6.0 * penalty * fmax(c->softness[body], c->softness[t->body]) *
                                    (1.0 / c->height[body] + 1.0 / c->height[t->body]));
  PetscFunctionReturn(0);
}

static PetscErrorCode AddWall(Contact c, WallCandidate wall)
{
  PetscFunctionBeginUser;
  if (c->nwalls == c->wall_capacity) {
    c->wall_capacity = 2 * c->wall_capacity + 64;
    PetscCall(PetscRealloc((size_t)c->wall_capacity * sizeof *c->wall, &c->wall));
  }
  c->wall[c->nwalls++] = wall;
  PetscFunctionReturn(0);
}

static PetscErrorCode FindWalls(Contact c, Solid s, const GeometryBox edge[])
{
  const double *lower = s->setup.lower, *upper = s->setup.upper;
  PetscFunctionBeginUser;
  for (int k = 0; k < s->nfacets; k++) {
    const int body = s->elements.body[s->facet_element[k]], before = c->nwalls;
    for (int axis = 0; axis < 2; axis++) {
      if (edge[k].lower[axis] < lower[axis])
        PetscCall(AddWall(c, (WallCandidate){k, axis, -1.0, lower[axis]}));
      if (edge[k].upper[axis] > upper[axis])
        PetscCall(AddWall(c, (WallCandidate){k, axis, 1.0, upper[axis]}));
    }
    /* in a corner two walls act */
    c->rate[1] = fmax(c->rate[1], 3.0 * (c->nwalls - before) * s->body[body].material.penalty *
                                      c->softness[body] / c->height[body]);
  }
  PetscFunctionReturn(0);
}

static const double *Position(const Contact c, const Solid s, int node)
{
  return node < s->nnodes ? s->x + 2 * node : HaloPositions(c->halo) + 2 * (node - s->nnodes);
}

static Point PointOf(const Contact c, const Solid s, int node)
{
  const double *x = Position(c, s, node);
  return (Point){x[0], x[1]};
}

/* Brings other ranks' targets near this rank's edges behind its own. */
static PetscErrorCode BringTargets(Contact c, Solid s, const GeometryBox edge[])
{
  GeometryBox all = GeometryBoxEmpty();
  const Target *foreign;
  int only_body = s->nfacets ? s->elements.body[s->facet_element[0]] : -1;
  PetscFunctionBeginUser;
  c->nall = c->ntargets;
  if (!c->halo) PetscFunctionReturn(0);
  for (int k = 0; k < s->nfacets; k++) {
    GeometryBoxGrow(&all, edge[k].lower);
    GeometryBoxGrow(&all, edge[k].upper);
    if (s->elements.body[s->facet_element[k]] != only_body) only_body = -1;
  }
  PetscCall(HaloBuild(c->halo, s->nnodes, s->x, &all, only_body, c->ntargets, c->target));
  PetscCall(HaloForward(c->halo, s->x));
  const int n = HaloTargets(c->halo, &foreign);
  c->nall += n;
  PetscCall(PetscRealloc((size_t)c->nall * sizeof *c->target, &c->target));
  PetscCall(PetscArraycpy(c->target + c->ntargets, foreign, (size_t)n));
  PetscFunctionReturn(0);
}

/* Forgets the targets of other ranks that no candidate has. */
static PetscErrorCode DropTargets(Contact c, const char keep[])
{
  const Target *foreign;
  int *index;
  PetscFunctionBeginUser;
  if (!c->halo) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1((size_t)(c->nall - c->ntargets), &index));
  PetscCall(HaloKeep(c->halo, keep, index));
  for (int k = 0; k < c->ncandidates; k++) {
    int *target = &c->candidate[k].target;
    if (*target >= c->ntargets) *target = c->ntargets + index[*target - c->ntargets];
  }
  const int n = HaloTargets(c->halo, &foreign);
  c->nall = c->ntargets + n;
  PetscCall(PetscArraycpy(c->target + c->ntargets, foreign, (size_t)n));
  PetscCall(PetscFree(index));
  PetscFunctionReturn(0);
}

/* Every pair of boxes closer than the buffer. */
static PetscErrorCode FindPairs(Contact c, Solid s, const GeometryBox edge[])
{
  SearchContext context = {c, s, NULL};
  GeometryBox *box;
  PetscFunctionBeginUser;
  PetscCall(BringTargets(c, s, edge));
  PetscCall(PetscMalloc1((size_t)c->nall, &box));
  PetscCall(PetscCalloc1((size_t)(c->nall - c->ntargets), &context.keep));
  for (int k = 0; k < c->nall; k++) {
    box[k] = GeometryBoxEmpty();
    for (int i = 0; i < 3; i++) GeometryBoxGrow(&box[k], Position(c, s, c->target[k].node[i]));
  }
  PetscCall(CellGridPairs(s->nfacets, edge, c->nall, box, AddCandidate, &context));
  PetscCall(DropTargets(c, context.keep));
  PetscCall(PetscFree(context.keep));
  PetscCall(PetscFree(box));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactSearch(Contact c, Solid s, double least_buffer)
{
  GeometryBox *edge;
  PetscFunctionBeginUser;
  c->buffer = fmax(c->shortest_buffer, least_buffer);
  c->ncandidates = c->nwalls = 0;
  c->rate[0] = c->rate[1] = 0.0;
  PetscCall(PetscMalloc1((size_t)s->nfacets, &edge));
  for (int k = 0; k < s->nfacets; k++) {
    edge[k] = GeometryBoxEmpty();
    for (int i = 0; i < 2; i++) GeometryBoxGrow(&edge[k], s->x + 2 * s->facet[2 * k + i]);
    for (int axis = 0; axis < 2; axis++) {
      edge[k].lower[axis] -= c->buffer;
      edge[k].upper[axis] += c->buffer;
    }
  }
  if (s->setup.walls) PetscCall(FindWalls(c, s, edge));
  if (s->nbodies > 1) PetscCall(FindPairs(c, s, edge));
  if (s->size > 1) PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, c->rate, 2, MPI_DOUBLE, MPI_MAX, s->comm));
  PetscCall(PetscArraycpy(c->searched, s->x, 2 * (size_t)s->nnodes));
  PetscCall(PetscFree(edge));
  s->stats.searches++;
  PetscFunctionReturn(0);
}

double ContactReach(Contact c)
{
  return 0.5 * c->buffer;
}

double ContactMoved(Contact c, Solid s)
{
  double largest = 0.0;
  for (int n = 0; n < s->nnodes; n++) {
    if (!s->surface[n]) continue;
    const double dx = s->x[2 * n] - c->searched[2 * n], dy = s->x[2 * n + 1] - c->searched[2 * n + 1];
    largest = fmax(largest, dx * dx + dy * dy);
  }
  return sqrt(largest);
}

double ContactRate(Contact c)
{
  return c->rate[0] + c->rate[1];
}

/* --- forces
 * ------------------------------------------------------------------------------------------------- */

static void Add(double force[], int node, double scale, Point f)
{
  force[2 * node] += scale * f.x;
  force[2 * node + 1] += scale * f.y;
}

static void AddPair(const Contact c, Solid s, const Candidate *k)
{
  const Target *t = &c->target[k->target];
  const int *edge = s->facet + 2 * k->facet;
  const Point corner[3] = {PointOf(c, s, t->node[0]), PointOf(c, s, t->node[1]), PointOf(c, s, t->node[2])};
  ContactForces f;
  if (!ContactEdgeTriangle(PointAt(s->x, edge[0]), PointAt(s->x, edge[1]), corner, &f)) return;
  const double scale = k->strength / f.twice_area;
  Add(s->force, edge[0], scale, f.p);
  Add(s->force, edge[1], scale, f.q);
  for (int i = 0; i < 3; i++) {
    if (t->node[i] < s->nnodes)
      Add(s->force, t->node[i], scale, f.t[i]);
    else
      Add(HaloForces(c->halo), t->node[i] - s->nnodes, scale, f.t[i]);
  }
}

static void AddWallForce(const Contact c, Solid s, const WallCandidate *w)
{
  const int *edge = s->facet + 2 * w->facet, body = s->elements.body[s->facet_element[w->facet]];
  const Point p = PointAt(s->x, edge[0]), q = PointAt(s->x, edge[1]), n = {q.y - p.y, p.x - q.x};
  const double depth_p = w->outward * ((w->axis ? p.y : p.x) - w->at);
  const double depth_q = w->outward * ((w->axis ? q.y : q.x) - w->at);
  double integral[2];
  if (!ContactEdgeWall(depth_p, depth_q, c->height[body], integral)) return;
  for (int i = 0; i < 2; i++) Add(s->force, edge[i], -s->body[body].material.penalty * integral[i], n);
}

PetscErrorCode ContactAddForces(Contact c, Solid s)
{
  PetscFunctionBeginUser;
  if (c->halo) PetscCall(HaloForward(c->halo, s->x));
  for (int k = 0; k < c->ncandidates; k++) AddPair(c, s, &c->candidate[k]);
  for (int k = 0; k < c->nwalls; k++) AddWallForce(c, s, &c->wall[k]);
  if (c->halo) PetscCall(HaloReverse(c->halo, s->force));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactDestroy(Contact *c)
{
  PetscFunctionBeginUser;
  if (!*c) PetscFunctionReturn(0);
  PetscCall(HaloDestroy(&(*c)->halo));
  PetscCall(PetscFree3((*c)->height, (*c)->softness, (*c)->searched));
  PetscCall(PetscFree((*c)->target));
  PetscCall(PetscFree((*c)->candidate));
  PetscCall(PetscFree((*c)->wall));
  PetscCall(PetscFree(*c));
  PetscFunctionReturn(0);
}
