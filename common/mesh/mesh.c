#include "common/mesh/mesh.h"
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
  memset(mesh, 0, sizeof *mesh);
  PetscFunctionReturn(0);
}
