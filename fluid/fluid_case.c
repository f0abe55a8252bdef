#include "fluid/fluid_case.h"
#include "common/mesh/mesh_checkpoint.h"
#include "common/output/options.h"
#include "common/supermesh/geometry.h"

/* --- mesh: a graded box, or a Gmsh file
 * ------------------------------------------------------------------------ */

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

static void CheckCount(Case c, const char *key, const double lower[2], const double upper[2], double size)
{
  const double count = 2.0 * (upper[0] - lower[0]) * (upper[1] - lower[1]) / (size * size);
  if (count > TRIANGLES_MAX)
    CaseRefuse(c, key, "cells of %g m make a mesh of about %.2g triangles, more than %g", size, count,
               TRIANGLES_MAX);
}

static void CheckRefined(Case c, int k, const RefinedBox *box, double size)
{
  char key[64];
  for (int i = 0; i < 2; i++) {
    if (box->at.lower[i] <= box->at.upper[i]) continue;
    (void)snprintf(key, sizeof key, "fluid.mesh.refine[%d].upper", k);
    CaseRefuse(c, key,
               "the box is empty: expected a corner above and right of lower (%g, %g), found (%g, %g)",
               box->at.lower[0], box->at.lower[1], box->at.upper[0], box->at.upper[1]);
  }
  (void)snprintf(key, sizeof key, "fluid.mesh.refine[%d].size", k);
  CheckCount(c, key, box->at.lower, box->at.upper, size);
}

static PetscErrorCode BoxMesh(Case c, PetscBool make, MeshSerial *serial)
{
  SizeField f = {0};
  double lower[2], upper[2];
  char key[64];
  PetscFunctionBeginUser;
  CaseVector(c, "fluid.mesh.lower", 2, lower);
  CaseVector(c, "fluid.mesh.upper", 2, upper);
  if (upper[0] <= lower[0] || upper[1] <= lower[1])
    CaseRefuse(c, "fluid.mesh.upper", "expected a corner above and right of lower (%g, %g), found (%g, %g)",
               lower[0], lower[1], upper[0], upper[1]);
  f.size_max = CasePositive(c, "fluid.mesh.size_max");
  CheckCount(c, "fluid.mesh.size_max", lower, upper, f.size_max);
  f.growth = CaseNumberOr(c, "fluid.mesh.growth", 0.25, 0.0, HUGE_VAL);
  f.n = CaseCount(c, "fluid.mesh.refine");
  PetscCall(PetscMalloc1(f.n, &f.box));
  for (int k = 0; k < f.n; k++) {
    (void)snprintf(key, sizeof key, "fluid.mesh.refine[%d].lower", k);
    CaseVector(c, key, 2, f.box[k].at.lower);
    (void)snprintf(key, sizeof key, "fluid.mesh.refine[%d].upper", k);
    CaseVector(c, key, 2, f.box[k].at.upper);
    (void)snprintf(key, sizeof key, "fluid.mesh.refine[%d].size", k);
    f.box[k].size = CasePositive(c, key);
    CheckRefined(c, k, &f.box[k], fmin(f.box[k].size, f.size_max));
  }
  if (make) PetscCall(MeshBox(lower, upper, f.size_max, SizeAt, &f, serial));
  PetscCall(PetscFree(f.box));
  PetscFunctionReturn(0);
}

/* The keys are read in any case. */
PetscErrorCode FluidCaseMesh(Case c, MPI_Comm comm, Checkpoint from, Mesh **mesh, PetscInt **row)
{
  MeshSerial serial = {0};
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  const PetscBool make = (PetscBool)(rank == 0 && !from);
  if (CaseHas(c, "fluid.mesh.file")) {
    const char *path = CaseFile(c, "fluid.mesh.file"), *why = NULL;
    if (make && MeshReadGmsh(path, &serial, &why)) CaseRefuse(c, "fluid.mesh.file", "%s", why);
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

/* --- boundaries
 * -------------------------------------------------------------------------------------------------- */

static void ReadBoundary(Case c, const char *name, Boundary *b)
{
  static const char *const WORDS[] = {"no_slip", "free_slip", "open", NULL}, *const PROFILES[] = {"uniform",
                                                                                                  "parabolic",
                                                                                                  NULL};
  static const BoundaryKind KINDS[] = {BOUNDARY_VELOCITY, BOUNDARY_FREE_SLIP, BOUNDARY_OPEN};
  char key[160], sub[192];
  memset(b, 0, sizeof *b);
  (void)snprintf(key, sizeof key, "fluid.boundaries.%s", name);
  (void)snprintf(sub, sizeof sub, "%s.velocity", key);
  if (CaseHas(c, sub)) {
    b->kind = BOUNDARY_VELOCITY;
    CaseVector(c, sub, 2, b->velocity);
    (void)snprintf(sub, sizeof sub, "%s.profile", key);
    b->parabolic = (PetscBool)(CaseWord(c, sub, 0, PROFILES) == 1);
    (void)snprintf(sub, sizeof sub, "%s.rise", key);
    b->rise = CaseNumberOr(c, sub, 0.0, 0.0, HUGE_VAL);
    return;
  }
  (void)snprintf(sub, sizeof sub, "%s.pressure", key);
  if (CaseHas(c, sub)) {
    b->kind = BOUNDARY_OPEN;
    b->pressure = CaseNumber(c, sub, -HUGE_VAL, HUGE_VAL);
    return;
  }
  b->kind = KINDS[CaseWord(c, key, -1, WORDS)];
}

/* The boundaries of the case file and those of the mesh. */
typedef struct {
  Case c;
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
  CaseRefuse(check->c, key, "the mesh has no boundary of this name; it has %s", known);
}

static void ListBoundaryName(void *context, const char *name)
{
  BoundaryCheck *check = context;
  check->nlisted++;
  check->nknown += MeshTagIndex(check->mesh, name) >= 0;
  AppendName(check->listed, name);
}

void FluidCaseCheckResumed(Case c, const Mesh *mesh, const char *folder)
{
  BoundaryCheck check = {.c = c, .mesh = mesh};
  char found[512];
  CaseKeys(c, "fluid.boundaries", ListBoundaryName, &check);
  if (check.nlisted == mesh->ntags && check.nknown == mesh->ntags) return;
  MeshBoundaries(mesh, found);
  CaseRefuse(c, "resume",
             "expected a mesh with the %d boundaries of fluid.boundaries (%s), found %d (%s) in %s/fluid.h5",
             check.nlisted, check.listed, mesh->ntags, found, folder);
}

/* Without an open boundary what is prescribed must neither fill nor empty the domain: in the end, and as it rises. */
static PetscErrorCode CheckFlux(Case c, const Mesh *mesh, Boundary boundary[])
{
  double net, gross, full;
  PetscFunctionBeginUser;
  for (int b = 0; b < mesh->ntags; b++)
    if (boundary[b].kind == BOUNDARY_OPEN) PetscFunctionReturn(0);
  PetscCall(FluidPrescribedFlux(mesh, boundary, HUGE_VAL, &net, &full));
  gross = full;
  for (int b = -1; b < mesh->ntags; b++) {
    if (b >= 0) PetscCall(FluidPrescribedFlux(mesh, boundary, 0.5 * boundary[b].rise, &net, &gross));
    if (fabs(net) > 1e-6 * full)
      CaseRefuse(c, "fluid.boundaries",
                 "no boundary is open, and the prescribed velocities bring %g m2/s %s than they take out%s",
                 fabs(net), net < 0.0 ? "more into the domain" : "less into the domain",
                 b < 0 ? "" : " as they rise");
  }
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCaseSetup(Case c, const Mesh *mesh, FluidSetup *setup)
{
  BoundaryCheck check = {.c = c, .mesh = mesh};
  PetscFunctionBeginUser;
  memset(setup, 0, sizeof *setup);
  setup->rho = CasePositive(c, "fluid.density");
  setup->mu = CasePositive(c, "fluid.viscosity");
  setup->theta = CaseNumberOr(c, "fluid.theta", 0.5, 0.5, 1.0);
  CaseVector(c, "gravity", 2, setup->gravity);
  setup->cfl = CasePositive(c, "time.cfl");
  setup->dt_max = CasePositive(c, "time.dt_max");
  PetscCall(PetscMalloc1(mesh->ntags, &setup->boundary));
  for (int b = 0; b < mesh->ntags; b++) ReadBoundary(c, mesh->tag_name[b], setup->boundary + b);
  CaseKeys(c, "fluid.boundaries", CheckBoundaryName, &check);
  PetscCall(CheckFlux(c, mesh, setup->boundary));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCaseAdaptation(Case c, PetscBool *adapts, AdaptationSetup *s)
{
  PetscFunctionBeginUser;
  *adapts = (PetscBool)CaseHas(c, "fluid.adapt");
  if (!*adapts) PetscFunctionReturn(0);
  s->size_min = CasePositive(c, "fluid.adapt.size_min");
  s->size_max = CasePositive(c, "fluid.adapt.size_max");
  if (s->size_max < s->size_min)
    CaseRefuse(c, "fluid.adapt.size_max", "expected at least fluid.adapt.size_min, %g, found %g", s->size_min,
               s->size_max);
  s->velocity_error = CasePositive(c, "fluid.adapt.velocity_error");
  s->growth = CaseNumberOr(c, "fluid.adapt.growth", 1.5, 1.01, 10.0);
  s->anisotropy = CaseNumberOr(c, "fluid.adapt.anisotropy", 5.0, 1.0, 1000.0);
  s->elements_max = CaseNumberOr(c, "fluid.adapt.elements_max", 200000.0, 100.0, 1e9);
  s->every = CaseIntegerOr(c, "fluid.adapt.every", 20, 1, 1000000);
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCaseCheckOptions(Case c)
{
  char option[256];
  PetscFunctionBeginUser;
  PetscCall(OptionsUnused(CaseStringOr(c, "fluid.petsc", ""), sizeof option, option));
  if (option[0]) CaseRefuse(c, "fluid.petsc", "no solver of the fluid has the option %s", option);
  PetscFunctionReturn(0);
}
