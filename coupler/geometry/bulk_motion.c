#include "coupler/geometry/bulk_motion.h"
#include "common/supermesh/geometry.h"

/* sum += size * (1, mean velocity of the n nodes) */
static void AddSimplex(const SolidState *solid, int n, const int node[], double size, double sum[3])
{
  sum[0] += size;
  for (int i = 0; i < n; i++) {
    for (int c = 0; c < 2; c++) sum[1 + c] += size / n * solid->u[2 * node[i] + c];
  }
}

PetscErrorCode BulkMotionOf(MPI_Comm comm, const SolidState *solid, BulkMotion *motion)
{
  double sum[9] = {0.0};

  PetscFunctionBeginUser;
  for (int t = 0; t < solid->nelements; t++) {
    const int *e = &solid->element[3 * t];
    AddSimplex(solid, 3, e, 0.5 * GeometryTurn(&solid->x[2 * e[0]], &solid->x[2 * e[1]], &solid->x[2 * e[2]]),
               sum);
  }
  for (int f = 0; f < solid->nfacets; f++) {
    const int *e = &solid->facet[2 * f];
    const double *a = &solid->x[2 * e[0]], *b = &solid->x[2 * e[1]];
    AddSimplex(solid, 2, e, hypot(b[0] - a[0], b[1] - a[1]), sum + 3);
  }
  sum[6] = solid->nelements;
  sum[7] = solid->nfacets;
  for (int n = 0; n < solid->nnodes && solid->mobility; n++) sum[8] += solid->mobility[n] == 0.0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 9, MPI_DOUBLE, MPI_SUM, comm));
  const double *mean = sum[6] > 0.0 ? sum : sum + 3;
  for (int c = 0; c < 2; c++) motion->velocity[c] = mean[0] != 0.0 ? mean[1 + c] / mean[0] : 0.0;
  motion->held = sum[8] > 0.0;
  motion->nelements = (long long)sum[6];
  motion->nfacets = (long long)sum[7];
  PetscFunctionReturn(0);
}
