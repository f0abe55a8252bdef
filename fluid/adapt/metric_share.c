#include "fluid/adapt/metric_share.h"
#include "fluid/adapt/metric_tensor.h"

typedef struct {
  PetscInt id;
  double metric[3];
} SharedTensor;

PetscErrorCode SharedVerticesCreate(const Mesh *m, SharedVertices *s)
{
  PetscInt n = 0;
  int swap;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(6 * m->ng + 6, &s->id, 6 * m->ng + 6, &s->vertex));
  for (int k = 0; k < 3 * m->ne; k++) {
    if (m->neighbor[k] < m->ne) continue;
    for (int i = 1; i < 3; i++) {
      const int e = k / 3, corner = (k + i) % 3;
      s->id[n] = m->vgid[m->vertex[3 * e + corner]];
      s->vertex[n++] = m->vertex[3 * e + corner];
    }
  }
  PetscCall(PetscSortIntWithDataArray(n, s->id, s->vertex, sizeof *s->vertex, &swap));
  s->count = 0;
  for (int k = 0; k < n; k++) {
    if (s->count && s->id[k] == s->id[s->count - 1]) continue;
    s->id[s->count] = s->id[k];
    s->vertex[s->count++] = s->vertex[k];
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SharedVerticesDestroy(SharedVertices *s)
{
  return PetscFree2(s->id, s->vertex);
}

/* metric becomes the intersection of what the ranks have, in the order of ranks: the same bits everywhere.
 * *changed: some rank's was coarser than that by more than 1e-3. */
static PetscErrorCode Share(MPI_Comm comm, const SharedVertices *s, double metric[], PetscBool *changed)
{
  SharedTensor *mine, *all;
  char *reply;
  PetscMPIInt size, bytes, *count, *first, any = 0;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc4(s->count, &mine, s->count, &reply, size, &count, size + 1, &first));
  for (int k = 0; k < s->count; k++) {
    mine[k].id = s->id[k];
    PetscCall(PetscArraycpy(mine[k].metric, metric + 3 * s->vertex[k], 3));
    reply[k] = 0;
  }
  bytes = s->count * (int)sizeof *mine;
  PetscCallMPI(MPI_Allgather(&bytes, 1, MPI_INT, count, 1, MPI_INT, comm));
  first[0] = 0;
  for (int r = 0; r < size; r++) first[r + 1] = first[r] + count[r];
  PetscCall(PetscMalloc1(first[size] / (int)sizeof *all, &all));
  PetscCallMPI(MPI_Allgatherv(mine, bytes, MPI_BYTE, all, count, first, MPI_BYTE, comm));
  for (int k = 0; k < first[size] / (int)sizeof *all; k++) {
    PetscInt at;
    PetscCall(PetscFindInt(all[k].id, s->count, s->id, &at));
    if (at < 0) continue;
    double *m = metric + 3 * s->vertex[at];
    if (reply[at])
      MetricIntersectTensor(all[k].metric, 0.0, m);
    else
      PetscCall(PetscArraycpy(m, all[k].metric, 3));
    reply[at] = 1;
  }
  for (int k = 0; k < s->count; k++)
    any |= MetricIntersectTensor(metric + 3 * s->vertex[k], 1e-3, mine[k].metric);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, comm));
  *changed = (PetscBool)any;
  PetscCall(PetscFree(all));
  PetscCall(PetscFree4(mine, reply, count, first));
  PetscFunctionReturn(0);
}

PetscErrorCode MetricGradeParallel(MPI_Comm comm, const MeshSerial *part, const SharedVertices *shared,
                                   double growth, double metric[])
{
  PetscBool changed = PETSC_TRUE;
  PetscFunctionBeginUser;
  while (changed) {
    PetscCall(MetricGrade(part, growth, metric, NULL));
    PetscCall(Share(comm, shared, metric, &changed));
  }
  PetscFunctionReturn(0);
}
