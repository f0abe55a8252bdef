/* Contact between bodies, of a body with itself and with the walls: the forces.
 *
 *     pass 1   every candidate that touches: integrals, normal force, relative velocity  -> sums of its pair
 *     pass 2   every pair: damping and friction from its sums and its spring              (ContactRespond)
 *     pass 3   every active pair: its share of the pair's force, on the edge's ends and the target's nodes */
#include "solid/contact/contact_impl.h"

/* --- what never changes ------------------------------------------------------------------------------- */

static PetscErrorCode FindTargets(Contact c, Solid s)
{
  const Elements *e = &s->elements;
  PetscFunctionBeginUser;
  PetscCall(PetscFree(c->target));
  c->ntargets = 0;
  for (int k = 0; k < e->n; k++)
    c->ntargets += s->surface[e->node[0][k]] || s->surface[e->node[1][k]] || s->surface[e->node[2][k]];
  PetscCall(PetscMalloc1((size_t)c->ntargets, &c->target));
  c->ntargets = 0;
  for (int k = 0; k < e->n; k++) {
    const int node[3] = {e->node[0][k], e->node[1][k], e->node[2][k]};
    if (!s->surface[node[0]] && !s->surface[node[1]] && !s->surface[node[2]]) continue;
    Target *t = &c->target[c->ntargets++];
    *t = (Target){.body = e->body[k], .material = e->material[k], .number = e->number[k]};
    t->twice_area = 1.0 / (e->inverse[0][k] * e->inverse[3][k] - e->inverse[1][k] * e->inverse[2][k]);
    for (int i = 0; i < 3; i++) {
      t->node[i] = node[i];
      t->gid[i] = s->gid[node[i]];
      for (int d = 0; d < 2; d++) t->rest[2 * i + d] = s->rest[2 * node[i] + d];
    }
  }
  PetscFunctionReturn(0);
}

static double FacetLength(const Solid s, int k)
{
  const Point d = PointMinus(PointAt(s->rest, s->facet[2 * k + 1]), PointAt(s->rest, s->facet[2 * k]));
  return hypot(d.x, d.y);
}

static double TargetHeight(const Target *t)
{
  double longest = 0.0;
  for (int i = 0; i < 3; i++) {
    const Point d = PointMinus(PointAt(t->rest, (i + 1) % 3), PointAt(t->rest, i));
    longest = fmax(longest, hypot(d.x, d.y));
  }
  return t->twice_area / longest;
}

/* The mass behind a metre of a body's surface, as if it were a square lying on a side. */
static PetscErrorCode MeasureArealMass(Contact c, Solid s)
{
  double *sum; /* [nbodies][3] mass, perimeter, fixed nodes */
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(3 * (size_t)s->nbodies, &sum));
  for (int n = 0; n < s->nnodes; n++) {
    if (!SolidOwns(s, n)) continue;
    sum[3 * s->node_body[n]] += s->mass[n];
    sum[3 * s->node_body[n] + 2] += s->inverse_mass[n] == 0.0;
  }
  for (int k = 0; k < s->nfacets; k++)
    sum[3 * s->elements.body[s->facet_element[k]] + 1] += FacetLength(s, k);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 3 * s->nbodies, MPI_DOUBLE, MPI_SUM, s->comm));
  for (int b = 0; b < s->nbodies; b++)
    c->areal_mass[b] = sum[3 * b + 2] > 0.0 ? HUGE_VAL : 4.0 * sum[3 * b] / sum[3 * b + 1];
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}

/* height, compliance and the shortest buffer, over all ranks. */
static PetscErrorCode Measure(Contact c, Solid s)
{
  double sum[2] = {0.0, s->nfacets}, *half;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(2 * (size_t)s->nnodes, &half));
  for (int b = 0; b < s->nbodies; b++) {
    c->height[b] = HUGE_VAL;
    c->compliance[b] = 0.0;
  }
  for (int k = 0; k < c->ntargets; k++) {
    const int b = c->target[k].body;
    c->height[b] = fmin(c->height[b], TargetHeight(&c->target[k]));
  }
  for (int k = 0; k < s->nfacets; k++) {
    const double length = FacetLength(s, k);
    sum[0] += length;
    for (int i = 0; i < 2; i++) half[2 * s->facet[2 * k + i]] += 0.5 * length;
  }
  PetscCall(CopiesSum(s->copies, 2, half));
  for (int n = 0; n < s->nnodes; n++) {
    double *compliance = &c->compliance[s->node_body[n]];
    *compliance = fmax(*compliance, half[2 * n] / s->mass[n]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, c->height, s->nbodies, MPI_DOUBLE, MPI_MIN, s->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, c->compliance, s->nbodies, MPI_DOUBLE, MPI_MAX, s->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->comm));
  c->shortest_buffer = 0.5 * sum[0] / sum[1];
  PetscCall(PetscFree(half));
  PetscFunctionReturn(0);
}

static PetscBool AnyRough(const Solid s)
{
  PetscBool rough = PETSC_FALSE;
  for (int m = 0; m < s->nmaterials; m++)
    if (s->material[m].friction > 0.0 || s->material[m].contact_damping > 0.0) rough = PETSC_TRUE;
  for (int k = 0; k < s->setup.nrules; k++)
    if (s->setup.rule[k].friction > 0.0 || s->setup.rule[k].damping > 0.0) rough = PETSC_TRUE;
  return rough;
}

PetscErrorCode ContactCreate(Solid s, Contact *contact)
{
  Contact c;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&c));
  if (s->size > 1) PetscCall(HaloCreate(s->comm, &c->halo));
  PetscCall(PetscCalloc3((size_t)s->nbodies, &c->height, (size_t)s->nbodies, &c->compliance,
                         (size_t)s->nbodies, &c->areal_mass));
  c->rough = AnyRough(s);
  PetscCall(ContactRenew(c, s));
  *contact = c;
  PetscFunctionReturn(0);
}

PetscErrorCode ContactRenew(Contact c, Solid s)
{
  PetscFunctionBeginUser;
  PetscCall(ContactForgetPairs(c));
  PetscCall(PetscRealloc(2 * (size_t)s->nnodes * sizeof *c->searched, &c->searched));
  PetscCall(PetscRealloc((size_t)s->nfacets * sizeof *c->first_pair, &c->first_pair));
  PetscCall(FindTargets(c, s));
  PetscCall(Measure(c, s));
  PetscCall(MeasureArealMass(c, s));
  PetscFunctionReturn(0);
}

double ContactSkin(Contact c)
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

ElementRates ContactRate(Contact c)
{
  return (ElementRates){c->rate[0] + c->rate[1], c->rate[2] + c->rate[3]};
}

Point ContactWalls(Contact c)
{
  return c->walls;
}

/* --- forces ------------------------------------------------------------------------------------------- */

static Point VelocityOf(const Contact c, const Solid s, int node)
{
  if (node < s->nnodes) return PointAt(s->v, node);
  return PointAt(HaloVelocities(c->halo), node - s->nnodes);
}

/* Relative velocity at the force's place, into the pair's sums with the normal force as weight. */
static void AddMotion(const Contact c, const Solid s, const ActivePair *active, const int *edge,
                      const Target *t, Point d, Pair *pair)
{
  const ContactIntegrals *k = &active->integrals;
  const double sum = k->edge[0] + k->edge[1];
  Point v = {0.0, 0.0};
  if (!(sum > 0.0)) return;
  for (int i = 0; i < 2; i++) {
    const Point u = PointAt(s->v, edge[i]);
    v.x += k->edge[i] / sum * u.x;
    v.y += k->edge[i] / sum * u.y;
  }
  for (int i = 0; t && i < 3; i++) {
    const Point u = VelocityOf(c, s, t->node[i]);
    v.x -= k->target[i] / sum * u.x;
    v.y -= k->target[i] / sum * u.y;
  }
  const double scale = active->scale * sum; /* normal force over the edge's length */
  pair->normal += scale * hypot(d.x, d.y);
  pair->inside += k->inside;
  pair->vn += scale * (v.x * d.y - v.y * d.x);
  pair->vt += scale * (v.x * d.x + v.y * d.y);
}

static Point EdgeVector(const Solid s, const int *edge)
{
  return PointMinus(PointAt(s->x, edge[1]), PointAt(s->x, edge[0]));
}

static int ActivePairTarget(const Contact c, Solid s, const Candidate *k, ActivePair *active)
{
  const Target *t = &c->target[k->target];
  const int *edge = s->facet + 2 * k->facet;
  Point corner[3];
  for (int i = 0; i < 3; i++) corner[i] = PointAt(ContactPosition(c, s, t->node[i]), 0);
  if (!ContactEdgeTriangle(PointAt(s->x, edge[0]), PointAt(s->x, edge[1]), corner, &active->integrals))
    return 0;
  active->scale = k->strength / active->integrals.twice_area;
  if (c->rough) AddMotion(c, s, active, edge, t, EdgeVector(s, edge), &c->pair[k->pair]);
  return 1;
}

static int ActivePairWall(const Contact c, Solid s, const WallCandidate *w, ActivePair *active)
{
  const int *edge = s->facet + 2 * w->facet, element = s->facet_element[w->facet];
  const Material *m = &s->material[s->elements.material[element]];
  const double depth_p = w->outward * (s->x[2 * edge[0] + w->axis] - w->at);
  const double depth_q = w->outward * (s->x[2 * edge[1] + w->axis] - w->at);
  const double height = c->height[s->elements.body[element]];
  if (!ContactEdgeWall(depth_p, depth_q, height, &active->integrals)) return 0;
  active->scale = m->penalty * m->thickness;
  if (c->rough) AddMotion(c, s, active, edge, NULL, EdgeVector(s, edge), &c->pair[w->pair]);
  return 1;
}

/* All that touches now; the pairs' sums. */
static PetscErrorCode FindActivePairs(Contact c, Solid s, int *nactive)
{
  const int most = c->ncandidates + c->nwalls;
  int n = 0;
  PetscFunctionBeginUser;
  if (most > c->active_capacity) {
    c->active_capacity = most + most / 2;
    PetscCall(PetscRealloc((size_t)c->active_capacity * sizeof *c->active, &c->active));
  }
  for (int k = 0; k < c->npairs; k++)
    c->pair[k].normal = c->pair[k].inside = c->pair[k].vn = c->pair[k].vt = 0.0;
  for (int k = 0; k < c->ncandidates; k++) {
    c->active[n].candidate = k;
    n += ActivePairTarget(c, s, &c->candidate[k], &c->active[n]);
  }
  for (int k = 0; k < c->nwalls; k++) {
    c->active[n].candidate = -1 - k;
    n += ActivePairWall(c, s, &c->wall[k], &c->active[n]);
  }
  *nactive = n;
  PetscFunctionReturn(0);
}

/* The spring stretches by the last substep's motion.  Nothing here changes `slip`: forces may be asked for
 * several times. */
static void Respond(Contact c, const Solid s)
{
  for (int k = 0; k < c->npairs; k++) {
    Pair *p = &c->pair[k];
    p->now = 0.0;
    p->response = (ContactResponse){0.0, 0.0, 0.0};
    if (!(p->normal > 0.0)) continue;
    /* vn and vt were summed with the edge's length as a factor, as was the normal force */
    const double vn = p->vn / p->normal, vt = p->vt / p->normal;
    p->response = ContactRespond(p->law, p->normal, p->inside, p->slip + s->moved_for * vt, vn, vt);
    p->now = p->response.slip;
  }
}

static void Add(double force[], int node, double scale, Point f)
{
  force[2 * node] += scale * f.x;
  force[2 * node + 1] += scale * f.y;
}

static void AddActivePair(Contact c, Solid s, const ActivePair *active)
{
  const Candidate *k = active->candidate < 0 ? NULL : &c->candidate[active->candidate];
  const WallCandidate *w = k ? NULL : &c->wall[-1 - active->candidate];
  const int *edge = s->facet + 2 * (k ? k->facet : w->facet);
  const ContactResponse *r = &c->pair[k ? k->pair : w->pair].response;
  const Point d = EdgeVector(s, edge);
  const double normal = 1.0 + r->normal, tangential = r->tangential;
  const Point f = {-d.y * normal + d.x * tangential, d.x * normal + d.y * tangential}; /* on the edge */
  for (int i = 0; i < 2; i++) {
    const double scale = active->scale * active->integrals.edge[i];
    Add(s->force, edge[i], scale, f);
    if (w) c->walls = (Point){c->walls.x + scale * f.x, c->walls.y + scale * f.y};
  }
  for (int i = 0; k && i < 3; i++) {
    const int node = c->target[k->target].node[i];
    const double scale = -active->scale * active->integrals.target[i];
    if (node < s->nnodes)
      Add(s->force, node, scale, f);
    else
      Add(HaloForces(c->halo), node - s->nnodes, scale, f);
  }
}

PetscErrorCode ContactAddForces(Contact c, Solid s)
{
  int n;
  PetscFunctionBeginUser;
  if (c->halo) PetscCall(HaloForward(c->halo, s->x, c->rough ? s->v : NULL));
  PetscCall(FindActivePairs(c, s, &n));
  Respond(c, s);
  c->walls = (Point){0.0, 0.0};
  for (int k = 0; k < n; k++) AddActivePair(c, s, &c->active[k]);
  if (c->halo) PetscCall(HaloReverse(c->halo, s->force));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactDestroy(Contact *c)
{
  PetscFunctionBeginUser;
  if (!*c) PetscFunctionReturn(0);
  PetscCall(HaloDestroy(&(*c)->halo));
  PetscCall(PetscFree3((*c)->height, (*c)->compliance, (*c)->areal_mass));
  PetscCall(PetscFree((*c)->searched));
  PetscCall(PetscFree((*c)->first_pair));
  PetscCall(PetscFree((*c)->target));
  PetscCall(PetscFree((*c)->candidate));
  PetscCall(PetscFree((*c)->wall));
  PetscCall(PetscFree((*c)->pair));
  PetscCall(PetscFree((*c)->active));
  PetscCall(PetscFree((*c)->history.slip));
  PetscCall(PetscFree((*c)->saved.slip));
  PetscCall(PetscFree(*c));
  PetscFunctionReturn(0);
}
