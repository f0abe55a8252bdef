// ranks: 1 2 3
/* Two inflows of different phases side by side, at a corner and on a straight side, along it, too: fractions stay within [0, 1],
 * what a boundary lets in is its phase alone, and each phase is what there was and what came in. */
#include "tests/phases/flows.h"
#include "tests/phases/set.h"

#define BOUND 1e-10
#define KEPT 1e-12

static double ObliquePsi(const double x[2])
{
  return 0.8 * x[1] - 0.3 * x[0];
}

static void ObliqueVelocity(const double x[2], double u[2])
{
  u[0] = 0.8;
  u[1] = 0.3;
}

/* Faster below, turned up and down. */
static double WavyPsi(const double x[2])
{
  return x[1] - 0.2 * x[1] * x[1] - 0.3 * x[0] + 0.05 * sin(2.0 * M_PI * x[0]);
}

static void WavyVelocity(const double x[2], double u[2])
{
  u[0] = 1.0 - 0.4 * x[1];
  u[1] = 0.3 - 0.1 * M_PI * cos(2.0 * M_PI * x[0]);
}

/* From now on the left side is the bottom's boundary up to `height`. */
static void Divide(Mesh *m, double height)
{
  const int left = MeshTagIndex(m, "left"), bottom = MeshTagIndex(m, "bottom");
  for (int k = 0; k < 3 * m->ne; k++) {
    const double *a = Corner(m, k / 3, (k + 1) % 3), *b = Corner(m, k / 3, (k + 2) % 3);
    if (m->tag[k] == left && 0.5 * (a[1] + b[1]) < height) m->tag[k] = bottom;
  }
}

/* volume[2] -= what has passed the boundary; *foreign: the largest part of what came in that is not the boundary's phase, m2. */
static void Account(const Mesh *m, const double fraction[][PHASES_MAX], const double swept[],
                    double volume[2], double *foreign)
{
  double out[2] = {0.0, 0.0};
  for (int k = 0; k < 3 * m->ne; k++) {
    if (m->tag[k] < 0) continue;
    const int own = fraction[m->tag[k]][1] > 0.0;
    for (int p = 0; p < 2; p++) out[p] += swept[2 * k + p];
    if (m->tag[k] == MeshTagIndex(m, "left")) *foreign = fmax(*foreign, fabs(swept[2 * k + !own]));
  }
  MPI_Allreduce(MPI_IN_PLACE, out, 2, MPI_DOUBLE, MPI_SUM, m->comm);
  for (int p = 0; p < 2; p++) volume[p] -= out[p];
}

/* Phase 0 below, phase 1 comes in on the left above `height`, phase 0 elsewhere; `start` is there at first.  Compressive: in steps in
 * which elements lose up to twice their content. */
static PetscErrorCode Beside(const char *name, const Flow *flow, double height, int start,
                             PhasesAdvection advection)
{
  const Shaken shaken = {.n = 14, .seed = 8u, .radius = 1.0};
  double fraction[4][PHASES_MAX] = {{0.0}}, *flux, *velocity, *swept, volume[2], foreign = 0.0;
  const PhasesInflow inflow = {.fraction = (const double(*)[PHASES_MAX])fraction};
  const Region all = {.shape = REGION_BOX, .phase = start, .a = {-9.0, -9.0}, .b = {9.0, 9.0}};
  const double dt = advection == PHASES_COMPRESSIVE ? 0.08 : 0.02;
  PhasesStats stats;
  Mesh *mesh;
  Set s;
  PetscFunctionBeginUser;
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  Divide(mesh, height);
  PetscCall(SetMake(mesh, 2, &s));
  PhasesSetAdvection(s.phases, advection);
  for (int k = 0; k < 4; k++) fraction[k][k == MeshTagIndex(mesh, "left")] = 1.0;
  PetscCall(PetscMalloc3(3 * mesh->ne, &flux, 6 * mesh->ne, &velocity, 6 * mesh->ne, &swept));
  FlowAt(flow, mesh, 0.0, flux, velocity);
  PetscCall(PhasesFill(s.phases, 1, &all));
  PetscCall(PhasesGetStats(s.phases, &stats));
  PetscCall(PetscArraycpy(volume, stats.volume, 2));
  for (int k = 0; k < 20; k++) {
    PetscCall(PhasesReconstruct(s.phases));
    PetscCall(PhasesAdvect(s.phases, dt, flux, velocity, &inflow, swept, NULL));
    PetscCall(PhasesGetStats(s.phases, &stats));
    Account(mesh, inflow.fraction, swept, volume, &foreign);
    CHECK(stats.lowest > -BOUND && stats.highest < 1.0 + BOUND, "%s, step %d: fractions %g .. 1 + %g", name,
          k, stats.lowest, stats.highest - 1.0);
  }
  for (int p = 0; p < 2; p++)
    CHECK(fabs(stats.volume[p] - volume[p]) < KEPT && volume[p] > 0.05,
          "%s: phase %d has %.15g of %.15g m2 that came in", name, p, stats.volume[p], volume[p]);
  CHECK(foreign < 1e-16, "%s: a face lets in %g m2 of a phase that is not its boundary's", name, foreign);
  PetscCall(PetscFree3(flux, velocity, swept));
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const Flow oblique = {ObliquePsi, ObliqueVelocity, 0.0, 0, 0.9, 1.0};
  const Flow wavy = {WavyPsi, WavyVelocity, 0.0, 0, 1.2, 1.0};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int k = 0; k < 4; k++) {
    const PhasesAdvection advection = k < 2 ? PHASES_GEOMETRIC : PHASES_COMPRESSIVE;
    PetscCall(Beside("corner", &oblique, 0.0, k % 2, advection));
    PetscCall(Beside("side", &oblique, 0.5, k % 2, advection));
    PetscCall(Beside("side, wavy", &wavy, 0.5, k % 2, advection));
  }
  return PetscFinalize();
}
