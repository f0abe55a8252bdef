#include "common/mesh/mesh.h"
#include "common/exchange/union_find.h"
#include <string.h>

int MeshTagIndex(const Mesh *mesh, const char *name)
{
  for (int k = 0; k < mesh->ntags; k++) {
    if (!strcmp(mesh->tag_name[k], name)) return k;
  }
  return -1;
}

PetscErrorCode MeshDestroy(Mesh **mesh)
{
  Mesh *m = *mesh;
  PetscFunctionBeginUser;
  if (!m) PetscFunctionReturn(0);
  PetscCall(PetscFree(m->x));
  PetscCall(PetscFree(m->vgid));
  PetscCall(PetscFree(m->vertex));
  PetscCall(PetscFree(m->egid));
  PetscCall(PetscFree(m->neighbor));
  PetscCall(PetscFree(m->neighbor_face));
  PetscCall(PetscFree(m->tag));
  PetscCall(PetscFree(m->tag_name));
  PetscCall(PetscFree(m->edge));
  PetscCall(PetscFree(*mesh));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshSerialComponents(const MeshSerial *mesh, int *components)
{
  int *root;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(mesh->nv, &root));
  for (int v = 0; v < mesh->nv; v++) root[v] = v;
  *components = mesh->nv;
  for (int k = 0; k < 3 * mesh->ne; k++)
    *components -= UnionFindJoin(root, mesh->vertex[k], mesh->vertex[k - k % 3]);
  PetscCall(PetscFree(root));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshSerialDestroy(MeshSerial *mesh)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(mesh->x));
  PetscCall(PetscFree(mesh->vertex));
  PetscCall(PetscFree(mesh->facet));
  PetscCall(PetscFree(mesh->facet_tag));
  PetscCall(PetscFree(mesh->tag_name));
  PetscCall(PetscFree(mesh->region));
  PetscCall(PetscFree(mesh->region_name));
  PetscCall(PetscFree(mesh->curve));
  PetscCall(PetscFree(mesh->curve_name));
  memset(mesh, 0, sizeof *mesh);
  PetscFunctionReturn(0);
}
