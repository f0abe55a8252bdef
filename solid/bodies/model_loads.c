/* Loads on the boundaries of bodies. */
#include "solid/bodies/element_edges.h"
#include "solid/bodies/model_impl.h"

PetscErrorCode ModelCopyRows(int n, const double **row)
{
  double *copy;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &copy));
  if (n) PetscCall(PetscArraycpy(copy, *row, n));
  *row = copy;
  PetscFunctionReturn(0);
}

PetscErrorCode BoundaryLoadCopy(const BoundaryLoad *from, BoundaryLoad *to)
{
  PetscFunctionBeginUser;
  *to = *from;
  PetscCall(ModelCopyRows(to->pressure.nrows * to->pressure.width, &to->pressure.row));
  PetscCall(ModelCopyRows(to->traction.nrows * to->traction.width, &to->traction.row));
  PetscFunctionReturn(0);
}

PetscErrorCode BoundaryLoadFree(BoundaryLoad *load)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(load->pressure.row));
  PetscCall(PetscFree(load->traction.row));
  PetscFunctionReturn(0);
}

PetscErrorCode ModelAddLoads(Model *a, const MeshSerial *m, const BodySetup *setup, int first,
                             const int renumber[])
{
  const int nedges = 3 * (a->nelements - first);
  ElementEdge *edge;
  PetscFunctionBeginUser;
  if (!setup->nloads) PetscFunctionReturn(0);
  PetscCall(ElementEdgesSorted(first, a->nelements, a->element, &edge));
  PetscCall(PetscRealloc((size_t)(a->nloads + setup->nloads) * sizeof *a->load, &a->load));
  PetscCall(PetscRealloc(((size_t)a->nloaded + (size_t)setup->nloads * (size_t)m->nb) * sizeof *a->loaded,
                         &a->loaded));
  for (int k = 0; k < setup->nloads; k++, a->nloads++) {
    PetscCall(BoundaryLoadCopy(&setup->load[k].load, &a->load[a->nloads]));
    for (int b = 0; b < m->nb; b++) {
      if (strcmp(m->tag_name[m->facet_tag[b]], setup->load[k].boundary)) continue;
      const ElementEdge *found =
          ElementEdgesFind(nedges, edge, renumber[m->facet[2 * b]], renumber[m->facet[2 * b + 1]]);
      if (found) a->loaded[a->nloaded++] = (LoadedSide){found->element, found->side, a->nloads};
    }
  }
  PetscCall(PetscFree(edge));
  PetscFunctionReturn(0);
}
