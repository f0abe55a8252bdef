#include "coupler/node_sum.h"
#include "common/exchange/scatter.h"
#include <stdlib.h>

/* Copies meet on rank gid % size, where those of one node are put in one group. */
struct NodeSum_s {
  int n, narriving, ngroups;
  Scatter route;
  int *group; /* [narriving] */
};

typedef struct {
  long long gid;
  int item;
} Copy;

static int CompareCopies(const void *a, const void *b)
{
  const Copy *p = a, *q = b;
  if (p->gid != q->gid) return p->gid < q->gid ? -1 : 1;
  return (p->item > q->item) - (p->item < q->item);
}

static PetscErrorCode GroupCopies(NodeSum s, const long long gid[])
{
  Copy *copy;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->narriving, &copy));
  for (int i = 0; i < s->narriving; i++) copy[i] = (Copy){gid[i], i};
  if (s->narriving) qsort(copy, (size_t)s->narriving, sizeof *copy, CompareCopies);
  for (int i = 0; i < s->narriving; i++) {
    if (i == 0 || copy[i].gid != copy[i - 1].gid) s->ngroups++;
    s->group[copy[i].item] = s->ngroups - 1;
  }
  PetscCall(PetscFree(copy));
  PetscFunctionReturn(0);
}

PetscErrorCode NodeSumCreate(MPI_Comm comm, int n, const long long gid[], NodeSum *sum)
{
  NodeSum s;
  int size, *rank, *source;
  long long *arriving;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->n = n;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc2(n, &rank, n, &source));
  for (int i = 0; i < n; i++) {
    rank[i] = (int)(gid[i] % size);
    source[i] = i;
  }
  PetscCall(ScatterCreate(comm, n, rank, source, &s->route));
  s->narriving = ScatterArriving(s->route);
  PetscCall(PetscMalloc1(s->narriving, &s->group));
  PetscCall(PetscMalloc1(s->narriving, &arriving));
  PetscCall(ScatterForward(s->route, sizeof *gid, gid, arriving));
  PetscCall(GroupCopies(s, arriving));
  PetscCall(PetscFree(arriving));
  PetscCall(PetscFree2(rank, source));
  *sum = s;
  PetscFunctionReturn(0);
}

PetscErrorCode NodeSumApply(NodeSum s, int ncomp, double value[])
{
  double *remote, *total;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)s->narriving * (size_t)ncomp, &remote));
  PetscCall(PetscCalloc1((size_t)s->ngroups * (size_t)ncomp, &total));
  PetscCall(ScatterForward(s->route, (size_t)ncomp * sizeof *value, value, remote));
  for (int i = 0; i < s->narriving; i++) {
    for (int c = 0; c < ncomp; c++) total[s->group[i] * ncomp + c] += remote[i * ncomp + c];
  }
  for (int i = 0; i < s->narriving; i++) {
    for (int c = 0; c < ncomp; c++) remote[i * ncomp + c] = total[s->group[i] * ncomp + c];
  }
  PetscCall(PetscArrayzero(value, (size_t)s->n * (size_t)ncomp));
  PetscCall(ScatterReverseAdd(s->route, ncomp, remote, value));
  PetscCall(PetscFree(remote));
  PetscCall(PetscFree(total));
  PetscFunctionReturn(0);
}

PetscErrorCode NodeSumDestroy(NodeSum *sum)
{
  PetscFunctionBeginUser;
  if (!*sum) PetscFunctionReturn(0);
  PetscCall(ScatterDestroy(&(*sum)->route));
  PetscCall(PetscFree((*sum)->group));
  PetscCall(PetscFree(*sum));
  PetscFunctionReturn(0);
}
