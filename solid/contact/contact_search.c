/* Which edges may touch which targets and walls before the next search. */
#include "solid/contact/cell_grid.h"
#include "solid/contact/contact_impl.h"

typedef struct {
  Contact c;
  Solid s;
  const GeometryBox *facet;     /* [nfaces] with their body's margin around them, as the others */
  const GeometryBox *contactor; /* [ncontactors] of their facets */
  const GeometryBox *target;    /* [nall] */
  char *keep;                   /* [halo targets] */
} SearchContext;

/* --- candidates --------------------------------------------------------------------------------------- */

/* Of both bodies in series. */
static double Together(double one, double other)
{
  if (one == HUGE_VAL || other == HUGE_VAL) return fmin(one, other);
  return one * other / (one + other);
}

/* Before cracks, of a body that is not held. */
static double IntactCompliance(const Contact c, int body)
{
  return c->compliance[body] > 0.0 ? c->intact_compliance[body] : 0.0;
}

/* Damping as a fraction of the critical 2 sqrt(k m), a metre: c/L.  now, intact: its part of 2 xi omega as it is, and before
 * bodies cracked (a corner of one element that cracks have freed has a third to a sixth of a node's mass, while the mass behind an
 * edge is still its body's); omega: of contact's stiffness.  Cracks make damping ask for no shorter substeps than it did before, or than
 * half of what the stiffness allows: 4/(d + sqrt(d^2 + 4 w^2)) with d = 3/2 w is 1/w. */
static double ViscosityOf(double damping, double stiffness, double areal_mass, double now, double intact,
                          double omega)
{
  if (!(damping > 0.0) || areal_mass == HUGE_VAL) return 0.0;
  const double critical = 2.0 * damping * sqrt(stiffness * areal_mass);
  return critical * fmin(1.0, fmax(intact, 1.5 * omega / critical) / now);
}

/* The tangential spring is half as stiff as the normal contact of the whole edge, 3 p L/height.  Of an edge that is longer than those of what it touches, spring and
 * damper are those of a part that lies along the other body (NULL: a wall): substeps are stable for that body's own surface and mass.  The spring, that may act on
 * one of its nodes, has the length of its longest edge, the damper, that is scaled by what is inside, the length of a side of it. */
static ContactLaw LawOf(const Solid s, int facet, const Extent *other, double friction, double stiffness,
                        double viscosity, double mass, double areal_mass)
{
  const double length = ContactRestLength(s, facet), edge = other ? fmin(length, other->longest) : length,
               side = other ? fmin(length, fmax(other->longest, other->side)) : length;
  return (ContactLaw){friction, friction > 0.0 ? 0.5 * stiffness * edge : 0.0, viscosity * side,
                      viscosity > 0.0 ? mass / (areal_mass * side) : 1.0, side / length};
}

/* Faces of a joint with a material of its own have its friction and damping on their body. */
static void FrictionOf(const Solid s, int facet, const Target *t, PetscBool joined, double *friction,
                       double *damping)
{
  const int element = s->facet_element[facet], material = s->elements.material[element];
  const Material *own = &s->material[material], *other = &s->material[t->material];
  ContactMaterials(s, material, t->material, friction, damping);
  if (s->facet_material[facet] >= 0 && t->body == s->elements.body[element]) {
    own = other = &s->material[s->facet_material[facet]];
    *friction = own->friction;
    *damping = own->contact_damping;
  }
  if (joined) *friction = fmin(own->internal_friction, other->internal_friction);
}

static PetscErrorCode AddCandidate(Contact c, Solid s, int facet, int target)
{
  const Target *t = &c->target[target];
  const int element = s->facet_element[facet], body = s->elements.body[element];
  const Material *own = &s->material[s->elements.material[element]], *other = &s->material[t->material];
  double friction, damping;
  int pair;
  PetscFunctionBeginUser;
  if (c->ncandidates == c->candidate_capacity) {
    c->candidate_capacity = 2 * c->candidate_capacity + 64;
    PetscCall(PetscRealloc((size_t)c->candidate_capacity * sizeof *c->candidate, &c->candidate));
  }
  const double penalty = fmin(own->penalty, other->penalty) * fmin(own->thickness, other->thickness);
  const double compliance = fmax(c->compliance[body], c->compliance[t->body]);
  const double intact = fmax(IntactCompliance(c, body), IntactCompliance(c, t->body));
  const PetscBool joined = ContactJoined(s, facet, t);
  FrictionOf(s, facet, t, joined, &friction, &damping);
  /* d(p phi)/dx = 3 p/height; a node takes half of its edges, |u_c - u_t|^2 <= 2 |u_c|^2 + 2 |u_t|^2, and
   * both bodies are contactor and target */
  const double rate = 6.0 * penalty * compliance * (1.0 / c->height[body] + 1.0 / c->height[t->body]);
  const double stiffness = 3.0 * penalty / c->height[t->body];
  const double areal_mass = Together(c->areal_mass[body], c->areal_mass[t->body]);
  const double viscosity =
      ViscosityOf(damping, stiffness, areal_mass, 4.0 * compliance, 4.0 * intact, sqrt(rate));
  const ContactLaw law = LawOf(s, facet, &c->extent[t->body], friction, stiffness, viscosity,
                               Together(c->mass[body], c->mass[t->body]), areal_mass);
  PetscCall(ContactPairOf(c, s, facet, joined ? JOINED : t->body, t->material, law, &pair));
  c->candidate[c->ncandidates++] = (Candidate){facet, target, pair, penalty * t->twice_area};
  c->rate[0] = fmax(c->rate[0], rate);
  c->rate[2] = fmax(c->rate[2], 4.0 * viscosity * compliance);
  PetscFunctionReturn(0);
}

/* Of a disc and another body the edges of that are enough, and a disc is all of its sectors. */
static PetscBool Considered(const Contact c, const Solid s, int own, int target)
{
  const Target *t = &c->target[target];
  if (!ContactIsDisc(s, t->body)) return (PetscBool)!ContactIsDisc(s, c->target[own].body);
  return (PetscBool)(t->sector >= 0 && t->body != c->target[own].body);
}

/* The facets of target `own` that may touch the target. */
static PetscErrorCode AddCandidates(const SearchContext *x, int own, int target, Couple *couple)
{
  const Contact c = x->c;
  double distance;
  PetscFunctionBeginUser;
  if (!Considered(c, x->s, own, target)) PetscFunctionReturn(0);
  for (int k = c->facet_start[own]; k < c->facet_start[own + 1]; k++) {
    const int facet = c->facet[k];
    if (!GeometryBoxOverlap(&x->facet[facet], &x->target[target])) continue;
    if (!ContactMayBeActive(c, x->s, facet, &c->target[target], &distance)) continue;
    PetscCall(AddCandidate(c, x->s, facet, target));
    couple->distance = fmin(couple->distance, distance);
  }
  couple->n = c->ncandidates - couple->first;
  couple->discs = (PetscBool)(couple->discs || ContactIsDisc(x->s, c->target[target].body));
  PetscFunctionReturn(0);
}

static void TakeNodes(const Contact c, Couple *k)
{
  for (int i = 0; i < 6; i++) k->node[i / 3][i % 3] = c->target[k->target[i / 3]].node[i % 3];
}

/* Two contactors of this rank are found both ways round: both are dealt with when the first is the lower. */
static PetscErrorCode AddCouple(void *context, int contactor, int target)
{
  const SearchContext *x = context;
  const Contact c = x->c;
  const int own = c->contactor[contactor], other = target < c->ntargets ? c->contactor_of[target] : -1;
  const PetscBool both = (PetscBool)(other >= 0 && GeometryBoxOverlap(&x->contactor[other], &x->target[own]));
  Couple couple = {.target = {own, target}, .first = c->ncandidates, .distance = HUGE_VAL};
  PetscFunctionBeginUser;
  if (own == target || (both && target < own)) PetscFunctionReturn(0);
  PetscCall(AddCandidates(x, own, target, &couple));
  if (both) PetscCall(AddCandidates(x, target, own, &couple));
  if (couple.n == 0) PetscFunctionReturn(0);
  if (c->ncouples == c->couple_capacity) {
    c->couple_capacity = 2 * c->couple_capacity + 64;
    PetscCall(PetscRealloc((size_t)c->couple_capacity * sizeof *c->couple, &c->couple));
    PetscCall(PetscRealloc((size_t)c->couple_capacity * sizeof *c->near, &c->near));
  }
  TakeNodes(c, &couple);
  couple.separating = ContactSeparatingSide(c, x->s, &couple);
  c->couple[c->ncouples++] = couple;
  if (target >= c->ntargets) x->keep[target - c->ntargets] = 1;
  PetscFunctionReturn(0);
}

static PetscErrorCode AddWall(Contact c, Solid s, int facet, int axis, double outward, double at)
{
  const int element = s->facet_element[facet], body = s->elements.body[element];
  const Material *m = &s->material[s->elements.material[element]];
  const int wall = WALL_LEFT + 2 * axis + (outward > 0.0);
  const double penalty = m->penalty * m->thickness, stiffness = 3.0 * penalty / c->height[body];
  const double compliance = c->compliance[body], intact = IntactCompliance(c, body);
  double friction, damping;
  PetscFunctionBeginUser;
  if (c->nwalls == c->wall_capacity) {
    c->wall_capacity = 2 * c->wall_capacity + 64;
    PetscCall(PetscRealloc((size_t)c->wall_capacity * sizeof *c->wall, &c->wall));
  }
  WallCandidate *w = &c->wall[c->nwalls++];
  *w = (WallCandidate){facet, axis, -1, outward, at};
  ContactMaterials(s, s->elements.material[element], wall, &friction, &damping);
  const double viscosity =
      ViscosityOf(damping, stiffness, c->areal_mass[body], 2.0 * compliance, 2.0 * intact,
                  sqrt(stiffness * compliance)); /* in a corner two walls act */
  const ContactLaw law =
      LawOf(s, facet, NULL, friction, stiffness, viscosity, c->mass[body], c->areal_mass[body]);
  PetscCall(ContactPairOf(c, s, facet, wall, 0, law, &w->pair));
  c->rate[3] = fmax(c->rate[3], 2.0 * viscosity * compliance);
  PetscFunctionReturn(0);
}

static PetscErrorCode FindWalls(Contact c, Solid s, const GeometryBox edge[])
{
  const double *lower = s->setup.lower, *upper = s->setup.upper;
  PetscFunctionBeginUser;
  for (int k = 0; k < s->nfaces; k++) {
    const int element = s->facet_element[k], body = s->elements.body[element], before = c->nwalls;
    const Material *m = &s->material[s->elements.material[element]];
    for (int axis = 0; axis < 2; axis++) {
      if (edge[k].lower[axis] - c->skin[body] < lower[axis])
        PetscCall(AddWall(c, s, k, axis, -1.0, lower[axis]));
      if (edge[k].upper[axis] + c->skin[body] > upper[axis])
        PetscCall(AddWall(c, s, k, axis, 1.0, upper[axis]));
    }
    /* in a corner two walls act */
    c->rate[1] = fmax(c->rate[1], 3.0 * (c->nwalls - before) * m->penalty * m->thickness *
                                      c->compliance[body] / c->height[body]);
  }
  PetscFunctionReturn(0);
}

/* Brings other ranks' targets near this rank's edges behind its own. */
static PetscErrorCode BringTargets(Contact c, Solid s, const GeometryBox edge[])
{
  GeometryBox all = GeometryBoxEmpty();
  const Target *foreign;
  PetscFunctionBeginUser;
  c->nall = c->ntargets;
  if (!c->halo) PetscFunctionReturn(0);
  for (int k = 0; k < s->nfaces; k++) GeometryBoxJoin(&all, &edge[k]);
  PetscCall(HaloBuild(c->halo, s->nnodes, s->x, c->margin, &all, c->ntargets, c->target));
  PetscCall(HaloForward(c->halo, s->x, NULL));
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
  for (int k = 0; k < c->ncouples; k++) {
    int *target = &c->couple[k].target[1];
    if (*target >= c->ntargets) *target = c->ntargets + index[*target - c->ntargets];
  }
  const int n = HaloTargets(c->halo, &foreign);
  c->nall = c->ntargets + n;
  PetscCall(PetscArraycpy(c->target + c->ntargets, foreign, (size_t)n));
  for (int k = 0; k < c->ncouples; k++) TakeNodes(c, &c->couple[k]);
  PetscCall(PetscFree(index));
  PetscFunctionReturn(0);
}

/* Every pair closer than its skins. */
static PetscErrorCode FindPairs(Contact c, Solid s, const GeometryBox edge[])
{
  GeometryBox *contactor, *target;
  char *keep;
  PetscFunctionBeginUser;
  PetscCall(BringTargets(c, s, edge));
  PetscCall(PetscMalloc2((size_t)c->ncontactors, &contactor, (size_t)c->nall, &target));
  PetscCall(PetscCalloc1((size_t)(c->nall - c->ntargets), &keep));
  for (int k = 0; k < c->nall; k++) {
    target[k] = GeometryBoxEmpty();
    for (int i = 0; i < 3; i++) {
      const Point at = ContactPosition(c, s, c->target[k].node[i]);
      GeometryBoxGrow(&target[k], (const double[]){at.x, at.y});
    }
    target[k] = GeometryBoxWidened(target[k], c->margin[c->target[k].body]);
  }
  for (int k = 0; k < c->ncontactors; k++) {
    const int own = c->contactor[k];
    contactor[k] = GeometryBoxEmpty();
    for (int i = c->facet_start[own]; i < c->facet_start[own + 1]; i++)
      GeometryBoxJoin(&contactor[k], &edge[c->facet[i]]);
  }
  SearchContext context = {c, s, edge, contactor, target, keep};
  PetscCall(CellGridPairs(c->ncontactors, contactor, c->nall, target, AddCouple, &context));
  PetscCall(DropTargets(c, keep));
  PetscCall(PetscFree(keep));
  PetscCall(PetscFree2(contactor, target));
  PetscFunctionReturn(0);
}

void ContactSetTravel(Contact c, double travel)
{
  c->nnear = 0;
  for (int k = 0; k < c->ncouples; k++)
    if (c->couple[k].distance <= 2.0 * travel) c->near[c->nnear++] = k;
}

PetscErrorCode ContactSearch(Contact c, Solid s, const double least[])
{
  GeometryBox *edge;
  PetscFunctionBeginUser;
  PetscCall(ContactForgetPairs(c));
  PetscCall(ContactHold(c, s));
  c->restored = PETSC_FALSE;
  for (int k = 0; k < s->nfaces; k++) c->first_pair[k] = -1;
  for (int b = 0; b < s->nbodies; b++) {
    c->skin[b] = fmax(0.5 * c->shortest_buffer, least ? least[b] : 0.0);
    c->margin[b] = c->skin[b] + c->bulge[b];
    c->waiting[b] = HUGE_VAL;
  }
  for (int k = 0; k < 4; k++) c->rate[k] = 0.0;
  PetscCall(PetscMalloc1((size_t)s->nfaces, &edge));
  for (int k = 0; k < s->nfaces; k++)
    edge[k] = GeometryBoxWidened(GeometryBoxOfNodes(2, s->facet + 2 * k, s->x),
                                 c->margin[s->elements.body[s->facet_element[k]]]);
  if (s->setup.walls) PetscCall(FindWalls(c, s, edge));
  PetscCall(FindPairs(c, s, edge));
  ContactSetTravel(c, HUGE_VAL);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, c->rate, 4, MPI_DOUBLE, MPI_MAX, s->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, c->waiting, s->nbodies, MPI_DOUBLE, MPI_MIN, s->comm));
  for (int b = 0; b < s->nbodies; b++) c->skin[b] = fmin(c->skin[b], 0.5 * c->waiting[b]);
  PetscCall(PetscArraycpy(c->searched, s->x, 2 * (size_t)s->nnodes));
  PetscCall(PetscFree(edge));
  s->stats.searches++;
  PetscFunctionReturn(0);
}
