#include "fluid/adapt/adapt_impl.h"
#include <string.h>

/* Facets are the faces on named lines: all of the boundary's, and one side of those inside. */
static bool IsFacet(const Adapt *a, int c)
{
  return a->mark[c] != NONE && a->mark[c] < a->background.mesh->ntags &&
         (a->across[c] == NONE || c < a->across[c]);
}

static PetscErrorCode CopyNames(const MeshSerial *from, MeshSerial *to)
{
  PetscFunctionBeginUser;
  to->ntags = from->ntags;
  to->nregions = from->nregions;
  PetscCall(PetscMalloc1(to->ntags, &to->tag_name));
  if (to->ntags) memcpy(to->tag_name, from->tag_name, (size_t)to->ntags * sizeof *to->tag_name);
  if (!from->region_name) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(to->nregions, &to->region_name));
  memcpy(to->region_name, from->region_name, (size_t)to->nregions * sizeof *to->region_name);
  PetscFunctionReturn(0);
}

/* Where things go: order[n] is the slot of triangle n, vertex[n] that of vertex n, number[v] the vertex of
 * slot v. */
typedef struct {
  int ne, nv;
  int *order, *vertex, *number;
} Numbering;

/* Triangle e and its vertices come next, unless they have come before. */
static void Append(const Adapt *a, int e, char seen[], Numbering *n)
{
  if (seen[e]) return;
  seen[e] = 1;
  n->order[n->ne++] = e;
  for (int c = 3 * e; c < 3 * e + 3; c++) {
    const int v = a->vertex[c];
    if (n->number[v] != NONE) continue;
    n->number[v] = n->nv;
    n->vertex[n->nv++] = v;
  }
}

/* Neighbours after neighbours, which keeps the caches of whoever walks over the mesh warm. */
static PetscErrorCode Order(const Adapt *a, Numbering *n)
{
  char *seen;
  PetscFunctionBeginUser;
  n->ne = n->nv = 0;
  PetscCall(PetscMalloc3(a->ne, &n->order, a->nv, &n->vertex, a->nv, &n->number));
  PetscCall(PetscCalloc1(a->ne, &seen));
  for (int v = 0; v < a->nv; v++) n->number[v] = NONE;
  for (int e = 0, next = 0; e < a->ne; e++) {
    if (a->vertex[3 * e] != NONE) Append(a, e, seen, n);
    for (; next < n->ne; next++) {
      for (int c = 3 * n->order[next]; c < 3 * n->order[next] + 3; c++) {
        if (a->across[c] != NONE) Append(a, a->across[c] / 3, seen, n);
      }
    }
  }
  PetscCall(PetscFree(seen));
  PetscFunctionReturn(0);
}

static PetscErrorCode ExtractVertices(const Adapt *a, const Numbering *n, AdaptResult *r)
{
  PetscFunctionBeginUser;
  r->mesh.nv = n->nv;
  PetscCall(PetscMalloc1(2 * n->nv, &r->mesh.x));
  PetscCall(PetscMalloc1(3 * n->nv, &r->metric));
  PetscCall(PetscMalloc1(n->nv, &r->origin));
  for (int v = 0; v < n->nv; v++) {
    memcpy(&r->mesh.x[2 * v], &a->x[2 * n->vertex[v]], 2 * sizeof(double));
    memcpy(&r->metric[3 * v], &a->metric[3 * n->vertex[v]], 3 * sizeof(double));
    r->origin[v] = a->origin[n->vertex[v]];
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ExtractTriangles(const Adapt *a, const Numbering *n, MeshSerial *m)
{
  PetscFunctionBeginUser;
  m->ne = n->ne;
  PetscCall(PetscMalloc1(3 * n->ne, &m->vertex));
  if (a->background.mesh->region) PetscCall(PetscMalloc1(n->ne, &m->region));
  for (int e = 0; e < n->ne; e++) {
    for (int i = 0; i < 3; i++) {
      m->vertex[3 * e + i] = n->number[a->vertex[3 * n->order[e] + i]];
      m->nb += IsFacet(a, 3 * n->order[e] + i);
    }
    if (m->region) m->region[e] = a->region[n->order[e]];
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ExtractFacets(const Adapt *a, const Numbering *n, MeshSerial *m)
{
  int nb = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * m->nb, &m->facet));
  PetscCall(PetscMalloc1(m->nb, &m->facet_tag));
  for (int k = 0; k < 3 * n->ne; k++) {
    const int c = 3 * n->order[k / 3] + k % 3;
    if (!IsFacet(a, c)) continue;
    m->facet[2 * nb] = n->number[a->vertex[Next(c)]];
    m->facet[2 * nb + 1] = n->number[a->vertex[Prev(c)]];
    m->facet_tag[nb++] = a->mark[c];
  }
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptExtract(const Adapt *a, AdaptResult *result)
{
  Numbering n;
  PetscFunctionBeginUser;
  memset(result, 0, sizeof *result);
  PetscCall(Order(a, &n));
  PetscCall(ExtractVertices(a, &n, result));
  PetscCall(ExtractTriangles(a, &n, &result->mesh));
  PetscCall(ExtractFacets(a, &n, &result->mesh));
  PetscCall(PetscFree3(n.order, n.vertex, n.number));
  PetscCall(CopyNames(a->background.mesh, &result->mesh));
  result->report = a->report;
  PetscCall(AdaptMeasure(&result->mesh, result->metric, &result->report));
  PetscFunctionReturn(0);
}
