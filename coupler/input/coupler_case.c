#include "coupler/input/coupler_case.h"
#include "common/link/case_key.h"
#include "common/output/options.h"
#include "common/program/run_case.h"
#include <math.h>
#include <stdio.h>

static double OfItem(CoracleCase file, const char *list, int k, const char *item)
{
  char key[CASE_KEY];
  return CoracleCaseHas(file, CaseKey(key, "%s[%d].%s", list, k, item))
             ? CoracleCaseNumber(file, key, 0.0, HUGE_VAL)
             : 0.0;
}

/* sqrt(largest surface tension/(range of the densities g)), m: water rises so far at a wall.  Infinite without gravity. */
static double CapillaryLength(CoracleCase file, double gravity)
{
  const char *const tensions = "fluid.surface_tension", *const phases = "fluid.phases";
  double least = HUGE_VAL, largest = 0.0, tension = 0.0;
  char first[CASE_KEY];
  for (int k = 0; k < CoracleCaseCount(file, phases); k++) {
    least = fmin(least, OfItem(file, phases, k, "density"));
    largest = fmax(largest, OfItem(file, phases, k, "density"));
  }
  if (!CoracleCaseHas(file, CaseKey(first, "%s[0]", tensions)))
    tension = CoracleCaseNumber(file, tensions, 0.0, HUGE_VAL);
  else
    for (int k = 0; k < CoracleCaseCount(file, tensions); k++)
      tension = fmax(tension, OfItem(file, tensions, k, "value"));
  const double weight = (largest - least) * gravity;
  return weight > 0.0 ? sqrt(tension / weight) : HUGE_VAL;
}

/* Of the elements at the interface, m; infinite: the case does not say, the mesh is a file's. */
static double InterfaceSize(CoracleCase file)
{
  static const char *const KEYS[] = {"fluid.adapt.interface_size", "fluid.adapt.size_min",
                                     "fluid.mesh.size_max", NULL};
  for (int k = 0; KEYS[k]; k++)
    if (CoracleCaseHas(file, KEYS[k])) return CoracleCasePositive(file, KEYS[k]);
  return HUGE_VAL;
}

/* Of a case with surface tension: whether elements resolve it, as all do without gravity. */
static PetscBool ResolvesTension(CoracleCase file, double gravity)
{
  const double length = CapillaryLength(file, gravity);
  return (PetscBool)(length == HUGE_VAL || InterfaceSize(file) < length);
}

/* One body without joints has nothing to touch but walls; a solid of others counts as one. */
static PetscBool IsOneBody(CoracleCase file)
{
  static const char *const SEVERAL[] = {"joints", "repeat", "mesh"};
  PetscBool one = (PetscBool)(CoracleCaseCount(file, "solid.bodies") <= 1);
  for (size_t k = 0; k < sizeof SEVERAL / sizeof *SEVERAL; k++) {
    char key[CASE_KEY];
    if (CoracleCaseHas(file, CaseKey(key, "solid.bodies[%d].%s", 0, SEVERAL[k]))) one = PETSC_FALSE;
  }
  return one;
}

static void ReadUplift(CoracleCase file, CouplerOptions *o)
{
  const PetscBool walls = (PetscBool)(CoracleCaseVectorOptional(file, "solid.walls.lower", 2, o->lower) &&
                                      CoracleCaseVectorOptional(file, "solid.walls.upper", 2, o->upper));
  for (int d = 0; d < 2 && !walls; d++) {
    o->lower[d] = -HUGE_VAL;
    o->upper[d] = HUGE_VAL;
  }
  o->uplift = (PetscBool)(o->mode == COUPLER_REACTION && (walls || !IsOneBody(file)) &&
                          GravityLargest(o->gravity, &o->gravity_table) > 0.0);
}

static void ReadOptions(CoracleCase file, CouplerOptions *o)
{
  o->mode = (CouplerMode)CoracleCaseWord(file, "coupler.mode", COUPLER_REACTION, COUPLER_MODES);
  const PetscBool empty =
      (PetscBool)(CoracleCaseHas(file, "solid.bodies") && CoracleCaseCount(file, "solid.bodies") == 0);
  const PetscBool needed = (PetscBool)(!empty || CoracleCaseHas(file, "coupler.shell_thickness"));
  o->thickness = needed ? CoracleCasePositive(file, "coupler.shell_thickness") : 0.0;
  GravityRead(file, o->gravity, &o->gravity_table);
  ReadUplift(file, o);
  o->capillary = (PetscBool)(CoracleCaseHas(file, "fluid.surface_tension") &&
                             ResolvesTension(file, GravityLargest(o->gravity, &o->gravity_table)));
}

PetscErrorCode CouplerCaseRead(CoracleCase file, CouplerCase *c)
{
  static const char *const SECTIONS[] = {"case", "note", "gravity", "time", "coupler", "output", NULL};
  char option[256];

  PetscFunctionBeginUser;
  snprintf(c->name, sizeof c->name, "%s", CoracleCaseString(file, "case"));
  snprintf(c->note, sizeof c->note, "%s", CoracleCaseStringOr(file, "note", ""));
  RunCaseRead(file, &c->run);
  c->path = CoracleCasePath(file);
  (void)CoracleCaseBoolOr(file, "output.trace", false); /* the library's */
  c->dt_max = CoracleCasePositive(file, "time.dt_max");
  /* the fluid's, read here so that the whole section can be checked */
  if (CoracleCaseHas(file, "time.cfl")) (void)CoracleCasePositive(file, "time.cfl");
  ReadOptions(file, &c->options);
  GaugesReadCase(file, &c->gauges);
  CoracleCaseRenamed(file, "coupler.tries", "coupler.max_iterations");
  c->max_iterations = CoracleCaseIntegerOr(file, "coupler.max_iterations", 30, 1, 1000);
  c->tolerance = CoracleCaseNumberOr(file, "coupler.tolerance", 1e-4, 1e-12, 1.0);
  PetscCall(PetscOptionsInsertString(NULL, CoracleCaseStringOr(file, "coupler.petsc", "")));
  PetscCall(CoracleCaseFinish(file, SECTIONS));
  PetscCall(OptionsUnused(CoracleCaseStringOr(file, "coupler.petsc", ""), NULL, sizeof option, option));
  if (option[0]) CoracleCaseRefuse(file, "coupler.petsc", "nothing in the coupler has the option %s", option);
  PetscFunctionReturn(0);
}
