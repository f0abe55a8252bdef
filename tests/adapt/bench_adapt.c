/* Triangles per second of one refinement, one coarsening and one change in place: bench_adapt [size, default
 * 0.0042]. The size field is that of a moving ring: `size` on the ring, growing by 0.2 m/m away from it. */
#include "fluid/adapt/adapt.h"
#include "fluid/adapt/metric.h"
#include <math.h>
#include <stdlib.h>
#include <time.h>

/* Of this process: other work on the machine does not count. */
static double CpuSeconds(void)
{
  return (double)clock() / CLOCKS_PER_SEC;
}

static PetscErrorCode Step(const char *what, const MeshSerial *from, double size, double center,
                           AdaptResult *to)
{
  double *metric;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(3 * from->nv, &metric));
  for (int v = 0; v < from->nv; v++) {
    const double r = hypot(from->x[2 * v] - center, from->x[2 * v + 1] - 0.5);
    const double h = size + 0.2 * fabs(r - 0.25);
    metric[3 * v] = metric[3 * v + 2] = 1.0 / (h * h);
  }
  const double t0 = CpuSeconds();
  PetscCall(MeshAdapt(from, metric, NULL, to));
  const double t = CpuSeconds() - t0;
  const AdaptReport *r = &to->report;
  PetscCall(PetscPrintf(PETSC_COMM_SELF,
                        "%-8s %8d -> %8d triangles, %.3f s, %8.0f/s out, %8.0f/s of the larger; %2d rounds, "
                        "%d splits %d collapses %d swaps %d moves; %.2f %% unit, worst %.3f mean %.3f\n",
                        what, from->ne, to->mesh.ne, t, to->mesh.ne / t, PetscMax(from->ne, to->mesh.ne) / t,
                        r->rounds, r->splits, r->collapses, r->swaps, r->moves,
                        100.0 * r->edges_unit / r->edges, r->quality_worst, r->quality_mean));
  PetscCall(PetscFree(metric));
  PetscFunctionReturn(0);
}

static double Uniform(void *context, const double x[2])
{
  return *(const double *)context;
}

int main(int argc, char **argv)
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {1.0, 1.0};
  double size = argc > 1 ? atof(argv[1]) : 0.001, coarse = 0.05;
  MeshSerial box;
  AdaptResult fine, shifted, back, again;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(MeshBox(lower, upper, coarse, Uniform, &coarse, &box));
  PetscCall(Step("refine", &box, size, 0.5, &fine));
  PetscCall(Step("refine", &fine.mesh, size, 0.5, &again));
  PetscCall(Step("shift", &again.mesh, size, 0.5 + 4.0 * size, &shifted));
  PetscCall(Step("coarsen", &shifted.mesh, 10.0 * size, 0.5, &back));
  PetscCall(MeshSerialDestroy(&box));
  PetscCall(AdaptResultDestroy(&fine));
  PetscCall(AdaptResultDestroy(&again));
  PetscCall(AdaptResultDestroy(&shifted));
  PetscCall(AdaptResultDestroy(&back));
  return PetscFinalize();
}
