#include "fluid/adapt/adapt_impl.h"

/* Corners by the smaller vertex of the face that they look at, as chains: head[v], next[c], ... */
typedef struct {
  int *head, *next;
} FaceTable;

static int Lower(const MeshSerial *m, int c)
{
  return PetscMin(m->vertex[Next(c)], m->vertex[Prev(c)]);
}
static int Upper(const MeshSerial *m, int c)
{
  return PetscMax(m->vertex[Next(c)], m->vertex[Prev(c)]);
}

/* The first corner in the chain that looks at the edge between two vertices, NONE if there is no such edge.
 */
static int Find(const MeshSerial *m, const FaceTable *table, int lower, int upper)
{
  int c = table->head[lower];
  while (c != NONE && Upper(m, c) != upper) c = table->next[c];
  return c;
}

static PetscErrorCode Join(const MeshSerial *m, int c, int d, int across[])
{
  const double *p = &m->x[2 * m->vertex[Next(c)]];
  PetscFunctionBeginUser;
  PetscCheck(across[d] == NONE && m->vertex[Next(c)] == m->vertex[Prev(d)], PETSC_COMM_SELF,
             PETSC_ERR_ARG_WRONG, "triangles %d and %d near (%g, %g) overlap on an edge", d / 3, c / 3, p[0],
             p[1]);
  across[c] = d;
  across[d] = c;
  PetscFunctionReturn(0);
}

static PetscErrorCode JoinAll(const MeshSerial *m, const FaceTable *table, int across[])
{
  PetscFunctionBeginUser;
  for (int v = 0; v < m->nv; v++) table->head[v] = NONE;
  for (int c = 0; c < 3 * m->ne; c++) {
    const int lower = Lower(m, c), d = Find(m, table, lower, Upper(m, c));
    across[c] = NONE;
    if (d == NONE) {
      table->next[c] = table->head[lower];
      table->head[lower] = c;
    } else {
      PetscCall(Join(m, c, d, across));
    }
  }
  PetscFunctionReturn(0);
}

static void MarkFacets(const MeshSerial *m, const FaceTable *table, const int across[], int mark[])
{
  for (int c = 0; c < 3 * m->ne; c++) mark[c] = NONE;
  for (int k = 0; k < m->nb; k++) {
    const int p = m->facet[2 * k], q = m->facet[2 * k + 1];
    const int c = Find(m, table, PetscMin(p, q), PetscMax(p, q));
    if (c == NONE) continue; /* off the mesh */
    mark[c] = m->facet_tag[k];
    if (across[c] != NONE) mark[across[c]] = mark[c];
  }
}

PetscErrorCode AdaptFaces(const MeshSerial *mesh, int across[], int mark[])
{
  FaceTable table;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(mesh->nv, &table.head, 3 * mesh->ne, &table.next));
  const PetscErrorCode failed = JoinAll(mesh, &table, across);
  if (!failed) MarkFacets(mesh, &table, across, mark);
  PetscCall(PetscFree2(table.head, table.next));
  PetscFunctionReturn(failed);
}
