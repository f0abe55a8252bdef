#include "fluid/input/boundary_case.h"
#include "common/program/gravity.h"

/* Fractions of what comes in. */
static void ReadFractions(CoracleCase c, const char *key, const PhaseNames *names, BoundaryPhases *b)
{
  char sub[CASE_KEY];
  double sum = 0.0;
  const int n = CoracleCaseCount(c, key);
  for (int k = 0; k < n; k++) {
    const int p = PhaseCaseIndex(c, CaseKey(sub, "%s[%d].phase", key, k), names);
    if (b->inflow[p] != 0.0) CoracleCaseRefuse(c, sub, "an item before this one is of the same phase");
    sum += b->inflow[p] = CoracleCaseNumber(c, CaseKey(sub, "%s[%d].value", key, k), 0.0, 1.0);
  }
  if (fabs(sum - 1.0) > 1e-9) CoracleCaseRefuse(c, key, "expected fractions whose sum is 1, found %g", sum);
  for (int p = 0; p < PHASES_MAX; p++) b->inflow[p] /= sum;
}

/* With phases: which ones come in through a boundary, and the contact angles there. */
static void ReadPhases(CoracleCase c, const char *key, const PhaseNames *names, BoundaryPhases *b)
{
  static const char *const FRACTIONS[] = {"fractions", NULL};
  char sub[CASE_KEY];
  if (!names->name[0]) return;
  CoracleCaseNotBeside(c, key, "phase", FRACTIONS);
  PhaseCaseAngles(c, CaseKey(sub, "%s.contact_angle", key), names, &b->contact_cosine);
  const PetscBool single = (PetscBool)CoracleCaseHas(c, CaseKey(sub, "%s.phase", key));
  if (single) b->inflow[PhaseCaseIndex(c, sub, names)] = 1.0;
  if (single || !CoracleCaseHas(c, CaseKey(sub, "%s.fractions", key))) return;
  ReadFractions(c, sub, names, b);
}

/* Rows of time (or place) and value; period, s: in which they repeat themselves, 0: they do not. */
static void ReadTable(CoracleCase c, const char *key, double period, TimeTable *table)
{
  table->width = 2;
  table->row = CoracleCaseTable(c, key, 2, &table->nrows);
  if (!table->nrows || period == 0.0) return;
  const double first = TimeTableAt(table, 0, 0), last = TimeTableAt(table, table->nrows - 1, 0);
  if (first < 0.0 || last > period)
    CoracleCaseRefuse(c, key, "expected times from 0 to the period, %g s, found %g to %g s", period, first,
                      last);
}

static double ReadPeriod(CoracleCase c, const char *key)
{
  char sub[CASE_KEY];
  return CoracleCaseHas(c, CaseKey(sub, "%s.period", key)) ? CoracleCasePositive(c, sub) : 0.0;
}

/* Of layer k: a number, or a table. */
static void ReadHeight(CoracleCase c, const char *key, int k, BoundaryPhases *b)
{
  char first[CASE_KEY];
  if (CoracleCaseHas(c, CaseKey(first, "%s[0]", key)))
    ReadTable(c, key, b->level_period, &b->level_table[k]);
  else
    b->level[k] = CoracleCaseNumber(c, key, -HUGE_VAL, HUGE_VAL);
}

/* Within a period. */
static double HeightOnce(const BoundaryPhases *b, int k, double t)
{
  return b->level_table[k].nrows ? TimeTableValue(&b->level_table[k], 1, t) : b->level[k];
}

/* Layer k lies above that below it at any time: at those of both tables' rows, between which they are linear. */
static void CheckAbove(CoracleCase c, const char *key, int k, const BoundaryPhases *b)
{
  for (int layer = k - 1; k > 0 && layer <= k; layer++) {
    const TimeTable *table = &b->level_table[layer];
    for (int row = 0; row < PetscMax(table->nrows, 1); row++) {
      const double t = table->nrows ? TimeTableAt(table, row, 0) : 0.0;
      const double below = HeightOnce(b, k - 1, t), height = HeightOnce(b, k, t);
      if (!(height > below))
        CoracleCaseRefuse(c, key, "expected layers from below: more than %g, found %g at %g s", below, height,
                          t);
    }
  }
}

/* The layers of the list at key, from below. */
static void ReadLayers(CoracleCase c, const char *key, const PhaseNames *names, BoundaryPhases *b)
{
  char sub[CASE_KEY];
  b->nlevels = CoracleCaseCount(c, key);
  if (b->nlevels > PHASES_MAX) CoracleCaseRefuse(c, key, "expected at most %d layers", PHASES_MAX);
  for (int k = 0; k < b->nlevels; k++) {
    b->level_phase[k] = PhaseCaseIndex(c, CaseKey(sub, "%s[%d].phase", key, k), names);
    ReadHeight(c, CaseKey(sub, "%s[%d].height", key, k), k, b);
    CheckAbove(c, sub, k, b);
  }
}

static void ReadLevel(CoracleCase c, const char *key, const PhaseNames *names, const PhaseProperties *p,
                      BoundaryPhases *b)
{
  char sub[CASE_KEY];
  double gravity[2];
  TimeTable table;
  GravityRead(c, gravity, &table);
  if (!names->name[0]) CoracleCaseRefuse(c, key, "there are no phases: expected fluid.phases");
  if (gravity[0] == 0.0 && gravity[1] == 0.0)
    CoracleCaseRefuse(c, key, "without gravity no side is up: expected a pressure instead, or a gravity");
  if (table.nrows)
    CoracleCaseRefuse(
        c, key,
        "with a gravity that depends on time levels outside would slope: expected a pressure instead");
  if (CoracleCaseHas(c, CaseKey(sub, "%s[0].phase", key)) ||
      CoracleCaseHas(c, CaseKey(sub, "%s[0].height", key))) {
    ReadLayers(c, key, names, b);
    return;
  }
  b->nlevels = 1;
  b->level_phase[0] = PhaseHeaviest(p);
  ReadHeight(c, key, 0, b);
}

/* How velocity or pressure depend on time. */
static void ReadVariation(CoracleCase c, const char *key, Boundary *b)
{
  char sub[CASE_KEY];
  b->rise = CoracleCaseNumberOr(c, CaseKey(sub, "%s.rise", key), 0.0, 0.0, HUGE_VAL);
  b->period = ReadPeriod(c, key);
  ReadTable(c, CaseKey(sub, "%s.factor", key), b->period, &b->factor);
}

/* Whether it is open by a pressure or a level. */
static PetscBool ReadOpen(CoracleCase c, const char *key, const PhaseNames *names, const PhaseProperties *p,
                          Boundary *b)
{
  char level[CASE_KEY], pressure[CASE_KEY], period[CASE_KEY];
  const PetscBool has_level = (PetscBool)CoracleCaseHas(c, CaseKey(level, "%s.level", key)),
                  has_pressure = (PetscBool)CoracleCaseHas(c, CaseKey(pressure, "%s.pressure", key));
  if (!has_level && !has_pressure) return PETSC_FALSE;
  b->kind = BOUNDARY_OPEN;
  if (has_level) {
    b->phases.level_period = ReadPeriod(c, key);
    ReadLevel(c, level, names, p, &b->phases);
    if (b->phases.level_period > 0.0 && !BoundaryVaries(b))
      CoracleCaseRefuse(c, CaseKey(period, "%s.period", key),
                        "the level is constant: expected rows of time and height, which repeat");
    b->pressure = CoracleCaseNumberOr(c, pressure, 0.0, -HUGE_VAL, HUGE_VAL);
  } else {
    b->pressure = CoracleCaseNumber(c, pressure, -HUGE_VAL, HUGE_VAL);
    ReadVariation(c, key, b);
  }
  return PETSC_TRUE;
}

/* Along the boundary: a word, or rows of place and factor. */
static void ReadProfile(CoracleCase c, const char *key, Boundary *b)
{
  static const char *const PROFILES[] = {"uniform", "parabolic", NULL};
  char first[CASE_KEY];
  if (CoracleCaseHas(c, CaseKey(first, "%s[0]", key)))
    ReadTable(c, key, 0.0, &b->profile);
  else
    b->parabolic = (PetscBool)(CoracleCaseWord(c, key, 0, PROFILES) == 1);
}

static void ReadBoundary(CoracleCase c, const char *name, const PhaseNames *names, const PhaseProperties *p,
                         Boundary *b)
{
  static const char *const WORDS[] = {"no_slip", "free_slip", "open", NULL};
  static const char *const WALLS[] = {"no_slip", "free_slip", NULL};
  static const BoundaryKind KINDS[] = {BOUNDARY_VELOCITY, BOUNDARY_FREE_SLIP, BOUNDARY_OPEN};
  static const char *const OPEN[] = {"level", "pressure", "wall", NULL}, *const *const WALL = OPEN + 2;
  char key[CASE_KEY], sub[CASE_KEY];
  memset(b, 0, sizeof *b);
  ReadPhases(c, CaseKey(key, "fluid.boundaries.%s", name), names, &b->phases);
  CoracleCaseNotBeside(c, key, "velocity", OPEN);
  CoracleCaseNotBeside(c, key, "level", WALL);
  CoracleCaseNotBeside(c, key, "pressure", WALL);
  if (CoracleCaseHas(c, CaseKey(sub, "%s.velocity", key))) {
    b->kind = BOUNDARY_VELOCITY;
    CoracleCaseVector(c, sub, 2, b->velocity);
    ReadProfile(c, CaseKey(sub, "%s.profile", key), b);
    ReadVariation(c, key, b);
    return;
  }
  if (ReadOpen(c, key, names, p, b)) return;
  b->kind = CoracleCaseHas(c, CaseKey(sub, "%s.wall", key)) ? KINDS[CoracleCaseWord(c, sub, -1, WALLS)]
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
  char known[512], key[CASE_KEY];
  if (MeshTagIndex(check->mesh, name) >= 0) return;
  MeshBoundaries(check->mesh, known);
  CoracleCaseRefuse(check->c, CaseKey(key, "fluid.boundaries.%s", name),
                    "the mesh has no boundary of this name; it has %s", known);
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
  const double time = fmax(TimeTableAt(&b->factor, k - 3, 0), 0.0);
  if (b->period == 0.0) return time;
  return time + b->period * ceil(b->rise / b->period); /* again, after the rise */
}

static int CompareTimes(const void *a, const void *b)
{
  const double d = *(const double *)a - *(const double *)b;
  return d < 0.0 ? -1 : d > 0.0;
}

/* Without an open boundary what is prescribed must neither fill nor empty the domain, at any time: looked for at the times of all boundaries and
 * between them. */
static PetscErrorCode CheckFlux(CoracleCase c, const Mesh *mesh, Boundary boundary[])
{
  double *time, largest[2] = {0.0, 0.0}, at = 0.0; /* of net, gross; when */
  int n = 0;
  PetscFunctionBeginUser;
  for (int b = 0; b < mesh->ntags; b++) {
    if (boundary[b].kind == BOUNDARY_OPEN) PetscFunctionReturn(0);
    n += CheckTimes(&boundary[b]);
  }
  PetscCall(PetscMalloc1(2 * n, &time));
  n = 0;
  for (int b = 0; b < mesh->ntags; b++)
    for (int k = 0; k < CheckTimes(&boundary[b]); k++) time[n++] = CheckTime(&boundary[b], k);
  qsort(time, (size_t)n, sizeof *time, CompareTimes);
  for (int k = 0; k + 1 < n; k++) time[n + k] = 0.5 * (time[k] + time[k + 1]);
  for (int k = 0; k < 2 * n - 1; k++) {
    double net, gross;
    if (k > 0 && time[k] == time[k - 1]) continue;
    PetscCall(BoundaryPrescribedFlux(mesh, boundary, time[k], &net, &gross));
    if (fabs(net) > fabs(largest[0])) {
      largest[0] = net;
      at = time[k];
    }
    largest[1] = PetscMax(largest[1], gross);
  }
  PetscCall(PetscFree(time));
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
  for (int b = 0; b < mesh->ntags; b++) {
    if (strpbrk(mesh->tag_name[b], ",\"\n"))
      CoracleCaseRefuse(c, "fluid.mesh.file", "boundary '%s': expected a name without commas and quotes",
                        mesh->tag_name[b]);
    ReadBoundary(c, mesh->tag_name[b], names, p, boundary + b);
  }
  CoracleCaseKeys(c, "fluid.boundaries", CheckBoundaryName, &check);
  PetscCall(CheckFlux(c, mesh, boundary));
  PetscFunctionReturn(0);
}
