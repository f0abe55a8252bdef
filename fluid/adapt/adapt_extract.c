#include "adapt_impl.h"
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

static PetscErrorCode ExtractVertices(const Adapt *a, int number[], AdaptResult *r)
{
  int nv = 0;
  PetscFunctionBeginUser;
  for (int v = 0; v < a->nv; v++) number[v] = a->corner[v] == NONE ? NONE : nv++;
  PetscCall(PetscMalloc1(2 * nv, &r->mesh.x));
  PetscCall(PetscMalloc1(3 * nv, &r->metric));
  PetscCall(PetscMalloc1(nv, &r->origin));
  r->mesh.nv = nv;
  for (int v = 0; v < a->nv; v++) {
    if (number[v] == NONE) continue;
    memcpy(&r->mesh.x[2 * number[v]], &a->x[2 * v], 2 * sizeof(double));
    memcpy(&r->metric[3 * number[v]], &a->metric[3 * v], 3 * sizeof(double));
    r->origin[number[v]] = a->origin[v];
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ExtractTriangles(const Adapt *a, const int number[], MeshSerial *m)
{
  PetscFunctionBeginUser;
  for (int e = 0; e < a->ne; e++) {
    if (a->vertex[3 * e] == NONE) continue;
    m->ne++;
    for (int c = 3 * e; c < 3 * e + 3; c++) m->nb += IsFacet(a, c);
  }
  PetscCall(PetscMalloc1(3 * m->ne, &m->vertex));
  PetscCall(PetscMalloc1(2 * m->nb, &m->facet));
  PetscCall(PetscMalloc1(m->nb, &m->facet_tag));
  if (a->background.mesh->region) PetscCall(PetscMalloc1(m->ne, &m->region));
  int ne = 0, nb = 0;
  for (int e = 0; e < a->ne; e++) {
    if (a->vertex[3 * e] == NONE) continue;
    for (int c = 3 * e; c < 3 * e + 3; c++) {
      m->vertex[3 * ne + c % 3] = number[a->vertex[c]];
      if (!IsFacet(a, c)) continue;
      m->facet[2 * nb] = number[a->vertex[Next(c)]];
      m->facet[2 * nb + 1] = number[a->vertex[Prev(c)]];
      m->facet_tag[nb++] = a->mark[c];
    }
    if (m->region) m->region[ne] = a->region[e];
    ne++;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptExtract(const Adapt *a, AdaptResult *result)
{
  int *number;
  PetscFunctionBeginUser;
  memset(result, 0, sizeof *result);
  PetscCall(PetscMalloc1(a->nv, &number));
  PetscCall(ExtractVertices(a, number, result));
  PetscCall(ExtractTriangles(a, number, &result->mesh));
  PetscCall(CopyNames(a->background.mesh, &result->mesh));
  PetscCall(PetscFree(number));
  result->report = a->report;
  PetscCall(AdaptMeasure(&result->mesh, result->metric, &result->report));
  PetscFunctionReturn(0);
}
