#include "common/mesh/mesh_impl.h"
#include <metis.h>

/* The graph of all triangles, on rank 0. */
typedef struct {
  int n;
  int *count, *start; /* [size], [size + 1] numbers a rank sends: 3 an element */
  long long *across;  /* [n][3] 3 element + face beyond a face, -1 on the boundary */
  int *weight;        /* [n][3] or NULL */
} Graph;

/* The number of what lies beyond each face of this piece. */
static void Across(const MeshSerial *s, const PartFaces *f, long long across[])
{
  const long long base = 3 * f->start[f->rank];
  for (int k = 0; k < 3 * s->ne; k++) {
    const int o = f->local.neighbor[k];
    across[k] = o < 0 ? -1 : base + 3 * o + f->local.face[k];
  }
  for (int k = 0; k < f->nopen; k++) across[f->open[k]] = f->across[k];
}

static PetscErrorCode GraphGather(MPI_Comm comm, const MeshPart *piece, const int weight[], Graph *g)
{
  const int n = 3 * piece->serial.ne;
  long long *across;
  PartFaces f;
  PetscFunctionBeginUser;
  const PetscErrorCode failed = PartFacesCreate(comm, piece, &f);
  if (failed) PetscFunctionReturn(failed);
  g->n = f.rank ? 0 : (int)f.start[f.size];
  PetscCall(PetscMalloc2(f.size, &g->count, f.size + 1, &g->start));
  for (int r = 0; r <= f.size; r++) g->start[r] = (int)(3 * f.start[r]);
  for (int r = 0; r < f.size; r++) g->count[r] = g->start[r + 1] - g->start[r];
  PetscCall(PetscMalloc1(n, &across));
  Across(&piece->serial, &f, across);
  PetscCall(PetscMalloc1(3 * g->n, &g->across));
  PetscCallMPI(MPI_Gatherv(across, n, MPI_LONG_LONG, g->across, g->count, g->start, MPI_LONG_LONG, 0, comm));
  PetscCall(PetscFree(across));
  PetscCall(PartFacesDestroy(&f));
  g->weight = NULL;
  if (!weight) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(3 * g->n, &g->weight));
  PetscCallMPI(MPI_Gatherv(weight, n, MPI_INT, g->weight, g->count, g->start, MPI_INT, 0, comm));
  PetscFunctionReturn(0);
}

static PetscErrorCode GraphDestroy(Graph *g)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(g->count, g->start));
  PetscCall(PetscFree(g->across));
  PetscCall(PetscFree(g->weight));
  PetscFunctionReturn(0);
}

/* The graph as METIS wants it: the neighbours of element e are list[first[e]] to list[first[e + 1] - 1]. */
static void Compress(const Graph *g, idx_t first[], idx_t list[], idx_t weight[])
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

static PetscErrorCode Metis(const Graph *g, idx_t nparts, int part[])
{
  idx_t n = g->n, ncon = 1, cut, options[METIS_NOPTIONS], *first, *list, *weight, *metis_part;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(n + 1, &first, 3 * n, &list, g->weight ? 3 * n : 0, &weight, n, &metis_part));
  Compress(g, first, list, g->weight ? weight : NULL);
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  const int status = (nparts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway)(
      &n, &ncon, first, list, NULL, NULL, g->weight ? weight : NULL, &nparts, NULL, NULL, options, &cut,
      metis_part);
  for (int e = 0; e < g->n && status == METIS_OK; e++) part[e] = (int)metis_part[e];
  PetscCall(PetscFree4(first, list, weight, metis_part));
  PetscCheck(status == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB,
             "METIS could not cut %d elements in %d parts: status %d", g->n, (int)nparts, status);
  PetscFunctionReturn(0);
}

/* Few elements are dealt out one by one, as METIS may fail on graphs smaller than the number of parts. */
static PetscErrorCode Cut(const Graph *g, int nparts, int part[])
{
  PetscFunctionBeginUser;
  if (g->n > 2 * nparts && nparts > 1) {
    PetscCall(Metis(g, nparts, part));
  } else {
    for (int e = 0; e < g->n; e++) part[e] = e % nparts;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshPartPartition(MPI_Comm comm, const MeshPart *piece, int nparts, const int weight[],
                                 int part[])
{
  const int ne = piece->serial.ne;
  int size, *all;
  Graph g;
  PetscFunctionBeginUser;
  PetscErrorCode failed = GraphGather(comm, piece, weight, &g);
  if (failed) PetscFunctionReturn(failed);
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc1(g.n, &all));
  failed = CollectiveError(comm, Cut(&g, nparts, all));
  for (int r = 0; r < size; r++) g.count[r] /= 3, g.start[r] /= 3;
  if (!failed) PetscCallMPI(MPI_Scatterv(all, g.count, g.start, MPI_INT, part, ne, MPI_INT, 0, comm));
  PetscCall(PetscFree(all));
  PetscCall(GraphDestroy(&g));
  PetscFunctionReturn(failed);
}
