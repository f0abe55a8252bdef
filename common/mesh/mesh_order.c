#include "mesh_impl.h"

/* A part's graph: elements joined across faces. */
typedef struct {
  const int *neighbor; /* [ne][3] */
  const int *part;     /* [ne] */
  int *mark;           /* [ne] number of the last search that reached the element */
  int search;
} Graph;

static PetscBool Reaches(const Graph *g, int e, int i)
{
  const int o = g->neighbor[3 * e + i];
  return o >= 0 && g->part[o] == g->part[e] && g->mark[o] != g->search ? PETSC_TRUE : PETSC_FALSE;
}

static int Degree(const Graph *g, int e)
{
  int degree = 0;
  for (int i = 0; i < 3; i++) {
    const int o = g->neighbor[3 * e + i];
    degree += o >= 0 && g->part[o] == g->part[e];
  }
  return degree;
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
        if (!Reaches(g, queue[k], i) || Degree(g, o) != degree) continue;
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

/* A connected piece that holds `e`: two searches from the last element of the one before find a far end to
 * start at. */
static int OrderPiece(Graph *g, int e, int queue[])
{
  int n = 0;
  for (int pass = 0; pass < 3; pass++) {
    n = Breadth(g, e, queue);
    e = queue[n - 1];
  }
  Reverse(n, queue);
  return n;
}

PetscErrorCode MeshOrder(int ne, const int neighbor[], int nparts, const int part[], int start[], int order[])
{
  Graph g = {.neighbor = neighbor, .part = part};
  int *next;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(ne, &g.mark));
  PetscCall(PetscMalloc1(nparts, &next));
  for (int r = 0; r <= nparts; r++) start[r] = 0;
  for (int e = 0; e < ne; e++) start[part[e] + 1]++;
  for (int r = 0; r < nparts; r++) {
    start[r + 1] += start[r];
    next[r] = start[r];
  }
  for (int e = 0; e < ne; e++) {
    if (!g.mark[e]) next[part[e]] += OrderPiece(&g, e, &order[next[part[e]]]);
  }
  PetscCall(PetscFree(next));
  PetscCall(PetscFree(g.mark));
  PetscFunctionReturn(0);
}
