// ranks: 1 3
/* Areas of regions on a random mesh: exact for straight sides, 1e-13 for a disc; what is painted later lies
 * on top; bad regions are refused with the reason. */
#include "tests/phases/flows.h"

static char reason[1024];

static PetscErrorCode Catch(MPI_Comm comm, int line, const char *function, const char *file,
                            PetscErrorCode code, PetscErrorType type, const char *message, void *context)
{
  if (message && type == PETSC_ERROR_INITIAL) snprintf(reason, sizeof reason, "%s", message);
  return code;
}

static void Expect(Phases f, int n, const Region region[], const double volume[3], double tolerance)
{
  PhasesStats stats;
  CHECK(!PhasesFill(f, n, region), "regions are refused");
  PhasesGetStats(f, &stats);
  for (int p = 0; p < 3; p++)
    CHECK(fabs(stats.volume[p] - volume[p]) < tolerance, "phase %d: %.16g m2 instead of %.16g", p,
          stats.volume[p], volume[p]);
  CHECK(stats.lowest >= 0.0 && stats.highest <= 1.0 + 1e-14 && stats.gap < 1e-15,
        "fractions %g .. 1 + %g, gap %g", stats.lowest, stats.highest - 1.0, stats.gap);
}

static void Refuse(Phases f, int n, const Region region[], PetscErrorCode expected, const char *text)
{
  reason[0] = 0;
  PetscPushErrorHandler(Catch, NULL);
  const PetscErrorCode code = PhasesFill(f, n, region);
  PetscPopErrorHandler();
  CHECK(code == expected && strstr(reason, text), "error %d: %s", (int)code, reason);
}

static void Shapes(Phases f)
{
  static const double ELL[6][2] = {{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.3}, {0.4, 0.3}, {0.4, 0.8}, {0.1, 0.8}};
  static const double BACK[4][2] = {{0.2, 0.2}, {0.3, 0.7}, {0.8, 0.6}, {0.6, 0.3}};
  Region r[4] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}}};
  r[1] = (Region){.shape = REGION_DISC, .phase = 0, .a = {0.45, 0.55}, .radius = 0.31};
  const double disc = M_PI * 0.31 * 0.31;
  Expect(f, 2, r, (const double[]){disc, 1.0 - disc, 0.0}, 1e-13);
  r[2] = (Region){.shape = REGION_BOX, .phase = 2, .a = {0.4, 0.5}, .b = {0.5, 0.6}};
  Expect(f, 3, r, (const double[]){disc - 0.01, 1.0 - disc, 0.01}, 1e-13);
  r[1] = (Region){.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.5}, .b = {1.0, 3.0}};
  Expect(f, 2, r, (const double[]){0.5, 0.5, 0.0}, 1e-14);
  r[2] = (Region){.shape = REGION_POLYGON, .phase = 2, .n = 6, .x = ELL};
  r[1].phase = 1;
  Expect(f, 3, r, (const double[]){0.0, 1.0 - 0.31, 0.31}, 1e-14);
  r[2] = (Region){.shape = REGION_POLYGON, .phase = 0, .n = 4, .x = BACK};
  double twice = 0.0;
  for (int k = 0; k < 4; k++) twice += BACK[k][0] * BACK[(k + 1) % 4][1] - BACK[k][1] * BACK[(k + 1) % 4][0];
  Expect(f, 3, r, (const double[]){fabs(0.5 * twice), 1.0 - fabs(0.5 * twice), 0.0}, 1e-14);
}

int main(int argc, char **argv)
{
  static const double BOW[4][2] = {{0.1, 0.1}, {0.9, 0.9}, {0.9, 0.1}, {0.1, 0.9}};
  const Shaken shaken = {.n = 17, .seed = 3u, .radius = 1.0};
  Mesh *mesh;
  Stars *stars;
  Phases f;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(StarsCreate(mesh, &stars));
  PetscCall(PhasesCreate(stars, 3, &f));
  Shapes(f);
  const Region disc = {.shape = REGION_DISC, .phase = 0, .a = {0.5, 0.5}, .radius = 0.1};
  Region bad = {.shape = REGION_DISC, .phase = 3, .a = {0.5, 0.5}, .radius = 0.1};
  Refuse(f, 1, &disc, PETSC_ERR_ARG_INCOMP, "in no phase");
  Refuse(f, 1, &bad, PETSC_ERR_ARG_OUTOFRANGE, "there are 3 phases");
  bad = (Region){.shape = REGION_DISC, .phase = 0, .radius = -1.0};
  Refuse(f, 1, &bad, PETSC_ERR_ARG_OUTOFRANGE, "radius -1");
  bad = (Region){.shape = REGION_BOX, .phase = 0, .a = {1, 1}, .b = {0, 2}};
  Refuse(f, 1, &bad, PETSC_ERR_ARG_OUTOFRANGE, "no area");
  bad = (Region){.shape = REGION_POLYGON, .phase = 0, .n = 4, .x = BOW};
  Refuse(f, 1, &bad, PETSC_ERR_ARG_OUTOFRANGE, "crosses itself");
  PetscCall(PhasesDestroy(&f));
  PetscCall(StarsDestroy(&stars));
  PetscCall(MeshDestroy(&mesh));
  return PetscFinalize();
}
