#include "fluid/discretization/domain.h"

static PetscErrorCode ListFaces(FluidDomain *d)
{
  const int n = 3 * d->mesh->ne, *neighbor = d->mesh->neighbor;
  PetscFunctionBeginUser;
  d->nfaces = 0;
  for (int k = 0; k < n; k++) d->nfaces += neighbor[k] < 0;
  PetscCall(PetscMalloc1(d->nfaces, &d->face));
  for (int k = 0, at = 0; k < n; k++)
    if (neighbor[k] < 0) d->face[at++] = k;
  PetscFunctionReturn(0);
}

PetscErrorCode DomainCreate(const Mesh *m, const Boundary boundary[], FluidDomain *d)
{
  PetscFunctionBeginUser;
  d->mesh = m;
  PetscCall(P2SpaceCreate(m, &d->p2));
  PetscCall(PetscMalloc1(m->ntags, &d->boundary));
  PetscCall(PetscArraycpy(d->boundary, boundary, m->ntags));
  PetscCall(BoundaryBoxes(m, d->boundary));
  PetscCall(PetscMalloc1(m->ne + m->ng, &d->geometry));
  for (int e = 0; e < m->ne + m->ng; e++)
    ElementGeometryCompute(ElementVertex(m, e, 0), ElementVertex(m, e, 1), ElementVertex(m, e, 2),
                           d->geometry + e);
  PetscCall(ListFaces(d));
  PetscFunctionReturn(0);
}

PetscErrorCode DomainDestroy(FluidDomain *d)
{
  PetscFunctionBeginUser;
  PetscCall(P2SpaceDestroy(&d->p2));
  PetscCall(PetscFree(d->geometry));
  PetscCall(PetscFree(d->boundary));
  PetscCall(PetscFree(d->face));
  PetscFunctionReturn(0);
}
