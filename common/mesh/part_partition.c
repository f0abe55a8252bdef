#include "common/mesh/part_partition.h"
#include "common/mesh/kept_signals.h"

/* A mesh of more triangles, if no rank has more than an eighth of them, is partitioned by clusters: of some ten
 * triangles at least, some thirty a part where these are enough. */
#define MAX_SERIAL 100000LL
enum { SPREAD = 8, CLUSTER_TRIANGLES = 10, PART_CLUSTERS = 30, MIN_CLUSTERS = 10000 };

/* --- on one rank ---------------------------------------------------------------------------------------- */

static void Compress(const PartGraph *g, idx_t first[], idx_t list[], idx_t weight[])
{
  first[0] = 0;
  for (int e = 0; e < g->n; e++) {
    first[e + 1] = first[e];
    for (int k = 3 * e; k < 3 * e + 3; k++) {
      const long long o = g->across[k];
      if (o < 0) continue;
      if (weight) weight[first[e + 1]] = PetscMax(g->weight[k], g->weight[o]);
      list[first[e + 1]++] = (idx_t)(o / 3);
    }
  }
}

static PetscErrorCode Metis(idx_t n, idx_t first[], idx_t list[], idx_t size[], idx_t weight[], idx_t nparts,
                            int target[])
{
  idx_t ncon = 1, cut, options[METIS_NOPTIONS], *metis_part;
  KeptSignals signals;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &metis_part));
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  SignalsKeep(&signals);
  const int status = (nparts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway)(
      &n, &ncon, first, list, size, NULL, weight, &nparts, NULL, NULL, options, &cut, metis_part);
  SignalsRestore(&signals);
  for (int e = 0; e < n && status == METIS_OK; e++) target[e] = (int)metis_part[e];
  PetscCall(PetscFree(metis_part));
  PetscCheck(status == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB,
             "METIS could not cut %d elements in %d parts: status %d", (int)n, (int)nparts, status);
  PetscFunctionReturn(0);
}

/* Few elements are dealt out one by one, as METIS may fail on graphs smaller than the number of parts. */
PetscErrorCode PartCut(int n, idx_t first[], idx_t list[], idx_t size[], idx_t weight[], int nparts,
                       int target[])
{
  PetscFunctionBeginUser;
  if (n > 2 * nparts && nparts > 1) {
    PetscCall(Metis(n, first, list, size, weight, nparts, target));
  } else {
    for (int e = 0; e < n; e++) target[e] = e % nparts;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode PartGraphCut(const PartGraph *g, int nparts, int target[])
{
  idx_t *first, *list, *weight;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(g->n + 1, &first, 3 * g->n, &list, g->weight ? 3 * g->n : 0, &weight));
  Compress(g, first, list, g->weight ? weight : NULL);
  const PetscErrorCode failed = PartCut(g->n, first, list, NULL, g->weight ? weight : NULL, nparts, target);
  PetscCall(PetscFree3(first, list, weight));
  PetscFunctionReturn(failed);
}

/* --- on all ranks --------------------------------------------------------------------------------------- */

/* The number of what lies beyond each face of this part. */
static void Across(const MeshSerial *s, const PartFaces *f, long long across[])
{
  const long long base = 3 * f->start[f->rank];
  for (int k = 0; k < 3 * s->ne; k++) {
    const int o = f->local.neighbor[k];
    across[k] = o < 0 ? -1 : base + 3 * o + f->local.face[k];
  }
  for (int k = 0; k < f->nopen; k++) across[f->open[k]] = f->across[k];
}

/* The graph of all triangles on rank 0, and its parts back. */
static PetscErrorCode PartitionGathered(MPI_Comm comm, const MeshPart *part, const PartFaces *f, int nparts,
                                        const int weight[], int target[])
{
  const int ne = part->serial.ne, n = f->rank ? 0 : (int)f->start[f->size];
  int *count, *start, *all, *every;
  long long *across, *gathered;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(f->size, &count, f->size, &start));
  for (int r = 0; r < f->size; r++)
    start[r] = (int)(3 * f->start[r]), count[r] = (int)(3 * f->start[r + 1]) - start[r];
  PetscCall(PetscMalloc4(3 * ne, &across, 3 * n, &gathered, weight ? 3 * n : 0, &every, n, &all));
  Across(&part->serial, f, across);
  PetscCallMPI(MPI_Gatherv(across, 3 * ne, MPI_LONG_LONG, gathered, count, start, MPI_LONG_LONG, 0, comm));
  if (weight) PetscCallMPI(MPI_Gatherv(weight, 3 * ne, MPI_INT, every, count, start, MPI_INT, 0, comm));
  const PartGraph graph = {.n = n, .across = gathered, .weight = weight ? every : NULL};
  const PetscErrorCode failed = CollectiveError(comm, PartGraphCut(&graph, nparts, all));
  for (int r = 0; r < f->size; r++) count[r] /= 3, start[r] /= 3;
  if (!failed) PetscCallMPI(MPI_Scatterv(all, count, start, MPI_INT, target, ne, MPI_INT, 0, comm));
  PetscCall(PetscFree4(across, gathered, every, all));
  PetscCall(PetscFree2(count, start));
  PetscFunctionReturn(failed);
}

PetscErrorCode PartPartition(MPI_Comm comm, const MeshPart *part, int nparts, const int weight[],
                             PetscBool clusters, int target[])
{
  PartFaces f;
  PetscFunctionBeginUser;
  PetscErrorCode failed = PartFacesCreate(comm, part, &f);
  if (failed) PetscFunctionReturn(failed);
  const long long total = f.start[f.size];
  const long long wanted =
      PetscMin(total / CLUSTER_TRIANGLES, PetscMax(MIN_CLUSTERS, PART_CLUSTERS * (long long)nparts));
  if (clusters)
    failed = PartPartitionClusters(comm, &f, part->serial.ne, nparts, weight, (int)wanted, target);
  else
    failed = PartitionGathered(comm, part, &f, nparts, weight, target);
  PetscCall(PartFacesDestroy(&f));
  PetscFunctionReturn(failed);
}

PetscErrorCode MeshPartPartition(MPI_Comm comm, const MeshPart *part, int nparts, const int weight[],
                                 int target[])
{
  long long total = part->serial.ne, largest = total;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_LONG_LONG, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_LONG_LONG, MPI_MAX, comm));
  const PetscBool clusters = (PetscBool)(total > MAX_SERIAL && largest * SPREAD <= total);
  PetscFunctionReturn(PartPartition(comm, part, nparts, weight, clusters, target));
}
