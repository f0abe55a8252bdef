/* P2 fields: nodes of unchanged elements keep their values; others are located among the migrated elements by
 * the rank that owns them; ranks that share a node take its owner's value. */
#include "common/space/p2.h"
#include "common/transfer/transfer_impl.h"
#include <petscis.h>

/* Outside of all old elements by more than round-off, in barycentric coordinates. */
static const double OUTSIDE = -1e-6;

enum { NOT_SEARCHED = -2 };

/* A P2 node of the new mesh in a migrated element. */
typedef struct {
  int node, moved;
  double n[3]; /* barycentric */
} NodeLocation;

/* Of the nodes of the new space: those of changed elements that this rank owns. */
typedef struct {
  Transfer transfer;
  const P2Space *to;
  int n;
  NodeLocation *location; /* [n] */
} Nodes;

/* Of the hits, the migrated element with the largest smallest barycentric coordinate at x; returns that
 * coordinate. */
static double Locate(Transfer t, int nhit, const int hit[], const double x[2], NodeLocation *node)
{
  double best = -HUGE_VAL;
  for (int h = 0; h < nhit; h++) {
    double n[3];
    GeometryBarycentric((const double(*)[2])t->moved[hit[h]], x, n);
    const double smallest = PetscMin(n[0], PetscMin(n[1], n[2]));
    if (!(smallest > best)) continue;
    best = smallest;
    node->moved = hit[h];
    for (int i = 0; i < 3; i++) node->n[i] = n[i];
  }
  return best;
}

/* Locates the nodes of changed element k that nobody has located.  Every migrated element that can hold one
 * of them touches the element's box. */
static PetscErrorCode LocateNodes(Nodes *s, int k, char located[])
{
  const Transfer t = s->transfer;
  const int *p2 = &s->to->node[6 * t->changed.element[k]], *hit = NULL;
  const double(*x)[2] = (const double(*)[2])t->changed.x[k];
  const GeometryBox box = GeometryBoxOf(x);
  int nhit = NOT_SEARCHED;
  PetscFunctionBeginUser;
  for (int i = 0; i < 6; i++) {
    const double *p = x[i < 3 ? i : (i + 1) % 3], *q = x[i < 3 ? i : (i + 2) % 3];
    const double at[2] = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])};
    NodeLocation *node = &s->location[s->n];
    if (p2[i] >= s->to->nowned || located[p2[i]]) continue;
    if (nhit == NOT_SEARCHED) nhit = SearchQuery(t->search, &box, &hit);
    PetscCheck(nhit >= 0, PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory to search %d elements", t->nmoved);
    PetscCheck(Locate(t, nhit, hit, at, node) > OUTSIDE, PETSC_COMM_SELF, PETSC_ERR_ARG_INCOMP,
               "(%g, %g) of the new mesh lies in no triangle of the old one", at[0], at[1]);
    node->node = p2[i];
    located[p2[i]] = 1;
    s->n++;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode LocateAll(Nodes *s)
{
  const Transfer t = s->transfer;
  char *located;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(s->to->n, &located));
  PetscCall(PetscMalloc1(s->to->nowned + 1, &s->location));
  for (int k = 0; k < t->ncopies; k++) {
    for (int i = 0; i < 6; i++) located[s->to->node[6 * t->copy[k].target + i]] = 1;
  }
  for (int k = 0; k < t->changed.n; k++) PetscCall(LocateNodes(s, k, located));
  PetscCall(PetscFree(located));
  PetscFunctionReturn(0);
}

/* The nodes of all old elements, [from->ne][6], brought to the ends of a route. */
static PetscErrorCode Bring(Scatter route, const double (*element)[6], double (**there)[6])
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(ScatterArriving(route), there));
  PetscCall(ScatterForward(route, sizeof *element, element, *there));
  PetscFunctionReturn(0);
}

/* The value of an owned node. */
typedef struct {
  PetscInt start;
  const double *value;
} OwnedValues;

static PetscErrorCode GetValue(void *context, long long gid, void *value)
{
  const OwnedValues *s = context;
  *(double *)value = s->value[gid - s->start];
  return 0;
}

/* Nodes that others own are asked of them. */
static PetscErrorCode FromOwners(MPI_Comm comm, const P2Space *space, double value[])
{
  const int n = space->n - space->nowned;
  OwnedValues owned = {space->start, value};
  PetscLayout layout;
  long long *gid;
  PetscMPIInt *of;
  PetscFunctionBeginUser;
  PetscCall(PetscLayoutCreateFromSizes(comm, space->nowned, space->nglobal, 1, &layout));
  PetscCall(PetscMalloc2(n, &of, n, &gid));
  for (int k = 0; k < n; k++) {
    gid[k] = space->gid[space->nowned + k];
    PetscCall(PetscLayoutFindOwner(layout, space->gid[space->nowned + k], &of[k]));
  }
  PetscCall(ScatterRequest(comm, n, of, gid, sizeof *value, GetValue, &owned, value + space->nowned));
  PetscCall(PetscFree2(of, gid));
  PetscCall(PetscLayoutDestroy(&layout));
  PetscFunctionReturn(0);
}

PetscErrorCode TransferP2(Transfer t, const P2Space *from, const P2Space *to, const double source[],
                          double target[])
{
  Nodes nodes = {.transfer = t, .to = to};
  double(*element)[6], (*copy)[6], (*moved)[6];
  PetscFunctionBeginUser;
  PetscCall(LocateAll(&nodes));
  PetscCall(PetscMalloc1(t->from->ne, &element));
  for (int e = 0; e < t->from->ne; e++) {
    for (int i = 0; i < 6; i++) element[e][i] = source[from->node[6 * e + i]];
  }
  PetscCall(Bring(t->copy_scatter, (const double(*)[6])element, &copy));
  PetscCall(Bring(t->moved_scatter, (const double(*)[6])element, &moved));
  for (int k = 0; k < t->ncopies; k++) {
    const int *p2 = &to->node[6 * t->copy[k].target], turn = t->copy[k].turn;
    for (int i = 0; i < 6; i++) target[p2[i]] = copy[k][i - i % 3 + (i + turn) % 3];
  }
  for (int k = 0; k < nodes.n; k++) {
    const NodeLocation *at = &nodes.location[k];
    target[at->node] = P2Evaluate(moved[at->moved], at->n);
  }
  PetscCall(FromOwners(t->comm, to, target));
  PetscCall(PetscFree(nodes.location));
  PetscCall(PetscFree(element));
  PetscCall(PetscFree(copy));
  PetscCall(PetscFree(moved));
  PetscFunctionReturn(0);
}
