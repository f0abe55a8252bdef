#include "solid/probes.h"
#include "common/link/case_key.h"
#include "common/output/output.h"
#include "common/program/run_case.h"
#include "common/supermesh/geometry.h"
#include "solid/point_in_body.h"
#include "solid/prescribed_motion.h"
#include <stdio.h>

enum { MAX_PROBES = 64, MAX_MOTIONS = 64, VALUES = 4, SUMS = VALUES + 1, REACTION = 4, CONTACT = 6 };
enum { COLUMNS = (MAX_PROBES + MAX_SPRINGS + MAX_MOTIONS + MAX_CONTACT_PROBES) * 380 };

struct Probes_s {
  MPI_Comm comm;
  Series series;
  int n, nsprings, nmotions, ncontacts;
  double point[MAX_PROBES][2];           /* m, at rest */
  char motion[MAX_MOTIONS][MOTION_NAME]; /* names of prescribed motions */
};

/* sum += displacement, velocity and 1 for each element of this rank that has the point at rest. */
static void AddElements(const SolidView *v, const double point[2], double sum[SUMS])
{
  for (int e = 0; e < v->nelements; e++) {
    double rest[3][2], weight[3];
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) rest[i][c] = v->rest[2 * v->element[3 * e + i] + c];
    GeometryBarycentric((const double(*)[2])rest, point, weight);
    if (fmin(weight[0], fmin(weight[1], weight[2])) < -POINT_ON_EDGE) continue;
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) {
        const int k = 2 * v->element[3 * e + i] + c;
        sum[c] += weight[i] * (v->x[k] - v->rest[k]);
        sum[2 + c] += weight[i] * v->v[k];
      }
    sum[VALUES] += 1.0;
  }
}

/* value[n][VALUES]; *missing: the first probe that no element has, or -1 */
static PetscErrorCode Values(Probes p, Solid s, double value[][VALUES], int *missing)
{
  double sum[MAX_PROBES][SUMS] = {{0.0}};
  SolidView v;
  PetscFunctionBeginUser;
  SolidGetView(s, &v);
  for (int k = 0; k < p->n; k++) AddElements(&v, p->point[k], sum[k]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, SUMS * p->n, MPI_DOUBLE, MPI_SUM, p->comm));
  *missing = -1;
  for (int k = p->n - 1; k >= 0; k--) {
    if (sum[k][VALUES] == 0.0) *missing = k;
    for (int i = 0; i < VALUES; i++) value[k][i] = sum[k][i] / sum[k][VALUES];
  }
  PetscFunctionReturn(0);
}

static const char *ReadName(CoracleCase c, const char *list, int k)
{
  char key[CASE_KEY];
  const char *name = CoracleCaseString(c, CaseKey(key, "%s[%d].name", list, k));
  if (!SeriesCanName(name))
    CoracleCaseRefuse(c, key, "expected a name of up to %d characters without commas and quotes",
                      SERIES_NAME_MAX);
  return name;
}

/* The name of item k, if it has one that is new. */
static void ReadMotionName(CoracleCase c, const char *list, int k, Probes p)
{
  char key[CASE_KEY];
  if (!CoracleCaseHas(c, CaseKey(key, "%s[%d].name", list, k))) return;
  const char *name = ReadName(c, list, k);
  for (int i = 0; i < p->nmotions; i++)
    if (!strcmp(p->motion[i], name)) return;
  if (p->nmotions == MAX_MOTIONS) CoracleCaseRefuse(c, key, "more than %d names of motions", MAX_MOTIONS);
  (void)snprintf(p->motion[p->nmotions++], MOTION_NAME, "%s", name);
}

static void ReadMotionNames(CoracleCase c, Probes p)
{
  const int nbodies = CoracleCaseCount(c, "solid.bodies");
  char list[CASE_KEY];
  for (int b = 0; b < nbodies; b++) {
    CaseKey(list, "solid.bodies[%d].prescribed", b);
    for (int k = 0; k < CoracleCaseCount(c, list); k++) ReadMotionName(c, list, k, p);
  }
}

/* The lists and their columns. */
static void ReadLists(CoracleCase c, Probes p, char columns[COLUMNS])
{
  char key[CASE_KEY];
  p->n = CoracleCaseCount(c, "solid.probes");
  p->nsprings = CoracleCaseCount(c, "solid.springs");
  if (p->n > MAX_PROBES) CoracleCaseRefuse(c, "solid.probes", "more than %d probes", MAX_PROBES);
  size_t used = (size_t)snprintf(columns, COLUMNS, "t [s]");
  for (int k = 0; k < p->n; k++) {
    CoracleCaseVector(c, CaseKey(key, "solid.probes[%d].point", k), 2, p->point[k]);
    const char *name = ReadName(c, "solid.probes", k);
    used += (size_t)snprintf(columns + used, COLUMNS - used, ",%s_x [m],%s_y [m],%s_u [m/s],%s_v [m/s]", name,
                             name, name, name);
  }
  for (int k = 0; k < p->nsprings; k++) {
    const char *name = ReadName(c, "solid.springs", k);
    used += (size_t)snprintf(columns + used, COLUMNS - used, ",%s_length [m],%s_tension [N/m]", name, name);
  }
  ReadMotionNames(c, p);
  for (int k = 0; k < p->nmotions; k++)
    used += (size_t)snprintf(columns + used, COLUMNS - used,
                             ",%s_force_x [N/m],%s_force_y [N/m],%s_moment [N],%s_power [W/m]", p->motion[k],
                             p->motion[k], p->motion[k], p->motion[k]);
  p->ncontacts = PetscMin(CoracleCaseCount(c, "solid.contact_probes"), MAX_CONTACT_PROBES);
  for (int k = 0; k < p->ncontacts; k++) {
    const char *name = ReadName(c, "solid.contact_probes", k);
    used += (size_t)snprintf(columns + used, COLUMNS - used,
                             ",%s_normal_x [N/m],%s_normal_y [N/m],%s_friction_x [N/m],%s_friction_y [N/m],"
                             "%s_place_x [m],%s_place_y [m]",
                             name, name, name, name, name, name);
  }
}

void ProbesCheckCase(CoracleCase c)
{
  struct Probes_s p = {.n = 0};
  char columns[COLUMNS];
  ReadLists(c, &p, columns);
}

/* The point of the bodies' sides at rest that is nearest to one that is in none: how far it is, m, the side's length, where. */
typedef struct {
  double distance, length, place[2];
} NearestSide;

static NearestSide NearestSideOf(const SolidView *v, const double point[2])
{
  NearestSide nearest = {.distance = HUGE_VAL};
  for (int k = 0; k < 3 * v->nelements; k++) {
    const double *a = v->rest + 2 * v->element[k], *b = v->rest + 2 * v->element[k % 3 == 2 ? k - 2 : k + 1],
                 s = GeometrySegmentPlace(a, b, point), distance = GeometryDistanceAt(a, b, s, point);
    if (distance >= nearest.distance) continue;
    nearest = (NearestSide){
        distance, hypot(b[0] - a[0], b[1] - a[1]), {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])}};
  }
  return nearest;
}

/* Collective: of all ranks. */
static PetscErrorCode Nearest(Probes p, Solid s, const double point[2], NearestSide *nearest)
{
  struct {
    double distance;
    int rank;
  } least;
  SolidView v;
  PetscFunctionBeginUser;
  SolidGetView(s, &v);
  *nearest = NearestSideOf(&v, point);
  least.distance = nearest->distance;
  PetscCallMPI(MPI_Comm_rank(p->comm, &least.rank));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, p->comm));
  PetscCallMPI(MPI_Bcast(nearest, sizeof *nearest, MPI_BYTE, least.rank, p->comm));
  PetscFunctionReturn(0);
}

/* A point that is in no body moves to the nearest side, or is refused if that is far. */
static PetscErrorCode CheckPoints(CoracleCase c, Probes p, Solid solid)
{
  char key[CASE_KEY];
  double value[MAX_PROBES][VALUES];
  NearestSide nearest;
  int missing;
  PetscFunctionBeginUser;
  for (int moved = 0;; moved++) {
    PetscCall(Values(p, solid, value, &missing));
    if (missing < 0) PetscFunctionReturn(0);
    double *point = p->point[missing];
    PetscCall(Nearest(p, solid, point, &nearest));
    if (!(nearest.distance <= POINT_NEAR * nearest.length) || moved == p->n)
      CoracleCaseRefuse(c, CaseKey(key, "solid.probes[%d].point", missing),
                        "no body is at (%g, %g) at rest; the nearest is %.3g m away", point[0], point[1],
                        nearest.distance);
    PetscCall(PetscArraycpy(point, nearest.place, 2));
  }
}

PetscErrorCode ProbesCheckPoints(CoracleCase c, MPI_Comm comm, Solid solid)
{
  struct Probes_s p = {.comm = comm};
  char columns[COLUMNS];
  PetscFunctionBeginUser;
  ReadLists(c, &p, columns);
  PetscCall(CheckPoints(c, &p, solid));
  PetscFunctionReturn(0);
}

PetscErrorCode ProbesCreate(CoracleCase c, MPI_Comm comm, Solid solid, Checkpoint from, Probes *probes)
{
  char columns[COLUMNS];
  RunCase run;
  Probes p;
  PetscFunctionBeginUser;
  *probes = NULL;
  PetscCall(PetscNew(&p));
  p->comm = comm;
  ReadLists(c, p, columns);
  if (p->n + p->nsprings + p->nmotions + p->ncontacts == 0) {
    PetscCall(PetscFree(p));
    PetscFunctionReturn(0);
  }
  PetscCall(CheckPoints(c, p, solid));
  RunCaseRead(c, &run);
  PetscCall(SeriesCreate(comm, run.folder, "solid_probes", columns, run.series_every, from, &p->series));
  *probes = p;
  PetscFunctionReturn(0);
}

PetscErrorCode ProbesDestroy(Probes *probes)
{
  PetscFunctionBeginUser;
  if (!*probes) PetscFunctionReturn(0);
  PetscCall(SeriesDestroy(&(*probes)->series));
  PetscCall(PetscFree(*probes));
  PetscFunctionReturn(0);
}

PetscErrorCode ProbesSave(Probes p, Checkpoint to)
{
  PetscFunctionBeginUser;
  if (p) PetscCall(SeriesSave(p->series, to));
  PetscFunctionReturn(0);
}

PetscErrorCode ProbesStep(Probes p, Solid solid)
{
  double
      row[1 + MAX_PROBES * VALUES + 2 * MAX_SPRINGS + REACTION * MAX_MOTIONS + CONTACT * MAX_CONTACT_PROBES],
      value[MAX_PROBES][VALUES];
  SpringState spring[MAX_SPRINGS];
  BodyContact contact[MAX_CONTACT_PROBES];
  int missing, n = 0;
  PetscFunctionBeginUser;
  if (!p) PetscFunctionReturn(0);
  PetscCall(Values(p, solid, value, &missing));
  row[n++] = SolidGetStats(solid)->t;
  for (int k = 0; k < p->n; k++)
    for (int i = 0; i < VALUES; i++) row[n++] = value[k][i];
  PetscCall(SolidSprings(solid, spring));
  for (int k = 0; k < p->nsprings; k++) {
    row[n++] = spring[k].length;
    row[n++] = spring[k].tension;
  }
  for (int k = 0; k < p->nmotions; k++, n += REACTION)
    PetscCall(SolidMotionReaction(solid, p->motion[k], &row[n]));
  PetscCall(SolidContactProbes(solid, contact));
  for (int k = 0; k < p->ncontacts; k++) {
    const double *const vector[] = {contact[k].normal, contact[k].friction, contact[k].place};
    for (int i = 0; i < CONTACT; i++) row[n++] = vector[i / 2][i % 2];
  }
  PetscCall(SeriesRow(p->series, row));
  PetscFunctionReturn(0);
}
