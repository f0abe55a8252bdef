#include "solid/writer.h"
#include "common/link/coracle.h"
#include "common/output/output.h"
#include "common/program/run_case.h"
#include "solid/probes.h"
#include <stddef.h>
#include <stdio.h>

enum { MAX_BODIES = 1000, PER_BODY = 16, COMMON = 26 };

/* What the output has of a body, PER_BODY numbers: names of the columns of the series and of the field of the snapshots' points. */
typedef struct {
  const char *name; /* NULL: the points themselves */
  const char *column[2], *unit;
  size_t offset; /* of a BodyState */
  int n;
} BodyField;

static const BodyField BODY_FIELD[] = {
    {NULL, {"x", "y"}, "m", offsetof(BodyState, x), 2},
    {"velocity", {"u", "v"}, "m/s", offsetof(BodyState, v), 2},
    {"angular_velocity", {"omega"}, "rad/s", offsetof(BodyState, angular_velocity), 1},
    {"force", {"fx", "fy"}, "N/m", offsetof(BodyState, load), 2},
    {"moment", {"moment"}, "N", offsetof(BodyState, moment), 1},
    {"kinetic", {"kinetic"}, "J/m", offsetof(BodyState, kinetic), 1},
    {"strain", {"strain"}, "J/m", offsetof(BodyState, strain), 1},
    {"mass", {"mass"}, "kg/m", offsetof(BodyState, mass), 1},
    {"reaction", {"rx", "ry"}, "N/m", offsetof(BodyState, reaction), 2},
    {"angle", {"angle"}, "rad", offsetof(BodyState, angle), 1},
    {"contact", {"cx", "cy"}, "N/m", offsetof(BodyState, contact), 2}};
enum { BODY_FIELDS = sizeof BODY_FIELD / sizeof *BODY_FIELD };

static const double *BodyValues(const BodyState *body, const BodyField *f)
{
  return (const double *)((const char *)body + f->offset);
}

struct Writer_s {
  MPI_Comm comm;
  Output output;
  Series series;
  Probes probes; /* NULL: the case has none */
  int nbodies;   /* that the series has */
  int revision;  /* of the snapshots' grids */
  double start;  /* s, by the clock, as if runs that this one resumes from had been just before it; */
  double waited; /* s, theirs */
};

static PetscErrorCode CreateSeries(Writer r, const RunCase *run, Checkpoint from)
{
  const size_t size = (size_t)r->nbodies * 300 + 512;
  char *columns;
  size_t used;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(size, &columns));
  used = (size_t)snprintf(columns, size, "t [s]");
  for (int b = 0; b < r->nbodies; b++)
    for (const BodyField *f = BODY_FIELD; f < BODY_FIELD + BODY_FIELDS; f++)
      for (int i = 0; i < f->n; i++)
        used += (size_t)snprintf(columns + used, size - used, ",%s%d [%s]", f->column[i], b, f->unit);
  (void)snprintf(
      columns + used, size - used,
      ",fracture [J/m],debonded [J/m],broken joints,cracks [m],pieces,walls_x [N s/m],walls_y [N "
      "s/m],reaction_x [N s/m],"
      "reaction_y [N s/m],start_momentum_x [N s/m],start_momentum_y [N s/m],momentum_x [N "
      "s/m],momentum_y [N s/m],load_x [N/m],load_y "
      "[N/m],weight_x [N/m],weight_y [N/m],"
      "work [J/m],reaction work [J/m],contact loss [J/m],dt [s],substeps,dt_s [s],computing [s],waiting [s]");
  PetscCall(SeriesCreate(r->comm, run->folder, "solid", columns, run->series_every, from, &r->series));
  PetscCall(PetscFree(columns));
  PetscFunctionReturn(0);
}

static double Principal(const double t[3], double sign)
{
  return 0.5 * (t[0] + t[1]) + sign * hypot(0.5 * (t[0] - t[1]), t[2]);
}

/* Fields of the elements that are numbers. */
static PetscErrorCode CellFields(Writer r, Solid s, const SolidView *v, const double stress[])
{
  double *value;
  int *fragment, pieces;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)v->nelements, &value, (size_t)v->nelements, &fragment));
  for (int k = 0; k < 2; k++) { /* the larger and the smaller principal stress of the plane */
    for (int e = 0; e < v->nelements; e++) value[e] = Principal(stress + 3 * e, k ? -1.0 : 1.0);
    PetscCall(OutputField(r->output, k ? "principal_stress_2" : "principal_stress_1", OUTPUT_CELL, 1, value));
  }
  SolidEnergyDensity(s, value);
  PetscCall(OutputField(r->output, "strain_energy", OUTPUT_CELL, 1, value));
  for (int e = 0; e < v->nelements; e++) value[e] = v->body[e];
  PetscCall(OutputField(r->output, "body", OUTPUT_CELL, 1, value));
  PetscCall(SolidFragments(s, fragment, &pieces));
  for (int e = 0; e < v->nelements; e++) value[e] = fragment[e];
  PetscCall(OutputField(r->output, "fragment", OUTPUT_CELL, 1, value));
  SolidDamage(s, value);
  PetscCall(OutputField(r->output, "damage", OUTPUT_CELL, 1, value));
  PetscCall(PetscFree2(value, fragment));
  PetscFunctionReturn(0);
}

/* What a snapshot has of the nodes: those of this rank's elements (a rank also knows parts of split nodes that only
 * others' elements have). */
typedef struct {
  int n, *element;                     /* [nelements][3] */
  double *x, *velocity, *displacement; /* [n][2] */
} SnapshotFields;

static PetscErrorCode SnapshotFieldsCreate(const SolidView *v, SnapshotFields *w)
{
  const size_t most = 2 * (size_t)v->nnodes;
  int *number;
  PetscFunctionBeginUser;
  w->n = 0;
  PetscCall(PetscMalloc4(3 * (size_t)v->nelements, &w->element, most, &w->x, most, &w->velocity, most,
                         &w->displacement));
  PetscCall(PetscMalloc1((size_t)v->nnodes, &number));
  for (int i = 0; i < v->nnodes; i++) number[i] = -1;
  for (int k = 0; k < 3 * v->nelements; k++) number[v->element[k]] = 0;
  for (int i = 0; i < v->nnodes; i++) {
    if (number[i] < 0) continue;
    number[i] = w->n++;
    for (int c = 0; c < 2; c++) {
      const int from = 2 * i + c, to = 2 * number[i] + c;
      w->x[to] = v->x[from];
      w->velocity[to] = v->v[from];
      w->displacement[to] = v->x[from] - v->rest[from];
    }
  }
  for (int k = 0; k < 3 * v->nelements; k++) w->element[k] = number[v->element[k]];
  PetscCall(PetscFree(number));
  PetscFunctionReturn(0);
}

/* The mass centres of all bodies as points, with the body's numbers: the first rank's. */
static PetscErrorCode SnapshotBodies(Writer r, Solid s, int nbodies)
{
  PetscMPIInt rank;
  BodyState *state;
  double *value; /* [nbodies][2] */
  int *point;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(r->comm, &rank));
  const int n = rank == 0 ? nbodies : 0;
  PetscCall(PetscMalloc3((size_t)nbodies, &state, 2 * (size_t)nbodies, &value, (size_t)nbodies, &point));
  PetscCall(SolidBodies(s, nbodies, state));
  for (int b = 0; b < n; b++) {
    point[b] = b;
    PetscCall(PetscArraycpy(value + 2 * b, state[b].x, 2));
  }
  PetscCall(OutputGrid(r->output, "bodies", r->revision, n, value, n, 1, point));
  for (int k = 1; k < BODY_FIELDS; k++) {
    const BodyField *f = &BODY_FIELD[k];
    for (int b = 0; b < n; b++) PetscCall(PetscArraycpy(value + f->n * b, BodyValues(&state[b], f), f->n));
    PetscCall(OutputField(r->output, f->name, OUTPUT_NODE, f->n, value));
  }
  PetscCall(PetscFree3(state, value, point));
  PetscFunctionReturn(0);
}

static PetscErrorCode ContactField(Writer r, const char *name, int n, const BodyContact contact[],
                                   size_t offset, double value[])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) memcpy(value + 2 * k, (const char *)&contact[k] + offset, 2 * sizeof *value);
  PetscCall(OutputField(r->output, name, OUTPUT_NODE, 2, value));
  PetscFunctionReturn(0);
}

/* What bodies do to each other, and walls to them, as points where they touch: the first rank's. */
static PetscErrorCode SnapshotContacts(Writer r, Solid s)
{
  BodyContact *contact;
  double *value; /* [n][2] */
  int n, *point;
  PetscFunctionBeginUser;
  PetscCall(SolidContacts(s, &n, &contact));
  PetscCall(PetscMalloc2(2 * (size_t)n, &value, (size_t)n, &point));
  for (int k = 0; k < n; k++) {
    point[k] = k;
    PetscCall(PetscArraycpy(value + 2 * k, contact[k].place, 2));
  }
  PetscCall(OutputGrid(r->output, "contacts", r->revision, n, value, n, 1, point));
  PetscCall(ContactField(r, "normal_force", n, contact, offsetof(BodyContact, normal), value));
  PetscCall(ContactField(r, "friction_force", n, contact, offsetof(BodyContact, friction), value));
  for (int k = 0; k < n; k++) value[k] = contact[k].body;
  PetscCall(OutputField(r->output, "body", OUTPUT_NODE, 1, value));
  for (int k = 0; k < n; k++) value[k] = contact[k].other;
  PetscCall(OutputField(r->output, "other", OUTPUT_NODE, 1, value));
  PetscCall(PetscFree2(value, point));
  PetscCall(PetscFree(contact));
  PetscFunctionReturn(0);
}

static PetscErrorCode Snapshot(Writer r, Solid s)
{
  SolidView v;
  SnapshotFields w;
  double *stress;
  PetscFunctionBeginUser;
  SolidGetView(s, &v);
  PetscCall(SnapshotFieldsCreate(&v, &w));
  PetscCall(PetscMalloc1(3 * (size_t)v.nelements, &stress));
  SolidStress(s, stress);
  PetscCall(OutputBegin(r->output, SolidGetStats(s)->t));
  PetscCall(OutputGrid(r->output, "solid", r->revision, w.n, w.x, v.nelements, 3, w.element));
  PetscCall(OutputField(r->output, "velocity", OUTPUT_NODE, 2, w.velocity));
  PetscCall(OutputField(r->output, "displacement", OUTPUT_NODE, 2, w.displacement));
  PetscCall(OutputField(r->output, "stress", OUTPUT_CELL, 3, stress));
  PetscCall(CellFields(r, s, &v, stress));
  PetscCall(SnapshotBodies(r, s, v.nbodies));
  PetscCall(SnapshotContacts(r, s));
  r->revision++;
  PetscCall(OutputEnd(r->output));
  PetscCall(PetscFree(stress));
  PetscCall(PetscFree4(w.element, w.x, w.velocity, w.displacement));
  PetscFunctionReturn(0);
}

/* The first rank's seconds, which the series has. */
PetscErrorCode WriterSave(Writer r, double waited, Checkpoint to)
{
  double seconds[2] = {MPI_Wtime() - r->start, r->waited + waited};
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Bcast(seconds, 2, MPI_DOUBLE, 0, r->comm));
  PetscCall(CheckpointPutNumber(to, "writer seconds", seconds[0]));
  PetscCall(CheckpointPutNumber(to, "writer waited", seconds[1]));
  PetscCall(OutputSave(r->output, to));
  PetscCall(SeriesSave(r->series, to));
  PetscCall(ProbesSave(r->probes, to));
  PetscFunctionReturn(0);
}

static PetscErrorCode Load(Writer r, Checkpoint from)
{
  double seconds;
  PetscFunctionBeginUser;
  PetscCall(CheckpointGetNumber(from, "writer seconds", &seconds));
  PetscCall(CheckpointGetNumber(from, "writer waited", &r->waited));
  r->start -= seconds;
  PetscFunctionReturn(0);
}

PetscErrorCode WriterCreate(CoracleCase c, MPI_Comm comm, Solid solid, Checkpoint from, Writer *record)
{
  SolidView v;
  RunCase run;
  Writer r;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&r));
  SolidGetView(solid, &v);
  r->comm = comm;
  r->nbodies = PetscMin(v.nbodies, MAX_BODIES);
  r->start = MPI_Wtime();
  RunCaseRead(c, &run);
  PetscCall(OutputCreate(comm, run.folder, "solid", run.every, run.end, from, &r->output));
  PetscCall(OutputText(r->output, "case", CoracleCaseStringOr(c, "case", "")));
  PetscCall(OutputText(r->output, "version", CORACLE_VERSION));
  PetscCall(CreateSeries(r, &run, from));
  PetscCall(ProbesCreate(c, comm, solid, from, &r->probes));
  PetscCall(from ? Load(r, from) : Snapshot(r, solid));
  *record = r;
  PetscFunctionReturn(0);
}

PetscErrorCode WriterStep(Writer r, Solid s, double waited)
{
  const SolidStats *stats = SolidGetStats(s);
  FractureState fracture;
  SolidBudget budget;
  double *row;
  BodyState *state;
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(r->nbodies, &state, COMMON + PER_BODY * r->nbodies, &row));
  PetscCall(SolidBodies(s, r->nbodies, state));
  row[n++] = stats->t;
  for (int b = 0; b < r->nbodies; b++)
    for (const BodyField *f = BODY_FIELD; f < BODY_FIELD + BODY_FIELDS; f++)
      for (int i = 0; i < f->n; i++) row[n++] = BodyValues(&state[b], f)[i];
  PetscCall(SolidFracture(s, &fracture));
  row[n++] = fracture.energy;
  row[n++] = fracture.debonded;
  row[n++] = fracture.broken;
  row[n++] = fracture.length;
  row[n++] = fracture.pieces;
  PetscCall(SolidGetBudget(s, &budget));
  const double *const vector[] = {budget.walls,    budget.reaction, budget.start,
                                  budget.momentum, budget.load,     budget.weight};
  for (int k = 0; k < 12; k++) row[n++] = vector[k / 2][k % 2];
  row[n++] = budget.work;
  row[n++] = budget.reaction_work;
  row[n++] = budget.contact_loss;
  row[n++] = stats->dt;
  row[n++] = stats->substeps;
  row[n++] = stats->h;
  waited += r->waited;
  row[n++] = MPI_Wtime() - r->start - waited;
  row[n++] = waited;
  PetscCall(SeriesRow(r->series, row));
  PetscCall(PetscFree2(state, row));
  PetscCall(ProbesStep(r->probes, s));
  if (OutputDue(r->output, stats->t)) PetscCall(Snapshot(r, s));
  PetscFunctionReturn(0);
}

PetscErrorCode WriterDestroy(Writer *r)
{
  PetscFunctionBeginUser;
  if (!*r) PetscFunctionReturn(0);
  PetscCall(OutputDestroy(&(*r)->output));
  PetscCall(SeriesDestroy(&(*r)->series));
  PetscCall(ProbesDestroy(&(*r)->probes));
  PetscCall(PetscFree(*r));
  PetscFunctionReturn(0);
}
