/* P2 fields: nodes of unchanged elements keep their values; others are located among the pieces by the rank
 * that owns them; ranks that share a node take its owner's value. */
#include "common/space/p2.h"
#include "common/transfer/transfer_impl.h"

/* Outside of all old elements by more than round-off, in barycentric coordinates. */
static const double OUTSIDE = -1e-6;

enum { NOT_SEARCHED = -2 };

/* Of the hits, the piece with the largest smallest barycentric coordinate at x; returns that coordinate. */
static double Locate(Transfer t, int nhit, const int hit[], const double x[2], TransferNode *node)
{
  double best = -HUGE_VAL;
  for (int h = 0; h < nhit; h++) {
    double n[3];
    GeometryBarycentric((const double(*)[2])t->piece[hit[h]], x, n);
    const double smallest = PetscMin(n[0], PetscMin(n[1], n[2]));
    if (!(smallest > best)) continue;
    best = smallest;
    node->piece = hit[h];
    for (int i = 0; i < 3; i++) node->n[i] = n[i];
  }
  return best;
}

/* Locates the nodes of changed element k that nobody has located.  Every piece that can hold one of them
 * touches the element's box. */
static PetscErrorCode LocateNodes(Transfer t, int k, char located[])
{
  const int *p2 = &t->to->p2[6 * t->changed.element[k]], *hit = NULL;
  const double(*x)[2] = (const double(*)[2])t->changed.x[k];
  const GeometryBox box = GeometryBoxOf(x);
  int nhit = NOT_SEARCHED;
  PetscFunctionBeginUser;
  for (int i = 0; i < 6; i++) {
    const double *p = x[i < 3 ? i : (i + 1) % 3], *q = x[i < 3 ? i : (i + 2) % 3];
    const double at[2] = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])};
    TransferNode *node = &t->node[t->nnodes];
    if (p2[i] >= t->to->np2_owned || located[p2[i]]) continue;
    if (nhit == NOT_SEARCHED) nhit = SearchQuery(t->search, &box, &hit);
    PetscCheck(nhit >= 0, PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory to search %d pieces", t->npieces);
    PetscCheck(Locate(t, nhit, hit, at, node) > OUTSIDE, PETSC_COMM_SELF, PETSC_ERR_ARG_INCOMP,
               "(%g, %g) of the new mesh lies in no triangle of the old one", at[0], at[1]);
    node->node = p2[i];
    located[p2[i]] = 1;
    t->nnodes++;
  }
  PetscFunctionReturn(0);
}

/* Nodes that others own are asked of them. */
static PetscErrorCode MakeAsking(Transfer t)
{
  const Mesh *to = t->to;
  const int n = to->np2 - to->np2_owned;
  int size, *rank, *source;
  PetscInt *start, *gid;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(t->comm, &size));
  PetscCall(PetscMalloc3(n, &rank, n, &source, size + 1, &start));
  PetscCallMPI(MPI_Allgather(&to->p2start, 1, MPIU_INT, start, 1, MPIU_INT, t->comm));
  start[size] = to->np2_global;
  for (int k = 0; k < n; k++) {
    int low = 0, high = size; /* start[low] <= gid < start[high]: bisection passes over empty ranks */
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      if (start[middle] <= to->p2gid[to->np2_owned + k])
        low = middle;
      else
        high = middle;
    }
    rank[k] = low;
    source[k] = to->np2_owned + k;
  }
  PetscCall(ScatterCreate(t->comm, n, rank, source, &t->ask_route));
  PetscCall(PetscMalloc1(ScatterArriving(t->ask_route), &t->asked));
  PetscCall(PetscMalloc1(ScatterArriving(t->ask_route), &gid));
  PetscCall(ScatterForward(t->ask_route, sizeof *gid, to->p2gid, gid));
  for (int k = 0; k < ScatterArriving(t->ask_route); k++) t->asked[k] = (int)(gid[k] - to->p2start);
  PetscCall(PetscFree(gid));
  PetscCall(PetscFree3(rank, source, start));
  PetscFunctionReturn(0);
}

PetscErrorCode TransferNodesCreate(Transfer t)
{
  char *located;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(t->to->np2, &located));
  PetscCall(PetscMalloc1(t->to->np2_owned + 1, &t->node));
  for (int k = 0; k < t->ncopies; k++) {
    for (int i = 0; i < 6; i++) located[t->to->p2[6 * t->copy[k].target + i]] = 1;
  }
  for (int k = 0; k < t->changed.n; k++) PetscCall(LocateNodes(t, k, located));
  PetscCall(PetscFree(located));
  PetscCall(MakeAsking(t));
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

static PetscErrorCode FromOwners(Transfer t, double target[])
{
  const int n = ScatterArriving(t->ask_route);
  double *value;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &value));
  for (int k = 0; k < n; k++) value[k] = target[t->asked[k]];
  PetscCall(PetscArrayzero(target + t->to->np2_owned, t->to->np2 - t->to->np2_owned));
  PetscCall(ScatterReverseAdd(t->ask_route, 1, value, target));
  PetscCall(PetscFree(value));
  PetscFunctionReturn(0);
}

PetscErrorCode TransferP2(Transfer t, const double source[], double target[])
{
  const Mesh *from = t->from;
  double(*element)[6], (*copy)[6], (*piece)[6];
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(from->ne, &element));
  for (int e = 0; e < from->ne; e++) {
    for (int i = 0; i < 6; i++) element[e][i] = source[from->p2[6 * e + i]];
  }
  PetscCall(Bring(t->copy_route, (const double(*)[6])element, &copy));
  PetscCall(Bring(t->piece_route, (const double(*)[6])element, &piece));
  for (int k = 0; k < t->ncopies; k++) {
    const int *p2 = &t->to->p2[6 * t->copy[k].target], turn = t->copy[k].turn;
    for (int i = 0; i < 6; i++) target[p2[i]] = copy[k][i - i % 3 + (i + turn) % 3];
  }
  for (int k = 0; k < t->nnodes; k++) {
    const TransferNode *node = &t->node[k];
    target[node->node] = P2Evaluate(piece[node->piece], node->n);
  }
  PetscCall(FromOwners(t, target));
  PetscCall(PetscFree(element));
  PetscCall(PetscFree(copy));
  PetscCall(PetscFree(piece));
  PetscFunctionReturn(0);
}
