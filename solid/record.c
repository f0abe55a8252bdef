#include "record.h"
#include "output.h"
#include <stdio.h>

enum { MAX_BODIES = 8, PER_BODY = 10, COMMON = 5 };

struct Record_s {
  MPI_Comm comm;
  Output output;
  Series series;
  int nbodies, revision;
  double every, next, start;
  double *displacement, *stress, *cell; /* [nnodes][2], [nelements][3], [nelements] */
};

static PetscErrorCode CreateSeries(Record r, const char *folder)
{
  char columns[MAX_BODIES * 160 + 160] = "t [s]";
  PetscFunctionBeginUser;
  for (int b = 0; b < r->nbodies; b++) {
    const size_t used = strlen(columns);
    (void)snprintf(
        columns + used, sizeof columns - used,
        ",x%d [m],y%d [m],u%d [m/s],v%d [m/s],omega%d [rad/s],fx%d [N/m],fy%d [N/m],kinetic%d [J/m],"
        "strain%d [J/m],mass%d [kg/m]",
        b, b, b, b, b, b, b, b, b, b);
  }
  const size_t used = strlen(columns);
  (void)snprintf(columns + used, sizeof columns - used, ",substeps,dt_s [s],computing [s],waiting [s]");
  PetscCall(SeriesCreate(r->comm, folder, "solid", columns, &r->series));
  PetscFunctionReturn(0);
}

static double Principal(const double t[3], double sign)
{
  return 0.5 * (t[0] + t[1]) + sign * hypot(0.5 * (t[0] - t[1]), t[2]);
}

static PetscErrorCode Snapshot(Record r, Solid s)
{
  SolidView v;
  PetscFunctionBeginUser;
  SolidGetView(s, &v);
  for (int i = 0; i < 2 * v.nnodes; i++) r->displacement[i] = v.x[i] - v.rest[i];
  SolidStress(s, r->stress);
  PetscCall(OutputBegin(r->output, SolidGetStats(s)->t));
  PetscCall(OutputGrid(r->output, "solid", r->revision++, v.nnodes, v.x, v.nelements, 3, v.element));
  PetscCall(OutputField(r->output, "velocity", OUTPUT_NODE, 2, v.v));
  PetscCall(OutputField(r->output, "displacement", OUTPUT_NODE, 2, r->displacement));
  PetscCall(OutputField(r->output, "stress", OUTPUT_CELL, 3, r->stress));
  for (int k = 0; k < 2; k++) { /* the larger and the smaller principal stress of the plane */
    for (int e = 0; e < v.nelements; e++) r->cell[e] = Principal(r->stress + 3 * e, k ? -1.0 : 1.0);
    PetscCall(
        OutputField(r->output, k ? "principal_stress_2" : "principal_stress_1", OUTPUT_CELL, 1, r->cell));
  }
  SolidEnergyDensity(s, r->cell);
  PetscCall(OutputField(r->output, "strain_energy", OUTPUT_CELL, 1, r->cell));
  for (int e = 0; e < v.nelements; e++) r->cell[e] = v.body[e];
  PetscCall(OutputField(r->output, "body", OUTPUT_CELL, 1, r->cell));
  PetscCall(OutputEnd(r->output));
  r->next += r->every;
  PetscFunctionReturn(0);
}

PetscErrorCode RecordCreate(Case c, MPI_Comm comm, Solid solid, Record *record)
{
  const char *folder = CaseString(c, "output.folder");
  SolidView v;
  Record r;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&r));
  SolidGetView(solid, &v);
  r->comm = comm;
  r->nbodies = PetscMin(v.nbodies, MAX_BODIES);
  r->every = CasePositive(c, "output.every");
  r->start = MPI_Wtime();
  PetscCall(PetscMalloc3(2 * (size_t)v.nnodes, &r->displacement, 3 * (size_t)v.nelements, &r->stress,
                         (size_t)v.nelements, &r->cell));
  PetscCall(OutputCreate(comm, folder, "solid", &r->output));
  PetscCall(CreateSeries(r, folder));
  PetscCall(Snapshot(r, solid));
  *record = r;
  PetscFunctionReturn(0);
}

PetscErrorCode RecordStep(Record r, Solid s, double waited)
{
  const SolidStats *stats = SolidGetStats(s);
  BodyState state[MAX_BODIES];
  double row[COMMON + MAX_BODIES * PER_BODY];
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(SolidBodies(s, r->nbodies, state));
  row[n++] = stats->t;
  for (int b = 0; b < r->nbodies; b++) {
    const BodyState *k = &state[b];
    const double value[PER_BODY] = {k->x[0],    k->x[1],    k->v[0],    k->v[1],   k->angular_velocity,
                                    k->load[0], k->load[1], k->kinetic, k->strain, k->mass};
    for (int i = 0; i < PER_BODY; i++) row[n++] = value[i];
  }
  row[n++] = stats->substeps;
  row[n++] = stats->h;
  row[n++] = MPI_Wtime() - r->start - waited;
  row[n++] = waited;
  PetscCall(SeriesRow(r->series, row));
  if (stats->t >= r->next * (1.0 - 1e-12)) PetscCall(Snapshot(r, s));
  PetscFunctionReturn(0);
}

PetscErrorCode RecordDestroy(Record *r)
{
  PetscFunctionBeginUser;
  if (!*r) PetscFunctionReturn(0);
  PetscCall(OutputDestroy(&(*r)->output));
  PetscCall(SeriesDestroy(&(*r)->series));
  PetscCall(PetscFree3((*r)->displacement, (*r)->stress, (*r)->cell));
  PetscCall(PetscFree(*r));
  PetscFunctionReturn(0);
}
