/* Errors, bounds and speed of advection:
 *   bench_phases [vortex | zalesak] [period of the vortex, default 8] [edges a side, default 32 64 128 ...]
 * Prints a table. */
#include "flows.h"

static PetscErrorCode Row(const char *name, int n, const Flow *flow, double *before)
{
  const int zalesak = name[0] == 'z', steps = (int)ceil(flow->end * flow->speed * n / 0.5);
  Mesh *mesh;
  Stars *stars;
  Phases phases;
  Region region[BODY_REGIONS];
  const double *volume;
  double *start;
  PhasesStats first, worst = {.lowest = 1.0};
  PetscFunctionBeginUser;
  PetscCall(UnstructuredMesh(PETSC_COMM_WORLD, 1.0 / n, &mesh));
  PetscCall(StarsCreate(mesh, &stars));
  PetscCall(PhasesCreate(stars, 2, &phases));
  PetscCall(PhasesFill(phases, zalesak ? ZalesakRegions(region) : DiscRegions(region), region));
  PetscCall(PhasesGetVolumes(phases, &volume));
  PetscCall(PetscMalloc1(2 * mesh->ne, &start));
  PetscCall(PetscArraycpy(start, volume, 2 * mesh->ne));
  PetscCall(PhasesGetStats(phases, &first));
  double seconds = 0.0;
  PetscCall(March(phases, mesh, flow, 0.0, flow->end / steps, steps, &worst, &seconds));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_SUM, mesh->comm));
  const double error = Difference(mesh, 2, start, volume);
  PetscCall(
      PetscPrintf(mesh->comm, "%-8s %4d %7d %6d  %5.2f  %.3e %.3e  %5.2f  %8.1e %8.1e %8.1e %8.1e  %9.0f\n",
                  name, n, (int)mesh->nglobal, steps, worst.courant, error, error / first.volume[0],
                  *before > 0.0 ? log2(*before / error) : 0.0, worst.volume[0] / first.volume[0] - 1.0,
                  worst.lowest, worst.highest - 1.0, worst.gap, (double)mesh->nglobal * steps / seconds));
  *before = error;
  PetscCall(PetscFree(start));
  PetscCall(PhasesDestroy(&phases));
  PetscCall(StarsDestroy(&stars));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const char *name = argc > 1 ? argv[1] : "vortex";
  const double period = argc > 2 ? atof(argv[2]) : 8.0;
  const Flow flow = name[0] == 'z' ? RotationFlow() : VortexFlow(period);
  double before = 0.0;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%-8s %4s %7s %6s  %5s  %9s %9s  %5s  %8s %8s %8s %8s  %9s\n",
                        "case", "n", "tri", "steps", "CFL", "E m2", "E/V", "order", "mass", "low", "high",
                        "gap", "tri-st/s"));
  if (argc > 3) {
    for (int k = 3; k < argc; k++) PetscCall(Row(name, atoi(argv[k]), &flow, &before));
  } else {
    for (int n = 32; n <= 128; n *= 2) PetscCall(Row(name, n, &flow, &before));
  }
  return PetscFinalize();
}
