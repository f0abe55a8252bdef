#include "fluid/input/boundary_case.h"

/* Fractions of what comes in. */
static void ReadFractions(CoracleCase c, const char *key, const PhaseNames *names, BoundaryPhases *b)
{
  char sub[224];
  double sum = 0.0;
  const int n = CoracleCaseCount(c, key);
  for (int k = 0; k < n; k++) {
    (void)snprintf(sub, sizeof sub, "%s[%d].phase", key, k);
    const int p = PhaseCaseIndex(c, sub, names);
    if (b->inflow[p] != 0.0) CoracleCaseRefuse(c, sub, "an item before this one is of the same phase");
    (void)snprintf(sub, sizeof sub, "%s[%d].value", key, k);
    sum += b->inflow[p] = CoracleCaseNumber(c, sub, 0.0, 1.0);
  }
  if (fabs(sum - 1.0) > 1e-9) CoracleCaseRefuse(c, key, "expected fractions whose sum is 1, found %g", sum);
}

/* With phases: which ones come in through a boundary, and the contact angles there. */
static void ReadPhases(CoracleCase c, const char *key, const PhaseNames *names, BoundaryPhases *b)
{
  char sub[192];
  if (!names->name[0]) return;
  (void)snprintf(sub, sizeof sub, "%s.contact_angle", key);
  PhaseCaseAngles(c, sub, names, &b->contact_cosine);
  (void)snprintf(sub, sizeof sub, "%s.phase", key);
  const PetscBool single = CoracleCaseHas(c, sub) ? PETSC_TRUE : PETSC_FALSE;
  if (single) b->inflow[PhaseCaseIndex(c, sub, names)] = 1.0;
  (void)snprintf(sub, sizeof sub, "%s.fractions", key);
  if (!CoracleCaseHas(c, sub)) return;
  if (single) CoracleCaseRefuse(c, sub, "expected phase or fractions, not both");
  ReadFractions(c, sub, names, b);
}

/* The layers of the list at key, from below. */
static void ReadLayers(CoracleCase c, const char *key, const PhaseNames *names, BoundaryPhases *b)
{
  char sub[224];
  b->nlevels = CoracleCaseCount(c, key);
  if (b->nlevels > PHASES_MAX) CoracleCaseRefuse(c, key, "expected at most %d layers", PHASES_MAX);
  for (int k = 0; k < b->nlevels; k++) {
    (void)snprintf(sub, sizeof sub, "%s[%d].phase", key, k);
    b->level_phase[k] = PhaseCaseIndex(c, sub, names);
    (void)snprintf(sub, sizeof sub, "%s[%d].height", key, k);
    b->level[k] = CoracleCaseNumber(c, sub, -HUGE_VAL, HUGE_VAL);
    if (k && !(b->level[k] > b->level[k - 1]))
      CoracleCaseRefuse(c, sub, "expected layers from below: more than %g, found %g", b->level[k - 1],
                        b->level[k]);
  }
}

static void ReadLevel(CoracleCase c, const char *key, const PhaseNames *names, const PhaseProperties *p,
                      BoundaryPhases *b)
{
  char first[200];
  double gravity[2];
  CoracleCaseVector(c, "gravity", 2, gravity);
  if (!names->name[0]) CoracleCaseRefuse(c, key, "there are no phases: expected fluid.phases");
  if (gravity[0] == 0.0 && gravity[1] == 0.0)
    CoracleCaseRefuse(c, key, "without gravity no side is up: expected a pressure instead, or a gravity");
  (void)snprintf(first, sizeof first, "%s[0]", key);
  if (CoracleCaseHas(c, first)) {
    ReadLayers(c, key, names, b);
    return;
  }
  b->nlevels = 1;
  b->level_phase[0] = PhaseHeaviest(p);
  b->level[0] = CoracleCaseNumber(c, key, -HUGE_VAL, HUGE_VAL);
}

/* How velocity or pressure depend on time. */
static void ReadVariation(CoracleCase c, const char *key, Boundary *b)
{
  char sub[192];
  (void)snprintf(sub, sizeof sub, "%s.rise", key);
  b->rise = CoracleCaseNumberOr(c, sub, 0.0, 0.0, HUGE_VAL);
  (void)snprintf(sub, sizeof sub, "%s.period", key);
  if (CoracleCaseHas(c, sub)) b->period = CoracleCasePositive(c, sub);
  (void)snprintf(sub, sizeof sub, "%s.factor", key);
  b->factor.width = 2;
  b->factor.row = CoracleCaseTable(c, sub, 2, &b->factor.nrows);
  if (!b->factor.nrows || b->period == 0.0) return;
  const double first = TimeTableAt(&b->factor, 0, 0), last = TimeTableAt(&b->factor, b->factor.nrows - 1, 0);
  if (first < 0.0 || last > b->period)
    CoracleCaseRefuse(c, sub, "expected times from 0 to the period, %g s, found %g to %g s", b->period, first,
                      last);
}

/* Whether it is open by a pressure or a level. */
static PetscBool ReadOpen(CoracleCase c, const char *key, const PhaseNames *names, const PhaseProperties *p,
                          Boundary *b)
{
  char level[192], pressure[192];
  (void)snprintf(level, sizeof level, "%s.level", key);
  (void)snprintf(pressure, sizeof pressure, "%s.pressure", key);
  const PetscBool has_level = CoracleCaseHas(c, level) ? PETSC_TRUE : PETSC_FALSE;
  if (!has_level && !CoracleCaseHas(c, pressure)) return PETSC_FALSE;
  b->kind = BOUNDARY_OPEN;
  if (has_level) {
    ReadLevel(c, level, names, p, &b->phases);
    b->pressure = CoracleCaseNumberOr(c, pressure, 0.0, -HUGE_VAL, HUGE_VAL);
  } else {
    b->pressure = CoracleCaseNumber(c, pressure, -HUGE_VAL, HUGE_VAL);
    ReadVariation(c, key, b);
  }
  return PETSC_TRUE;
}

static void ReadBoundary(CoracleCase c, const char *name, const PhaseNames *names, const PhaseProperties *p,
                         Boundary *b)
{
  static const char *const WORDS[] = {"no_slip", "free_slip", "open", NULL},
                           *const PROFILES[] = {"uniform", "parabolic", NULL},
                           *const WALLS[] = {"no_slip", "free_slip", NULL};
  static const BoundaryKind KINDS[] = {BOUNDARY_VELOCITY, BOUNDARY_FREE_SLIP, BOUNDARY_OPEN};
  char key[160], sub[192];
  memset(b, 0, sizeof *b);
  (void)snprintf(key, sizeof key, "fluid.boundaries.%s", name);
  ReadPhases(c, key, names, &b->phases);
  (void)snprintf(sub, sizeof sub, "%s.velocity", key);
  if (CoracleCaseHas(c, sub)) {
    b->kind = BOUNDARY_VELOCITY;
    CoracleCaseVector(c, sub, 2, b->velocity);
    (void)snprintf(sub, sizeof sub, "%s.profile", key);
    b->parabolic = (PetscBool)(CoracleCaseWord(c, sub, 0, PROFILES) == 1);
    ReadVariation(c, key, b);
    return;
  }
  if (ReadOpen(c, key, names, p, b)) return;
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

void BoundaryCaseCheckResumed(CoracleCase c, const Mesh *mesh, const char *folder)
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

/* Times, s, that show how what b prescribes depends on time: time[k] of k = 0 .. CheckTimes(b) - 1. */
static int CheckTimes(const Boundary *b)
{
  return 3 + b->factor.nrows;
}

static double CheckTime(const Boundary *b, int k)
{
  if (k < 3) return k == 0 ? 2.0 * b->rise : k == 1 ? 0.5 * b->rise : b->rise + 0.25 * b->period;
  return b->rise + TimeTableAt(&b->factor, k - 3, 0);
}

/* Without an open boundary what is prescribed must neither fill nor empty the domain, at any time. */
static PetscErrorCode CheckFlux(CoracleCase c, const Mesh *mesh, Boundary boundary[])
{
  double net, gross, largest[2] = {0.0, 0.0}, at = 0.0; /* of net, gross; when */
  PetscFunctionBeginUser;
  for (int b = 0; b < mesh->ntags; b++)
    if (boundary[b].kind == BOUNDARY_OPEN) PetscFunctionReturn(0);
  for (int b = 0; b < mesh->ntags; b++)
    for (int k = 0; k < CheckTimes(&boundary[b]); k++) {
      const double t = CheckTime(&boundary[b], k);
      PetscCall(BoundaryPrescribedFlux(mesh, boundary, t, &net, &gross));
      if (fabs(net) > fabs(largest[0])) {
        largest[0] = net;
        at = t;
      }
      largest[1] = PetscMax(largest[1], gross);
    }
  if (fabs(largest[0]) > 1e-6 * largest[1])
    CoracleCaseRefuse(
        c, "fluid.boundaries",
        "no boundary is open, and at %g s the prescribed velocities bring %g m2/s %s than they take out", at,
        fabs(largest[0]), largest[0] < 0.0 ? "more into the domain" : "less into the domain");
  PetscFunctionReturn(0);
}

PetscErrorCode BoundaryCaseRead(CoracleCase c, const Mesh *mesh, const PhaseNames *names,
                                const PhaseProperties *p, Boundary boundary[])
{
  BoundaryCheck check = {.c = c, .mesh = mesh};
  PetscFunctionBeginUser;
  for (int b = 0; b < mesh->ntags; b++) ReadBoundary(c, mesh->tag_name[b], names, p, boundary + b);
  CoracleCaseKeys(c, "fluid.boundaries", CheckBoundaryName, &check);
  PetscCall(CheckFlux(c, mesh, boundary));
  PetscFunctionReturn(0);
}
