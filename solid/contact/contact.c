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
    *t = (Target){.body = e->body[k], .material = e->material[k], .number = e->number[k], .sector = -1};
    for (int i = 0; i < 3; i++) {
      t->node[i] = node[i];
      t->gid[i] = s->gid[node[i]];
      for (int d = 0; d < 2; d++) t->rest[2 * i + d] = s->rest[2 * node[i] + d];
    }
    t->twice_area =
        TensorDeterminant(TensorOfEdges(PointAt(t->rest, 0), PointAt(t->rest, 1), PointAt(t->rest, 2)));
  }
  PetscFunctionReturn(0);
}

/* The targets' facets, and which targets have any. */
static PetscErrorCode ListFacets(Contact c, Solid s)
{
  const size_t n = (size_t)c->ntargets;
  int *target, *start; /* [elements] */
  PetscFunctionBeginUser;
  PetscCall(PetscFree5(c->facet_start, c->facet, c->contactor, c->contactor_of, c->facet_target));
  PetscCall(PetscCalloc5(n + 2, &c->facet_start, (size_t)s->nfaces, &c->facet, n, &c->contactor, n,
                         &c->contactor_of, (size_t)s->nfaces, &c->facet_target));
  PetscCall(PetscMalloc1((size_t)s->elements.n, &target));
  for (int k = 0, t = 0; k < s->elements.n; k++) {
    target[k] = t;
    t += t < c->ntargets && c->target[t].number == s->elements.number[k];
  }
  start = c->facet_start + 1; /* shifted: filling moves it to where it belongs */
  for (int k = 0; k < s->nfaces; k++) {
    c->facet_target[k] = target[s->facet_element[k]];
    start[c->facet_target[k] + 1]++;
  }
  for (int t = 0; t < c->ntargets; t++) start[t + 1] += start[t];
  for (int k = 0; k < s->nfaces; k++) c->facet[start[c->facet_target[k]]++] = k;
  c->ncontactors = 0;
  for (int t = 0; t < c->ntargets; t++) {
    const PetscBool any = (PetscBool)(c->facet_start[t + 1] > c->facet_start[t]);
    c->contactor_of[t] = any ? c->ncontactors : -1;
    if (any) c->contactor[c->ncontactors++] = t;
  }
  PetscCall(PetscFree(target));
  PetscFunctionReturn(0);
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

/* Until the step's end. */
static PetscBool Holds(const Solid s, const PrescribedMotion *d)
{
  return (PetscBool)PrescribedActs(d, s->stats.t + s->dt - s->done);
}

/* held[nnodes]: no force moves them: they are fixed, or prescribed in both components. */
static void MarkHeld(const Contact c, const Solid s, char held[])
{
  for (int n = 0; n < s->nnodes; n++) held[n] = s->inverse_mass[n] == 0.0 ? 3 : 0;
  for (int k = 0; c->nholding > 0 && k < s->nprescribed; k++) {
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    for (int i = 0; i < 2; i++)
      if (d->prescribed[i] && Holds(s, d)) held[s->prescribed[k].node] |= (char)(1 << i);
  }
  for (int n = 0; n < s->nnodes; n++) held[n] = held[n] == 3;
}

/* A body's mass that can move, and that behind a metre of its surface, as if it were a square lying on a side; its extent. */
static PetscErrorCode MeasureMass(Contact c, Solid s, const char held[])
{
  double *sum, *longest; /* [nbodies][2] mass, perimeter; [nbodies] */
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(2 * (size_t)s->nbodies, &sum, (size_t)s->nbodies, &longest));
  for (int n = 0; n < s->nnodes; n++)
    if (SolidOwns(s, n) && !held[n]) sum[2 * s->node_body[n]] += s->mass[n];
  for (int k = 0; k < s->nfaces; k++) { /* the surface first, then the sides of joints */
    const int body = s->elements.body[s->facet_element[k]];
    const double length = ContactRestLength(s, k);
    if (k < s->nfacets) sum[2 * body + 1] += length;
    longest[body] = fmax(longest[body], length);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2 * s->nbodies, MPI_DOUBLE, MPI_SUM, s->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, longest, s->nbodies, MPI_DOUBLE, MPI_MAX, s->comm));
  for (int b = 0; b < s->nbodies; b++) {
    c->mass[b] = sum[2 * b] > 0.0 ? sum[2 * b] : HUGE_VAL;
    c->areal_mass[b] = 4.0 * c->mass[b] / sum[2 * b + 1];
    c->extent[b] = (Extent){longest[b], 0.25 * sum[2 * b + 1]};
  }
  PetscCall(PetscFree2(sum, longest));
  PetscFunctionReturn(0);
}

/* height, compliance and the shortest buffer, over all ranks. */
static PetscErrorCode MeasureSurface(Contact c, Solid s, const char held[])
{
  double sum[2] = {0.0, s->nfaces}, *half;
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
  for (int k = 0; k < s->nfaces; k++) {
    const double length = ContactRestLength(s, k);
    sum[0] += length;
    for (int i = 0; i < 2; i++) half[2 * s->facet[2 * k + i]] += 0.5 * length;
  }
  PetscCall(CopiesSum(s->copies, 2, half));
  for (int n = 0; n < s->nnodes; n++) {
    double *compliance = &c->compliance[s->node_body[n]];
    if (!held[n]) *compliance = fmax(*compliance, half[2 * n] * s->inverse_mass[n]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, c->height, s->nbodies, MPI_DOUBLE, MPI_MIN, s->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, c->compliance, s->nbodies, MPI_DOUBLE, MPI_MAX, s->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->comm));
  for (int b = 0; b < s->nbodies; b++)
    if (s->body[b].rigid.mass > 0.0 && c->compliance[b] > 0.0)
      c->compliance[b] = s->body[b].rigid.surface_compliance;
  c->shortest_buffer = 0.5 * sum[0] / sum[1];
  PetscCall(PetscFree(half));
  PetscFunctionReturn(0);
}

static PetscErrorCode Measure(Contact c, Solid s)
{
  char *held;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)s->nnodes, &held));
  MarkHeld(c, s, held);
  PetscCall(MeasureSurface(c, s, held));
  PetscCall(MeasureMass(c, s, held));
  PetscCall(PetscFree(held));
  PetscFunctionReturn(0);
}

/* Motions are released for good, so that their number tells which hold. */
PetscErrorCode ContactHold(Contact c, Solid s)
{
  int nholding = 0;
  PetscFunctionBeginUser;
  for (int k = 0; k < s->nmotions; k++) nholding += Holds(s, &s->motion[k]);
  if (nholding == c->nholding) PetscFunctionReturn(0);
  c->nholding = nholding;
  PetscCall(Measure(c, s));
  PetscFunctionReturn(0);
}

static PetscBool AnyRough(const Solid s)
{
  PetscBool rough = PETSC_FALSE;
  for (int m = 0; m < s->nmaterials; m++)
    if (s->material[m].friction > 0.0 || s->material[m].internal_friction > 0.0 ||
        s->material[m].contact_damping > 0.0)
      rough = PETSC_TRUE;
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
  const size_t nbodies = (size_t)s->nbodies;
  PetscCall(PetscCalloc7(nbodies, &c->height, nbodies, &c->compliance, nbodies, &c->intact_compliance,
                         nbodies, &c->mass, nbodies, &c->areal_mass, nbodies, &c->skin, nbodies,
                         &c->waiting));
  PetscCall(PetscCalloc3(nbodies, &c->bulge, nbodies, &c->margin, nbodies, &c->extent));
  c->rough = AnyRough(s);
  PetscCall(ContactRenew(c, s));
  PetscCall(PetscArraycpy(c->intact_compliance, c->compliance, nbodies));
  *contact = c;
  PetscFunctionReturn(0);
}

PetscErrorCode ContactRenew(Contact c, Solid s)
{
  PetscFunctionBeginUser;
  PetscCall(ContactForgetPairs(c));
  PetscCall(PetscRealloc(2 * (size_t)s->nnodes * sizeof *c->searched, &c->searched));
  PetscCall(PetscRealloc((size_t)s->nfaces * sizeof *c->first_pair, &c->first_pair));
  PetscCall(FindTargets(c, s));
  PetscCall(ListFacets(c, s));
  PetscCall(DiscsMeasure(c, s));
  PetscCall(Measure(c, s));
  PetscFunctionReturn(0);
}

const double *ContactSkins(Contact c)
{
  return c->skin;
}

double ContactMovedSquared(Contact c, Solid s, int n)
{
  const double dx = s->x[2 * n] - c->searched[2 * n], dy = s->x[2 * n + 1] - c->searched[2 * n + 1];
  return dx * dx + dy * dy;
}

ElementRates ContactRate(Contact c)
{
  return (ElementRates){c->rate[0] + c->rate[1], c->rate[2] + c->rate[3]};
}

Point ContactWalls(Contact c)
{
  return c->walls;
}

PetscErrorCode ContactDestroy(Contact *c)
{
  PetscFunctionBeginUser;
  if (!*c) PetscFunctionReturn(0);
  PetscCall(HaloDestroy(&(*c)->halo));
  PetscCall(PetscFree7((*c)->height, (*c)->compliance, (*c)->intact_compliance, (*c)->mass, (*c)->areal_mass,
                       (*c)->skin, (*c)->waiting));
  PetscCall(PetscFree((*c)->searched));
  PetscCall(PetscFree((*c)->first_pair));
  PetscCall(PetscFree((*c)->target));
  PetscCall(
      PetscFree5((*c)->facet_start, (*c)->facet, (*c)->contactor, (*c)->contactor_of, (*c)->facet_target));
  PetscCall(PetscFree3((*c)->bulge, (*c)->margin, (*c)->extent));
  PetscCall(PetscFree((*c)->candidate));
  PetscCall(PetscFree((*c)->couple));
  PetscCall(PetscFree((*c)->pressed));
  PetscCall(PetscFree((*c)->near));
  PetscCall(PetscFree((*c)->wall));
  PetscCall(PetscFree((*c)->pair));
  PetscCall(PetscFree((*c)->active));
  PetscCall(PetscFree((*c)->history.slip));
  PetscCall(PetscFree((*c)->saved.slip));
  PetscCall(PetscFree(*c));
  PetscFunctionReturn(0);
}
