#include "coupler/force/pressure_load.h"
#include "coupler/force/surface_pressure.h"
#include "coupler/geometry/harmonic.h"
#include <stdlib.h>

/* H(p_s) and H(p_o) at a node; q and H(p_o) in an element. */
enum { SURFACE, OUTSIDE, NFIELDS };
enum { Q, LEVEL, NVALUES };

typedef struct {
  long long gid[3]; /* of the nodes, ascending */
  double value[NVALUES];
} Row;

struct PressureLoad_s {
  MPI_Comm comm;
  Harmonic harmonic; /* NULL: nothing is known of the solid yet */
  int nnodes, nelements;
  int (*node)[3];       /* [nelements] */
  double *x;            /* [nnodes][2] m */
  Row *row, *attempt;   /* [nelements] as the step began, and as its last attempt has left it, Pa */
  double (*h)[NFIELDS]; /* [nnodes] Pa */
  char *is_given;       /* [nnodes] h is p_s and p_o */
};

PetscErrorCode PressureLoadCreate(MPI_Comm comm, PressureLoad *load)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(load));
  (*load)->comm = comm;
  PetscFunctionReturn(0);
}

PetscErrorCode PressureLoadDestroy(PressureLoad *load)
{
  PressureLoad l = *load;

  PetscFunctionBeginUser;
  if (!l) PetscFunctionReturn(0);
  PetscCall(HarmonicDestroy(&l->harmonic));
  PetscCall(PetscFree3(l->node, l->row, l->attempt));
  PetscCall(PetscFree3(l->x, l->h, l->is_given));
  PetscCall(PetscFree(*load));
  PetscFunctionReturn(0);
}

/* --- the solid's mesh ----------------------------------------------------------------------------------- */

static int CompareIds(const void *a, const void *b)
{
  const long long x = *(const long long *)a, y = *(const long long *)b;
  return (x > y) - (x < y);
}

static PetscErrorCode Allocate(PressureLoad l, const SolidState *solid)
{
  const size_t n = (size_t)solid->nnodes, ne = (size_t)solid->nelements;

  PetscFunctionBeginUser;
  PetscCall(HarmonicCreate(l->comm, solid, &l->harmonic));
  l->nnodes = solid->nnodes;
  l->nelements = solid->nelements;
  PetscCall(PetscMalloc3(ne, &l->node, ne, &l->row, ne, &l->attempt));
  PetscCall(PetscMalloc3(2 * n, &l->x, n, &l->h, n, &l->is_given));
  PetscCall(PetscArrayzero(l->row, ne));
  for (size_t t = 0; t < ne; t++) {
    PetscCall(PetscArraycpy(l->node[t], solid->element + 3 * t, 3));
    for (int i = 0; i < 3; i++) l->row[t].gid[i] = solid->gid[l->node[t][i]];
    qsort(l->row[t].gid, 3, sizeof l->row[t].gid[0], CompareIds);
  }
  PetscCall(PetscArraycpy(l->attempt, l->row, ne));
  PetscFunctionReturn(0);
}

PetscErrorCode PressureLoadBuild(PressureLoad l, const SolidState *solid)
{
  PetscFunctionBeginUser;
  if (!l->harmonic) PetscCall(Allocate(l, solid));
  PetscCheck(l->nelements == solid->nelements && l->nnodes == solid->nnodes, PETSC_COMM_SELF, PETSC_ERR_SUP,
             "the solid has other elements than when it asked for the load of the pressure");
  PetscCall(PetscArraycpy(l->x, solid->x, 2 * l->nnodes));
  PetscFunctionReturn(0);
}

/* --- the load ------------------------------------------------------------------------------------------- */

/* force[nnodes][2] -= value int grad N_i of this rank's elements. */
static void AddLoad(const PressureLoad l, int value, double force[])
{
  for (int t = 0; t < l->nelements; t++)
    for (int i = 0; i < 3; i++) {
      const double *j = l->x + 2 * l->node[t][(i + 1) % 3], *k = l->x + 2 * l->node[t][(i + 2) % 3];
      const double half = 0.5 * l->attempt[t].value[value];
      force[2 * l->node[t][i]] -= half * (j[1] - k[1]);
      force[2 * l->node[t][i] + 1] -= half * (k[0] - j[0]);
    }
}

PetscErrorCode PressureLoadAdd(PressureLoad l, Overlap o, const double p[], double force[])
{
  double(*owned)[SURFACE_SUMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nowned, &owned));
  PetscCall(SurfacePressureSums(o, p, owned));
  PetscCall(SurfacePressureNodes(o, (const double(*)[SURFACE_SUMS])owned, l->nnodes, l->is_given, l->h));
  PetscCall(HarmonicSolve(l->harmonic, o->nodes, l->x, l->is_given, NFIELDS, (double *)l->h));
  for (int t = 0; t < l->nelements; t++) {
    double surface = 0.0, outside = 0.0;
    for (int i = 0; i < 3; i++) {
      surface += l->h[l->node[t][i]][SURFACE] / 3.0;
      outside += l->h[l->node[t][i]][OUTSIDE] / 3.0;
    }
    const double inside =
        owned[t][SURFACE_AREA] > 0.0 ? owned[t][SURFACE_INSIDE] / owned[t][SURFACE_AREA] : surface;
    const double *was = l->row[t].value;
    l->attempt[t].value[Q] = was[Q] + PRESSURE_LOAD_RISE * (inside - surface + outside - was[Q]);
    l->attempt[t].value[LEVEL] = was[LEVEL] + PRESSURE_LOAD_RISE * (outside - was[LEVEL]);
  }
  AddLoad(l, Q, force);
  PetscCall(PetscFree(owned));
  PetscFunctionReturn(0);
}

PetscErrorCode PressureLoadAccept(PressureLoad l, Overlap o, const double mobility[], double acceleration[])
{
  double *force;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(l->row, l->attempt, l->nelements));
  PetscCall(PetscCalloc1(2 * (size_t)l->nnodes, &force));
  AddLoad(l, LEVEL, force);
  PetscCall(CopiesSum(o->nodes, 2, force));
  for (int k = 0; k < 2 * l->nnodes; k++) acceleration[k] += mobility[k / 2] * force[k];
  PetscCall(PetscFree(force));
  PetscFunctionReturn(0);
}

/* --- checkpoints ---------------------------------------------------------------------------------------- */

static const char NODES[] = "pressure load nodes", VALUES[] = "pressure load";

static int CompareRows(const void *a, const void *b)
{
  const Row *p = a, *q = b;
  int order = 0;
  for (int i = 0; i < 3 && !order; i++) order = CompareIds(&p->gid[i], &q->gid[i]);
  return order;
}

PetscErrorCode PressureLoadSave(PressureLoad l, Checkpoint to)
{
  const size_t n = (size_t)l->nelements;
  long long(*gid)[3];
  double(*value)[NVALUES];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n, &gid, n, &value));
  for (size_t t = 0; t < n; t++) {
    PetscCall(PetscArraycpy(gid[t], l->row[t].gid, 3));
    PetscCall(PetscArraycpy(value[t], l->row[t].value, NVALUES));
  }
  PetscCall(CheckpointPutNumber(to, "has pressure load", 1.0));
  PetscCall(CheckpointPutIndices(to, NODES, l->nelements, 3, (const long long *)gid));
  PetscCall(CheckpointPutDoubles(to, VALUES, l->nelements, NVALUES, (const double *)value));
  PetscCall(PetscFree2(gid, value));
  PetscFunctionReturn(0);
}

PetscErrorCode PressureLoadLoad(PressureLoad l, const SolidState *solid, Checkpoint from)
{
  long long total, (*gid)[3];
  double(*value)[NVALUES];
  Row *row;

  PetscFunctionBeginUser;
  PetscCall(Allocate(l, solid));
  if (!CheckpointHasNumber(from, "has pressure load")) PetscFunctionReturn(0);
  PetscCall(CheckpointRows(from, VALUES, &total));
  const size_t n = (size_t)total;
  PetscCall(PetscMalloc3(n, &gid, n, &value, n, &row));
  PetscCall(CheckpointGetIndices(from, NODES, 0, (int)total, 3, (long long *)gid));
  PetscCall(CheckpointGetDoubles(from, VALUES, 0, (int)total, NVALUES, (double *)value));
  for (size_t t = 0; t < n; t++) {
    PetscCall(PetscArraycpy(row[t].gid, gid[t], 3));
    PetscCall(PetscArraycpy(row[t].value, value[t], NVALUES));
  }
  if (n) qsort(row, n, sizeof *row, CompareRows);
  for (int t = 0; t < l->nelements; t++) {
    const Row *found = n ? bsearch(&l->row[t], row, n, sizeof *row, CompareRows) : NULL;
    if (found) l->row[t] = *found;
  }
  PetscCall(PetscArraycpy(l->attempt, l->row, l->nelements));
  PetscCall(PetscFree3(gid, value, row));
  PetscFunctionReturn(0);
}
