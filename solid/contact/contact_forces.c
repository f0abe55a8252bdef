/* The forces of contact: what touches, springs and dampers of each pair, forces on edges and targets. */
#include "solid/contact/contact_impl.h"

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
  pair->phi += sum;
  pair->largest_phi = Greater(pair->largest_phi, k->largest_phi);
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
  for (int k = 0; k < c->npairs; k++) {
    Pair *p = &c->pair[k];
    p->normal = p->inside = p->vn = p->vt = p->phi = p->largest_phi = 0.0;
  }
  for (int k = 0; k < c->nnear; k++) {
    c->active[n].candidate = c->near[k];
    n += ActivePairTarget(c, s, &c->candidate[c->near[k]], &c->active[n]);
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
    const double viscosity = ContactViscosity(p->law, p->inside, p->phi / p->largest_phi);
    p->response = ContactRespond(p->law, p->normal, viscosity, p->slip + s->moved_for * vt, vn, vt);
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
