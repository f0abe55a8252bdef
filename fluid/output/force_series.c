#include "fluid/output/force_series.h"
#include "common/output/output.h"
#include "fluid/flow/budget.h"

static const char *const TERM[BUDGET_TERMS + 1] = {"weight",    "solid",      "correction", "divergence",
                                                   "interface", "absorption", "adaptation", "rest"},
                                             *const PART[FORCE_PARTS] = {"pressure", "viscous", "convection"};

struct ForceSeries_s {
  Series series;
  double *row;
};

/* Columns of a vector's two components. */
static void AddColumns(const char *name, const char *part, const char *unit, char **end)
{
  for (int c = 0; c < 2; c++)
    *end += sprintf(*end, ",%s%s%s %c [%s]", name, part ? " " : "", part ? part : "", "xy"[c], unit);
}

PetscErrorCode ForceSeriesCreate(const RunCase *run, Fluid fluid, Checkpoint from, ForceSeries *series)
{
  const Mesh *m = FluidMesh(fluid);
  const size_t nvectors = 2 + BUDGET_TERMS + 1 + FORCE_PARTS * (size_t)m->ntags;
  size_t longest = 32;
  char *columns, *end;
  ForceSeries s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  for (int b = 0; b < m->ntags; b++) longest = PetscMax(longest, strlen(m->tag_name[b]) + 32);
  PetscCall(PetscMalloc1(2 * nvectors * longest + 32, &columns));
  end = columns + sprintf(columns, "t [s],dt [s]");
  AddColumns("start momentum", NULL, "kg/s", &end);
  AddColumns("momentum", NULL, "kg/s", &end);
  for (int k = 0; k <= BUDGET_TERMS; k++) AddColumns(TERM[k], NULL, "N/m", &end);
  for (int b = 0; b < m->ntags; b++)
    for (int k = 0; k < FORCE_PARTS; k++) AddColumns(m->tag_name[b], PART[k], "N/m", &end);
  PetscCall(SeriesCreate(m->comm, run->folder, "fluid_forces", columns, run->series_every, from, &s->series));
  PetscCall(PetscFree(columns));
  PetscCall(PetscMalloc1(2 + 2 * nvectors, &s->row));
  *series = s;
  PetscFunctionReturn(0);
}

PetscErrorCode ForceSeriesSave(ForceSeries s, Checkpoint to)
{
  PetscFunctionBeginUser;
  PetscCall(SeriesSave(s->series, to));
  PetscFunctionReturn(0);
}

PetscErrorCode ForceSeriesStep(ForceSeries s, Fluid fluid)
{
  const FluidBudget *b = FluidGetBudget(fluid);
  double *next = s->row;
  PetscFunctionBeginUser;
  *next++ = FluidGetStats(fluid)->t;
  *next++ = b->dt;
  for (int c = 0; c < 2; c++) *next++ = b->start[c];
  for (int c = 0; c < 2; c++) *next++ = b->momentum[c];
  for (int k = 0; k < 2 * BUDGET_TERMS; k++) *next++ = b->term[k / 2][k % 2];
  for (int c = 0; c < 2; c++) *next++ = b->rest[c];
  for (int k = 0; k < FluidMesh(fluid)->ntags; k++) {
    PetscCall(PetscArraycpy(next, &b->boundary[k][0][0], 2 * FORCE_PARTS));
    next += 2 * FORCE_PARTS;
  }
  PetscCall(SeriesRow(s->series, s->row));
  PetscFunctionReturn(0);
}

PetscErrorCode ForceSeriesDestroy(ForceSeries *s)
{
  PetscFunctionBeginUser;
  if (!*s) PetscFunctionReturn(0);
  PetscCall(SeriesDestroy(&(*s)->series));
  PetscCall(PetscFree((*s)->row));
  PetscCall(PetscFree(*s));
  PetscFunctionReturn(0);
}
