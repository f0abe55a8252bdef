#include "common/exchange/scatter.h"
#include <string.h>

enum { SCATTER_TAG = 61 };

struct Scatter_s {
  MPI_Comm comm; /* borrowed */
  PetscMPIInt me;
  int nout, nin;
  ScatterRanks out, in;
  int *row;         /* [nout] in the order of the ranks that the items go to */
  PetscBool packed; /* row[k] = k: items leave from the caller's array */
  char *buffer;     /* of items that leave or have come back */
  size_t capacity;
  MPI_Request *request; /* [out.n + in.n] */
  MPI_Datatype record;  /* of record_bytes */
  size_t record_bytes;
};

static PetscErrorCode RanksCreate(int n, ScatterRanks *r)
{
  PetscFunctionBeginUser;
  r->n = n;
  PetscCall(PetscMalloc1(n, &r->rank));
  PetscCall(PetscCalloc1(n + 1, &r->start));
  PetscFunctionReturn(0);
}

/* Items by rank, of a list of ranks that ascends. */
static PetscErrorCode RanksOf(int n, const int rank[], ScatterRanks *r)
{
  int distinct = 0;
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) distinct += k == 0 || rank[k] != rank[k - 1];
  PetscCall(RanksCreate(distinct, r));
  distinct = 0;
  for (int k = 0; k < n; k++) {
    if (k == 0 || rank[k] != rank[k - 1]) r->rank[distinct++] = rank[k];
    r->start[distinct] = k + 1;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Allocate(MPI_Comm comm, int nout, Scatter *scatter)
{
  Scatter e;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&e));
  e->comm = comm;
  e->nout = nout;
  e->record = MPI_DATATYPE_NULL;
  PetscCallMPI(MPI_Comm_rank(comm, &e->me));
  PetscCall(PetscMalloc1(nout, &e->row));
  *scatter = e;
  PetscFunctionReturn(0);
}

/* Once the lists are made. */
static PetscErrorCode Finish(Scatter e)
{
  PetscFunctionBeginUser;
  e->packed = PETSC_TRUE;
  for (int k = 0; k < e->nout; k++) e->packed = (PetscBool)(e->packed && e->row[k] == k);
  PetscCall(PetscMalloc1(e->out.n + e->in.n, &e->request));
  PetscFunctionReturn(0);
}

/* Sorts the items by rank, those of one rank stay in their order. */
static PetscErrorCode SortItems(MPI_Comm comm, int n, const int to[], const int row[], Scatter e)
{
  PetscMPIInt size;
  int *next, ranks = 0;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscCalloc1(size + 1, &next));
  for (int k = 0; k < n; k++) next[to[k] + 1]++;
  for (int r = 0; r < size; r++) ranks += next[r + 1] > 0;
  PetscCall(RanksCreate(ranks, &e->out));
  ranks = 0;
  for (int r = 0; r < size; r++) {
    if (next[r + 1]) {
      e->out.rank[ranks++] = r;
      e->out.start[ranks] = next[r] + next[r + 1];
    }
    next[r + 1] += next[r];
  }
  for (int k = 0; k < n; k++) e->row[next[to[k]]++] = row ? row[k] : k;
  PetscCall(PetscFree(next));
  PetscFunctionReturn(0);
}

/* Who sends how much to this rank: each rank knows only where it sends itself. */
static PetscErrorCode FindSources(Scatter e)
{
  PetscMPIInt nfrom, *from, *count;
  int *items;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(e->out.n, &items));
  for (int j = 0; j < e->out.n; j++) items[j] = e->out.start[j + 1] - e->out.start[j];
  PetscCall(PetscCommBuildTwoSided(e->comm, 1, MPI_INT, e->out.n, e->out.rank, items, &nfrom, &from, &count));
  PetscCall(PetscSortMPIIntWithArray(nfrom, from, count));
  PetscCall(RanksCreate(nfrom, &e->in));
  for (int j = 0; j < nfrom; j++) {
    e->in.rank[j] = from[j];
    e->in.start[j + 1] = e->in.start[j] + count[j];
  }
  e->nin = e->in.start[nfrom];
  PetscCall(PetscFree(from));
  PetscCall(PetscFree(count));
  PetscCall(PetscFree(items));
  PetscFunctionReturn(0);
}

PetscErrorCode ScatterCreate(MPI_Comm comm, int n, const int to[], const int row[], Scatter *scatter)
{
  PetscFunctionBeginUser;
  PetscCall(Allocate(comm, n, scatter));
  PetscCall(SortItems(comm, n, to, row, *scatter));
  PetscCall(FindSources(*scatter));
  PetscCall(Finish(*scatter));
  PetscFunctionReturn(0);
}

PetscErrorCode ScatterCreateMatched(MPI_Comm comm, int nout, const int to[], const int row[], int nin,
                                    const int from[], Scatter *scatter)
{
  PetscFunctionBeginUser;
  PetscCall(Allocate(comm, nout, scatter));
  (*scatter)->nin = nin;
  for (int k = 0; k < nout; k++) (*scatter)->row[k] = row ? row[k] : k;
  PetscCall(RanksOf(nout, to, &(*scatter)->out));
  PetscCall(RanksOf(nin, from, &(*scatter)->in));
  PetscCall(Finish(*scatter));
  PetscFunctionReturn(0);
}

PetscErrorCode ScatterDestroy(Scatter *scatter)
{
  Scatter e = *scatter;
  PetscFunctionBeginUser;
  if (!e) PetscFunctionReturn(0);
  PetscCall(PetscFree(e->out.rank));
  PetscCall(PetscFree(e->out.start));
  PetscCall(PetscFree(e->in.rank));
  PetscCall(PetscFree(e->in.start));
  PetscCall(PetscFree(e->row));
  PetscCall(PetscFree(e->buffer));
  PetscCall(PetscFree(e->request));
  if (e->record != MPI_DATATYPE_NULL) PetscCallMPI(MPI_Type_free(&e->record));
  PetscCall(PetscFree(*scatter));
  PetscFunctionReturn(0);
}

int ScatterArriving(Scatter e)
{
  return e->nin;
}

PetscErrorCode ScatterGetSources(Scatter e, const ScatterRanks **sources)
{
  PetscFunctionBeginUser;
  *sources = &e->in;
  PetscFunctionReturn(0);
}

PetscErrorCode ScatterGetLeaving(Scatter e, const ScatterRanks **targets, const int **row)
{
  PetscFunctionBeginUser;
  *targets = &e->out;
  *row = e->row;
  PetscFunctionReturn(0);
}

static PetscErrorCode Reserve(Scatter e, size_t bytes)
{
  PetscFunctionBeginUser;
  if (bytes * (size_t)e->nout > e->capacity) {
    PetscCall(PetscFree(e->buffer));
    e->capacity = bytes * (size_t)e->nout;
    PetscCall(PetscMalloc1(e->capacity, &e->buffer));
  }
  PetscFunctionReturn(0);
}

/* The type of one record, kept until another size is wanted. */
static PetscErrorCode SetRecord(Scatter e, size_t bytes)
{
  PetscFunctionBeginUser;
  if (e->record != MPI_DATATYPE_NULL && bytes == e->record_bytes) PetscFunctionReturn(0);
  if (e->record != MPI_DATATYPE_NULL) PetscCallMPI(MPI_Type_free(&e->record));
  PetscCallMPI(MPI_Type_contiguous((int)bytes, MPI_BYTE, &e->record));
  PetscCallMPI(MPI_Type_commit(&e->record));
  e->record_bytes = bytes;
  PetscFunctionReturn(0);
}

/* What stays on this rank goes from one list to the other. */
static PetscErrorCode CopySelf(Scatter e, const ScatterRanks *from, int j, const char *send,
                               const ScatterRanks *to, char *receive)
{
  int k = 0;
  PetscFunctionBeginUser;
  while (to->rank[k] != e->me) k++;
  PetscCall(PetscMemcpy(receive + e->record_bytes * (size_t)to->start[k],
                        send + e->record_bytes * (size_t)from->start[j],
                        e->record_bytes * (size_t)(from->start[j + 1] - from->start[j])));
  PetscFunctionReturn(0);
}

static PetscErrorCode Transport(Scatter e, size_t bytes, const ScatterRanks *from, const char *send,
                                const ScatterRanks *to, char *receive)
{
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(SetRecord(e, bytes));
  for (int j = 0; j < to->n; j++) {
    if (to->rank[j] == e->me) continue;
    PetscCallMPI(MPI_Irecv(receive + bytes * (size_t)to->start[j], to->start[j + 1] - to->start[j], e->record,
                           to->rank[j], SCATTER_TAG, e->comm, &e->request[n++]));
  }
  for (int j = 0; j < from->n; j++) {
    if (from->rank[j] == e->me) {
      PetscCall(CopySelf(e, from, j, send, to, receive));
      continue;
    }
    PetscCallMPI(MPI_Isend(send + bytes * (size_t)from->start[j], from->start[j + 1] - from->start[j],
                           e->record, from->rank[j], SCATTER_TAG, e->comm, &e->request[n++]));
  }
  PetscCallMPI(MPI_Waitall(n, e->request, MPI_STATUSES_IGNORE));
  PetscFunctionReturn(0);
}

PetscErrorCode ScatterForward(Scatter e, size_t bytes, const void *local, void *arrived)
{
  const char *from = local;
  PetscFunctionBeginUser;
  if (!e->packed) {
    PetscCall(Reserve(e, bytes));
    for (int k = 0; k < e->nout; k++)
      memcpy(e->buffer + bytes * (size_t)k, from + bytes * (size_t)e->row[k], bytes);
    from = e->buffer;
  }
  PetscCall(Transport(e, bytes, &e->out, from, &e->in, arrived));
  PetscFunctionReturn(0);
}

PetscErrorCode ScatterReverse(Scatter e, size_t bytes, const void *arrived, void *local)
{
  PetscFunctionBeginUser;
  PetscCall(Reserve(e, bytes));
  PetscCall(Transport(e, bytes, &e->in, arrived, &e->out, e->buffer));
  for (int k = 0; k < e->nout; k++)
    memcpy((char *)local + bytes * (size_t)e->row[k], e->buffer + bytes * (size_t)k, bytes);
  PetscFunctionReturn(0);
}

PetscErrorCode ScatterReverseAdd(Scatter e, int ncomp, const double arrived[], double local[])
{
  const size_t bytes = (size_t)ncomp * sizeof *local;
  PetscFunctionBeginUser;
  PetscCall(Reserve(e, bytes));
  PetscCall(Transport(e, bytes, &e->in, (const char *)arrived, &e->out, e->buffer));
  const double *back = (const double *)(const void *)e->buffer;
  for (int k = 0; k < e->nout; k++) {
    double *to = local + (size_t)ncomp * (size_t)e->row[k];
    for (int c = 0; c < ncomp; c++) to[c] += back[(size_t)ncomp * (size_t)k + (size_t)c];
  }
  PetscFunctionReturn(0);
}

/* The ranks that still have items, and the rows of these unless row is NULL; returns their number. */
static int Compress(ScatterRanks *r, const char keep[], int row[])
{
  int ranks = 0, kept = 0;
  for (int j = 0, k = 0; j < r->n; j++) {
    const int end = r->start[j + 1], before = kept;
    for (; k < end; k++) {
      if (!keep[k]) continue;
      if (row) row[kept] = row[k];
      kept++;
    }
    if (kept == before) continue;
    r->rank[ranks] = r->rank[j];
    r->start[++ranks] = kept;
  }
  r->n = ranks;
  return kept;
}

PetscErrorCode ScatterKeep(Scatter e, const char keep[])
{
  char *kept;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(e->nout, &kept));
  PetscCall(Transport(e, 1, &e->in, keep, &e->out, kept));
  e->nin = Compress(&e->in, keep, NULL);
  e->nout = Compress(&e->out, kept, e->row);
  e->packed = PETSC_TRUE;
  for (int k = 0; k < e->nout; k++) e->packed = (PetscBool)(e->packed && e->row[k] == k);
  PetscCall(PetscFree(kept));
  PetscFunctionReturn(0);
}
