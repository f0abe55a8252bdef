/* Kinetic energy of a Taylor vortex against the number of transfers between random meshes; vortex.h says what
 * must hold.  bench_vortex [transfers, default 1000] [csv, default vortex.csv] [cells a side ..., default 16
 * 32 48] writes a table that scripts/plot_transfer.py draws.  Exit code 1 when the energy ever grows, falls
 * by more than theory allows, or momentum drifts, or the loss of a transfer is not O(h^4). */
#include "tests/transfer/vortex.h"

/* Mean relative loss of the last half of the transfers. */
static PetscErrorCode Follow(int n, int transfers, FILE *csv, double *rate)
{
  Vortex v;
  double half = 0.0;
  PetscFunctionBeginUser;
  PetscCall(VortexCreate(n, &v));
  const VortexState start = v.state;
  for (int k = 0; k <= transfers; k++) {
    if (k > 0) PetscCall(VortexTransfer(&v));
    if (k > 0) VortexCheck(&v, &start);
    if (k == transfers / 2) half = v.state.energy;
    if (csv) {
      fprintf(csv, "%d,%d,%.15g,%.6g,%.6g,%.6g\n", n, k, v.state.energy / start.energy,
              v.state.loss / start.energy, v.state.bound / start.energy,
              v.state.error / sqrt(2.0 * start.energy));
    }
  }
  *rate = log(half / v.state.energy) / (transfers - transfers / 2);
  PetscCall(
      PetscPrintf(PETSC_COMM_WORLD,
                  "%6d triangles: energy %.8f of the start after %d transfers, rate %.3g a transfer "
                  "(first e^2/E %.3g), error %.3g, momentum drifts by %.1g\n",
                  2 * n * n, v.state.energy / start.energy, transfers, *rate,
                  start.best * start.best / start.energy, v.state.error / sqrt(2.0 * start.energy),
                  hypot(v.state.momentum[0] - start.momentum[0], v.state.momentum[1] - start.momentum[1]) /
                      start.modulus));
  PetscCall(VortexDestroy(&v));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  static const int CELLS[] = {16, 32, 48};
  const int transfers = argc > 1 ? atoi(argv[1]) : 1000, sizes = argc > 3 ? argc - 3 : 3;
  const char *path = argc > 2 ? argv[2] : "vortex.csv";
  double rate = 0.0, before = 0.0;
  int rank, last = 0;
  FILE *csv = NULL;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) {
    csv = fopen(path, "w");
    CHECK(csv, "%s cannot be written", path);
    fprintf(csv, "cells,transfers,energy,loss,bound,error\n");
  }
  for (int k = 0; k < sizes; k++) {
    const int n = argc > 3 ? atoi(argv[3 + k]) : CELLS[k];
    PetscCall(Follow(n, transfers, csv, &rate));
    if (k > 0) {
      const double order = log(before / rate) / log((double)n / last);
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  order of the rate in h: %.2f\n", order));
      CHECK(order > 3.6 && order < 4.4, "the rate a transfer is O(h^%.2f), not O(h^4)", order);
    }
    before = rate;
    last = n;
  }
  if (csv) fclose(csv);
  return PetscFinalize();
}
