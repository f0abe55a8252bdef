#include "coupler/pressure_load.h"
#include "common/space/p2.h"
#include <stdlib.h>

/* H(p_s) and H(p_o) at a node; q and H(p_o) in an element. */
enum { SURFACE, OUTSIDE, NFIELDS };
enum { Q, LEVEL, NVALUES };

/* Conjugate gradients of H: residuals relative to the first ones. */
#define TOLERANCE 1e-9
enum { MAX_ITERATIONS = 1000 };

typedef struct {
  long long gid[3]; /* of the nodes, ascending */
  double value[NVALUES];
} Row;

typedef double Fields[NFIELDS];

struct PressureLoad_s {
  MPI_Comm comm;
  PetscBool has_mesh;
  int nnodes, nelements;
  int (*node)[3];           /* [nelements] */
  double (*gradient)[3][2]; /* [nelements] int_T grad N_i, m */
  double *area;             /* [nelements] m2 */
  Row *row, *attempt;       /* [nelements] as the step began, and as its last attempt has left it, Pa */
  double *diagonal;         /* [nnodes] of the Laplacian, summed over the ranks */
  Fields *h, *residual, *direction; /* [nnodes] */
  Fields *image;                    /* [nnodes] */
  char *counts, *is_free;           /* [nnodes] on this rank in sums over all nodes; H is found here */
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
  PetscCall(PetscFree5(l->node, l->gradient, l->area, l->row, l->attempt));
  PetscCall(PetscFree5(l->diagonal, l->h, l->residual, l->direction, l->image));
  PetscCall(PetscFree2(l->counts, l->is_free));
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
  l->has_mesh = PETSC_TRUE;
  l->nnodes = solid->nnodes;
  l->nelements = solid->nelements;
  PetscCall(PetscMalloc5(ne, &l->node, ne, &l->gradient, ne, &l->area, ne, &l->row, ne, &l->attempt));
  PetscCall(PetscMalloc5(n, &l->diagonal, n, &l->h, n, &l->residual, n, &l->direction, n, &l->image));
  PetscCall(PetscMalloc2(n, &l->counts, n, &l->is_free));
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
  if (!l->has_mesh) PetscCall(Allocate(l, solid));
  PetscCheck(l->nelements == solid->nelements && l->nnodes == solid->nnodes, PETSC_COMM_SELF, PETSC_ERR_SUP,
             "the solid has other elements than when it asked for the load of the pressure");
  for (int t = 0; t < l->nelements; t++) {
    const double *x[3];
    for (int i = 0; i < 3; i++) x[i] = solid->x + 2 * l->node[t][i];
    l->area[t] = 0.5 * GeometryTurn(x[0], x[1], x[2]);
    for (int i = 0; i < 3; i++) {
      const double *j = x[(i + 1) % 3], *k = x[(i + 2) % 3];
      l->gradient[t][i][0] = 0.5 * (j[1] - k[1]);
      l->gradient[t][i][1] = 0.5 * (k[0] - j[0]);
    }
  }
  PetscFunctionReturn(0);
}

/* --- the fluid's pressure ------------------------------------------------------------------------------- */

/* Sums over the pairs of a source triangle. */
enum { AREA, INSIDE, OUTER, NSUMS };

static double PressureAtCentre(const Overlap o, const SupermeshPair *pair, const double p[6])
{
  const SupermeshBasis *b = &o->basis[pair->b];
  double d[2], n[3];
  SupermeshCentreInB(pair, &o->source_basis[pair->a], b, d);
  for (int i = 1; i < 3; i++) n[i] = b->gradient[i - 1][0] * d[0] + b->gradient[i - 1][1] * d[1];
  n[0] = 1.0 - n[1] - n[2];
  return P2Evaluate(p, n);
}

static int OutermostVertex(const double x[3][2], const double normal[2])
{
  int outermost = 0;
  for (int i = 1; i < 3; i++)
    if (normal[0] * (x[i][0] - x[outermost][0]) + normal[1] * (x[i][1] - x[outermost][1]) > 0.0)
      outermost = i;
  return outermost;
}

/* owned[nowned][NSUMS]: area, int p and, of the shell, int p_o over what the fluid covers. */
static PetscErrorCode SumPairs(Overlap o, const double p[], double owned[][NSUMS])
{
  double(*source)[NSUMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nsources, &source));
  for (int k = 0; k < o->pairs.n; k++) {
    const SupermeshPair *pair = &o->pairs.pair[k];
    const SourceTriangle *t = &o->source[pair->a];
    const double *at = &p[6 * pair->b];
    double *s = source[pair->a];
    s[AREA] += pair->area;
    s[INSIDE] += pair->area * PressureAtCentre(o, pair, at);
    if (t->is_shell)
      s[OUTER] += pair->area * at[OutermostVertex((const double(*)[2])o->x[pair->b], t->normal)];
  }
  PetscCall(OverlapReverseAdd(o, NSUMS, (const double *)source, (double *)owned));
  PetscCall(PetscFree(source));
  PetscFunctionReturn(0);
}

/* p_s and p_o in h of the surface's nodes, 0 elsewhere; after SetDiagonal. */
static PetscErrorCode SurfaceValues(PressureLoad l, Overlap o, const double owned[][NSUMS])
{
  double(*node)[NSUMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(l->nnodes, &node));
  for (int t = o->nvolume; t < o->nowned; t++)
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < NSUMS; c++) node[o->node[t][i]][c] += owned[t][c];
  PetscCall(CopiesSum(o->nodes, NSUMS, (double *)node));
  for (int i = 0; i < l->nnodes; i++) {
    const double area = node[i][AREA];
    l->is_free[i] = area == 0.0 && l->diagonal[i] > 0.0;
    l->h[i][SURFACE] = area > 0.0 ? node[i][INSIDE] / area : 0.0;
    l->h[i][OUTSIDE] = area > 0.0 ? node[i][OUTER] / area : 0.0;
  }
  PetscCall(PetscFree(node));
  PetscFunctionReturn(0);
}

/* --- H -------------------------------------------------------------------------------------------------- */

/* image = K v, K the Laplacian's stiffness matrix; 0 at nodes that are not free. */
static PetscErrorCode ApplyLaplacian(PressureLoad l, Overlap o, const Fields v[], Fields image[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(image, l->nnodes));
  for (int t = 0; t < l->nelements; t++) {
    const double(*g)[2] = (const double(*)[2])l->gradient[t];
    const int *node = l->node[t];
    for (int c = 0; c < NFIELDS; c++) {
      double d[2] = {0.0, 0.0};
      for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) d[k] += g[i][k] * v[node[i]][c];
      for (int i = 0; i < 3; i++) image[node[i]][c] += (g[i][0] * d[0] + g[i][1] * d[1]) / l->area[t];
    }
  }
  PetscCall(CopiesSum(o->nodes, NFIELDS, (double *)image));
  for (int i = 0; i < l->nnodes; i++)
    for (int c = 0; c < NFIELDS && !l->is_free[i]; c++) image[i][c] = 0.0;
  PetscFunctionReturn(0);
}

static PetscErrorCode SetDiagonal(PressureLoad l, Overlap o)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(l->diagonal, l->nnodes));
  for (int t = 0; t < l->nelements; t++)
    for (int i = 0; i < 3; i++) {
      const double *g = l->gradient[t][i];
      l->diagonal[l->node[t][i]] += (g[0] * g[0] + g[1] * g[1]) / l->area[t];
    }
  PetscCall(CopiesSum(o->nodes, 1, l->diagonal));
  PetscCallMPI(MPI_Comm_rank(l->comm, &rank));
  for (int i = 0; i < l->nnodes; i++) l->counts[i] = CopiesOwner(o->nodes, i) == rank;
  PetscFunctionReturn(0);
}

/* sum[c] = a_c.b_c over all nodes, over the diagonal where by_diagonal. */
static PetscErrorCode Dot(const PressureLoad l, const Fields a[], const Fields b[], PetscBool by_diagonal,
                          double sum[NFIELDS])
{
  PetscFunctionBeginUser;
  for (int c = 0; c < NFIELDS; c++) sum[c] = 0.0;
  for (int i = 0; i < l->nnodes; i++)
    for (int c = 0; c < NFIELDS && l->counts[i] && l->is_free[i]; c++)
      sum[c] += a[i][c] * b[i][c] / (by_diagonal ? l->diagonal[i] : 1.0);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, NFIELDS, MPI_DOUBLE, MPI_SUM, l->comm));
  PetscFunctionReturn(0);
}

/* h at free nodes, where it is 0 so far, from the others: conjugate gradients with the diagonal, both fields at once. */
static PetscErrorCode SolveHarmonic(PressureLoad l, Overlap o)
{
  double rz[NFIELDS], first[NFIELDS], pq[NFIELDS], next[NFIELDS];

  PetscFunctionBeginUser;
  PetscCall(ApplyLaplacian(l, o, (const Fields *)l->h, l->residual));
  PetscCall(PetscArrayzero(l->direction, l->nnodes));
  for (int i = 0; i < l->nnodes; i++)
    for (int c = 0; c < NFIELDS; c++) {
      l->residual[i][c] = -l->residual[i][c];
      if (l->is_free[i]) l->direction[i][c] = l->residual[i][c] / l->diagonal[i];
    }
  PetscCall(Dot(l, (const Fields *)l->residual, (const Fields *)l->residual, PETSC_TRUE, rz));
  PetscCall(PetscArraycpy(first, rz, NFIELDS));
  for (int k = 0; k < MAX_ITERATIONS; k++) {
    PetscBool done = PETSC_TRUE;
    for (int c = 0; c < NFIELDS; c++)
      if (rz[c] > TOLERANCE * TOLERANCE * first[c]) done = PETSC_FALSE;
    if (done) break;
    PetscCall(ApplyLaplacian(l, o, (const Fields *)l->direction, l->image));
    PetscCall(Dot(l, (const Fields *)l->direction, (const Fields *)l->image, PETSC_FALSE, pq));
    for (int i = 0; i < l->nnodes; i++)
      for (int c = 0; c < NFIELDS && l->is_free[i]; c++) {
        const double alpha = pq[c] > 0.0 ? rz[c] / pq[c] : 0.0;
        l->h[i][c] += alpha * l->direction[i][c];
        l->residual[i][c] -= alpha * l->image[i][c];
      }
    PetscCall(Dot(l, (const Fields *)l->residual, (const Fields *)l->residual, PETSC_TRUE, next));
    for (int i = 0; i < l->nnodes; i++)
      for (int c = 0; c < NFIELDS && l->is_free[i]; c++)
        l->direction[i][c] =
            l->residual[i][c] / l->diagonal[i] + (rz[c] > 0.0 ? next[c] / rz[c] : 0.0) * l->direction[i][c];
    PetscCall(PetscArraycpy(rz, next, NFIELDS));
  }
  PetscFunctionReturn(0);
}

/* --- the load ------------------------------------------------------------------------------------------- */

/* force[nnodes][2] -= value int grad N_i of this rank's elements. */
static void AddLoad(const PressureLoad l, int value, double force[])
{
  for (int t = 0; t < l->nelements; t++)
    for (int i = 0; i < 3; i++)
      for (int d = 0; d < 2; d++)
        force[2 * l->node[t][i] + d] -= l->attempt[t].value[value] * l->gradient[t][i][d];
}

PetscErrorCode PressureLoadAdd(PressureLoad l, Overlap o, const double p[], double force[])
{
  double(*owned)[NSUMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nowned, &owned));
  PetscCall(SumPairs(o, p, owned));
  PetscCall(SetDiagonal(l, o));
  PetscCall(SurfaceValues(l, o, (const double(*)[NSUMS])owned));
  PetscCall(SolveHarmonic(l, o));
  for (int t = 0; t < l->nelements; t++) {
    double surface = 0.0, outside = 0.0;
    for (int i = 0; i < 3; i++) {
      surface += l->h[l->node[t][i]][SURFACE] / 3.0;
      outside += l->h[l->node[t][i]][OUTSIDE] / 3.0;
    }
    const double inside = owned[t][AREA] > 0.0 ? owned[t][INSIDE] / owned[t][AREA] : surface;
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
