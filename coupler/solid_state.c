#include "coupler/solid_state.h"

PetscErrorCode SolidStateOnStartNodes(const SolidState *solid, const double value[], int n, double start[])
{
  double(*sum)[3]; /* of the corners' values, and their number */

  PetscFunctionBeginUser;
  if (!solid->start_element) {
    PetscCall(PetscArraycpy(start, value, 2 * (size_t)n));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscCalloc1((size_t)n, &sum));
  for (int k = 0; k < 3 * solid->nelements; k++) {
    double *s = sum[solid->start_element[k]];
    for (int c = 0; c < 2; c++) s[c] += value[2 * solid->element[k] + c];
    s[2] += 1.0;
  }
  for (int i = 0; i < n; i++)
    for (int c = 0; c < 2; c++) start[2 * i + c] = sum[i][2] > 0.0 ? sum[i][c] / sum[i][2] : start[2 * i + c];
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}
