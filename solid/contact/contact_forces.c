/* The forces of contact: what touches, springs and dampers of each pair, forces on edges and targets. */
#include "solid/contact/contact_impl.h"

/* --- couples ------------------------------------------------------------------------------------------ */

static PetscBool Separated(const Contact c, const Solid s, const Couple *k)
{
  if (k->separating < 0) return PETSC_FALSE;
  const int i = k->separating % 3, *a = k->node[k->separating / 3], *b = k->node[1 - k->separating / 3];
  const Point side[2] = {ContactPosition(c, s, a[(i + 1) % 3]), ContactPosition(c, s, a[(i + 2) % 3])};
  for (int n = 0; n < 3; n++)
    if (!ContactBeyond(side[0], side[1], ContactPosition(c, s, b[n]))) return PETSC_FALSE;
  return PETSC_TRUE;
}

int ContactSeparatingSide(const Contact c, const Solid s, const Couple *couple)
{
  Couple k = *couple;
  for (k.separating = 5; k.separating >= 0 && !Separated(c, s, &k);) k.separating--;
  return k.separating;
}

/* --- what touches ------------------------------------------------------------------------------------- */

/* Relative velocity at the force's place, into the pair's sums with the normal force as weight; edge[2], target[3]: velocities
 * of the nodes, the latter NULL at a wall. */
static void AddMotion(Contact c, const ActivePair *active, const Point *const edge[2], const Point target[3])
{
  const ContactIntegrals *k = &active->integrals;
  const Point d = active->along;
  const double sum = k->edge[0] + k->edge[1], normal = active->scale * sum * sqrt(d.x * d.x + d.y * d.y);
  Pair *pair = &c->pair[active->pair];
  Point v = {0.0, 0.0}; /* times the sum */
  if (!(normal > 0.0)) return;
  for (int i = 0; i < 2; i++) {
    v.x += k->edge[i] * edge[i]->x;
    v.y += k->edge[i] * edge[i]->y;
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

/* Of the nodes of both elements. */
typedef struct {
  Point x[2][3], v[2][3];
  double twice_area[2], at[2][3][3]; /* at[of][k][i]: lambda_i of the other element at node k of target[of] */
} CoupleShape;

static void ShapeOf(const Contact c, const Solid s, const Couple *k, CoupleShape *shape)
{
  for (int of = 0; of < 2; of++) {
    for (int i = 0; i < 3; i++) shape->x[of][i] = ContactPosition(c, s, k->node[of][i]);
    shape->twice_area[of] = ContactTwiceArea(shape->x[of]);
  }
  for (int of = 0; of < 2; of++)
    ContactCoordinates(shape->x[1 - of], shape->twice_area[1 - of], 3, shape->x[of], shape->at[of]);
}

static void VelocitiesOf(const Contact c, const Solid s, const Couple *k, CoupleShape *shape)
{
  for (int of = 0; of < 2; of++)
    for (int i = 0; i < 3; i++) {
      const int node = k->node[of][i];
      shape->v[of][i] =
          node < s->nnodes ? PointAt(s->v, node) : PointAt(HaloVelocities(c->halo), node - s->nnodes);
    }
}

/* Adds those candidates of the couple that touch to active[n]; returns their number. */
static int FindActive(Contact c, const Solid s, int couple, ActivePair active[])
{
  const Couple *k = &c->couple[couple];
  CoupleShape shape;
  int n = 0;
  ShapeOf(c, s, k, &shape);
  for (int i = k->first; i < k->first + k->n; i++) {
    const Candidate *candidate = &c->candidate[i];
    const int of = candidate->target == k->target[0], p = s->facet_side[candidate->facet], q = (p + 1) % 3;
    ActivePair *a = &active[n];
    if (!ContactIntegralsOf(shape.at[of][p], shape.at[of][q], shape.twice_area[1 - of], &a->integrals))
      continue;
    if (c->rough && n == 0) VelocitiesOf(c, s, k, &shape);
    a->couple = couple;
    a->of = of;
    a->side = p;
    a->pair = candidate->pair;
    a->scale = candidate->strength / shape.twice_area[1 - of];
    a->along = PointMinus(shape.x[of][q], shape.x[of][p]);
    if (c->rough) AddMotion(c, a, (const Point *[]){&shape.v[of][p], &shape.v[of][q]}, shape.v[1 - of]);
    n++;
  }
  return n;
}

static int ActiveWall(const Contact c, Solid s, int wall, ActivePair *active)
{
  const WallCandidate *w = &c->wall[wall];
  const int *edge = s->facet + 2 * w->facet, element = s->facet_element[w->facet];
  const Material *m = &s->material[s->elements.material[element]];
  const Point v[2] = {PointAt(s->v, edge[0]), PointAt(s->v, edge[1])};
  const double depth_p = w->outward * (s->x[2 * edge[0] + w->axis] - w->at);
  const double depth_q = w->outward * (s->x[2 * edge[1] + w->axis] - w->at);
  const double height = c->height[s->elements.body[element]];
  if (!ContactEdgeWall(depth_p, depth_q, height, &active->integrals)) return 0;
  active->couple = -1 - wall;
  active->pair = w->pair;
  active->scale = m->penalty * m->thickness;
  active->along = PointMinus(PointAt(s->x, edge[1]), PointAt(s->x, edge[0]));
  if (c->rough) AddMotion(c, active, (const Point *[]){&v[0], &v[1]}, NULL);
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
static PetscErrorCode FindActivePairs(Contact c, Solid s, int *nactive)
{
  const int most = c->ncandidates + c->nwalls;
  int n = 0;
  PetscFunctionBeginUser;
  if (most > c->active_capacity) {
    c->active_capacity = most + most / 2;
    PetscCall(PetscRealloc((size_t)c->active_capacity * sizeof *c->active, &c->active));
  }
  ForgetSums(c);
  for (int k = 0; k < c->nnear; k++) {
    Couple *couple = &c->couple[c->near[k]];
    if (Separated(c, s, couple)) continue;
    const int found = FindActive(c, s, c->near[k], c->active + n);
    couple->separating = found > 0 ? -1 : ContactSeparatingSide(c, s, couple);
    n += found;
  }
  for (int k = 0; k < c->nwalls; k++) n += ActiveWall(c, s, k, &c->active[n]);
  *nactive = n;
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
  const int *edge = s->facet + 2 * c->wall[-1 - active->couple].facet;
  const Point f = ForceOf(c, active);
  for (int i = 0; i < 2; i++) {
    Add(s->force, edge[i], active->integrals.edge[i], f);
    c->walls.x += active->integrals.edge[i] * f.x;
    c->walls.y += active->integrals.edge[i] * f.y;
  }
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
  int n = 0;
  PetscFunctionBeginUser;
  if (c->halo) PetscCall(HaloForward(c->halo, s->x, c->rough ? s->v : NULL));
  PetscCall(FindActivePairs(c, s, &n));
  Respond(c, s);
  c->walls = (Point){0.0, 0.0};
  for (int k = 0; k < n;)
    if (c->active[k].couple < 0)
      AddWall(c, s, &c->active[k++]);
    else
      k += AddCouple(c, s, n - k, &c->active[k]);
  if (c->halo) PetscCall(HaloReverse(c->halo, s->force));
  PetscFunctionReturn(0);
}
