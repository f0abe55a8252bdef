#include "solid/contact/contact_halo.h"

enum { TAG_TARGETS = 81, TAG_KEEP, TAG_POSITIONS, TAG_VELOCITIES, TAG_FORCES };

/* One side's lists: targets of (or for) rank r at start[r] .. start[r + 1] - 1. */
typedef struct {
  int n, capacity;
  int *start;     /* [size + 1] */
  Target *target; /* [n] */
  double *value;  /* [n][3][2] what travels per substep */
} ClientList;

typedef struct {
  double lower[2], upper[2];
} Offer;

struct Halo_s {
  MPI_Comm comm;
  PetscMPIInt rank, size;
  int nnodes;
  ClientList out, in;       /* own targets that others need; theirs that this rank needs */
  double *force, *velocity; /* [in.n][3][2] */
  MPI_Request *request;
};

PetscErrorCode HaloCreate(MPI_Comm comm, Halo *halo)
{
  Halo h;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&h));
  h->comm = comm;
  PetscCallMPI(MPI_Comm_rank(comm, &h->rank));
  PetscCallMPI(MPI_Comm_size(comm, &h->size));
  PetscCall(PetscCalloc3((size_t)h->size + 1, &h->out.start, (size_t)h->size + 1, &h->in.start,
                         2 * (size_t)h->size, &h->request));
  *halo = h;
  PetscFunctionReturn(0);
}

static PetscErrorCode Reserve(ClientList *s, int n)
{
  PetscFunctionBeginUser;
  if (n <= s->capacity) PetscFunctionReturn(0);
  s->capacity = n + n / 2 + 16;
  PetscCall(PetscRealloc((size_t)s->capacity * sizeof *s->target, &s->target));
  PetscCall(PetscRealloc(6 * (size_t)s->capacity * sizeof *s->value, &s->value));
  PetscFunctionReturn(0);
}

/* Sends from's parts and receives to's, `bytes` a target. */
static PetscErrorCode Travel(Halo h, const ClientList *from, const void *send, const ClientList *to,
                             void *receive, size_t bytes, int tag)
{
  int n = 0;
  PetscFunctionBeginUser;
  for (int r = 0; r < h->size; r++) {
    const int incoming = to->start[r + 1] - to->start[r], outgoing = from->start[r + 1] - from->start[r];
    if (incoming)
      PetscCallMPI(MPI_Irecv((char *)receive + bytes * (size_t)to->start[r], (int)(bytes * (size_t)incoming),
                             MPI_BYTE, r, tag, h->comm, &h->request[n++]));
    if (outgoing)
      PetscCallMPI(MPI_Isend((const char *)send + bytes * (size_t)from->start[r],
                             (int)(bytes * (size_t)outgoing), MPI_BYTE, r, tag, h->comm, &h->request[n++]));
  }
  PetscCallMPI(MPI_Waitall(n, h->request, MPI_STATUSES_IGNORE));
  PetscFunctionReturn(0);
}

static PetscBool Wanted(const Offer *o, const Target *t, const double x[])
{
  const GeometryBox edges = {{o->lower[0], o->lower[1]}, {o->upper[0], o->upper[1]}};
  GeometryBox box = GeometryBoxEmpty();
  for (int i = 0; i < 3; i++) GeometryBoxGrow(&box, x + 2 * t->node[i]);
  return (PetscBool)GeometryBoxOverlap(&edges, &box);
}

/* The received targets' nodes lie behind this rank's own. */
static void Renumber(Halo h)
{
  for (int k = 0; k < h->in.n; k++)
    for (int i = 0; i < 3; i++) h->in.target[k].node[i] = h->nnodes + 3 * k + i;
}

PetscErrorCode HaloBuild(Halo h, int nnodes, const double x[], const GeometryBox *edges, int n,
                         const Target target[])
{
  Offer mine = {{edges->lower[0], edges->lower[1]}, {edges->upper[0], edges->upper[1]}}, *offer;
  int *count;
  PetscFunctionBeginUser;
  h->nnodes = nnodes;
  PetscCall(PetscMalloc2((size_t)h->size, &offer, (size_t)h->size, &count));
  PetscCallMPI(MPI_Allgather(&mine, sizeof mine, MPI_BYTE, offer, sizeof mine, MPI_BYTE, h->comm));
  h->out.n = 0;
  for (int r = 0; r < h->size; r++) {
    h->out.start[r] = h->out.n;
    for (int k = 0; k < n && r != h->rank; k++) {
      if (!Wanted(&offer[r], &target[k], x)) continue;
      PetscCall(Reserve(&h->out, h->out.n + 1));
      h->out.target[h->out.n++] = target[k];
    }
    count[r] = h->out.n - h->out.start[r];
  }
  h->out.start[h->size] = h->out.n;
  PetscCallMPI(MPI_Alltoall(count, 1, MPI_INT, h->in.start + 1, 1, MPI_INT, h->comm));
  h->in.start[0] = 0;
  for (int r = 0; r < h->size; r++) h->in.start[r + 1] += h->in.start[r];
  h->in.n = h->in.start[h->size];
  PetscCall(Reserve(&h->in, h->in.n));
  PetscCall(PetscRealloc(6 * (size_t)h->in.n * sizeof *h->force, &h->force));
  PetscCall(PetscRealloc(6 * (size_t)h->in.n * sizeof *h->velocity, &h->velocity));
  PetscCall(Travel(h, &h->out, h->out.target, &h->in, h->in.target, sizeof(Target), TAG_TARGETS));
  Renumber(h);
  PetscCall(PetscFree2(offer, count));
  PetscFunctionReturn(0);
}

static void Compress(ClientList *s, int size, const char keep[], int index[])
{
  int kept = 0;
  for (int r = 0, k = 0; r < size; r++) {
    const int end = s->start[r + 1];
    s->start[r] = kept;
    for (; k < end; k++) {
      if (index) index[k] = keep[k] ? kept : -1;
      if (keep[k]) s->target[kept++] = s->target[k];
    }
  }
  s->start[size] = s->n = kept;
}

PetscErrorCode HaloKeep(Halo h, const char keep[], int index[])
{
  char *kept;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)h->out.n, &kept));
  PetscCall(Travel(h, &h->in, keep, &h->out, kept, 1, TAG_KEEP));
  Compress(&h->in, h->size, keep, index);
  Compress(&h->out, h->size, kept, NULL);
  Renumber(h);
  PetscCall(PetscFree(kept));
  PetscFunctionReturn(0);
}

int HaloTargets(Halo h, const Target **target)
{
  *target = h->in.target;
  return h->in.n;
}

int HaloTraffic(Halo h)
{
  return h->in.n + h->out.n;
}

static void Pack(Halo h, const double value[])
{
  for (int k = 0; k < h->out.n; k++)
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) h->out.value[6 * k + 2 * i + c] = value[2 * h->out.target[k].node[i] + c];
}

PetscErrorCode HaloForward(Halo h, const double x[], const double v[])
{
  PetscFunctionBeginUser;
  if (h->out.n == 0 && h->in.n == 0) PetscFunctionReturn(0);
  Pack(h, x);
  PetscCall(Travel(h, &h->out, h->out.value, &h->in, h->in.value, 6 * sizeof(double), TAG_POSITIONS));
  if (v) {
    Pack(h, v);
    PetscCall(Travel(h, &h->out, h->out.value, &h->in, h->velocity, 6 * sizeof(double), TAG_VELOCITIES));
  }
  for (int k = 0; k < 6 * h->in.n; k++) h->force[k] = 0.0;
  PetscFunctionReturn(0);
}

const double *HaloVelocities(Halo h)
{
  return h->velocity;
}

const double *HaloPositions(Halo h)
{
  return h->in.value;
}

double *HaloForces(Halo h)
{
  return h->force;
}

PetscErrorCode HaloReverse(Halo h, double force[])
{
  PetscFunctionBeginUser;
  if (h->out.n == 0 && h->in.n == 0) PetscFunctionReturn(0);
  PetscCall(Travel(h, &h->in, h->force, &h->out, h->out.value, 6 * sizeof(double), TAG_FORCES));
  for (int k = 0; k < h->out.n; k++)
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) force[2 * h->out.target[k].node[i] + c] += h->out.value[6 * k + 2 * i + c];
  PetscFunctionReturn(0);
}

PetscErrorCode HaloDestroy(Halo *h)
{
  PetscFunctionBeginUser;
  if (!*h) PetscFunctionReturn(0);
  PetscCall(PetscFree3((*h)->out.start, (*h)->in.start, (*h)->request));
  PetscCall(PetscFree((*h)->out.target));
  PetscCall(PetscFree((*h)->out.value));
  PetscCall(PetscFree((*h)->in.target));
  PetscCall(PetscFree((*h)->in.value));
  PetscCall(PetscFree((*h)->force));
  PetscCall(PetscFree((*h)->velocity));
  PetscCall(PetscFree(*h));
  PetscFunctionReturn(0);
}
