#include "fluid/pressure/compressibility.h"
#include "fluid/discretization/ghosted.h"

PetscErrorCode CompressibilityAddLoads(const FluidDomain *domain, const CompressibleElement elements[],
                                       double dt, Vec pressure, PetscScalar d[])
{
  const int *node = domain->p2->node;
  const PetscScalar *p;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(pressure, &p));
  for (int e = 0; e < domain->mesh->ne; e++) {
    double own[6], load[6] = {0.0};
    for (int k = 0; k < 6; k++) own[k] = p[node[6 * e + k]];
    CompressibilityLoad(&elements[e], domain->geometry[e].area, dt, own, load);
    for (int k = 0; k < 6; k++) d[node[6 * e + k]] += load[k];
  }
  PetscCall(GhostedRestoreArrayRead(pressure, &p));
  PetscFunctionReturn(0);
}
