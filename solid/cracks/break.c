/* How a body comes apart: nodes split where the bonds of their star are cut, broken edges become surface. */
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

/* --- nodes -------------------------------------------------------------------------------------------- */

/* root[c]: the lowest corner of the star that uncut bonds connect with c. */
static void ConnectCorners(const Joints j, int star, int root[])
{
  const Bond *bond = j->bond + j->star_bond[star];
  const int n = j->star_bond[star + 1] - j->star_bond[star];
  int merged = 1;
  for (int c = 0; c < j->star_corner[star + 1] - j->star_corner[star]; c++) root[c] = c;
  while (merged) {
    merged = 0;
    for (int k = 0; k < n; k++) {
      if (bond[k].joint >= 0 && j->memory[bond[k].joint].stage != JOINT_INTACT) continue;
      int *one = &root[bond[k].corner[0]], *two = &root[bond[k].corner[1]];
      merged |= *one != *two;
      *one = *two = PetscMin(*one, *two);
    }
  }
}

/* A node at the same place with the same velocity and history. */
static int CopyNode(Solid s, int from, long long gid)
{
  double *const field[] = {s->rest, s->x, s->v, s->start, s->load};
  const int n = s->nnodes++;
  for (int k = 0; k < 5; k++)
    for (int c = 0; c < 2; c++) field[k][2 * n + c] = field[k][2 * from + c];
  s->gid[n] = gid;
  s->node_body[n] = s->node_body[from];
  s->base[n] = s->base[from];
  s->mass[n] = 0.0;
  s->inverse_mass[n] = s->inverse_mass[from];
  s->is_prescribed[n] = s->is_prescribed[from];
  return n;
}

static void SetCornerNode(Joints j, Solid s, Corner *corner, int node)
{
  const int ne = s->elements.n;
  corner->node = node;
  if (corner->place >= ne)
    j->ghost[corner->place - ne].node[corner->corner] = node;
  else if (corner->place >= 0)
    s->element[3 * corner->place + corner->corner] = s->elements.node[corner->corner][corner->place] = node;
}

/* What a corner's node was before its star split. */
typedef struct {
  double mass, load[2];
} Before;

/* Each node's mass from its corners; the load of a node is split between its parts by their masses, so that none is
 * accelerated otherwise than before. */
static void SplitMass(Solid s, int n, const Corner corner[], const Before before[])
{
  for (int c = 0; c < n; c++) s->mass[corner[c].node] = 0.0;
  for (int c = 0; c < n; c++) s->mass[corner[c].node] += corner[c].mass;
  for (int c = 0; c < n; c++) {
    const int k = corner[c].node;
    if (s->inverse_mass[k] > 0.0) s->inverse_mass[k] = 1.0 / s->mass[k];
    for (int i = 0; i < 2; i++) s->load[2 * k + i] = before[c].load[i] * (s->mass[k] / before[c].mass);
  }
}

static void SplitStar(Joints j, Solid s, int star)
{
  Corner *corner = j->corner + j->star_corner[star];
  const int n = j->star_corner[star + 1] - j->star_corner[star];
  int root[STAR_CORNERS], node[STAR_CORNERS];
  Before before[STAR_CORNERS];
  ConnectCorners(j, star, root);
  for (int c = 0; c < n; c++) {
    const int old = corner[c].node;
    before[c] = (Before){s->mass[old], {s->load[2 * old], s->load[2 * old + 1]}};
    node[c] = root[c] == c ? old : node[root[c]];
    for (int b = 0; b < c && root[c] == c; b++) /* the old node stays with the first of its parts */
      if (node[b] == old) {
        node[c] = CopyNode(s, old, j->first_gid + 3 * (long long)corner[c].element + corner[c].corner);
        break;
      }
  }
  for (int c = 0; c < n; c++) SetCornerNode(j, s, &corner[c], node[c]);
  SplitMass(s, n, corner, before);
}

/* Parts of a prescribed node have its prescribed motion. */
static PetscErrorCode PrescribeParts(Solid s)
{
  PetscFunctionBeginUser;
  s->nprescribed = s->nprescribed_first;
  for (int n = 0; n < s->nnodes; n++) {
    if (s->base[n] == n || !s->is_prescribed[n]) continue;
    PetscCall(PetscRealloc((size_t)(s->nprescribed + s->nprescribed_first) * sizeof *s->prescribed,
                           &s->prescribed));
    for (int k = 0; k < s->nprescribed_first; k++)
      if (s->prescribed[k].node == s->base[n])
        s->prescribed[s->nprescribed++] = (PrescribedNode){n, s->prescribed[k].motion};
  }
  PetscCall(PetscRealloc(2 * (size_t)s->nprescribed * sizeof *s->position_before, &s->position_before));
  PetscFunctionReturn(0);
}

/* --- surface ------------------------------------------------------------------------------------------ */

static void PlaceFacets(Solid s, int first)
{
  for (int k = first; k < s->nfacets; k++)
    for (int i = 0; i < 2; i++)
      s->facet[2 * k + i] = s->element[3 * s->facet_element[k] + (s->facet_side[k] + i) % 3];
}

/* This rank's sides of a broken edge. */
static void AddFacets(Solid s, const Joint *joint)
{
  for (int i = 0; i < 2; i++) {
    if (joint->place[i] < 0 || joint->place[i] >= s->elements.n) continue;
    s->facet_element[s->nfacets] = joint->place[i];
    s->facet_side[s->nfacets++] = joint->side[i];
  }
}

static PetscErrorCode MarkSurface(Solid s)
{
  double *on;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)s->nnodes, &on));
  for (int k = 0; k < 2 * s->nfacets; k++) on[s->facet[k]] = 1.0;
  PetscCall(CopiesSum(s->copies, 1, on));
  for (int n = 0; n < s->nnodes; n++) s->surface[n] = on[n] > 0.0;
  PetscCall(PetscFree(on));
  PetscFunctionReturn(0);
}

/* --- ranks -------------------------------------------------------------------------------------------- */

typedef struct {
  int rank, node;
  long long gid;
} Copy;

static int CompareCopies(const void *a, const void *b)
{
  const Copy *p = a, *q = b;
  return p->rank != q->rank ? (p->rank > q->rank) - (p->rank < q->rank)
                            : (p->gid > q->gid) - (p->gid < q->gid);
}

/* A part of a node is on all ranks that had the node. */
static PetscErrorCode RenewSubdomain(Solid s)
{
  const SharedNodes *c = &s->shared;
  int n = 0, *first, *next, *rank, *node;
  Copy *copy;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)s->nnodes, &first, (size_t)s->nnodes, &next)); /* the parts of each base */
  for (int k = 0; k < s->nnodes; k++) first[k] = -1;
  for (int k = s->nnodes - 1; k >= 0; k--) {
    next[k] = first[s->base[k]];
    first[s->base[k]] = k;
  }
  for (int k = 0; k < c->n; k++)
    for (int part = first[c->node[k]]; part >= 0; part = next[part]) n++;
  PetscCall(PetscMalloc3((size_t)n, &copy, (size_t)n, &rank, (size_t)n, &node));
  n = 0;
  for (int k = 0; k < c->n; k++)
    for (int part = first[c->node[k]]; part >= 0; part = next[part])
      copy[n++] = (Copy){c->rank[k], part, s->gid[part]};
  if (n > 0) qsort(copy, (size_t)n, sizeof *copy, CompareCopies);
  for (int k = 0; k < n; k++) {
    rank[k] = copy[k].rank;
    node[k] = copy[k].node;
  }
  PetscCall(CopiesDestroy(&s->copies));
  PetscCall(CopiesCreateMatched(s->comm, s->nnodes, n, rank, node, &s->copies));
  PetscCall(PetscFree3(copy, rank, node));
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
    AddFacets(s, &j->joint[k]);
  }
}

static PetscErrorCode SplitMarked(Joints j, Solid s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscSortInt(j->nmarked, j->cut));
  for (int k = 0; k < j->nmarked; k++) SplitStar(j, s, j->cut[k]);
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
  PetscCall(PrescribeParts(s));
  PetscCall(RenewSubdomain(s));
  PetscCall(MarkSurface(s));
  PetscCall(JointsMeasureRate(j, s));
  PetscCall(ContactRenew(s->contact, s));
  PetscCall(ContactSearch(s->contact, s, 0.0));
  PetscFunctionReturn(0);
}

PetscErrorCode JointsApply(Joints j, Solid s, int n, const int event[])
{
  PetscFunctionBeginUser;
  s->revision++;
  for (int k = 0; k < n; k++) ApplyEvent(j, s, s->revision, event[k]);
  PetscCall(SplitMarked(j, s));
  PlaceFacets(s, 0);
  SolidListCorners(s);
  JointsList(j, s);
  JointsBeginEnds(j, s);
  JointsFindCrackTips(j, s, PETSC_FALSE);
  JointsList(j, s);
  ClearMarks(j);
  s->force_valid = PETSC_FALSE;
  PetscCall(JointsSynchronise(j, s));
  PetscFunctionReturn(0);
}

/* --- once more ---------------------------------------------------------------------------------------- */

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
  PlaceFacets(s, 0);
  SolidListCorners(s);
  JointsFindCrackTips(j, s, PETSC_TRUE);
  JointsList(j, s);
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
  for (int star = 0; star < j->nstars; star++) {
    const int first = j->star_corner[star], n = j->star_corner[star + 1] - first;
    Before before[STAR_CORNERS];
    for (int c = 0; c < n; c++) {
      before[c] = (Before){1.0, {0.0, 0.0}}; /* the coming step has loads of its own */
      SetCornerNode(j, s, &j->corner[first + c], j->saved_corner[first + c].node);
    }
    SplitMass(s, n, j->corner + first, before);
  }
  PlaceFacets(s, 0);
  SolidListCorners(s);
  JointsFindCrackTips(j, s, PETSC_TRUE);
  JointsList(j, s);
  s->unsynchronised = PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode JointsState(Joints j, Solid s, int save)
{
  PetscFunctionBeginUser;
  PetscCall(save ? Save(j, s) : Restore(j, s));
  PetscFunctionReturn(0);
}
