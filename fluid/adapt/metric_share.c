#include "fluid/adapt/metric_share.h"
#include "fluid/adapt/metric_tensor.h"

PetscErrorCode SharedVerticesCreate(const Mesh *m, SharedVertices *s)
{
  long long *number;
  char *listed;
  PetscFunctionBeginUser;
  s->n = 0;
  PetscCall(PetscMalloc1(m->nv, &s->vertex));
  PetscCall(PetscMalloc1(m->nv, &number));
  PetscCall(PetscCalloc1(m->nv, &listed));
  for (int k = 0; k < 3 * m->ne; k++) {
    if (m->neighbor[k] < m->ne) continue;
    for (int i = 1; i < 3; i++) {
      const int v = m->vertex[k - k % 3 + (k + i) % 3];
      if (listed[v]) continue;
      listed[v] = 1;
      number[s->n] = m->vgid[v];
      s->vertex[s->n++] = v;
    }
  }
  PetscCall(CopiesCreateByNumber(m->comm, s->n, number, &s->copies));
  PetscCall(PetscFree(number));
  PetscCall(PetscFree(listed));
  PetscFunctionReturn(0);
}

PetscErrorCode SharedVerticesDestroy(SharedVertices *s)
{
  PetscFunctionBeginUser;
  PetscCall(CopiesDestroy(&s->copies));
  PetscCall(PetscFree(s->vertex));
  PetscFunctionReturn(0);
}

static void FoldTensor(void *into, const void *next)
{
  MetricIntersectTensor(next, 0.0, into);
}

/* metric becomes the intersection of what the ranks have, in the order of ranks: the same bits everywhere.
 * *changed: some rank's was coarser than that by more than 1e-3. */
static PetscErrorCode Share(MPI_Comm comm, const SharedVertices *s, double metric[], PetscBool *changed)
{
  double(*shared)[3];
  int any = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->n, &shared));
  for (int k = 0; k < s->n; k++) PetscCall(PetscArraycpy(shared[k], metric + 3 * s->vertex[k], 3));
  PetscCall(CopiesReduce(s->copies, sizeof *shared, FoldTensor, shared));
  for (int k = 0; k < s->n; k++) {
    double *mine = metric + 3 * s->vertex[k], own[3] = {mine[0], mine[1], mine[2]};
    any |= MetricIntersectTensor(shared[k], 1e-3, own);
    PetscCall(PetscArraycpy(mine, shared[k], 3));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, comm));
  *changed = (PetscBool)any;
  PetscCall(PetscFree(shared));
  PetscFunctionReturn(0);
}

PetscErrorCode MetricGradeParallel(MPI_Comm comm, const MeshSerial *part, const SharedVertices *shared,
                                   double growth, double metric[])
{
  PetscBool changed = PETSC_TRUE;
  PetscFunctionBeginUser;
  while (changed) {
    PetscCall(MetricGrade(part, growth, metric));
    PetscCall(Share(comm, shared, metric, &changed));
  }
  PetscFunctionReturn(0);
}
