#include "common/space/p2_space.h"
#include "common/exchange/copies.h"

/* Vertices and edges of the owned elements, as nodes: a vertex by its local number, then the edges. */
typedef struct {
  const Mesh *mesh;
  int n;
  char *foreign; /* [n] nonzero if a lower rank owns the node */
  PetscInt *gid; /* [n] */
} Nodes;

static int NodeOf(const Mesh *m, int e, int i)
{
  return i < 3 ? m->vertex[3 * e + i] : m->nv + m->edge[3 * e + i - 3];
}

/* Adds a node to the list of those that other ranks may have, once. */
static void List(int node, CopiesKey key, char listed[], int *n, int list[], CopiesKey keys[])
{
  if (listed[node]) return;
  listed[node] = 1;
  list[*n] = node;
  keys[(*n)++] = key;
}

/* The nodes of faces without an owned element behind them: every rank that has a node of another one lists it. */
static void ListOpen(const Nodes *s, char listed[], int *n, int list[], CopiesKey key[])
{
  const Mesh *m = s->mesh;
  *n = 0;
  for (int k = 0; k < 3 * m->ne; k++) {
    if (m->neighbor[k] >= 0 && m->neighbor[k] < m->ne) continue;
    const int e = k / 3, a = m->vertex[3 * e + (k + 1) % 3], b = m->vertex[3 * e + (k + 2) % 3];
    const PetscInt p = m->vgid[a], q = m->vgid[b];
    List(a, (CopiesKey){p, p}, listed, n, list, key);
    List(b, (CopiesKey){q, q}, listed, n, list, key);
    List(m->nv + m->edge[k], (CopiesKey){PetscMin(p, q), PetscMax(p, q)}, listed, n, list, key);
  }
}

/* Global numbers of own nodes, as the elements meet them. */
static PetscErrorCode NumberOwned(Nodes *s, P2Space *space)
{
  const Mesh *m = s->mesh;
  PetscMPIInt rank;
  PetscInt next = 0, start = 0;
  PetscFunctionBeginUser;
  for (int k = 0; k < 6 * m->ne; k++) {
    const int node = NodeOf(m, k / 6, k % 6);
    if (!s->foreign[node] && s->gid[node] < 0) s->gid[node] = next++;
  }
  space->nowned = (int)next;
  PetscCallMPI(MPI_Comm_rank(m->comm, &rank));
  PetscCallMPI(MPI_Exscan(&next, &start, 1, MPIU_INT, MPI_SUM, m->comm));
  space->start = rank ? start : 0;
  PetscCallMPI(MPI_Allreduce(&next, &space->nglobal, 1, MPIU_INT, MPI_SUM, m->comm));
  for (int k = 0; k < s->n; k++) {
    if (s->gid[k] >= 0) s->gid[k] += space->start;
  }
  PetscFunctionReturn(0);
}

static void FoldHighest(void *into, const void *next)
{
  PetscInt *a = into;
  const PetscInt *b = next;
  *a = PetscMax(*a, *b);
}

/* Owner and number of each node: lower ranks own what they share, and tell its number. */
static PetscErrorCode Number(Nodes *s, P2Space *space)
{
  const int max = s->n;
  int n, *list;
  char *listed;
  CopiesKey *key;
  PetscInt *number;
  Copies copies;
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(s->mesh->comm, &rank));
  PetscCall(PetscMalloc3(max, &list, max, &key, max, &number));
  PetscCall(PetscCalloc1(max, &listed));
  ListOpen(s, listed, &n, list, key);
  PetscCall(PetscFree(listed));
  PetscCall(CopiesCreate(s->mesh->comm, n, key, &copies));
  for (int k = 0; k < s->n; k++) {
    s->foreign[k] = 0;
    s->gid[k] = -1;
  }
  for (int k = 0; k < n; k++) s->foreign[list[k]] = CopiesOwner(copies, k) < rank;
  PetscCall(NumberOwned(s, space));
  for (int k = 0; k < n; k++) number[k] = s->gid[list[k]];
  PetscCall(CopiesReduce(copies, sizeof *number, FoldHighest, number));
  for (int k = 0; k < n; k++) s->gid[list[k]] = number[k];
  PetscCall(CopiesDestroy(&copies));
  PetscCall(PetscFree3(list, key, number));
  PetscFunctionReturn(0);
}

/* Local numbers: owned nodes in the order of their global numbers, the others as the elements meet them. */
static PetscErrorCode Localize(const Nodes *s, P2Space *space)
{
  const Mesh *m = s->mesh;
  int *local;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->n, &local));
  for (int k = 0; k < s->n; k++) local[k] = -1;
  space->n = space->nowned;
  for (int k = 0; k < 6 * m->ne; k++) {
    const int node = NodeOf(m, k / 6, k % 6);
    int *l = &local[node];
    if (*l < 0) {
      *l = s->foreign[node] ? space->n++ : (int)(s->gid[node] - space->start);
      space->gid[*l] = s->gid[node];
    }
    space->node[k] = *l;
  }
  PetscCall(PetscFree(local));
  PetscFunctionReturn(0);
}

PetscErrorCode P2SpaceCreate(const Mesh *m, P2Space **space)
{
  Nodes nodes = {.mesh = m, .n = m->nv + m->nedge};
  PetscFunctionBeginUser;
  PetscCall(PetscNew(space));
  PetscCall(PetscMalloc1(nodes.n, &(*space)->gid)); /* at most */
  PetscCall(PetscMalloc1(6 * m->ne, &(*space)->node));
  PetscCall(PetscMalloc2(nodes.n, &nodes.foreign, nodes.n, &nodes.gid));
  PetscCall(Number(&nodes, *space));
  PetscCall(Localize(&nodes, *space));
  PetscCall(PetscFree2(nodes.foreign, nodes.gid));
  PetscFunctionReturn(0);
}

PetscErrorCode P2SpaceDestroy(P2Space **space)
{
  P2Space *s = *space;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  PetscCall(PetscFree(s->gid));
  PetscCall(PetscFree(s->node));
  PetscCall(PetscFree(*space));
  PetscFunctionReturn(0);
}
