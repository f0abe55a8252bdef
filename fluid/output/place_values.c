#include "fluid/output/place_values.h"
#include "common/space/p2.h"

PetscErrorCode PlacesValues(const Places *places, Fluid fluid, double value[][PLACE_VALUES])
{
  const double *u = FluidVelocity(fluid), *p = FluidPressure(fluid), *rho = FluidDensity(fluid);
  const int *node = FluidPressureSpace(fluid)->node;
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(&value[0][0], PLACE_VALUES * (size_t)places->npoints));
  for (int k = 0; k < places->n; k++) {
    const Place *at = &places->place[k];
    double nodal[6], *sum = value[at->point];
    for (int i = 0; i < 6; i++) nodal[i] = p[node[6 * at->element + i]];
    for (int c = 0; c < 2; c++)
      for (int i = 0; i < 3; i++) sum[c] += at->share * at->n[i] * u[6 * at->element + 3 * c + i];
    sum[PLACE_P] += at->share * P2Evaluate(nodal, at->n);
    sum[PLACE_RHO] += at->share * rho[at->element];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, value, PLACE_VALUES * places->npoints, MPI_DOUBLE, MPI_SUM,
                             FluidMesh(fluid)->comm));
  for (int k = 0; k < places->npoints; k++)
    for (int i = 0; i < PLACE_VALUES && places->outside[k] > 0.0; i++) value[k][i] = NAN;
  PetscFunctionReturn(0);
}
