/* How a body comes apart: broken edges become surface, nodes split (split.c), on all ranks that have them; and how
 * that happens again, or is undone. */
#include "solid/cracks/joints_impl.h"
#include <stdlib.h>

int JointsFind(Joints j, int number)
{
  int low = 0, high = j->n;
  while (low < high) {
    const int middle = (low + high) / 2;
    if (j->joint[middle].number < number)
      low = middle + 1;
    else
      high = middle;
  }
  return low < j->n && j->joint[low].number == number ? low : -1;
}

/* --- surface ------------------------------------------------------------------------------------------ */

/* This rank's sides of an edge that is broken, or that its joint holds, behind the n facets before. */
static void AddFacets(Solid s, const Joint *joint, PetscBool held, int *n)
{
  for (int i = 0; i < 2; i++) {
    if (joint->place[i] < 0 || joint->place[i] >= s->elements.n) continue;
    s->facet_element[*n] = joint->place[i];
    s->facet_across[*n] = !held ? -1 : i ? joint->first : joint->second;
    s->facet_material[*n] = joint->material;
    s->facet_side[(*n)++] = joint->side[i];
  }
}

/* Joints are listed. */
static void PlaceFacets(Joints j, Solid s)
{
  s->nfaces = s->nfacets;
  for (int k = 0; k < j->nactive; k++) AddFacets(s, &j->joint[j->active[k]], PETSC_TRUE, &s->nfaces);
  for (int k = 0; k < s->nfaces; k++)
    for (int i = 0; i < 2; i++)
      s->facet[2 * k + i] = s->element[3 * s->facet_element[k] + (s->facet_side[k] + i) % 3];
}

static PetscErrorCode MarkSurface(Solid s)
{
  double *on;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)s->nnodes, &on));
  for (int k = 0; k < 2 * s->nfaces; k++) on[s->facet[k]] = 1.0;
  PetscCall(CopiesSum(s->copies, 1, on));
  for (int n = 0; n < s->nnodes; n++) s->surface[n] = on[n] > 0.0;
  PetscCall(PetscFree(on));
  PetscFunctionReturn(0);
}

/* --- ranks -------------------------------------------------------------------------------------------- */

/* A part of a node is on all ranks that had the node. */
static PetscErrorCode RenewSubdomain(Solid s)
{
  const SharedNodes *c = &s->shared;
  int n = 0, *first, *next;
  CopiesMatch *match;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)s->nnodes, &first, (size_t)s->nnodes, &next)); /* the parts of each base */
  for (int k = 0; k < s->nnodes; k++) first[k] = -1;
  for (int k = s->nnodes - 1; k >= 0; k--) {
    next[k] = first[s->base[k]];
    first[s->base[k]] = k;
  }
  for (int k = 0; k < c->n; k++)
    for (int part = first[c->node[k].item]; part >= 0; part = next[part]) n++;
  PetscCall(PetscMalloc1(n, &match));
  n = 0;
  for (int k = 0; k < c->n; k++)
    for (int part = first[c->node[k].item]; part >= 0; part = next[part])
      match[n++] = (CopiesMatch){c->node[k].rank, part, s->gid[part]};
  PetscCall(CopiesDestroy(&s->copies));
  PetscCall(CopiesCreateMatched(s->comm, s->nnodes, &n, match, &s->copies));
  PetscCall(PetscFree(match));
  PetscCall(PetscFree2(first, next));
  PetscFunctionReturn(0);
}

/* --- all joints --------------------------------------------------------------------------------------- */

static void MarkStar(Joints j, int star)
{
  if (star < 0 || j->marked[star]) return;
  j->marked[star] = 1;
  j->cut[j->nmarked++] = star;
}

/* With which the solid has come to that revision. */
static void ApplyEvent(Joints j, Solid s, int revision, int event)
{
  const int k = JointsFind(j, event / 2);
  if (k < 0) return;
  j->memory[k].since[event % 2] = revision;
  if (event % 2 == 0) {
    j->memory[k].stage = JOINT_ACTIVE;
    for (int end = 0; end < 2; end++) MarkStar(j, j->joint[k].star[end]);
  } else {
    j->memory[k].stage = JOINT_BROKEN;
    AddFacets(s, &j->joint[k], PETSC_FALSE, &s->nfacets);
  }
}

static PetscErrorCode SplitMarked(Joints j, Solid s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscSortInt(j->nmarked, j->cut));
  for (int k = 0; k < j->nmarked; k++) JointsSplitStar(j, s, j->cut[k]);
  PetscFunctionReturn(0);
}

static void ClearMarks(Joints j)
{
  for (int k = 0; k < j->nmarked; k++) j->marked[j->cut[k]] = 0;
  j->nmarked = 0;
}

PetscErrorCode JointsSynchronise(Joints j, Solid s)
{
  PetscFunctionBeginUser;
  s->npieces = 0;
  PetscCall(JointsPrescribeParts(s));
  PetscCall(RenewSubdomain(s));
  PetscCall(MarkSurface(s));
  PetscCall(JointsMeasureRate(j, s));
  PetscCall(ContactRenew(s->contact, s));
  PetscCall(ContactSearch(s->contact, s, NULL));
  PetscFunctionReturn(0);
}

PetscErrorCode JointsApply(Joints j, Solid s, int n, const int event[])
{
  PetscFunctionBeginUser;
  s->revision++;
  for (int k = 0; k < n; k++) ApplyEvent(j, s, s->revision, event[k]);
  PetscCall(SplitMarked(j, s));
  SolidListCorners(s);
  JointsList(j);
  PlaceFacets(j, s);
  JointsBeginEnds(j, s);
  JointsFindCrackTips(j, s, PETSC_FALSE);
  JointsList(j);
  ClearMarks(j);
  s->force_valid = PETSC_FALSE;
  PetscCall(JointsSynchronise(j, s));
  PetscFunctionReturn(0);
}

/* --- once more ---------------------------------------------------------------------------------------- */

/* After nodes and joints' stages have become those of a state that was. */
static void ListAgain(Joints j, Solid s)
{
  SolidListCorners(s);
  JointsFindCrackTips(j, s, PETSC_TRUE);
  JointsList(j);
  PlaceFacets(j, s);
}

typedef struct {
  int revision, event;
} Past;

static int ComparePast(const void *a, const void *b)
{
  const Past *p = a, *q = b;
  return p->revision != q->revision ? (p->revision > q->revision) - (p->revision < q->revision)
                                    : (p->event > q->event) - (p->event < q->event);
}

/* All that has happened to this rank's joints, as it followed, allocated; the joints become intact. */
static PetscErrorCode TakePast(Joints j, int *n, Past **past)
{
  PetscFunctionBeginUser;
  *n = 0;
  PetscCall(PetscMalloc1(2 * (size_t)j->n, past));
  for (int k = 0; k < j->n; k++) {
    for (int i = 0; i < 2; i++)
      if (j->memory[k].since[i]) (*past)[(*n)++] = (Past){j->memory[k].since[i], 2 * j->joint[k].number + i};
    j->memory[k].stage = JOINT_INTACT;
  }
  if (*n > 1) qsort(*past, (size_t)*n, sizeof **past, ComparePast);
  PetscFunctionReturn(0);
}

PetscErrorCode JointsReplay(Joints j, Solid s)
{
  Past *past;
  int n;
  PetscFunctionBeginUser;
  PetscCall(TakePast(j, &n, &past));
  for (int k = 0; k < n;) {
    const int revision = past[k].revision;
    for (; k < n && past[k].revision == revision; k++) ApplyEvent(j, s, revision, past[k].event);
    PetscCall(SplitMarked(j, s));
    ClearMarks(j);
  }
  ListAgain(j, s);
  PetscCall(PetscFree(past));
  PetscFunctionReturn(0);
}

/* --- a step that is redone ---------------------------------------------------------------------------- */

static PetscErrorCode Save(Joints j, Solid s)
{
  SavedState *k = &s->saved;
  PetscFunctionBeginUser;
  k->nnodes = s->nnodes;
  k->nfacets = s->nfacets;
  k->revision = s->revision;
  PetscCall(PetscArraycpy(j->saved, j->memory, (size_t)j->n));
  PetscCall(PetscArraycpy(j->saved_corner, j->corner, (size_t)j->ncorners));
  PetscFunctionReturn(0);
}

/* Nodes and facets of the failed try lie behind those of the state. */
static PetscErrorCode Restore(Joints j, Solid s)
{
  const SavedState *k = &s->saved;
  const PetscBool changed = (PetscBool)(s->revision != k->revision);
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(j->memory, j->saved, (size_t)j->n));
  if (!changed) PetscFunctionReturn(0);
  s->nnodes = k->nnodes;
  s->nfacets = k->nfacets;
  s->revision = k->revision;
  for (int star = 0; star < j->nstars; star++) JointsRestoreStar(j, s, star);
  ListAgain(j, s);
  s->unsynchronised = PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode JointsState(Joints j, Solid s, int save)
{
  PetscFunctionBeginUser;
  PetscCall(save ? Save(j, s) : Restore(j, s));
  PetscFunctionReturn(0);
}
