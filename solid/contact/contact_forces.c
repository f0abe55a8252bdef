/* The forces of contact: what touches, springs and dampers of each pair, forces on edges and targets. */
#include "common/supermesh/vectorize.h"
#include "solid/contact/contact_impl.h"

enum { MOST_CANDIDATES = 6 }; /* of a couple: the sides of both */

/* --- couples ------------------------------------------------------------------------------------------ */

static PetscBool Separated(const Contact c, const Solid s, const Couple *k)
{
  if (k->separating < 0) return PETSC_FALSE; /* discs: of triangles alone */
  const int i = k->separating % 3, *a = k->node[k->separating / 3], *b = k->node[1 - k->separating / 3];
  const Point side[2] = {ContactPosition(c, s, a[(i + 1) % 3]), ContactPosition(c, s, a[(i + 2) % 3])};
  for (int n = 0; n < 3; n++)
    if (!ContactBeyond(side[0], side[1], ContactPosition(c, s, b[n]))) return PETSC_FALSE;
  return PETSC_TRUE;
}

int ContactSeparatingSide(const Contact c, const Solid s, const Couple *couple)
{
  Couple k = *couple;
  if (k.discs) return -1;
  for (k.separating = 5; k.separating >= 0 && !Separated(c, s, &k);) k.separating--;
  return k.separating;
}

static Point VelocityOf(const Contact c, const Solid s, int node)
{
  return node < s->nnodes ? PointAt(s->v, node) : PointAt(HaloVelocities(c->halo), node - s->nnodes);
}

/* --- what touches ------------------------------------------------------------------------------------- */

/* Relative velocity at the force's place, into the pair's sums with the normal force as weight; contactor[3], from the edge's start on, target[3]: velocities
 * of the nodes, the latter NULL at a wall. */
static void AddMotion(Contact c, const ActivePair *active, const Point contactor[3], const Point target[3])
{
  const ContactIntegrals *k = &active->integrals;
  const Point d = active->along;
  const double weight[3] = {k->edge[0], k->edge[1], k->opposite}, sum = ContactSum(k),
               normal = active->scale * sum * sqrt(d.x * d.x + d.y * d.y);
  Pair *pair = &c->pair[active->pair];
  Point v = {0.0, 0.0}; /* times the sum */
  if (!(normal > 0.0)) return;
  for (int i = 0; i < 3; i++) {
    v.x += weight[i] * contactor[i].x;
    v.y += weight[i] * contactor[i].y;
  }
  for (int i = 0; target && i < 3; i++) {
    v.x -= k->target[i] * target[i].x;
    v.y -= k->target[i] * target[i].y;
  }
  if (pair->normal == 0.0) c->pressed[c->npressed++] = active->pair;
  pair->normal += normal;
  pair->inside += k->inside;
  pair->phi += sum;
  pair->largest_phi = Greater(pair->largest_phi, k->largest_phi);
  pair->vn += active->scale * (v.x * d.y - v.y * d.x);
  pair->vt += active->scale * (v.x * d.x + v.y * d.y);
}

static void AddMotionOfCouple(Contact c, const Solid s, const Couple *couple, const ActivePair *a)
{
  Point contactor[3], target[3];
  for (int i = 0; i < 3; i++) {
    contactor[i] = VelocityOf(c, s, couple->node[a->of][(a->side + i) % 3]);
    target[i] = VelocityOf(c, s, couple->node[1 - a->of][i]);
  }
  AddMotion(c, a, contactor, target);
}

/* Candidates whose integrals are made side by side. */
typedef struct {
  int n, couple[STRIP], candidate[STRIP];
  double p[2][STRIP], q[2][STRIP], t[3][2][STRIP];
  double edge[2][STRIP], target[3][STRIP], largest_phi[STRIP], inside[STRIP], twice_area[STRIP];
} Strip;

static void AddToStrip(const Contact c, const Solid s, int couple, Strip *strip)
{
  const Couple *k = &c->couple[couple];
  for (int i = k->first; i < k->first + k->n; i++) {
    const Candidate *candidate = &c->candidate[i];
    const int of = candidate->target == k->target[0], *edge = s->facet + 2 * candidate->facet, n = strip->n++;
    strip->couple[n] = couple;
    strip->candidate[n] = i;
    for (int d = 0; d < 2; d++) {
      strip->p[d][n] = s->x[2 * edge[0] + d];
      strip->q[d][n] = s->x[2 * edge[1] + d];
    }
    for (int j = 0; j < 3; j++) {
      const Point x = ContactPosition(c, s, k->node[1 - of][j]);
      strip->t[j][0][n] = x.x;
      strip->t[j][1][n] = x.y;
    }
  }
}

static WIDE void IntegrateStrip(Strip *strip)
{
  VECTORIZE
  for (int k = 0; k < strip->n; k++) {
    const Point p = {strip->p[0][k], strip->p[1][k]}, q = {strip->q[0][k], strip->q[1][k]};
    const Point t[3] = {{strip->t[0][0][k], strip->t[0][1][k]},
                        {strip->t[1][0][k], strip->t[1][1][k]},
                        {strip->t[2][0][k], strip->t[2][1][k]}};
    const ContactIntegrals c = ContactEdgeTriangle(p, q, t);
    for (int i = 0; i < 2; i++) strip->edge[i][k] = c.edge[i];
    for (int i = 0; i < 3; i++) strip->target[i][k] = c.target[i];
    strip->largest_phi[k] = c.largest_phi;
    strip->inside[k] = c.inside;
    strip->twice_area[k] = c.twice_area;
  }
}

static void AddActive(Contact c, const Solid s, const Strip *strip, int k, ActivePair *a)
{
  const Couple *couple = &c->couple[strip->couple[k]];
  const Candidate *candidate = &c->candidate[strip->candidate[k]];
  a->couple = strip->couple[k];
  a->of = candidate->target == couple->target[0];
  a->side = s->facet_side[candidate->facet];
  a->pair = candidate->pair;
  a->scale = candidate->strength / strip->twice_area[k];
  a->along = (Point){strip->q[0][k] - strip->p[0][k], strip->q[1][k] - strip->p[1][k]};
  a->integrals = (ContactIntegrals){.edge = {strip->edge[0][k], strip->edge[1][k]},
                                    .target = {strip->target[0][k], strip->target[1][k], strip->target[2][k]},
                                    .largest_phi = strip->largest_phi[k],
                                    .inside = strip->inside[k],
                                    .twice_area = strip->twice_area[k]};
  if (c->rough) AddMotionOfCouple(c, s, couple, a);
}

/* Adds those that touch to active[n]; returns their number.  The strip is empty then. */
static int FindActive(Contact c, const Solid s, Strip *strip, ActivePair active[])
{
  int n = 0;
  IntegrateStrip(strip);
  for (int k = 0; k < strip->n;) {
    const int couple = strip->couple[k], before = n;
    for (; k < strip->n && strip->couple[k] == couple; k++)
      if (strip->inside[k] > 0.0) AddActive(c, s, strip, k, &active[n++]);
    c->couple[couple].separating = n > before ? -1 : ContactSeparatingSide(c, s, &c->couple[couple]);
  }
  strip->n = 0;
  return n;
}

/* Discs' candidates that touch, to active[]; returns their number. */
static int FindActiveDiscs(Contact c, const Solid s, int couple, ActivePair active[])
{
  const Couple *k = &c->couple[couple];
  int n = 0;
  for (int i = k->first; i < k->first + k->n; i++) {
    const Candidate *candidate = &c->candidate[i];
    ActivePair *a = &active[n];
    a->couple = couple;
    a->of = candidate->target == k->target[0];
    a->side = s->facet_side[candidate->facet];
    a->pair = candidate->pair;
    if (!DiscActive(c, s, candidate, k->target[a->of], a)) continue;
    if (c->rough) AddMotionOfCouple(c, s, k, a);
    n++;
  }
  return n;
}

static int OppositeNode(const Solid s, int facet)
{
  return s->elements.node[(s->facet_side[facet] + 2) % 3][s->facet_element[facet]];
}

static int ActiveWall(const Contact c, Solid s, int wall, ActivePair *active)
{
  const WallCandidate *w = &c->wall[wall];
  const int *edge = s->facet + 2 * w->facet, element = s->facet_element[w->facet];
  const int body = s->elements.body[element], opposite = OppositeNode(s, w->facet);
  const Material *m = &s->material[s->elements.material[element]];
  const Point v[3] = {PointAt(s->v, edge[0]), PointAt(s->v, edge[1]), PointAt(s->v, opposite)};
  active->couple = -1 - wall;
  active->pair = w->pair;
  active->scale = m->penalty * m->thickness;
  active->along = PointMinus(PointAt(s->x, edge[1]), PointAt(s->x, edge[0]));
  if (ContactIsDisc(s, body)) {
    if (!DiscActiveAtWall(c, s, w, active)) return 0;
  } else {
    const double depth_p = w->outward * (s->x[2 * edge[0] + w->axis] - w->at);
    const double depth_q = w->outward * (s->x[2 * edge[1] + w->axis] - w->at);
    if (!ContactEdgeWall(depth_p, depth_q, c->height[body], &active->integrals)) return 0;
  }
  if (c->rough) AddMotion(c, active, v, NULL);
  return 1;
}

static void ForgetSums(Contact c)
{
  for (int k = 0; k < c->npressed; k++) {
    Pair *p = &c->pair[c->pressed[k]];
    p->normal = p->inside = p->vn = p->vt = p->phi = p->largest_phi = p->now = 0.0;
    p->response = (ContactResponse){0.0, 0.0, 0.0};
  }
  c->npressed = 0;
}

/* All that touches now; the pairs' sums. */
static PetscErrorCode FindActivePairs(Contact c, Solid s)
{
  const int most = c->ncandidates + c->nwalls;
  Strip strip;
  int n = 0;
  PetscFunctionBeginUser;
  if (most > c->active_capacity) {
    c->active_capacity = most + most / 2;
    PetscCall(PetscRealloc((size_t)c->active_capacity * sizeof *c->active, &c->active));
  }
  ForgetSums(c);
  strip.n = 0;
  for (int k = 0; k < c->nnear; k++) {
    if (c->couple[c->near[k]].discs) {
      n += FindActiveDiscs(c, s, c->near[k], c->active + n);
      continue;
    }
    if (Separated(c, s, &c->couple[c->near[k]])) continue;
    AddToStrip(c, s, c->near[k], &strip);
    if (strip.n > STRIP - MOST_CANDIDATES) n += FindActive(c, s, &strip, c->active + n);
  }
  n += FindActive(c, s, &strip, c->active + n);
  for (int k = 0; k < c->nwalls; k++) n += ActiveWall(c, s, k, &c->active[n]);
  c->nactive = n;
  PetscFunctionReturn(0);
}

/* --- forces ------------------------------------------------------------------------------------------- */

/* The spring stretches by the last substep's motion.  Nothing here changes `slip`: forces may be asked for
 * several times. */
static void Respond(Contact c, const Solid s)
{
  for (int k = 0; k < c->npressed; k++) {
    Pair *p = &c->pair[c->pressed[k]];
    /* vn and vt were summed with the edge's length as a factor, as was the normal force */
    const double vn = p->vn / p->normal, vt = p->vt / p->normal;
    const double viscosity = ContactViscosity(p->law, p->inside, p->phi / p->largest_phi);
    p->response = ContactRespond(p->law, p->normal, viscosity, p->slip + s->moved_for * vt, vn, vt);
    p->now = p->response.slip;
  }
}

double ContactLoss(const Contact c)
{
  double loss = 0.0;
  for (int k = 0; k < c->npressed; k++) {
    const Pair *p = &c->pair[c->pressed[k]];
    loss += p->response.normal * p->vn - p->response.tangential * p->vt;
  }
  return loss;
}

static void Add(double force[], int node, double scale, Point f)
{
  force[2 * node] += scale * f.x;
  force[2 * node + 1] += scale * f.y;
}

/* On the edge, over the length of which the integrals are shares. */
static Point ForceOf(const Contact c, const ActivePair *active)
{
  const ContactResponse *r = &c->pair[active->pair].response;
  const Point d = active->along;
  const double normal = active->scale * (1.0 + r->normal), tangential = active->scale * r->tangential;
  return (Point){-d.y * normal + d.x * tangential, d.x * normal + d.y * tangential};
}

static void AddWall(Contact c, Solid s, const ActivePair *active)
{
  const int facet = c->wall[-1 - active->couple].facet, *edge = s->facet + 2 * facet;
  const Point f = ForceOf(c, active);
  const double sum = ContactSum(&active->integrals);
  for (int i = 0; i < 2; i++) Add(s->force, edge[i], active->integrals.edge[i], f);
  Add(s->force, OppositeNode(s, facet), active->integrals.opposite, f);
  c->walls.x += sum * f.x;
  c->walls.y += sum * f.y;
}

/* All active pairs of the first one's couple, in its nodes; returns their number. */
static int AddCouple(Contact c, Solid s, int n, const ActivePair active[])
{
  const Couple *couple = &c->couple[active->couple];
  double force[2][6] = {{0.0}};
  int k = 0;
  for (; k < n && active[k].couple == active->couple; k++) {
    const ActivePair *a = &active[k];
    const Point f = ForceOf(c, a);
    Add(force[a->of], a->side, a->integrals.edge[0], f);
    Add(force[a->of], (a->side + 1) % 3, a->integrals.edge[1], f);
    Add(force[a->of], (a->side + 2) % 3, a->integrals.opposite, f);
    for (int i = 0; i < 3; i++) Add(force[1 - a->of], i, -a->integrals.target[i], f);
  }
  for (int i = 0; i < 6; i++) {
    const int node = couple->node[i / 3][i % 3];
    const Point f = PointAt(force[i / 3], i % 3);
    if (node < s->nnodes)
      Add(s->force, node, 1.0, f);
    else
      Add(HaloForces(c->halo), node - s->nnodes, 1.0, f);
  }
  return k;
}

PetscErrorCode ContactAddForces(Contact c, Solid s)
{
  PetscFunctionBeginUser;
  if (c->halo) PetscCall(HaloForward(c->halo, s->x, c->rough ? s->v : NULL));
  PetscCall(FindActivePairs(c, s));
  Respond(c, s);
  c->walls = (Point){0.0, 0.0};
  for (int k = 0; k < c->nactive;)
    if (c->active[k].couple < 0)
      AddWall(c, s, &c->active[k++]);
    else
      k += AddCouple(c, s, c->nactive - k, &c->active[k]);
  if (c->halo) PetscCall(HaloReverse(c->halo, s->force));
  PetscFunctionReturn(0);
}
