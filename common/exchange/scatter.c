#include "common/exchange/scatter_impl.h"
#include <string.h>

enum { SCATTER_TAG = 61 };

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
  ScatterFindPacked(e);
  PetscCall(PetscFree(kept));
  PetscFunctionReturn(0);
}
