/* The memory of friction: one spring for every edge and each material that it touches, which survives new candidates and
 * steps that are redone. */
#include "solid/contact/contact_impl.h"
#include <stdlib.h>

void ContactMaterials(const Solid s, int material, int other, double *friction, double *damping)
{
  const PetscBool wall = (PetscBool)(other < 0), own = (PetscBool)(wall && s->setup.rough_walls);
  const Material *a = &s->material[material], *b = wall ? a : &s->material[other];
  const double rough = own && s->setup.wall_friction >= 0.0 ? s->setup.wall_friction : b->friction;
  const double damped = own && s->setup.wall_damping >= 0.0 ? s->setup.wall_damping : b->contact_damping;
  *friction = sqrt(a->friction * rough);
  *damping = sqrt(a->contact_damping * damped);
  for (int k = 0; k < s->setup.nrules; k++) {
    const ContactRule *r = &s->setup.rule[k];
    const char *one = a->name, *two = wall ? CONTACT_WALLS : b->name;
    if (!(!strcmp(r->between[0], one) && !strcmp(r->between[1], two)) &&
        !(!strcmp(r->between[1], one) && !strcmp(r->between[0], two)))
      continue;
    if (r->friction >= 0.0) *friction = r->friction;
    if (r->damping >= 0.0) *damping = r->damping;
  }
}

/* --- history ------------------------------------------------------------------------------------------ */

static int CompareSlips(const void *a, const void *b)
{
  const Slip *p = a, *q = b;
  if (p->edge != q->edge) return (p->edge > q->edge) - (p->edge < q->edge);
  if (p->other != q->other) return (p->other > q->other) - (p->other < q->other);
  return (p->material > q->material) - (p->material < q->material);
}

static PetscErrorCode Reserve(Slips *h, int n)
{
  PetscFunctionBeginUser;
  if (n <= h->capacity) PetscFunctionReturn(0);
  h->capacity = n + n / 2 + 16;
  PetscCall(PetscRealloc((size_t)h->capacity * sizeof *h->slip, &h->slip));
  PetscFunctionReturn(0);
}

/* The slips of the pairs that have one, sorted. */
static PetscErrorCode Collect(const Contact c, Slips *h)
{
  PetscFunctionBeginUser;
  PetscCall(Reserve(h, c->npairs));
  h->n = 0;
  for (int k = 0; k < c->npairs; k++) {
    const Pair *p = &c->pair[k];
    if (p->slip != 0.0) h->slip[h->n++] = (Slip){p->edge, p->other, p->material, p->slip};
  }
  if (h->n > 1) qsort(h->slip, (size_t)h->n, sizeof *h->slip, CompareSlips);
  PetscFunctionReturn(0);
}

PetscErrorCode ContactSlips(Contact c, int *n, const Slip **slip)
{
  PetscFunctionBeginUser;
  if (!c->restored) PetscCall(Collect(c, &c->history));
  *n = c->history.n;
  *slip = c->history.slip;
  PetscFunctionReturn(0);
}

PetscErrorCode ContactForgetPairs(Contact c)
{
  const Slip *slip;
  int n;
  PetscFunctionBeginUser;
  PetscCall(ContactSlips(c, &n, &slip));
  c->restored = PETSC_TRUE;
  c->ncandidates = c->ncouples = c->nnear = c->nwalls = c->npairs = c->npressed = 0;
  PetscFunctionReturn(0);
}

PetscErrorCode ContactTakeSlips(Contact c, int n, Slip slip[])
{
  PetscFunctionBeginUser;
  if (n > 1) qsort(slip, (size_t)n, sizeof *slip, CompareSlips);
  PetscCall(Reserve(&c->history, n));
  PetscCall(PetscArraycpy(c->history.slip, slip, (size_t)n));
  c->history.n = n;
  c->restored = PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode ContactPairOf(Contact c, Solid s, int facet, int other, int material, ContactLaw law,
                             int *pair)
{
  PetscFunctionBeginUser;
  for (*pair = c->first_pair[facet]; *pair >= 0; *pair = c->pair[*pair].next)
    if (c->pair[*pair].other == other && c->pair[*pair].material == material) PetscFunctionReturn(0);
  if (c->npairs == c->pair_capacity) {
    c->pair_capacity = 2 * c->pair_capacity + 64;
    PetscCall(PetscRealloc((size_t)c->pair_capacity * sizeof *c->pair, &c->pair));
    PetscCall(PetscRealloc((size_t)c->pair_capacity * sizeof *c->pressed, &c->pressed));
  }
  const Slip key = {3 * s->facet_element[facet] + s->facet_side[facet], other, material, 0.0};
  const Slip *found = c->history.n ? bsearch(&key, c->history.slip, (size_t)c->history.n,
                                             sizeof *c->history.slip, CompareSlips)
                                   : NULL;
  *pair = c->npairs++;
  c->pair[*pair] = (Pair){.facet = facet,
                          .other = other,
                          .material = material,
                          .edge = key.edge,
                          .next = c->first_pair[facet],
                          .law = law,
                          .slip = found ? found->slip : 0.0};
  c->first_pair[facet] = *pair;
  PetscFunctionReturn(0);
}

void ContactCommit(Contact c)
{
  for (int k = 0; k < c->npairs; k++) c->pair[k].slip = c->pair[k].now;
}

PetscErrorCode ContactState(Contact c, int save)
{
  const Slips *from = save ? &c->history : &c->saved;
  Slips *to = save ? &c->saved : &c->history;
  PetscFunctionBeginUser;
  if (save && !c->restored) {
    PetscCall(Collect(c, to));
    PetscFunctionReturn(0);
  }
  PetscCall(Reserve(to, from->n));
  PetscCall(PetscArraycpy(to->slip, from->slip, (size_t)from->n));
  to->n = from->n;
  if (save) PetscFunctionReturn(0);
  c->restored = PETSC_TRUE;
  c->ncandidates = c->ncouples = c->nnear = c->nwalls = c->npairs = c->npressed = 0;
  PetscFunctionReturn(0);
}
