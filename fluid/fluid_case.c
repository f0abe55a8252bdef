#include "fluid/fluid_case.h"
#include "common/mesh/mesh_checkpoint.h"
#include "common/output/options.h"
#include "common/supermesh/geometry.h"
#include "fluid/phase_case.h"

/* --- mesh: a graded box, or a Gmsh file ------------------------------------------------------------------ */

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

static void CheckCount(CoracleCase c, const char *key, const double lower[2], const double upper[2],
                       double size)
{
  const double count = 2.0 * (upper[0] - lower[0]) * (upper[1] - lower[1]) / (size * size);
  if (count > TRIANGLES_MAX)
    CoracleCaseRefuse(c, key, "cells of %g m make a mesh of about %.2g triangles, more than %g", size, count,
                      TRIANGLES_MAX);
}

static void CheckRefined(CoracleCase c, int k, const RefinedBox *box, double size)
{
  char key[64];
  for (int i = 0; i < 2; i++) {
    if (box->at.lower[i] <= box->at.upper[i]) continue;
    (void)snprintf(key, sizeof key, "fluid.mesh.refine[%d].upper", k);
    CoracleCaseRefuse(c, key,
                      "the box is empty: expected a corner above and right of lower (%g, %g), found (%g, %g)",
                      box->at.lower[0], box->at.lower[1], box->at.upper[0], box->at.upper[1]);
  }
  (void)snprintf(key, sizeof key, "fluid.mesh.refine[%d].size", k);
  CheckCount(c, key, box->at.lower, box->at.upper, size);
}

static PetscErrorCode BoxMesh(CoracleCase c, PetscBool make, MeshSerial *serial)
{
  SizeField f = {0};
  double lower[2], upper[2];
  char key[64];
  PetscFunctionBeginUser;
  CoracleCaseVector(c, "fluid.mesh.lower", 2, lower);
  CoracleCaseVector(c, "fluid.mesh.upper", 2, upper);
  if (upper[0] <= lower[0] || upper[1] <= lower[1])
    CoracleCaseRefuse(c, "fluid.mesh.upper",
                      "expected a corner above and right of lower (%g, %g), found (%g, %g)", lower[0],
                      lower[1], upper[0], upper[1]);
  f.size_max = CoracleCasePositive(c, "fluid.mesh.size_max");
  CheckCount(c, "fluid.mesh.size_max", lower, upper, f.size_max);
  f.growth = CoracleCaseNumberOr(c, "fluid.mesh.growth", 0.25, 0.0, HUGE_VAL);
  f.n = CoracleCaseCount(c, "fluid.mesh.refine");
  PetscCall(PetscMalloc1(f.n, &f.box));
  for (int k = 0; k < f.n; k++) {
    (void)snprintf(key, sizeof key, "fluid.mesh.refine[%d].lower", k);
    CoracleCaseVector(c, key, 2, f.box[k].at.lower);
    (void)snprintf(key, sizeof key, "fluid.mesh.refine[%d].upper", k);
    CoracleCaseVector(c, key, 2, f.box[k].at.upper);
    (void)snprintf(key, sizeof key, "fluid.mesh.refine[%d].size", k);
    f.box[k].size = CoracleCasePositive(c, key);
    CheckRefined(c, k, &f.box[k], fmin(f.box[k].size, f.size_max));
  }
  if (make) PetscCall(MeshBox(lower, upper, f.size_max, SizeAt, &f, serial));
  PetscCall(PetscFree(f.box));
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
    if (make && MeshReadGmsh(path, &serial, &why)) CoracleCaseRefuse(c, "fluid.mesh.file", "%s", why);
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

/* --- boundaries ----------------------------------------------------------------------------------------- */

/* With phases: which one comes in through a boundary, and the contact angle there. */
static void ReadPhases(CoracleCase c, const char *key, const PhaseNames *names, Boundary *b)
{
  char sub[192];
  (void)snprintf(sub, sizeof sub, "%s.contact_angle", key);
  if (names->name[0] && CoracleCaseHas(c, sub))
    b->contact_cosine = cos(CoracleCaseNumber(c, sub, 0.0, 180.0) * M_PI / 180.0);
  (void)snprintf(sub, sizeof sub, "%s.phase", key);
  b->has_phase = (PetscBool)(names->name[0] && CoracleCaseHas(c, sub));
  if (b->has_phase) b->phase = PhaseCaseIndex(c, sub, names);
}

/* Whether it is open by a pressure or a level. */
static PetscBool ReadOpen(CoracleCase c, const char *key, const PhaseNames *names, Boundary *b)
{
  char level[192], pressure[192];
  (void)snprintf(level, sizeof level, "%s.level", key);
  (void)snprintf(pressure, sizeof pressure, "%s.pressure", key);
  b->has_level = CoracleCaseHas(c, level) ? PETSC_TRUE : PETSC_FALSE;
  if (!b->has_level && !CoracleCaseHas(c, pressure)) return PETSC_FALSE;
  b->kind = BOUNDARY_OPEN;
  if (b->has_level) {
    if (!names->name[0]) CoracleCaseRefuse(c, level, "there are no phases: expected fluid.phases");
    b->level = CoracleCaseNumber(c, level, -HUGE_VAL, HUGE_VAL);
    b->pressure = CoracleCaseNumberOr(c, pressure, 0.0, -HUGE_VAL, HUGE_VAL);
  } else {
    b->pressure = CoracleCaseNumber(c, pressure, -HUGE_VAL, HUGE_VAL);
  }
  return PETSC_TRUE;
}

static void ReadBoundary(CoracleCase c, const char *name, const PhaseNames *names, Boundary *b)
{
  static const char *const WORDS[] = {"no_slip", "free_slip", "open", NULL},
                           *const PROFILES[] = {"uniform", "parabolic", NULL},
                           *const WALLS[] = {"no_slip", "free_slip", NULL};
  static const BoundaryKind KINDS[] = {BOUNDARY_VELOCITY, BOUNDARY_FREE_SLIP, BOUNDARY_OPEN};
  char key[160], sub[192];
  memset(b, 0, sizeof *b);
  (void)snprintf(key, sizeof key, "fluid.boundaries.%s", name);
  ReadPhases(c, key, names, b);
  (void)snprintf(sub, sizeof sub, "%s.velocity", key);
  if (CoracleCaseHas(c, sub)) {
    b->kind = BOUNDARY_VELOCITY;
    CoracleCaseVector(c, sub, 2, b->velocity);
    (void)snprintf(sub, sizeof sub, "%s.profile", key);
    b->parabolic = (PetscBool)(CoracleCaseWord(c, sub, 0, PROFILES) == 1);
    (void)snprintf(sub, sizeof sub, "%s.rise", key);
    b->rise = CoracleCaseNumberOr(c, sub, 0.0, 0.0, HUGE_VAL);
    return;
  }
  if (ReadOpen(c, key, names, b)) return;
  (void)snprintf(sub, sizeof sub, "%s.wall", key);
  b->kind = CoracleCaseHas(c, sub) ? KINDS[CoracleCaseWord(c, sub, -1, WALLS)]
                                   : KINDS[CoracleCaseWord(c, key, -1, WORDS)];
}

/* The boundaries of the case file and those of the mesh. */
typedef struct {
  CoracleCase c;
  const Mesh *mesh;
  int nlisted, nknown; /* in the case file, and of these in the mesh */
  char listed[512];
} BoundaryCheck;

static void AppendName(char list[512], const char *name)
{
  const size_t used = strlen(list);
  (void)snprintf(list + used, 512 - used, "%s%s", used ? ", " : "", name);
}

static void MeshBoundaries(const Mesh *m, char list[512])
{
  list[0] = 0;
  for (int b = 0; b < m->ntags; b++) AppendName(list, m->tag_name[b]);
}

/* A boundary of the case file must be one of the mesh's. */
static void CheckBoundaryName(void *context, const char *name)
{
  const BoundaryCheck *check = context;
  char known[512], key[160];
  if (MeshTagIndex(check->mesh, name) >= 0) return;
  MeshBoundaries(check->mesh, known);
  (void)snprintf(key, sizeof key, "fluid.boundaries.%s", name);
  CoracleCaseRefuse(check->c, key, "the mesh has no boundary of this name; it has %s", known);
}

static void ListBoundaryName(void *context, const char *name)
{
  BoundaryCheck *check = context;
  check->nlisted++;
  check->nknown += MeshTagIndex(check->mesh, name) >= 0;
  AppendName(check->listed, name);
}

void FluidCaseCheckResumed(CoracleCase c, const Mesh *mesh, const char *folder)
{
  BoundaryCheck check = {.c = c, .mesh = mesh};
  char found[512];
  CoracleCaseKeys(c, "fluid.boundaries", ListBoundaryName, &check);
  if (check.nlisted == mesh->ntags && check.nknown == mesh->ntags) return;
  MeshBoundaries(mesh, found);
  CoracleCaseRefuse(
      c, "resume",
      "expected a mesh with the %d boundaries of fluid.boundaries (%s), found %d (%s) in %s/fluid.h5",
      check.nlisted, check.listed, mesh->ntags, found, folder);
}

/* Without an open boundary what is prescribed must neither fill nor empty the domain: in the end, and as it rises. */
static PetscErrorCode CheckFlux(CoracleCase c, const Mesh *mesh, Boundary boundary[])
{
  double net, gross, full;
  PetscFunctionBeginUser;
  for (int b = 0; b < mesh->ntags; b++)
    if (boundary[b].kind == BOUNDARY_OPEN) PetscFunctionReturn(0);
  PetscCall(BoundaryPrescribedFlux(mesh, boundary, HUGE_VAL, &net, &full));
  gross = full;
  for (int b = -1; b < mesh->ntags; b++) {
    if (b >= 0) PetscCall(BoundaryPrescribedFlux(mesh, boundary, 0.5 * boundary[b].rise, &net, &gross));
    if (fabs(net) > 1e-6 * full)
      CoracleCaseRefuse(
          c, "fluid.boundaries",
          "no boundary is open, and the prescribed velocities bring %g m2/s %s than they take out%s",
          fabs(net), net < 0.0 ? "more into the domain" : "less into the domain",
          b < 0 ? "" : " as they rise");
  }
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCaseSetup(CoracleCase c, const Mesh *mesh, FluidSetup *setup)
{
  BoundaryCheck check = {.c = c, .mesh = mesh};
  PhaseNames names;
  PetscFunctionBeginUser;
  memset(setup, 0, sizeof *setup);
  PhaseCaseRead(c, &names, &setup->phases);
  if (setup->phases.n) {
    setup->rho = setup->phases.rho[PhaseLightest(&setup->phases)];
    setup->mu = setup->phases.mu[PhaseLightest(&setup->phases)];
  } else {
    setup->rho = CoracleCasePositive(c, "fluid.density");
    setup->mu = CoracleCasePositive(c, "fluid.viscosity");
  }
  setup->theta =
      CoracleCaseNumberOr(c, "fluid.theta", setup->phases.surface_tension > 0.0 ? 1.0 : 0.5, 0.5, 1.0);
  CoracleCaseVector(c, "gravity", 2, setup->gravity);
  if (CoracleCaseHas(c, "fluid.initial")) CoracleCaseVector(c, "fluid.initial.velocity", 2, setup->velocity);
  setup->cfl = CoracleCasePositive(c, "time.cfl");
  setup->dt_max = CoracleCasePositive(c, "time.dt_max");
  setup->capillary_cfl = CAPILLARY_CFL;
  if (CoracleCaseHas(c, "fluid.capillary_cfl"))
    setup->capillary_cfl = CoracleCasePositive(c, "fluid.capillary_cfl");
  PetscCall(PetscMalloc1(mesh->ntags, &setup->boundary));
  for (int b = 0; b < mesh->ntags; b++) ReadBoundary(c, mesh->tag_name[b], &names, setup->boundary + b);
  CoracleCaseKeys(c, "fluid.boundaries", CheckBoundaryName, &check);
  PetscCall(CheckFlux(c, mesh, setup->boundary));
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
  char option[256];
  PetscFunctionBeginUser;
  PetscCall(OptionsUnused(CoracleCaseStringOr(c, "fluid.petsc", ""), sizeof option, option));
  if (option[0]) CoracleCaseRefuse(c, "fluid.petsc", "no solver of the fluid has the option %s", option);
  PetscFunctionReturn(0);
}
