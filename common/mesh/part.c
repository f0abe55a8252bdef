#include "common/mesh/mesh_impl.h"
#include "common/mesh/mesh_table.h"
#include <string.h>

PetscErrorCode MeshPartDestroy(MeshPart *part)
{
  PetscFunctionBeginUser;
  PetscCall(MeshSerialDestroy(&part->serial));
  PetscCall(PetscFree(part->gid));
  PetscFunctionReturn(0);
}

PetscErrorCode PartMerge(int n, const long long gid[], int local[], MeshPart *part)
{
  MeshTable table;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &part->gid));
  PetscCall(MeshTableCreate(&table, (size_t)n));
  for (int k = 0; k < n; k++) {
    int *v = MeshTableAt(&table, (int)(gid[k] >> 32), (int)gid[k]);
    if (*v < 0) {
      part->gid[part->serial.nv] = gid[k];
      *v = part->serial.nv++;
    }
    local[k] = *v;
  }
  PetscCall(MeshTableDestroy(&table));
  PetscFunctionReturn(0);
}

PetscErrorCode PartFacets(const int tag[], MeshSerial *s)
{
  PetscFunctionBeginUser;
  for (int k = 0; k < 3 * s->ne; k++) s->nb += tag[k] >= 0;
  PetscCall(PetscMalloc1(2 * s->nb, &s->facet));
  PetscCall(PetscMalloc1(s->nb, &s->facet_tag));
  for (int k = 0, b = 0; k < 3 * s->ne; k++) {
    if (tag[k] < 0) continue;
    MeshFaceEnds(s, k, &s->facet[2 * b], &s->facet[2 * b + 1]);
    s->facet_tag[b++] = tag[k];
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode CopyVertices(const Mesh *m, MeshPart *part)
{
  MeshSerial *s = &part->serial;
  PetscFunctionBeginUser;
  for (int k = 0; k < 3 * m->ne; k++) s->nv = PetscMax(s->nv, m->vertex[k] + 1);
  PetscCall(PetscMalloc1(2 * s->nv, &s->x));
  PetscCall(PetscMalloc1(s->nv, &part->gid));
  PetscCall(PetscArraycpy(s->x, m->x, 2 * s->nv));
  for (int v = 0; v < s->nv; v++) part->gid[v] = m->vgid[v];
  PetscFunctionReturn(0);
}

PetscErrorCode MeshPartOf(const Mesh *m, MeshPart *part)
{
  MeshSerial *s = &part->serial;
  PetscFunctionBeginUser;
  memset(part, 0, sizeof *part);
  s->ne = m->ne;
  PetscCall(CopyVertices(m, part));
  PetscCall(PetscMalloc1(3 * m->ne, &s->vertex));
  PetscCall(PetscArraycpy(s->vertex, m->vertex, 3 * m->ne));
  PetscCall(PartFacets(m->tag, s));
  s->ntags = m->ntags;
  PetscCall(PetscMalloc1(m->ntags, &s->tag_name));
  if (m->ntags) memcpy(s->tag_name, m->tag_name, (size_t)m->ntags * sizeof *m->tag_name);
  PetscFunctionReturn(0);
}
