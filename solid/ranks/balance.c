/* When elements should change ranks, and to which.  A rank's load in a substep is
 *
 *     c = elements + candidates of contact + joints (its work)  +  what it exchanges with others
 *
 * in units of partition.h, and all wait for the largest one: against a perfect partition of the work w the solid
 * loses  i = max c/(sum w/ranks) - 1  of every substep.  Some of it no partition can avoid, so that what counts
 * is how much worse i is than at its best since the last redistribution; this is summed up over the substeps
 * until it exceeds what a redistribution costs, `rebalance` substeps. */
#include "common/exchange/scatter.h"
#include "solid/contact/contact_impl.h"
#include "solid/cracks/joints_impl.h"
#include "solid/ranks/partition.h"

/* Work of a joint, and of what travels in a substep: a target, a node on several ranks, a ghost element of another
 * rank's element; measured on two ranks. */
enum { WORK_JOINT = 1, WORK_ACTIVE = 12, TRAVEL_TARGET = 8, TRAVEL_NODE = 2, WORK_GHOST = 3 };

typedef struct {
  double work, all;
} Load;

static Load LoadOf(const Solid s)
{
  const Contact c = s->contact;
  Load l = {.work = WORK_ELEMENT * s->elements.n + WORK_CANDIDATE * (c->ncandidates + c->nwalls)};
  if (s->joints)
    l.work += WORK_JOINT * (s->joints->initiation.n + s->joints->ntips) + WORK_ACTIVE * s->joints->nactive;
  l.all = l.work + TRAVEL_NODE * s->shared.n;
  if (c->halo) l.all += TRAVEL_TARGET * HaloTraffic(c->halo);
  if (s->joints) l.all += WORK_GHOST * s->joints->nghosts;
  return l;
}

/* Largest load over the mean work. */
static PetscErrorCode Inefficiency(Solid s, double *inefficiency)
{
  const Load mine = LoadOf(s);
  Load *all;
  double sum = 0.0, most = 0.0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)s->size, &all));
  PetscCallMPI(MPI_Allgather(&mine, 2, MPI_DOUBLE, all, 2, MPI_DOUBLE, s->comm));
  for (int r = 0; r < s->size; r++) {
    sum += all[r].work;
    most = fmax(most, all[r].all);
  }
  *inefficiency = most * s->size / sum;
  PetscCall(PetscFree(all));
  PetscFunctionReturn(0);
}

/* --- the new subdomain -------------------------------------------------------------------------------- */

typedef struct {
  int number, work, piece;
  double at[2];
} Place;

/* This rank's elements as they are now. */
static PetscErrorCode FindPlaces(Solid s, Place place[])
{
  const Elements *e = &s->elements;
  const Contact c = s->contact;
  const int *piece;
  int npieces;
  PetscFunctionBeginUser;
  PetscCall(SolidPieces(s, &npieces, &piece));
  for (int k = 0; k < e->n; k++) {
    place[k] = (Place){.number = e->number[k], .work = WORK_ELEMENT, .piece = piece[e->node[0][k]]};
    for (int i = 0; i < 3; i++)
      for (int d = 0; d < 2; d++) place[k].at[d] += s->x[2 * e->node[i][k] + d] / 3.0;
  }
  for (int k = 0; k < c->ncandidates; k++)
    place[s->facet_element[c->candidate[k].facet]].work += WORK_CANDIDATE;
  for (int k = 0; k < c->nwalls; k++) place[s->facet_element[c->wall[k].facet]].work += WORK_CANDIDATE;
  for (int k = 0; s->joints && k < s->joints->n; k++) {
    const Joint *joint = &s->joints->joint[k];
    const JointStage stage = s->joints->memory[k].stage;
    if (joint->mine)
      place[joint->place[0]].work += stage == JOINT_ACTIVE ? WORK_ACTIVE : stage == JOINT_INTACT;
  }
  PetscFunctionReturn(0);
}

/* Contact, and what has parted; elements by their numbers in the model. */
static PetscErrorCode FindLinks(Solid s, PartitionGraph *g)
{
  const Contact c = s->contact;
  const Joints j = s->joints;
  PetscFunctionBeginUser;
  for (int k = 0; k < c->ncandidates; k++) {
    const int own = s->elements.number[s->facet_element[c->candidate[k].facet]];
    PetscCall(PartitionGraphLink(g, own, c->target[c->candidate[k].target].number, LINK_NEAR));
  }
  for (int k = 0; j && k < j->n; k++)
    if (j->joint[k].mine && j->memory[k].stage == JOINT_BROKEN)
      PetscCall(PartitionGraphLink(g, j->joint[k].first, j->joint[k].second, LINK_PARTED - LINK_INTACT));
  PetscFunctionReturn(0);
}

/* The first rank learns of all elements and links. */
static PetscErrorCode GatherGraph(Solid s, PartitionGraph *g)
{
  PartitionGraph mine = {0};
  Place *place, *all;
  PartitionLink *link;
  void *received;
  int n, *zero;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)s->elements.n, &place));
  PetscCall(FindPlaces(s, place));
  PetscCall(FindLinks(s, &mine));
  PetscCall(PetscCalloc1((size_t)PetscMax(s->elements.n, mine.nlinks), &zero));
  PetscCall(ScatterRecords(s->comm, s->elements.n, zero, sizeof *place, place, &n, &received));
  all = received;
  for (int k = 0; k < n; k++) {
    g->work[all[k].number] = all[k].work;
    g->piece[all[k].number] = all[k].piece;
    for (int d = 0; d < 2; d++) g->at[all[k].number][d] = all[k].at[d];
  }
  PetscCall(PetscFree(all));
  PetscCall(ScatterRecords(s->comm, mine.nlinks, zero, sizeof *link, mine.link, &n, &received));
  link = received;
  for (int k = 0; k < n; k++) PetscCall(PartitionGraphLink(g, link[k].a, link[k].b, link[k].weight));
  PetscCall(PetscFree(link));
  PetscCall(PetscFree(mine.link));
  PetscCall(PetscFree(zero));
  PetscCall(PetscFree(place));
  PetscFunctionReturn(0);
}

static PetscErrorCode NewPart(Solid s, int part[])
{
  const int n = s->model->nelements;
  PartitionGraph graph = {0};
  PetscFunctionBeginUser;
  if (s->rank == 0) PetscCall(PartitionGraphCreate(s->model, &graph));
  PetscCall(GatherGraph(s, &graph));
  if (s->rank == 0) {
    PetscCall(PartitionGraphCut(&graph, s->model, s->size, part));
    PetscCall(PartitionKeep(n, s->size, s->part, part));
  }
  PetscCallMPI(MPI_Bcast(part, n, MPI_INT, 0, s->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidDealOut(Solid s)
{
  int *part;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)s->model->nelements, &part));
  PetscCall(NewPart(s, part));
  PetscCall(SolidRedistribute(s, part));
  s->balance = (Balance){0};
  PetscCall(Inefficiency(s, &s->balance.best));
  PetscCall(PetscFree(part));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidRebalance(Solid s)
{
  Balance *b = &s->balance;
  double now;
  PetscFunctionBeginUser;
  if (!s->part) PetscFunctionReturn(0);
  PetscCall(Inefficiency(s, &now));
  if (b->best == 0.0 || now < b->best) b->best = now;
  b->loss += (now - b->best) * s->stats.substeps;
  if (b->loss >= s->setup.rebalance) PetscCall(SolidDealOut(s));
  PetscFunctionReturn(0);
}
