#include "solid/ranks/subdomain.h"

enum { SUBDOMAIN_TAG = 71 };

struct Subdomain_s {
  MPI_Comm comm;
  PetscMPIInt me;
  int n, nneighbours, nshared;
  int *node;              /* [n] */
  int *start;             /* [nneighbours + 1] into node */
  int *neighbour;         /* [nneighbours] ranks, ascending */
  int *shared;            /* [nshared] each shared node once */
  int *lowest;            /* [nnodes] lowest rank that has the node */
  double *out, *in, *own; /* [n][2], [n][2], [nshared][2] */
  MPI_Request *request;   /* [2 nneighbours] */
};

PetscErrorCode SubdomainCreate(MPI_Comm comm, int nnodes, int n, const int rank[], const int node[],
                               Subdomain *subdomain)
{
  Subdomain s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->comm = comm;
  s->n = n;
  PetscCallMPI(MPI_Comm_rank(comm, &s->me));
  PetscCall(PetscMalloc5((size_t)n, &s->node, (size_t)n + 1, &s->start, (size_t)n, &s->neighbour, (size_t)n,
                         &s->shared, (size_t)nnodes, &s->lowest));
  PetscCall(PetscMalloc4(2 * (size_t)n, &s->out, 2 * (size_t)n, &s->in, 2 * (size_t)n, &s->own, 2 * (size_t)n,
                         &s->request));
  for (int i = 0; i < nnodes; i++) s->lowest[i] = -1;
  s->start[0] = 0;
  for (int k = 0; k < n; k++) {
    if (k == 0 || rank[k] != rank[k - 1]) s->neighbour[s->nneighbours++] = rank[k];
    s->start[s->nneighbours] = k + 1;
    s->node[k] = node[k];
    if (s->lowest[node[k]] < 0) {
      s->lowest[node[k]] = PetscMin(rank[k], s->me);
      s->shared[s->nshared++] = node[k];
    }
  }
  for (int i = 0; i < nnodes; i++)
    if (s->lowest[i] < 0) s->lowest[i] = s->me;
  *subdomain = s;
  PetscFunctionReturn(0);
}

static void Add(const Subdomain s, int neighbour, double value[])
{
  for (int k = s->start[neighbour]; k < s->start[neighbour + 1]; k++)
    for (int c = 0; c < 2; c++) value[2 * s->node[k] + c] += s->in[2 * k + c];
}

/* in: what the neighbours have */
static PetscErrorCode Exchange(Subdomain s, const double value[])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < s->n; k++)
    for (int c = 0; c < 2; c++) s->out[2 * k + c] = value[2 * s->node[k] + c];
  for (int j = 0; j < s->nneighbours; j++) {
    const int first = 2 * s->start[j], count = 2 * s->start[j + 1] - first;
    PetscCallMPI(MPI_Irecv(s->in + first, count, MPI_DOUBLE, s->neighbour[j], SUBDOMAIN_TAG, s->comm,
                           &s->request[2 * j]));
    PetscCallMPI(MPI_Isend(s->out + first, count, MPI_DOUBLE, s->neighbour[j], SUBDOMAIN_TAG, s->comm,
                           &s->request[2 * j + 1]));
  }
  PetscCallMPI(MPI_Waitall(2 * s->nneighbours, s->request, MPI_STATUSES_IGNORE));
  PetscFunctionReturn(0);
}

PetscErrorCode SubdomainSum(Subdomain s, double value[])
{
  int j = 0;
  PetscFunctionBeginUser;
  if (s->nneighbours == 0) PetscFunctionReturn(0);
  PetscCall(Exchange(s, value));
  for (int i = 0; i < s->nshared; i++)
    for (int c = 0; c < 2; c++) {
      s->own[2 * i + c] = value[2 * s->shared[i] + c];
      value[2 * s->shared[i] + c] = 0.0;
    }
  for (j = 0; j < s->nneighbours && s->neighbour[j] < s->me; j++) Add(s, j, value);
  for (int i = 0; i < s->nshared; i++)
    for (int c = 0; c < 2; c++) value[2 * s->shared[i] + c] += s->own[2 * i + c];
  for (; j < s->nneighbours; j++) Add(s, j, value);
  PetscFunctionReturn(0);
}

PetscErrorCode SubdomainMin(Subdomain s, double value[])
{
  PetscFunctionBeginUser;
  if (s->nneighbours == 0) PetscFunctionReturn(0);
  PetscCall(Exchange(s, value));
  for (int k = 0; k < s->n; k++)
    for (int c = 0; c < 2; c++)
      value[2 * s->node[k] + c] = PetscMin(value[2 * s->node[k] + c], s->in[2 * k + c]);
  PetscFunctionReturn(0);
}

PetscBool SubdomainOwns(Subdomain s, int node)
{
  return (PetscBool)(s->lowest[node] == s->me);
}

PetscErrorCode SubdomainDestroy(Subdomain *s)
{
  PetscFunctionBeginUser;
  if (!*s) PetscFunctionReturn(0);
  PetscCall(PetscFree5((*s)->node, (*s)->start, (*s)->neighbour, (*s)->shared, (*s)->lowest));
  PetscCall(PetscFree4((*s)->out, (*s)->in, (*s)->own, (*s)->request));
  PetscCall(PetscFree(*s));
  PetscFunctionReturn(0);
}
