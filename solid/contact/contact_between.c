/* What two bodies, or a body and a wall, do to each other: the sums over their contact. */
#include "solid/contact/contact_impl.h"
#include <stdlib.h>

/* On the body; the weight of a place is its normal force. */
enum { NORMAL, FRICTION = 2, PLACE = 4, WEIGHT = 6 };

typedef struct {
  int body, other;
  double sum[CONTACT_SUMS];
} Between;

/* Of a candidate that touches; body: the edge's. */
static Between BetweenOf(const Contact c, const Solid s, const ActivePair *a)
{
  const Pair *pair = &c->pair[a->pair];
  const ContactIntegrals *k = &a->integrals;
  const double at_node[3] = {k->edge[0], k->edge[1], k->opposite};
  const int element = s->facet_element[pair->facet], side = s->facet_side[pair->facet];
  const double sum = ContactSum(k), normal = a->scale * (1.0 + pair->response.normal),
               tangential = a->scale * pair->response.tangential;
  const double d[2] = {a->along.x, a->along.y}, inward[2] = {-d[1], d[0]};
  Between f = {s->elements.body[element], pair->other, {0.0}};
  for (int i = 0; i < 2; i++) {
    f.sum[NORMAL + i] = sum * normal * inward[i];
    f.sum[FRICTION + i] = sum * tangential * d[i];
  }
  const double weight = normal * hypot(d[0], d[1]);
  for (int j = 0; j < 3; j++) {
    const int node = s->elements.node[(side + j) % 3][element];
    f.sum[WEIGHT] += weight * at_node[j];
    for (int i = 0; i < 2; i++) f.sum[PLACE + i] += weight * at_node[j] * s->x[2 * node + i];
  }
  return f;
}

/* Not within a body. */
static PetscBool IsBetween(const Between *f)
{
  return (PetscBool)(f->other != f->body && f->other != JOINED);
}

static void Add(double factor, double on_body, const double from[], double to[])
{
  for (int i = 0; i < CONTACT_SUMS; i++) to[i] += factor * (i < PLACE ? on_body : 1.0) * from[i];
}

static BodyContact Contacting(int body, int other, const double sum[], double over)
{
  BodyContact k = {.body = body, .other = other};
  for (int i = 0; i < 2; i++) {
    k.normal[i] = sum[NORMAL + i] / over;
    k.friction[i] = sum[FRICTION + i] / over;
    k.place[i] = sum[PLACE + i] / sum[WEIGHT];
  }
  return k;
}

/* --- over a step -------------------------------------------------------------------------------------- */

/* 1: the probe has what acts on this body, -1: what this body does, 0: neither. */
static double PartOf(const ContactProbe *probe, const Between *f)
{
  const PetscBool any = (PetscBool)(probe->other == CONTACT_ANY);
  if (f->body == probe->body && (any || f->other == probe->other)) return 1.0;
  if (f->other == probe->body && (any || f->body == probe->other)) return -1.0;
  return 0.0;
}

void ContactAddImpulses(Contact c, const Solid s, double sum[][CONTACT_SUMS])
{
  for (int a = 0; a < c->nactive && s->setup.ncontact_probes > 0; a++) {
    const Between f = BetweenOf(c, s, &c->active[a]);
    for (int k = 0; k < s->setup.ncontact_probes && IsBetween(&f); k++) {
      const double part = PartOf(&s->setup.contact_probe[k], &f);
      if (part != 0.0) Add(s->kick, part, f.sum, sum[k]);
    }
  }
}

PetscErrorCode SolidContactProbes(Solid s, BodyContact contact[])
{
  const int n = s->setup.ncontact_probes;
  double sum[MAX_CONTACT_PROBES][CONTACT_SUMS];
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(&sum[0][0], &s->contact_impulse[0][0], (size_t)n * CONTACT_SUMS));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, CONTACT_SUMS * n, MPI_DOUBLE, MPI_SUM, s->comm));
  for (int k = 0; k < n; k++) {
    const ContactProbe *p = &s->setup.contact_probe[k];
    contact[k] = Contacting(p->body, p->other, sum[k], s->dt > 0.0 ? s->dt : 1.0);
  }
  PetscFunctionReturn(0);
}

/* --- now ---------------------------------------------------------------------------------------------- */

static int CompareBetween(const void *a, const void *b)
{
  const Between *p = a, *q = b;
  if (p->body != q->body) return p->body < q->body ? -1 : 1;
  return (p->other > q->other) - (p->other < q->other);
}

/* One of each two bodies; returns their number. */
static int Merge(int n, Between f[])
{
  int merged = 0;
  if (n > 1) qsort(f, (size_t)n, sizeof *f, CompareBetween);
  for (int k = 0; k < n; k++)
    if (merged && !CompareBetween(&f[merged - 1], &f[k]))
      Add(1.0, 1.0, f[k].sum, f[merged - 1].sum);
    else
      f[merged++] = f[k];
  return merged;
}

/* This rank's, on the body with the lesser number, or on the one that touches a wall. */
static PetscErrorCode FindHere(const Solid s, int *n, Between **found)
{
  const Contact c = s->contact;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)c->nactive, found));
  *n = 0;
  for (int a = 0; a < c->nactive; a++) {
    const Between f = BetweenOf(c, s, &c->active[a]);
    if (!IsBetween(&f) || !(f.sum[WEIGHT] > 0.0)) continue;
    const PetscBool turned = (PetscBool)(f.other >= 0 && f.other < f.body);
    Between *to = &(*found)[(*n)++];
    *to = (Between){turned ? f.other : f.body, turned ? f.body : f.other, {0.0}};
    Add(1.0, turned ? -1.0 : 1.0, f.sum, to->sum);
  }
  *n = Merge(*n, *found);
  PetscFunctionReturn(0);
}

PetscErrorCode SolidContacts(Solid s, int *n, BodyContact **contact)
{
  const double *force;
  Between *here, *all;
  int nhere, *bytes, *first;
  PetscFunctionBeginUser;
  PetscCall(SolidForces(s, &force));
  PetscCall(FindHere(s, &nhere, &here));
  PetscCall(PetscMalloc2((size_t)s->size, &bytes, (size_t)s->size + 1, &first));
  nhere *= (int)sizeof *here;
  PetscCallMPI(MPI_Gather(&nhere, 1, MPI_INT, bytes, 1, MPI_INT, 0, s->comm));
  first[0] = 0;
  for (int r = 0; r < s->size && s->rank == 0; r++) first[r + 1] = first[r] + bytes[r];
  const int nall = s->rank == 0 ? first[s->size] / (int)sizeof *all : 0;
  PetscCall(PetscMalloc1((size_t)nall, &all));
  PetscCallMPI(MPI_Gatherv(here, nhere, MPI_BYTE, all, bytes, first, MPI_BYTE, 0, s->comm));
  *n = Merge(nall, all);
  PetscCall(PetscMalloc1((size_t)*n, contact));
  for (int k = 0; k < *n; k++) (*contact)[k] = Contacting(all[k].body, all[k].other, all[k].sum, 1.0);
  PetscCall(PetscFree(here));
  PetscCall(PetscFree(all));
  PetscCall(PetscFree2(bytes, first));
  PetscFunctionReturn(0);
}
