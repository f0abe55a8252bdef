#include "solid/bodies/model.h"

static PetscErrorCode CopyBytes(const void *from, size_t bytes, void *to)
{
  char *copy;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(bytes + 1, &copy));
  if (bytes) PetscCall(PetscMemcpy(copy, from, bytes));
  *(void **)to = copy;
  PetscFunctionReturn(0);
}

#define COPY(field, n)                                                                                       \
  PetscCall(CopyBytes(from->field, (size_t)(n) * sizeof *from->field, (void *)&to->field))

PetscErrorCode ModelCopy(const Model *from, Model *to)
{
  PetscFunctionBeginUser;
  *to = *from;
  COPY(rest, 2 * from->nnodes);
  COPY(x, 2 * from->nnodes);
  COPY(u, 2 * from->nnodes);
  COPY(fixed, from->nnodes);
  COPY(node_body, from->nnodes);
  COPY(element, 3 * from->nelements);
  COPY(element_body, from->nelements);
  COPY(element_material, from->nelements);
  COPY(jointed, from->nelements);
  COPY(joint_material, 3 * from->nelements);
  COPY(six_node, from->nelements);
  COPY(facet, 2 * from->nfacets);
  COPY(facet_element, from->nfacets);
  COPY(body, from->nbodies);
  COPY(material, from->nmaterials);
  COPY(motion, from->nmotions);
  COPY(prescribed, from->nprescribed);
  for (int k = 0; k < from->nmotions; k++) {
    COPY(motion[k].row, 3 * from->motion[k].nrows);
    COPY(motion[k].spin.row, 2 * from->motion[k].spin.nrows);
  }
  COPY(load, from->nloads);
  COPY(loaded, from->nloaded);
  for (int k = 0; k < from->nloads; k++) PetscCall(BoundaryLoadCopy(&from->load[k], &to->load[k]));
  PetscFunctionReturn(0);
}

PetscErrorCode ModelDestroy(Model *a)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(a->rest));
  PetscCall(PetscFree(a->x));
  PetscCall(PetscFree(a->u));
  PetscCall(PetscFree(a->fixed));
  PetscCall(PetscFree(a->node_body));
  PetscCall(PetscFree(a->element));
  PetscCall(PetscFree(a->element_body));
  PetscCall(PetscFree(a->jointed));
  PetscCall(PetscFree(a->joint_material));
  PetscCall(PetscFree(a->six_node));
  for (int k = 0; k < a->nmotions; k++) {
    PetscCall(PetscFree(a->motion[k].row));
    PetscCall(PetscFree(a->motion[k].spin.row));
  }
  PetscCall(PetscFree(a->motion));
  PetscCall(PetscFree(a->prescribed));
  for (int k = 0; k < a->nloads; k++) PetscCall(BoundaryLoadFree(&a->load[k]));
  PetscCall(PetscFree(a->load));
  PetscCall(PetscFree(a->loaded));
  PetscCall(PetscFree(a->material));
  PetscCall(PetscFree(a->element_material));
  PetscCall(PetscFree(a->facet));
  PetscCall(PetscFree(a->facet_element));
  PetscCall(PetscFree(a->body));
  PetscCall(PetscMemzero(a, sizeof *a));
  PetscFunctionReturn(0);
}
