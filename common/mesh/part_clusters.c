#include "common/exchange/scatter.h"
#include "common/mesh/part_partition.h"
#include <stdlib.h>

/* Partition of a large mesh that lies on many ranks: each rank cuts its own part into clusters, which are
 * partitioned on rank 0 as one graph, a vertex a cluster.
 *
 *     rank 0  | a a b b      clusters a, b, c, d with 4, 4, 3, 5 triangles     a --- b
 *             | a a b b      edges: the faces between two of them,             |     |
 *     rank 1  | c d d d      summed with their weights                         c --- d
 *             | c c d d
 */
typedef struct {
  int n, *of;             /* clusters of this rank; [ne] whose an element is */
  long long first, total; /* its first number of all, and how many there are */
} Clusters;

typedef struct {
  long long from, to;
  int weight;
} Edge;

/* What an element's owner says of one of its faces. */
typedef struct {
  long long cluster;
  int weight;
} Beyond;

typedef struct {
  const Clusters *clusters;
  const int *weight;
  long long base; /* 3 times the number of this rank's first element */
} Answerer;

static PetscErrorCode Answer(void *context, long long key, void *record)
{
  const Answerer *a = context;
  const long long face = key - a->base;
  Beyond *beyond = record;
  PetscFunctionBeginUser;
  beyond->cluster = a->clusters->first + a->clusters->of[face / 3];
  beyond->weight = a->weight ? a->weight[face] : 1;
  PetscFunctionReturn(0);
}

static PetscErrorCode Cluster(MPI_Comm comm, const MeshFaces *local, int ne, const int weight[], double per,
                              Clusters *c)
{
  long long n;
  long long *across;
  PetscFunctionBeginUser;
  c->n = (int)PetscMax(ne > 0 ? 1 : 0, ne / per);
  PetscCall(PetscMalloc1(ne, &c->of));
  PetscCall(PetscMalloc1(3 * ne, &across));
  for (int k = 0; k < 3 * ne; k++)
    across[k] = local->neighbor[k] < 0 ? -1 : 3 * local->neighbor[k] + local->face[k];
  const PartGraph graph = {.n = ne, .across = across, .weight = weight};
  const PetscErrorCode failed = CollectiveError(comm, c->n ? PartGraphCut(&graph, c->n, c->of) : 0);
  PetscCall(PetscFree(across));
  n = c->n;
  PetscCallMPI(MPI_Allreduce(&n, &c->total, 1, MPI_LONG_LONG, MPI_SUM, comm));
  c->first = 0;
  PetscCallMPI(MPI_Exscan(&n, &c->first, 1, MPI_LONG_LONG, MPI_SUM, comm));
  PetscFunctionReturn(failed);
}

static int CompareEdges(const void *a, const void *b)
{
  const Edge *x = a, *y = b;
  if (x->from != y->from) return x->from < y->from ? -1 : 1;
  return (x->to > y->to) - (x->to < y->to);
}

/* Sorted, those between the same two clusters as one; how many are left. */
static int MergeEdges(int n, Edge edge[])
{
  int m = 0;
  qsort(edge, (size_t)n, sizeof *edge, CompareEdges);
  for (int k = 0; k < n; k++) {
    if (m && !CompareEdges(&edge[m - 1], &edge[k]))
      edge[m - 1].weight += edge[k].weight;
    else
      edge[m++] = edge[k];
  }
  return m;
}

/* The edges from this rank's clusters: *edge[*nedges], PetscFree'd by the caller. */
static PetscErrorCode FindEdges(MPI_Comm comm, const PartFaces *f, int ne, const int weight[],
                                const Clusters *c, int *nedges, Edge **edge)
{
  Answerer answerer = {c, weight, 3 * f->start[f->rank]};
  Beyond *beyond;
  int nremote = 0, *rank, n = 0;
  long long *key;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(f->nopen, &beyond, f->nopen, &rank, f->nopen, &key));
  for (int k = 0; k < f->nopen; k++)
    if (f->across[k] >= 0) rank[nremote] = f->across_rank[k], key[nremote++] = f->across[k];
  PetscCall(ScatterRequest(comm, nremote, rank, key, sizeof *beyond, Answer, &answerer, beyond));
  PetscCall(PetscMalloc1(3 * ne, edge));
  for (int k = 0; k < 3 * ne; k++) {
    const int o = f->local.neighbor[k];
    if (o < 0 || c->of[o] == c->of[k / 3]) continue;
    const int other = 3 * o + f->local.face[k];
    (*edge)[n++] =
        (Edge){c->first + c->of[k / 3], c->first + c->of[o], weight ? PetscMax(weight[k], weight[other]) : 1};
  }
  for (int k = 0, j = 0; k < f->nopen; k++) {
    if (f->across[k] < 0) continue;
    const int mine = weight ? weight[f->open[k]] : 1;
    (*edge)[n++] =
        (Edge){c->first + c->of[f->open[k] / 3], beyond[j].cluster, PetscMax(mine, beyond[j].weight)};
    j++;
  }
  *nedges = MergeEdges(n, *edge);
  PetscCall(PetscFree3(beyond, rank, key));
  PetscFunctionReturn(0);
}

/* The rank of each of all clusters, on rank 0: edge[nedges] sorted, elements[total] in each. */
static PetscErrorCode CutClusters(int total, const int elements[], int nedges, const Edge edge[], int nparts,
                                  int target[])
{
  idx_t *first, *list, *weight, *size;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc4(total + 1, &first, nedges, &list, nedges, &weight, total, &size));
  for (int k = 0; k < nedges; k++) {
    first[edge[k].from + 1]++;
    list[k] = (idx_t)edge[k].to;
    weight[k] = edge[k].weight;
  }
  for (int v = 0; v < total; v++) first[v + 1] += first[v], size[v] = elements[v];
  const PetscErrorCode failed = PartCut(total, first, list, size, weight, nparts, target);
  PetscCall(PetscFree4(first, list, weight, size));
  PetscFunctionReturn(failed);
}

/* The rank of this rank's clusters, to[n]. */
static PetscErrorCode Deal(MPI_Comm comm, const Clusters *c, int ne, int nedges, const Edge edge[],
                           int nparts, int to[])
{
  int rank, all_edges = 0, all_clusters = 0, *elements, *zero, *every = NULL, *target = NULL;
  void *edges;
  Scatter clusters;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(PetscCalloc1(c->n, &elements));
  for (int e = 0; e < ne; e++) elements[c->of[e]]++;
  PetscCall(PetscCalloc1(PetscMax(nedges, c->n), &zero)); /* all go to rank 0, in the order of the ranks */
  PetscCall(ScatterRecords(comm, nedges, zero, sizeof *edge, edge, &all_edges, &edges));
  PetscCall(ScatterCreate(comm, c->n, zero, NULL, &clusters));
  all_clusters = ScatterArriving(clusters);
  PetscCall(PetscMalloc2(all_clusters, &every, all_clusters, &target));
  PetscCall(ScatterForward(clusters, sizeof *every, elements, every));
  const PetscErrorCode failed =
      CollectiveError(comm, rank ? 0 : CutClusters(all_clusters, every, all_edges, edges, nparts, target));
  if (!failed) PetscCall(ScatterReverse(clusters, sizeof *target, target, to));
  PetscCall(ScatterDestroy(&clusters));
  PetscCall(PetscFree2(every, target));
  PetscCall(PetscFree(edges));
  PetscCall(PetscFree(elements));
  PetscCall(PetscFree(zero));
  PetscFunctionReturn(failed);
}

PetscErrorCode PartPartitionClusters(MPI_Comm comm, const PartFaces *f, int ne, int nparts,
                                     const int weight[], int wanted, int target[])
{
  Clusters c;
  Edge *edge;
  int nedges = 0, *to;
  PetscFunctionBeginUser;
  PetscErrorCode failed = Cluster(comm, &f->local, ne, weight, (double)f->start[f->size] / wanted, &c);
  if (failed) PetscFunctionReturn(failed);
  PetscCall(FindEdges(comm, f, ne, weight, &c, &nedges, &edge));
  PetscCall(PetscMalloc1(c.n, &to));
  failed = Deal(comm, &c, ne, nedges, edge, nparts, to);
  for (int e = 0; e < ne && !failed; e++) target[e] = to[c.of[e]];
  PetscCall(PetscFree(to));
  PetscCall(PetscFree(edge));
  PetscCall(PetscFree(c.of));
  PetscFunctionReturn(failed);
}
