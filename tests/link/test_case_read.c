/* What a good case file gives: types, defaults, lists, order, overrides, hashes. */
#include "common/link/case_impl.h"
#include "tests/link/catch.h"
#include <math.h>

static const char GOOD[] = "case: disc\n"
                           "gravity: [0.0, -9.81]\n"
                           "fluid:\n"
                           "  density: 1.0e3\n"
                           "  steps: 12\n"
                           "  adapt: true\n"
                           "  file: 'meshes/a b.msh'\n"
                           "  boundaries:\n"
                           "    left: no_slip\n"
                           "    right: {velocity: [1, 0]}\n"
                           "solid:\n"
                           "  bodies:\n"
                           "    - {centre: [1.25, 4.75], radius: 0.125}\n"
                           "    - {centre: [2.25, 4.75], radius: 0.5}\n";
static const char *const ALL[] = {"case", "gravity", "fluid", "solid", NULL};
static const char *const SLIP[] = {"free_slip", "no_slip", NULL};

static void Join(void *context, const char *name)
{
  strcat(context, name);
  strcat(context, " ");
}

static void ReadFluid(CoracleCase c)
{
  double v[2];
  char names[64] = "";
  CHECK(!strcmp(CoracleCaseString(c, "case"), "disc"));
  CoracleCaseVector(c, "gravity", 2, v);
  CHECK(v[0] == 0.0 && v[1] == -9.81);
  CHECK(CoracleCasePositive(c, "fluid.density") == 1000.0);
  CHECK(CoracleCaseNumberOr(c, "fluid.theta", 0.5, 0.5, 1.0) == 0.5);
  CHECK(CoracleCaseIntegerOr(c, "fluid.steps", 3, 0, 100) == 12);
  CHECK(CoracleCaseIntegerOr(c, "fluid.other", 3, 0, 100) == 3);
  CHECK(CoracleCaseBoolOr(c, "fluid.adapt", false));
  CHECK(CoracleCaseBoolOr(c, "fluid.adapt2", true));
  const char *path = CoracleCaseFile(c, "fluid.file");
  CHECK(!strcmp(path, "/tmp/meshes/a b.msh"));
  CoracleCaseKeys(c, "fluid.boundaries", Join, names);
  CHECK(!strcmp(names, "left right "));
  CHECK(CoracleCaseWord(c, "fluid.boundaries.left", -1, SLIP) == 1);
  CHECK(CoracleCaseWord(c, "fluid.boundaries.top", 0, SLIP) == 0);
  CoracleCaseVector(c, "fluid.boundaries.right.velocity", 2, v);
  CHECK(v[0] == 1.0 && v[1] == 0.0);
  CHECK(!CoracleCaseVectorOptional(c, "fluid.lower", 2, v) && v[0] == 1.0);
}

static void ReadSolid(CoracleCase c)
{
  double v[2];
  CHECK(CoracleCaseCount(c, "solid.bodies") == 2 && CoracleCaseCount(c, "solid.none") == 0);
  CHECK(CoracleCaseHas(c, "solid.bodies[1].radius") && !CoracleCaseHas(c, "solid.bodies[2].radius"));
  CoracleCaseVector(c, "solid.bodies[0].centre", 2, v);
  CHECK(v[0] == 1.25 && v[1] == 4.75);
  CoracleCaseVector(c, "solid.bodies[1].centre", 2, v);
  CHECK(v[0] == 2.25);
  CHECK(CoracleCaseNumber(c, "solid.bodies[0].radius", 0.0, HUGE_VAL) == 0.125);
  CHECK(CoracleCaseNumber(c, "solid.bodies[1].radius", 0.5, 0.5) == 0.5);
}

static void ReadAll(CoracleCase c)
{
  ReadFluid(c);
  ReadSolid(c);
  CoracleCaseFinish(c, ALL);
}

static void ReadSet(CoracleCase c)
{
  double v[2];
  CHECK(CoracleCasePositive(c, "fluid.density") == 2.5);
  CHECK(!strcmp(CoracleCaseString(c, "fluid.petsc"), "-ksp_view -x"));
  CoracleCaseVector(c, "solid.bodies[1].centre", 2, v);
  CHECK(v[0] == 7.0 && v[1] == 8.0);
  CHECK(CoracleCaseCount(c, "solid.bodies") == 3);
  CHECK(CoracleCasePositive(c, "solid.bodies[2].radius") == 4.0);
  CHECK(CoracleCasePositive(c, "coupler.deep.er.key") == 1.0);
}

static unsigned long long HashOf(const char *text, char *set)
{
  char path[] = "/tmp/coracle-case-XXXXXX", problem[CASE_MESSAGE];
  char *argv[] = {(char *)"test", path, (char *)"--set", set};
  const int file = mkstemp(path);
  CoracleCase c;
  CHECK(file >= 0 && write(file, text, strlen(text)) > 0 && !close(file));
  CHECK(!CaseLoad(set ? 4 : 2, argv, problem, &c));
  const unsigned long long hash = CoracleCaseHash(c);
  CoracleCaseClose(&c);
  unlink(path);
  return hash;
}

int main(void)
{
  static const char *const SETS[] = {
      "fluid.density=2.5",        "fluid.petsc='-ksp_view -x'", "solid.bodies[1].centre=[7, 8]",
      "solid.bodies[2].radius=4", "coupler.deep.er.key=1",      NULL};
  CheckCase(GOOD, NULL, ReadAll, NULL);
  CheckCase(GOOD, SETS, ReadSet, NULL);
  CHECK(HashOf("a: 1", NULL) == HashOf("a: 1", NULL));
  CHECK(HashOf("a: 1", NULL) != HashOf("a: 2", NULL));
  CHECK(HashOf("a: 1", (char *)"b=1") != HashOf("a: 1", NULL));
  CHECK(HashOf("a: 1", (char *)"b=1") != HashOf("a: 1", (char *)"b=2"));
  CHECK(CaseEditDistance("densty", "density", 3) == 1 && CaseEditDistance("density", "denisty", 3) == 1);
  CHECK(CaseEditDistance("abc", "xyz", 3) == 3 && CaseEditDistance("abcdef", "uvwxyz", 3) == 4);
  CHECK(!CaseSimilar("density", "viscosity"));
  return 0;
}
