// ranks: 1 2 3
/* A vortex transferred between random meshes: energy never grows and falls by O(h^4) a transfer, momentum
 * stays; bench_vortex runs a thousand transfers. */
#include "tests/transfer/vortex.h"

enum { TRANSFERS = 20 };

/* Mean relative loss a transfer. */
static PetscErrorCode Follow(int n, double *rate)
{
  Vortex v;
  PetscFunctionBeginUser;
  PetscCall(VortexCreate(n, &v));
  const VortexState start = v.state;
  while (v.transfers < TRANSFERS) {
    PetscCall(VortexTransfer(&v));
    VortexCheck(&v, &start);
  }
  *rate = (1.0 - v.state.energy / start.energy) / TRANSFERS;
  PetscCall(VortexDestroy(&v));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  double coarse = 0.0, fine = 0.0;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Follow(12, &coarse));
  PetscCall(Follow(24, &fine));
  const double order = log2(coarse / fine);
  CHECK(order > 3.7 && order < 4.3, "%g, then %g a transfer: O(h^%.2f), not O(h^4)", coarse, fine, order);
  return PetscFinalize();
}
