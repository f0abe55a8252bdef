#include "fluid/input/fluid_case.h"
#include "common/mesh/mesh_checkpoint.h"
#include "common/output/options.h"
#include "common/program/outline_case.h"
#include "common/supermesh/geometry.h"
#include "fluid/input/boundary_case.h"

/* --- mesh: a graded box, a polygon, or a Gmsh file ------------------------------------------------------------------ */

typedef struct {
  GeometryBox at;
  double size;
} RefinedBox;

typedef struct {
  int n;
  RefinedBox *box;
  double size_max, growth;
} SizeField;

/* The smallest over the refined boxes of size + growth * distance to the box. */
static double SizeAt(void *context, const double x[2])
{
  const SizeField *f = context;
  double size = f->size_max;
  for (int k = 0; k < f->n; k++)
    size = fmin(size, f->box[k].size + f->growth * GeometryBoxDistance(&f->box[k].at, x));
  return size;
}

/* More triangles than any computer that this is meant for holds (100 GB): a slip in a size. */
#define TRIANGLES_MAX 2e7
/* Of size_min: the least edge at corners. */
#define CORNER_LEAST 1e-3

/* A cell is two triangles. */
static double BoxCount(const double lower[2], const double upper[2], double size)
{
  return 2.0 * (upper[0] - lower[0]) * (upper[1] - lower[1]) / (size * size);
}

static void CheckCount(CoracleCase c, const char *key, double count, double size)
{
  if (count > TRIANGLES_MAX)
    CoracleCaseRefuse(c, key, "cells of %g m make a mesh of about %.2g triangles, more than %g", size, count,
                      TRIANGLES_MAX);
}

static void CheckRefined(CoracleCase c, int k, const RefinedBox *box, double size)
{
  char key[CASE_KEY];
  for (int i = 0; i < 2; i++) {
    if (box->at.lower[i] <= box->at.upper[i]) continue;
    CoracleCaseRefuse(c, CaseKey(key, "fluid.mesh.refine[%d].upper", k),
                      "the box is empty: expected a corner above and right of lower (%g, %g), found (%g, %g)",
                      box->at.lower[0], box->at.lower[1], box->at.upper[0], box->at.upper[1]);
  }
  CheckCount(c, CaseKey(key, "fluid.mesh.refine[%d].size", k), BoxCount(box->at.lower, box->at.upper, size),
             size);
}

/* Of the sizes at the middles of a grid of the box. */
static void CheckRefinedCount(CoracleCase c, const double lower[2], const double upper[2], SizeField *f)
{
  enum { CELLS = 200 };
  double count = 0.0;
  const double step[2] = {(upper[0] - lower[0]) / CELLS, (upper[1] - lower[1]) / CELLS};
  for (int k = 0; k < CELLS * CELLS; k++) {
    const double x[2] = {lower[0] + step[0] * (k % CELLS + 0.5), lower[1] + step[1] * (k / CELLS + 0.5)},
                 size = SizeAt(f, x);
    count += 2.0 * step[0] * step[1] / (size * size);
  }
  if (count > TRIANGLES_MAX)
    CoracleCaseRefuse(c, "fluid.mesh.refine",
                      "with a growth of %g m a metre the mesh has about %.2g triangles, more than %g",
                      f->growth, count, TRIANGLES_MAX);
}

static PetscErrorCode BoxMesh(CoracleCase c, PetscBool make, MeshSerial *serial)
{
  SizeField f = {0};
  double lower[2], upper[2];
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  CoracleCaseVector(c, "fluid.mesh.lower", 2, lower);
  CoracleCaseVector(c, "fluid.mesh.upper", 2, upper);
  if (upper[0] <= lower[0] || upper[1] <= lower[1])
    CoracleCaseRefuse(c, "fluid.mesh.upper",
                      "expected a corner above and right of lower (%g, %g), found (%g, %g)", lower[0],
                      lower[1], upper[0], upper[1]);
  f.size_max = CoracleCasePositive(c, "fluid.mesh.size_max");
  CheckCount(c, "fluid.mesh.size_max", BoxCount(lower, upper, f.size_max), f.size_max);
  f.growth = CoracleCaseNumberOr(c, "fluid.mesh.growth", 0.25, 0.0, HUGE_VAL);
  f.n = CoracleCaseCount(c, "fluid.mesh.refine");
  PetscCall(PetscMalloc1(f.n, &f.box));
  for (int k = 0; k < f.n; k++) {
    CoracleCaseVector(c, CaseKey(key, "fluid.mesh.refine[%d].lower", k), 2, f.box[k].at.lower);
    CoracleCaseVector(c, CaseKey(key, "fluid.mesh.refine[%d].upper", k), 2, f.box[k].at.upper);
    f.box[k].size = CoracleCasePositive(c, CaseKey(key, "fluid.mesh.refine[%d].size", k));
    CheckRefined(c, k, &f.box[k], fmin(f.box[k].size, f.size_max));
  }
  if (f.n) CheckRefinedCount(c, lower, upper, &f);
  if (make) PetscCall(MeshBox(lower, upper, f.size_max, SizeAt, &f, serial));
  PetscCall(PetscFree(f.box));
  PetscFunctionReturn(0);
}

static PetscErrorCode PolygonMesh(CoracleCase c, PetscBool make, MeshSerial *serial)
{
  static const char *const OF_BOX[] = {"lower", "upper", "refine", "growth", NULL};
  int n;
  double(*corner)[2];
  const char **side;
  PetscFunctionBeginUser;
  CoracleCaseNotBeside(c, "fluid.mesh", "corners", OF_BOX);
  PetscCall(CaseReadOutline(c, "fluid.mesh.corners", &n, &corner));
  PetscCall(CaseReadSides(c, "fluid.mesh.sides", n, &side));
  const double size = CoracleCasePositive(c, "fluid.mesh.size_max");
  CheckCount(c, "fluid.mesh.size_max", MeshPolygonCount(n, (const double(*)[2])corner, size), size);
  if (make) PetscCall(MeshPolygon(n, (const double(*)[2])corner, side, size, serial));
  PetscCall(PetscFree(side));
  PetscCall(PetscFree(corner));
  PetscFunctionReturn(0);
}

/* The keys are read in any case. */
PetscErrorCode FluidCaseMesh(CoracleCase c, MPI_Comm comm, Checkpoint from, Mesh **mesh, PetscInt **row)
{
  MeshSerial serial = {0};
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  const PetscBool make = (PetscBool)(rank == 0 && !from);
  if (CoracleCaseHas(c, "fluid.mesh.file")) {
    const char *path = CoracleCaseFile(c, "fluid.mesh.file"), *why = NULL;
    int components = 1;
    if (make && MeshReadGmsh(path, &serial, &why)) CoracleCaseRefuse(c, "fluid.mesh.file", "%s", why);
    if (serial.order == 2)
      CoracleCaseRefuse(
          c, "fluid.mesh.file",
          "%s: the fluid's triangles have straight sides: write the mesh with Mesh.ElementOrder = 1", path);
    if (make) PetscCall(MeshSerialComponents(&serial, &components));
    if (components != 1)
      CoracleCaseRefuse(c, "fluid.mesh.file",
                        "%s: the mesh has %d components that share no vertex, expected one", path,
                        components);
  } else if (CoracleCaseHas(c, "fluid.mesh.corners")) {
    PetscCall(PolygonMesh(c, make, &serial));
  } else {
    PetscCall(BoxMesh(c, make, &serial));
  }
  if (from)
    PetscCall(MeshLoad(comm, from, mesh, row));
  else
    PetscCall(MeshDistribute(comm, &serial, mesh));
  PetscCall(MeshSerialDestroy(&serial));
  PetscFunctionReturn(0);
}

/* --- the flow, its numbers and its adaptation ----------------------------------------------------------- */

static void ReadZone(CoracleCase c, int k, const PhaseNames *names, AbsorptionZone *z)
{
  char key[CASE_KEY];
  z->rate = CoracleCaseNumber(c, CaseKey(key, "fluid.absorption[%d].rate", k), 0.0, HUGE_VAL);
  z->velocity[0] = z->velocity[1] = 0.0;
  z->phase = names->name[0] && CoracleCaseHas(c, CaseKey(key, "fluid.absorption[%d].phase", k))
                 ? PhaseCaseIndex(c, key, names)
                 : -1;
  (void)CoracleCaseVectorOptional(c, CaseKey(key, "fluid.absorption[%d].velocity", k), 2, z->velocity);
  CoracleCaseVector(c, CaseKey(key, "fluid.absorption[%d].from", k), 2, z->from);
  CoracleCaseVector(c, CaseKey(key, "fluid.absorption[%d].to", k), 2, z->to);
  if (z->to[0] == z->from[0] && z->to[1] == z->from[1])
    CoracleCaseRefuse(c, key, "expected another point than from, (%g, %g)", z->to[0], z->to[1]);
}

static void ReadAbsorption(CoracleCase c, const PhaseNames *names, Absorption *a)
{
  a->n = CoracleCaseCount(c, "fluid.absorption");
  if (a->n > ABSORPTION_MAX) CoracleCaseRefuse(c, "fluid.absorption", "more than %d zones", ABSORPTION_MAX);
  for (int k = 0; k < a->n; k++) ReadZone(c, k, names, &a->zone[k]);
}

static double PositiveOr(CoracleCase c, const char *key, double fallback)
{
  return CoracleCaseHas(c, key) ? CoracleCasePositive(c, key) : fallback;
}

PetscErrorCode FluidCaseSetup(CoracleCase c, const Mesh *mesh, FluidSetup *setup)
{
  static const char *const SINGLE[] = {"density", "viscosity", NULL};
  PhaseNames names;
  PetscFunctionBeginUser;
  memset(setup, 0, sizeof *setup);
  CoracleCaseNotBeside(c, "fluid", "phases", SINGLE);
  PhaseCaseRead(c, &names, &setup->phases);
  if (setup->phases.n) {
    setup->rho = setup->phases.rho[PhaseLightest(&setup->phases)];
    setup->mu = setup->phases.mu[PhaseLightest(&setup->phases)];
  } else {
    setup->rho = CoracleCasePositive(c, "fluid.density");
    setup->mu = CoracleCasePositive(c, "fluid.viscosity");
  }
  setup->theta = CoracleCaseNumberOr(c, "fluid.theta", PhaseHasTension(&setup->phases) ? 1.0 : 0.5, 0.5, 1.0);
  GravityRead(c, setup->gravity, &setup->gravity_table);
  (void)CoracleCaseVectorOptional(c, "fluid.initial.velocity", 2, setup->velocity);
  ReadAbsorption(c, &names, &setup->absorption);
  setup->cfl = CoracleCasePositive(c, "time.cfl");
  setup->dt_max = CoracleCasePositive(c, "time.dt_max");
  setup->capillary_cfl = PositiveOr(c, "fluid.capillary_cfl", CAPILLARY_CFL);
  setup->gravity_cfl = PositiveOr(c, "fluid.gravity_cfl", GRAVITY_CFL);
  PetscCall(PetscMalloc1(mesh->ntags, &setup->boundary));
  PetscCall(BoundaryCaseRead(c, mesh, &names, &setup->phases, setup->boundary));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCaseAdaptation(CoracleCase c, const FluidSetup *setup, PetscBool *adapts,
                                   AdaptationSetup *s)
{
  PetscFunctionBeginUser;
  *adapts = (PetscBool)CoracleCaseHas(c, "fluid.adapt");
  if (!*adapts) PetscFunctionReturn(0);
  s->size_min = CoracleCasePositive(c, "fluid.adapt.size_min");
  s->size_max = CoracleCasePositive(c, "fluid.adapt.size_max");
  if (s->size_max < s->size_min)
    CoracleCaseRefuse(c, "fluid.adapt.size_max", "expected at least fluid.adapt.size_min, %g, found %g",
                      s->size_min, s->size_max);
  s->velocity_error = CoracleCasePositive(c, "fluid.adapt.velocity_error");
  s->corner_size =
      CoracleCaseNumberOr(c, "fluid.adapt.corner_size", s->size_min, CORNER_LEAST * s->size_min, s->size_min);
  s->interface_size = s->size_min;
  s->light_velocity_error = 0.0;
  if (setup->phases.n) {
    s->interface_size =
        CoracleCaseNumberOr(c, "fluid.adapt.interface_size", s->size_min, s->size_min, s->size_max);
    s->light_velocity_error = CoracleCaseNumberOr(c, "fluid.adapt.light_velocity_error", 0.0, 0.0, HUGE_VAL);
  }
  s->growth = CoracleCaseNumberOr(c, "fluid.adapt.growth", 1.5, 1.01, 10.0);
  s->anisotropy = CoracleCaseNumberOr(c, "fluid.adapt.anisotropy", 5.0, 1.0, 1000.0);
  s->elements_max = CoracleCaseNumberOr(c, "fluid.adapt.elements_max", 200000.0, 100.0, 1e9);
  s->every = CoracleCaseIntegerOr(c, "fluid.adapt.every", 20, 1, 1000000);
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCaseCheckOptions(CoracleCase c)
{
  static const char *const LATER[] = {"-momentum_factor_", "-momentum_multigrid_", NULL};
  char option[256];
  PetscFunctionBeginUser;
  PetscCall(OptionsUnused(CoracleCaseStringOr(c, "fluid.petsc", ""), LATER, sizeof option, option));
  if (option[0])
    CoracleCaseRefuse(
        c, "fluid.petsc",
        "no solver that this run has takes the option %s: theirs begin with -momentum_, -momentum_factor_, "
        "-momentum_multigrid_, -pressure_, -pressure_varying_, -pressure_coarse_ or -pressure_patch_",
        option);
  PetscFunctionReturn(0);
}
