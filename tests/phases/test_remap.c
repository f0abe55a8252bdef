// ranks: 1 2 3
/* Phases through adaptations of the mesh: a straight interface and a layer stay where they are to round-off;
 * a disc through 100 adaptations keeps its area to 1e-12 and its outline to a tenth of the edge length le,
 * fractions stay within bounds; what did not change is copied.  remap print: also says how well. */
#include "tests/phases/flows.h"
#include "tests/phases/set.h"

#define LE 0.02

static int print;

/* The phases go to a mesh that is fine around the circle, not always in the same way. */
static PetscErrorCode Adapt(int k, int np, Set *s, TransferStats *stats)
{
  double *metric;
  Mesh *mesh;
  Set next;
  Transfer transfer;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(3 * s->mesh->nv, &metric));
  for (int v = 0; v < s->mesh->nv; v++) {
    const double x = s->mesh->x[2 * v] - 0.5, y = s->mesh->x[2 * v + 1] - 0.5;
    const double away = fmax(fabs(hypot(x, y) - 0.3) - 4.0 * LE, 0.0);
    const double h = LE * (1.0 + 0.25 * sin(1.7 * k + 3.0 * atan2(y, x))) + 0.4 * away;
    metric[3 * v] = metric[3 * v + 2] = 1.0 / (h * h);
    metric[3 * v + 1] = 0.0;
  }
  PetscCall(MeshAdaptParallel(s->mesh, metric, &mesh, NULL));
  PetscCall(SetMake(mesh, np, &next));
  PetscCall(PhasesReconstruct(s->phases));
  PetscCall(TransferCreate(s->mesh, mesh, &transfer));
  PetscCall(TransferGetStats(transfer, stats));
  PetscCall(PhasesRemap(s->phases, transfer, next.phases));
  PetscCall(TransferDestroy(&transfer));
  PetscCall(PetscFree(metric));
  PetscCall(SetDestroy(s));
  *s = next;
  PetscFunctionReturn(0);
}

static void Bounds(const Set *s, int np, const PhasesStats *first)
{
  PhasesStats now;
  PhasesGetStats(s->phases, &now);
  for (int p = 0; p < np; p++)
    CHECK(fabs(now.volume[p] - first->volume[p]) < 1e-12 * first->volume[p], "phase %d has %.17g of %.17g m2",
          p, now.volume[p], first->volume[p]);
  CHECK(now.lowest > -1e-10 && now.highest < 1.0 + 1e-10 && now.gap < 1e-10, "fractions %g .. 1 + %g, gap %g",
        now.lowest, now.highest - 1.0, now.gap);
}

/* Three layers between straight lines, on ten meshes. */
static PetscErrorCode Layers(void)
{
  const Shaken shaken = {.n = 20, .seed = 2u, .radius = 1.0};
  Region region[3] = {{.shape = REGION_BOX, .phase = 2, .a = {-1, -1}, .b = {2, 2}}};
  const double *now, *exact;
  double worst = 0.0;
  TransferStats stats;
  PhasesStats first;
  Phases fresh;
  Mesh *mesh;
  Set s;
  PetscFunctionBeginUser;
  region[1] = (Region){.shape = REGION_HALF_PLANE, .phase = 1, .a = {0.5, 0.52}, .b = {0.3, 1.0}};
  region[2] = (Region){.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.5}, .b = {0.3, 1.0}};
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(SetMake(mesh, 3, &s));
  PetscCall(PhasesFill(s.phases, 3, region));
  PetscCall(PhasesGetStats(s.phases, &first));
  for (int k = 0; k < 10; k++) PetscCall(Adapt(k, 3, &s, &stats));
  Bounds(&s, 3, &first);
  PetscCall(PhasesCreate(s.stars, 3, &fresh));
  PetscCall(PhasesFill(fresh, 3, region));
  PetscCall(PhasesGetVolumes(s.phases, &now));
  PetscCall(PhasesGetVolumes(fresh, &exact));
  for (int k = 0; k < 3 * s.mesh->ne; k++)
    worst = fmax(worst, fabs(now[k] - exact[k]) / ElementArea(s.mesh, k / 3));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  if (print) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "layers: off by %.1e of an element\n", worst));
  CHECK(worst < 1e-9, "layers are off by %g of an element after 10 adaptations", worst);
  PetscCall(PhasesDestroy(&fresh));
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

/* Distance of the lines' ends from the disc's outline in units of le: largest and mean. */
static PetscErrorCode Outline(const Set *s, double *largest, double *mean)
{
  double sum[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  *largest = 0.0;
  PetscCall(PhasesReconstruct(s->phases));
  for (int e = 0; e < s->mesh->ne; e++) {
    Polygon part;
    if (PhasesSingle(s->phases, e) >= 0) continue;
    PetscCall(PhasesGetPolygon(s->phases, e, 0, &part));
    for (int k = 0; k < part.n; k++) {
      int corner = 0;
      for (int i = 0; i < 3; i++) {
        const double *c = Corner(s->mesh, e, i);
        corner |= hypot(part.x[k][0] - c[0], part.x[k][1] - c[1]) < 1e-9;
      }
      if (corner) continue;
      const double d = fabs(hypot(part.x[k][0] - 0.5, part.x[k][1] - 0.5) - 0.3) / LE;
      *largest = fmax(*largest, d);
      sum[0] += d;
      sum[1] += 1.0;
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  *mean = sum[0] / sum[1];
  PetscFunctionReturn(0);
}

static PetscErrorCode Disc(int times)
{
  const Shaken shaken = {.n = 30, .seed = 2u, .radius = 1.0};
  Region region[BODY_REGIONS];
  double largest, mean;
  TransferStats stats;
  PhasesStats first;
  Mesh *mesh;
  Set s;
  PetscFunctionBeginUser;
  DiscRegions(region);
  region[1] = (Region){.shape = REGION_DISC, .phase = 0, .a = {0.5, 0.5}, .radius = 0.3};
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(SetMake(mesh, 2, &s));
  PetscCall(PhasesFill(s.phases, 2, region));
  PetscCall(Adapt(0, 2, &s, &stats));
  PetscCall(PhasesFill(s.phases, 2, region));
  PetscCall(PhasesGetStats(s.phases, &first));
  for (int k = 1; k <= times; k++) {
    PetscCall(Adapt(k, 2, &s, &stats));
    Bounds(&s, 2, &first);
    if (!print || (k % 10 != 0 && k > 3)) continue;
    PetscCall(Outline(&s, &largest, &mean));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                          "disc, adaptation %3d: %5d of %5d elements copied, outline off by %.3f le, "
                          "in the mean %.4f le\n",
                          k, (int)stats.copied, (int)s.mesh->nglobal, largest, mean));
  }
  PetscCall(Outline(&s, &largest, &mean));
  CHECK(largest < 0.1, "the disc's outline has moved by %g le in %d adaptations", largest, times);
  CHECK(stats.copied > 0 && stats.projected > 100, "%d elements copied, %d intersected", (int)stats.copied,
        (int)stats.projected);
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  print = argc > 1;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Layers());
  PetscCall(Disc(100));
  return PetscFinalize();
}
