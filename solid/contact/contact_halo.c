#include "solid/contact/contact_halo.h"
#include "common/exchange/scatter.h"

struct Halo_s {
  MPI_Comm comm;
  PetscMPIInt rank, size;
  int nnodes;
  Scatter scatter; /* rows, of own targets that another rank needs -> those of others that this rank needs */
  int row_capacity;
  int (*node)[3];                      /* [rows] of the own target */
  double (*row)[6];                    /* [rows] its vertices' values that leave or have come back */
  int nleaving;                        /* rows that are still needed */
  const int *leaving;                  /* [nleaving] in the order of the ranks, borrowed from the scatter */
  int n, capacity;                     /* targets that this rank needs */
  Target *target;                      /* [n] */
  double *position, *velocity, *force; /* [n][3][2] */
};

PetscErrorCode HaloCreate(MPI_Comm comm, Halo *halo)
{
  Halo h;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&h));
  h->comm = comm;
  PetscCallMPI(MPI_Comm_rank(comm, &h->rank));
  PetscCallMPI(MPI_Comm_size(comm, &h->size));
  *halo = h;
  PetscFunctionReturn(0);
}

static PetscBool Wanted(const GeometryBox *edges, const Target *t, const double x[], const double margin[])
{
  const GeometryBox box = GeometryBoxWidened(GeometryBoxOfNodes(3, t->node, x), margin[t->body]);
  return (PetscBool)GeometryBoxOverlap(edges, &box);
}

static PetscErrorCode ReserveRows(Halo h, int n)
{
  PetscFunctionBeginUser;
  if (n <= h->row_capacity) PetscFunctionReturn(0);
  h->row_capacity = n + n / 2 + 16;
  PetscCall(PetscRealloc((size_t)h->row_capacity * sizeof *h->node, &h->node));
  PetscCall(PetscRealloc((size_t)h->row_capacity * sizeof *h->row, &h->row));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReserveTargets(Halo h, int n)
{
  const size_t bytes = 6 * (size_t)(n + n / 2 + 16) * sizeof *h->force;
  PetscFunctionBeginUser;
  if (n <= h->capacity) PetscFunctionReturn(0);
  h->capacity = n + n / 2 + 16;
  PetscCall(PetscRealloc((size_t)h->capacity * sizeof *h->target, &h->target));
  PetscCall(PetscRealloc(bytes, &h->position));
  PetscCall(PetscRealloc(bytes, &h->velocity));
  PetscCall(PetscRealloc(bytes, &h->force));
  PetscFunctionReturn(0);
}

/* Targets near the edges of other ranks, edges[size]: target row[k] goes to rank to[k].  Returns their number;
 * counts alone if to is NULL. */
static int Offer(Halo h, const double x[], const double margin[], const GeometryBox edges[], int n,
                 const Target target[], int to[], int row[])
{
  int rows = 0;
  for (int r = 0; r < h->size; r++)
    for (int k = 0; k < n && r != h->rank; k++) {
      if (!Wanted(&edges[r], &target[k], x, margin)) continue;
      if (to) {
        to[rows] = r;
        row[rows] = k;
      }
      rows++;
    }
  return rows;
}

/* Who needs which target, and the targets that this rank needs. */
static PetscErrorCode Exchange(Halo h, int nrows, const int to[], const int row[], const Target target[])
{
  Target *leaving;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)nrows, &leaving));
  PetscCall(ReserveRows(h, nrows));
  for (int k = 0; k < nrows; k++) {
    leaving[k] = target[row[k]];
    PetscCall(PetscArraycpy(h->node[k], leaving[k].node, 3));
  }
  PetscCall(ScatterDestroy(&h->scatter));
  PetscCall(ScatterCreate(h->comm, nrows, to, NULL, &h->scatter));
  h->n = ScatterArriving(h->scatter);
  PetscCall(ReserveTargets(h, h->n));
  PetscCall(ScatterForward(h->scatter, sizeof *leaving, leaving, h->target));
  PetscCall(PetscFree(leaving));
  PetscFunctionReturn(0);
}

/* After the lists have changed. */
static PetscErrorCode Renew(Halo h)
{
  const ScatterRanks *to;
  PetscFunctionBeginUser;
  PetscCall(ScatterGetLeaving(h->scatter, &to, &h->leaving));
  h->nleaving = to->start[to->n];
  for (int k = 0; k < h->n; k++) /* behind this rank's own nodes */
    for (int i = 0; i < 3; i++) h->target[k].node[i] = h->nnodes + 3 * k + i;
  PetscFunctionReturn(0);
}

PetscErrorCode HaloBuild(Halo h, int nnodes, const double x[], const double margin[],
                         const GeometryBox *edges, int n, const Target target[])
{
  GeometryBox *all;
  int *to, *row;
  PetscFunctionBeginUser;
  h->nnodes = nnodes;
  PetscCall(PetscMalloc1((size_t)h->size, &all));
  PetscCallMPI(MPI_Allgather(edges, sizeof *edges, MPI_BYTE, all, sizeof *all, MPI_BYTE, h->comm));
  const int nrows = Offer(h, x, margin, all, n, target, NULL, NULL);
  PetscCall(PetscMalloc2((size_t)nrows, &to, (size_t)nrows, &row));
  Offer(h, x, margin, all, n, target, to, row);
  PetscCall(Exchange(h, nrows, to, row, target));
  PetscCall(Renew(h));
  PetscCall(PetscFree2(to, row));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(0);
}

PetscErrorCode HaloKeep(Halo h, const char keep[], int index[])
{
  int kept = 0;
  PetscFunctionBeginUser;
  PetscCall(ScatterKeep(h->scatter, keep));
  for (int k = 0; k < h->n; k++) {
    index[k] = keep[k] ? kept : -1;
    if (keep[k]) h->target[kept++] = h->target[k];
  }
  h->n = kept;
  PetscCall(Renew(h));
  PetscFunctionReturn(0);
}

int HaloTargets(Halo h, const Target **target)
{
  *target = h->target;
  return h->n;
}

int HaloTraffic(Halo h)
{
  return h->n + h->nleaving;
}

static PetscErrorCode Forward(Halo h, const double value[], double *received)
{
  PetscFunctionBeginUser;
  for (int k = 0; k < h->nleaving; k++) {
    const int row = h->leaving[k], *node = h->node[row];
    for (int i = 0; i < 6; i++) h->row[row][i] = value[2 * node[i / 2] + i % 2];
  }
  PetscCall(ScatterForward(h->scatter, sizeof *h->row, h->row, received));
  PetscFunctionReturn(0);
}

PetscErrorCode HaloForward(Halo h, const double x[], const double v[])
{
  PetscFunctionBeginUser;
  if (!h->scatter) PetscFunctionReturn(0);
  PetscCall(Forward(h, x, h->position));
  if (v) PetscCall(Forward(h, v, h->velocity));
  PetscCall(PetscArrayzero(h->force, 6 * (size_t)h->n));
  PetscFunctionReturn(0);
}

const double *HaloVelocities(Halo h)
{
  return h->velocity;
}

const double *HaloPositions(Halo h)
{
  return h->position;
}

double *HaloForces(Halo h)
{
  return h->force;
}

PetscErrorCode HaloReverse(Halo h, double force[])
{
  PetscFunctionBeginUser;
  if (!h->scatter) PetscFunctionReturn(0);
  PetscCall(ScatterReverse(h->scatter, sizeof *h->row, h->force, h->row));
  for (int k = 0; k < h->nleaving; k++) {
    const int row = h->leaving[k], *node = h->node[row];
    for (int i = 0; i < 6; i++) force[2 * node[i / 2] + i % 2] += h->row[row][i];
  }
  PetscFunctionReturn(0);
}

PetscErrorCode HaloDestroy(Halo *halo)
{
  Halo h = *halo;
  PetscFunctionBeginUser;
  if (!h) PetscFunctionReturn(0);
  PetscCall(ScatterDestroy(&h->scatter));
  PetscCall(PetscFree(h->node));
  PetscCall(PetscFree(h->row));
  PetscCall(PetscFree(h->target));
  PetscCall(PetscFree(h->position));
  PetscCall(PetscFree(h->velocity));
  PetscCall(PetscFree(h->force));
  PetscCall(PetscFree(*halo));
  PetscFunctionReturn(0);
}
