/* Who exchanges what with whom: found, or known. */
#include "common/exchange/scatter_impl.h"

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

void ScatterFindPacked(Scatter e)
{
  e->packed = PETSC_TRUE;
  for (int k = 0; k < e->nout; k++) e->packed = (PetscBool)(e->packed && e->row[k] == k);
}

/* Once the lists are made. */
static PetscErrorCode Finish(Scatter e)
{
  PetscFunctionBeginUser;
  ScatterFindPacked(e);
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
