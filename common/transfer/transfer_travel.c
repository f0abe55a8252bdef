/* Changed old elements go to every rank one of whose boxes they touch.  A rank has up to BOXES boxes, each
 * around a cluster of its changed new elements. */
#include "common/transfer/transfer_impl.h"

enum { BOXES = 64 };

/* The boxes of all ranks: n of them in *box, *rank says whose; free with PetscFree2. */
static PetscErrorCode GatherBoxes(Transfer t, int *n, GeometryBox **box, int **rank)
{
  int size, mine, *count;
  GeometryBox cover[BOXES] = {0}, *all;
  Search search;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(t->comm, &size));
  PetscCheck(!SearchCreateTriangles(t->changed.n, (const double(*)[3][2])t->changed.x, &search),
             PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for the search tree of %d elements", t->changed.n);
  mine = SearchCover(search, BOXES, cover);
  SearchDestroy(&search);
  PetscCall(PetscMalloc2(size, &count, size * BOXES, &all));
  PetscCallMPI(MPI_Allgather(&mine, 1, MPI_INT, count, 1, MPI_INT, t->comm));
  PetscCallMPI(MPI_Allgather(cover, 4 * BOXES, MPI_DOUBLE, all, 4 * BOXES, MPI_DOUBLE, t->comm));
  PetscCall(PetscMalloc2(size * BOXES, box, size * BOXES, rank));
  *n = 0;
  for (int p = 0; p < size; p++) {
    for (int k = 0; k < count[p]; k++) {
      (*rank)[*n] = p;
      (*box)[(*n)++] = all[p * BOXES + k];
    }
  }
  PetscCall(PetscFree2(count, all));
  PetscFunctionReturn(0);
}

/* Items of one list and their ranks, growing. */
typedef struct {
  int n, capacity;
  int *rank, *source;
} Items;

static PetscErrorCode AddItem(Items *items, int rank, int source)
{
  PetscFunctionBeginUser;
  if (items->n == items->capacity) {
    items->capacity = 2 * items->capacity + 64;
    PetscCall(PetscRealloc((size_t)items->capacity * sizeof(int), &items->rank));
    PetscCall(PetscRealloc((size_t)items->capacity * sizeof(int), &items->source));
  }
  items->rank[items->n] = rank;
  items->source[items->n++] = source;
  PetscFunctionReturn(0);
}

/* items: which of the old elements goes where, each at most once to a rank. */
static PetscErrorCode FindRanks(Transfer t, const TransferElements *old, Items *items)
{
  int size, n, *rank, *last;
  GeometryBox *box;
  Search search;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(t->comm, &size));
  PetscCall(GatherBoxes(t, &n, &box, &rank));
  PetscCheck(!SearchCreate(n, box, &search), PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for %d boxes", n);
  PetscCall(PetscMalloc1(size, &last));
  for (int p = 0; p < size; p++) last[p] = -1;
  for (int e = 0; e < old->n; e++) {
    const GeometryBox around = GeometryBoxOf((const double(*)[2])old->x[e]);
    const int *hit, nhit = SearchQuery(search, &around, &hit);
    PetscCheck(nhit >= 0, PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory to search %d boxes", n);
    for (int h = 0; h < nhit; h++) {
      const int p = rank[hit[h]];
      if (last[p] != e) PetscCall(AddItem(items, p, e));
      last[p] = e;
    }
  }
  PetscCall(PetscFree(last));
  PetscCall(PetscFree2(box, rank));
  SearchDestroy(&search);
  PetscFunctionReturn(0);
}

PetscErrorCode TransferTravel(Transfer t, const TransferElements *old)
{
  Items items = {0};
  Scatter once;
  PetscFunctionBeginUser;
  PetscCall(FindRanks(t, old, &items));
  PetscCall(ScatterCreate(t->comm, items.n, items.rank, items.source, &once));
  t->npieces = ScatterArriving(once);
  PetscCall(PetscMalloc1(t->npieces, &t->piece));
  PetscCall(ScatterForward(once, sizeof *old->x, old->x, t->piece));
  PetscCall(ScatterDestroy(&once));
  for (int k = 0; k < items.n; k++) items.source[k] = old->element[items.source[k]];
  PetscCall(ScatterCreate(t->comm, items.n, items.rank, items.source, &t->piece_route));
  PetscCall(PetscFree(items.rank));
  PetscCall(PetscFree(items.source));
  PetscCheck(!SearchCreateTriangles(t->npieces, (const double(*)[3][2])t->piece, &t->search), PETSC_COMM_SELF,
             PETSC_ERR_MEM, "no memory for the search tree of %d pieces", t->npieces);
  PetscFunctionReturn(0);
}
