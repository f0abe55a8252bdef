// ranks: 1 2
/* Advection with prescribed flows: a straight interface moves exactly, across open boundaries too, with two
 * and three phases; the vortex and Zalesak's disc come back within the errors stated, converge, keep their
 * area and stay within bounds; the volumes that pass faces sum to the fluxes; a step that is too long is
 * refused.  Compressive advection, too: the same but for larger errors, and a step of any length.
 *
 * advect print: also prints the table. */
#include "tests/phases/flows.h"
#include "tests/phases/set.h"

#define KEPT 1e-12

static int print;
static PhasesAdvection advection = PHASES_GEOMETRIC;
static char reason[1024];

static PetscErrorCode Catch(MPI_Comm comm, int line, const char *function, const char *file,
                            PetscErrorCode code, PetscErrorType type, const char *message, void *context)
{
  if (message && type == PETSC_ERROR_INITIAL) snprintf(reason, sizeof reason, "%s", message);
  return code;
}

static double Uniform(const double x[2])
{
  return 0.3 * x[1] - 0.8 * x[0];
}

static void UniformVelocity(const double x[2], double u[2])
{
  u[0] = 0.3;
  u[1] = 0.8;
}

/* Two or three phases divided by lines (layers), as they are after a time t of the uniform flow. */
static int Layers(int np, double t, Region region[3])
{
  const double x = 0.2 + 0.3 * t, y = 0.5 + 0.8 * t;
  region[0] = (Region){.shape = REGION_BOX, .phase = np - 1, .a = {-9.0, -9.0}, .b = {9.0, 9.0}};
  region[np - 1] = (Region){.shape = REGION_HALF_PLANE, .phase = 0, .a = {x, y}, .b = {-2.0, 1.0}};
  if (np == 3)
    region[1] = (Region){.shape = REGION_HALF_PLANE, .phase = 1, .a = {x, y + 0.07}, .b = {-2.0, 1.0}};
  return np;
}

/* Where nothing but phase 0 flows in from below, the last from the left: the interface leaves no boundary
 * point where it would enter, apart from the corner region that is left out of the comparison. */
static PetscErrorCode Straight(int np)
{
  static const double LAST[PHASES_MAX] = {0.0};
  const Shaken shaken = {.n = 14, .seed = 8u, .radius = 1.0};
  const Flow flow = {Uniform, UniformVelocity, 0.0, 0, 1.0, 1.0};
  double fraction[4][PHASES_MAX], *flux, *velocity, *swept, worst = 0.0, excess = 0.0;
  const PhasesInflow inflow = {.fraction = (const double(*)[PHASES_MAX])fraction};
  const double *volume, dt = 0.03;
  Region region[3];
  Mesh *mesh;
  Set s, exact;
  PetscFunctionBeginUser;
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(SetMake(mesh, np, &s));
  exact = s;
  PetscCall(PhasesCreate(s.stars, np, &exact.phases));
  for (int k = 0; k < 4; k++) {
    memcpy(fraction[k], LAST, sizeof LAST);
    fraction[k][k == MeshTagIndex(mesh, "left") ? np - 1 : 0] = 1.0;
  }
  PetscCall(PetscMalloc3(3 * mesh->ne, &flux, 6 * mesh->ne, &velocity, 3 * np * mesh->ne, &swept));
  FlowAt(&flow, mesh, 0.0, flux, velocity);
  PetscCall(PhasesFill(s.phases, Layers(np, 0.0, region), region));
  for (int k = 0; k < 6; k++) {
    PetscCall(PhasesReconstruct(s.phases));
    PetscCall(PhasesAdvect(s.phases, dt, flux, velocity, &inflow, swept, NULL));
  }
  PetscCall(PhasesFill(exact.phases, Layers(np, 6 * dt, region), region));
  PetscCall(PhasesGetVolumes(s.phases, &volume));
  for (int e = 0; e < mesh->ne; e++) {
    const double *v;
    double low = HUGE_VAL;
    for (int i = 0; i < 3; i++) {
      double sum = -dt * flux[3 * e + i];
      for (int p = 0; p < np; p++) sum += swept[np * (3 * e + i) + p];
      excess = fmax(excess, fabs(sum));
      low = fmin(low, Corner(mesh, e, i)[0]);
    }
    PetscCall(PhasesGetVolumes(exact.phases, &v));
    for (int p = 0; p < np && low > 0.25; p++)
      worst = fmax(worst, fabs(v[np * e + p] - volume[np * e + p]) / ElementArea(mesh, e));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, mesh->comm));
  CHECK(worst < 1e-9, "%d phases: a straight interface is off by %g of an element after 6 steps", np, worst);
  CHECK(excess < 1e-16, "the volumes through a face differ from its flux by %g m2", excess);
  PetscCall(PetscFree3(flux, velocity, swept));
  PetscCall(PhasesDestroy(&exact.phases));
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

static PetscErrorCode MakePhases(Mesh *mesh, int np, Set *s)
{
  PetscFunctionBeginUser;
  PetscCall(SetMake(mesh, np, s));
  PhasesSetAdvection(s->phases, advection);
  PetscFunctionReturn(0);
}

/* lost: through open sides, of a phase */
static void Bounds(const char *name, const PhasesStats *first, const PhasesStats *worst, int np, double lost)
{
  for (int p = 0; p < np; p++)
    CHECK(fabs(worst->volume[p] - first->volume[p]) < lost * first->volume[p],
          "%s: phase %d has %.17g of %.17g m2", name, p, worst->volume[p], first->volume[p]);
  CHECK(worst->lowest > -1e-10 && worst->highest < 1.0 + 1e-10 && worst->gap < 1e-10,
        "%s: fractions %g .. 1 + %g, gap %g", name, worst->lowest, worst->highest - 1.0, worst->gap);
}

/* |V - V at the start| of phase 0, m2 */
static PetscErrorCode Return(const char *name, int n, const Flow *flow, int nregions, const Region region[],
                             double lost, double *error)
{
  const int steps = (int)ceil(flow->end * flow->speed * n / 0.5);
  PhasesStats first, worst = {.lowest = 1.0};
  const double *volume;
  double *start;
  Mesh *mesh;
  Set s;
  PetscFunctionBeginUser;
  PetscCall(UnstructuredMesh(PETSC_COMM_WORLD, 1.0 / n, &mesh));
  PetscCall(MakePhases(mesh, 2, &s));
  PetscCall(PhasesFill(s.phases, nregions, region));
  PetscCall(PhasesGetVolumes(s.phases, &volume));
  PetscCall(PetscMalloc1(2 * mesh->ne, &start));
  PetscCall(PetscArraycpy(start, volume, 2 * mesh->ne));
  PetscCall(PhasesGetStats(s.phases, &first));
  PetscCall(March(s.phases, mesh, flow, 0.0, flow->end / steps, steps, &worst, NULL));
  *error = Difference(mesh, 2, start, volume);
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%-8s %4d %7d  %.3e m2  %.2f %%\n", name, n, (int)mesh->nglobal,
                          *error, 100.0 * *error / first.volume[0]));
  Bounds(name, &first, &worst, 2, lost);
  PetscCall(PetscFree(start));
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

/* What all ranks together get is what each gets alone, for every element of the mesh. */
static PetscErrorCode Ranks(void)
{
  const Shaken shaken = {.n = 16, .seed = 21u, .radius = 1.0};
  const Flow flow = VortexFlow(2.0);
  PhasesStats stats = {0};
  Region region[BODY_REGIONS];
  const double *volume[2];
  double worst = 0.0;
  Set s[2];
  PetscFunctionBeginUser;
  for (int alone = 0; alone < 2; alone++) {
    Mesh *mesh;
    PetscCall(ShakenMesh(alone ? PETSC_COMM_SELF : PETSC_COMM_WORLD, &shaken, &mesh));
    PetscCall(MakePhases(mesh, 2, &s[alone]));
    PetscCall(PhasesFill(s[alone].phases, DiscRegions(region), region));
    PetscCall(March(s[alone].phases, mesh, &flow, 0.0, 2.0 / 64, 40, &stats, NULL));
    PetscCall(PhasesGetVolumes(s[alone].phases, &volume[alone]));
  }
  for (int e = 0; e < s[0].mesh->ne; e++) {
    const double(*x)[2] = (const double(*)[2])s[0].stars->element[e].x;
    int found = -1;
    for (int o = 0; o < s[1].mesh->ne && found < 0; o++) {
      int same = 0;
      for (int i = 0; i < 9; i++) same += !memcmp(x[i / 3], s[1].stars->element[o].x[i % 3], sizeof x[0]);
      if (same == 3) found = o;
    }
    CHECK(found >= 0, "element %d is not in the mesh of one rank", e);
    worst = fmax(worst, fabs(volume[0][2 * e] - volume[1][2 * found]) / ElementArea(s[0].mesh, e));
  }
  CHECK(worst < 1e-9, "an element's fraction differs by %g from that on one rank", worst);
  for (int alone = 0; alone < 2; alone++) PetscCall(SetDestroy(&s[alone]));
  PetscFunctionReturn(0);
}

/* Three phases, a drop half of each of two in the third, sheared. */
static PetscErrorCode Three(void)
{
  const Flow flow = VortexFlow(2.0);
  PhasesStats first, worst = {.lowest = 1.0};
  Region region[4];
  Mesh *mesh;
  Set s;
  PetscFunctionBeginUser;
  DiscRegions(region);
  region[0].phase = 2;
  region[1].phase = 1;
  region[2] = (Region){.shape = REGION_BOX, .phase = 0, .a = {0.42, 0.55}, .b = {0.5, 0.95}};
  PetscCall(UnstructuredMesh(PETSC_COMM_WORLD, 1.0 / 24, &mesh));
  PetscCall(MakePhases(mesh, 3, &s));
  PetscCall(PhasesFill(s.phases, 3, region));
  PetscCall(PhasesGetStats(s.phases, &first));
  PetscCall(March(s.phases, mesh, &flow, 0.0, 2.0 / 96, 96, &worst, NULL));
  Bounds("three phases", &first, &worst, 3, KEPT);
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

static PetscErrorCode TooLong(void)
{
  const Flow flow = VortexFlow(8.0);
  PhasesStats worst = {0};
  Region region[BODY_REGIONS];
  Mesh *mesh;
  Set s;
  PetscFunctionBeginUser;
  PetscCall(UnstructuredMesh(PETSC_COMM_WORLD, 1.0 / 24, &mesh));
  PetscCall(MakePhases(mesh, 2, &s));
  PetscCall(PhasesFill(s.phases, DiscRegions(region), region));
  PetscCall(PetscPushErrorHandler(Catch, NULL));
  const PetscErrorCode code = March(s.phases, mesh, &flow, 0.0, 0.5, 1, &worst, NULL);
  PetscCall(PetscPopErrorHandler());
  CHECK(code == PETSC_ERR_ARG_OUTOFRANGE && strstr(reason, "crosses more than an"), "error %d: %s", (int)code,
        reason);
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

/* *vortex: error, m2, *ratio: that of twice the edges over it; *disc: of Zalesak's disc; lost: of that, through the sides. */
static PetscErrorCode Returns(double lost, double *ratio, double *vortex, double *disc)
{
  const Flow swirl = VortexFlow(2.0), rotation = RotationFlow();
  double coarse;
  Region region[BODY_REGIONS];
  PetscFunctionBeginUser;
  const int nregions = DiscRegions(region);
  PetscCall(Return("vortex 2", 16, &swirl, nregions, region, KEPT, &coarse));
  PetscCall(Return("vortex 2", 32, &swirl, nregions, region, KEPT, vortex));
  *ratio = coarse / *vortex;
  const int slotted = ZalesakRegions(region);
  PetscCall(Return("zalesak", 32, &rotation, slotted, region, lost, disc));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  double ratio, vortex, disc;
  print = argc > 1;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Straight(2));
  PetscCall(Straight(3));
  PetscCall(Returns(KEPT, &ratio, &vortex, &disc));
  CHECK(vortex < 1.6e-3 && ratio > 3.0, "vortex: error %g m2, of twice the edges %g times as much", vortex,
        ratio);
  CHECK(disc < 6.5e-3, "Zalesak's disc: error %g m2", disc);
  PetscCall(Ranks());
  PetscCall(Three());
  PetscCall(TooLong());
  advection = PHASES_COMPRESSIVE;
  PetscCall(Returns(1e-5, &ratio, &vortex, &disc));
  CHECK(vortex < 8.5e-3 && ratio > 1.5,
        "compressive, vortex: error %g m2, of twice the edges %g times as much", vortex, ratio);
  CHECK(disc < 1.8e-2, "compressive, Zalesak's disc: error %g m2", disc);
  PetscCall(Ranks());
  PetscCall(Three());
  return PetscFinalize();
}
