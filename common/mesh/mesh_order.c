#include "common/mesh/mesh_impl.h"

/* Elements joined across faces. */
typedef struct {
  const int *neighbor; /* [ne][3] */
  int *mark;           /* [ne] number of the last search that reached the element */
  int search;
} Graph;

static int Degree(const Graph *g, int e)
{
  const int *o = &g->neighbor[3 * e];
  return (o[0] >= 0) + (o[1] >= 0) + (o[2] >= 0);
}

/* Breadth first from `root`, few-neighboured elements first (Cuthill-McKee); returns how many were reached.
 */
static int Breadth(Graph *g, int root, int queue[])
{
  int n = 1;
  g->search++;
  g->mark[root] = g->search;
  queue[0] = root;
  for (int k = 0; k < n; k++) {
    for (int degree = 1; degree <= 3; degree++) {
      for (int i = 0; i < 3; i++) {
        const int o = g->neighbor[3 * queue[k] + i];
        if (o < 0 || g->mark[o] == g->search || Degree(g, o) != degree) continue;
        g->mark[o] = g->search;
        queue[n++] = o;
      }
    }
  }
  return n;
}

static void Reverse(int n, int list[])
{
  for (int i = 0; i < n / 2; i++) {
    const int swap = list[i];
    list[i] = list[n - 1 - i];
    list[n - 1 - i] = swap;
  }
}

/* All that is connected to `e`: two searches from the last element of the one before find a far end to start
 * at. */
static int OrderConnected(Graph *g, int e, int queue[])
{
  int n = 0;
  for (int pass = 0; pass < 3; pass++) {
    n = Breadth(g, e, queue);
    e = queue[n - 1];
  }
  Reverse(n, queue);
  return n;
}

PetscErrorCode MeshOrder(int ne, const int neighbor[], int order[])
{
  Graph g = {.neighbor = neighbor};
  int next = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(ne, &g.mark));
  for (int e = 0; e < ne; e++) {
    if (!g.mark[e]) next += OrderConnected(&g, e, &order[next]);
  }
  PetscCall(PetscFree(g.mark));
  PetscFunctionReturn(0);
}
