#include "coupler/geometry/harmonic.h"
#include "common/supermesh/geometry.h"
#include <petscpc.h>

#define TOLERANCE 1e-10
/* What the factor's diagonal has more, so that there is one where a body has no given node. */
#define SHIFT 1e-10
enum { N = HARMONIC_FIELDS, MAX_ITERATIONS = 1000 };

typedef double Fields[N];

struct Harmonic_s {
  MPI_Comm comm;
  int nnodes, nelements;
  int (*node)[3];                    /* [nelements] */
  double (*stiffness)[3];            /* [nelements] K_01, K_12, K_20 */
  double *diagonal;                  /* [nnodes] K_ii, summed over the ranks */
  char *counts, *is_free, *was_free; /* [nnodes] in sums on this rank; now, and in the factor */
  Fields *residual, *corrected, *direction, *image; /* [nnodes] */
  Mat matrix; /* this rank's part of K with the whole diagonal; NULL: none yet */
  PC factor;
  Vec right, left;
};

PetscErrorCode HarmonicCreate(MPI_Comm comm, const SolidState *solid, Harmonic *harmonic)
{
  const size_t n = (size_t)solid->nnodes, ne = (size_t)solid->nelements;
  Harmonic h;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&h));
  h->comm = comm;
  h->nnodes = solid->nnodes;
  h->nelements = solid->nelements;
  PetscCall(PetscMalloc3(ne, &h->node, ne, &h->stiffness, n, &h->diagonal));
  PetscCall(PetscMalloc3(n, &h->counts, n, &h->is_free, n, &h->was_free));
  PetscCall(PetscCalloc4(n, &h->residual, n, &h->corrected, n, &h->direction, n, &h->image));
  for (size_t t = 0; t < ne; t++) PetscCall(PetscArraycpy(h->node[t], solid->element + 3 * t, 3));
  *harmonic = h;
  PetscFunctionReturn(0);
}

static PetscErrorCode FreeFactor(Harmonic h)
{
  PetscFunctionBeginUser;
  PetscCall(PCDestroy(&h->factor));
  PetscCall(MatDestroy(&h->matrix));
  PetscCall(VecDestroy(&h->right));
  PetscCall(VecDestroy(&h->left));
  PetscFunctionReturn(0);
}

PetscErrorCode HarmonicDestroy(Harmonic *harmonic)
{
  Harmonic h = *harmonic;

  PetscFunctionBeginUser;
  if (!h) PetscFunctionReturn(0);
  PetscCall(FreeFactor(h));
  PetscCall(PetscFree3(h->node, h->stiffness, h->diagonal));
  PetscCall(PetscFree3(h->counts, h->is_free, h->was_free));
  PetscCall(PetscFree4(h->residual, h->corrected, h->direction, h->image));
  PetscCall(PetscFree(*harmonic));
  PetscFunctionReturn(0);
}

/* --- the matrix ----------------------------------------------------------------------------------------- */

static PetscErrorCode SetStiffness(Harmonic h, Copies nodes, const double x[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(h->diagonal, h->nnodes));
  for (int t = 0; t < h->nelements; t++) {
    const int *node = h->node[t];
    double edge[3][2]; /* opposite to each vertex */
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) edge[i][c] = x[2 * node[(i + 2) % 3] + c] - x[2 * node[(i + 1) % 3] + c];
    const double area = 0.5 * GeometryTurn(&x[2 * node[0]], &x[2 * node[1]], &x[2 * node[2]]);
    for (int i = 0; i < 3; i++) {
      const double *a = edge[i], *b = edge[(i + 1) % 3], k = (a[0] * b[0] + a[1] * b[1]) / (4.0 * area);
      h->stiffness[t][i] = k;
      h->diagonal[node[i]] -= k;
      h->diagonal[node[(i + 1) % 3]] -= k;
    }
  }
  PetscCall(CopiesSum(nodes, 1, h->diagonal));
  PetscFunctionReturn(0);
}

/* image = K v at free nodes, else 0. */
static PetscErrorCode Apply(Harmonic h, Copies nodes, const Fields v[], Fields image[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(image, h->nnodes));
  for (int t = 0; t < h->nelements; t++)
    for (int i = 0; i < 3; i++) {
      const int a = h->node[t][i], b = h->node[t][(i + 1) % 3];
      for (int c = 0; c < N; c++) {
        const double flux = h->stiffness[t][i] * (v[b][c] - v[a][c]);
        image[a][c] += flux;
        image[b][c] -= flux;
      }
    }
  PetscCall(CopiesSum(nodes, N, (double *)image));
  for (int i = 0; i < h->nnodes; i++)
    for (int c = 0; c < N && !h->is_free[i]; c++) image[i][c] = 0.0;
  PetscFunctionReturn(0);
}

/* Which nodes the matrix couples: of each element its three edges both ways, then the diagonal. */
static PetscErrorCode SetPattern(Harmonic h)
{
  const int n = 6 * h->nelements + h->nnodes;
  PetscInt *row, *column;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n, &row, n, &column));
  for (int k = 0; k < 6 * h->nelements; k++) {
    const int *node = h->node[k / 6], i = k % 6 / 2;
    row[k] = node[(i + k % 2) % 3];
    column[k] = node[(i + 1 - k % 2) % 3];
  }
  for (int i = 0; i < h->nnodes; i++) row[6 * h->nelements + i] = column[6 * h->nelements + i] = i;
  PetscCall(MatCreate(PETSC_COMM_SELF, &h->matrix));
  PetscCall(MatSetSizes(h->matrix, h->nnodes, h->nnodes, h->nnodes, h->nnodes));
  PetscCall(MatSetType(h->matrix, MATSEQAIJ));
  PetscCall(MatSetPreallocationCOO(h->matrix, n, row, column));
  PetscCall(PetscFree2(row, column));
  PetscFunctionReturn(0);
}

static PetscErrorCode Factor(Harmonic h)
{
  double *value;

  PetscFunctionBeginUser;
  PetscCall(FreeFactor(h));
  PetscCall(SetPattern(h));
  PetscCall(PetscMalloc1(6 * (size_t)h->nelements + (size_t)h->nnodes, &value));
  for (int k = 0; k < 6 * h->nelements; k++) {
    const int *node = h->node[k / 6], i = k % 6 / 2;
    value[k] = h->is_free[node[i]] && h->is_free[node[(i + 1) % 3]] ? h->stiffness[k / 6][i] : 0.0;
  }
  for (int i = 0; i < h->nnodes; i++)
    value[6 * h->nelements + i] = h->is_free[i] ? (1.0 + SHIFT) * h->diagonal[i] : 1.0;
  PetscCall(MatSetValuesCOO(h->matrix, value, INSERT_VALUES));
  PetscCall(PetscFree(value));
  PetscCall(MatSetOption(h->matrix, MAT_SPD, PETSC_TRUE));
  PetscCall(MatCreateVecs(h->matrix, &h->right, &h->left));
  PetscCall(PCCreate(PETSC_COMM_SELF, &h->factor));
  PetscCall(PCSetType(h->factor, PCCHOLESKY));
  PetscCall(PCFactorSetMatOrderingType(h->factor, MATORDERINGND));
  PetscCall(PCSetOperators(h->factor, h->matrix, h->matrix));
  PetscCall(PCSetUp(h->factor));
  PetscCall(PetscArraycpy(h->was_free, h->is_free, h->nnodes));
  PetscFunctionReturn(0);
}

/* --- conjugate gradients -------------------------------------------------------------------------------- */

/* sum[c] = a_c.b_c over the nodes of all ranks. */
static PetscErrorCode Dot(const Harmonic h, const Fields a[], const Fields b[], double sum[N])
{
  PetscFunctionBeginUser;
  for (int c = 0; c < N; c++) sum[c] = 0.0;
  for (int i = 0; i < h->nnodes; i++)
    for (int c = 0; c < N && h->counts[i]; c++) sum[c] += a[i][c] * b[i][c];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, N, MPI_DOUBLE, MPI_SUM, h->comm));
  PetscFunctionReturn(0);
}

/* corrected = the sum over the ranks of their factors' solutions for residual; rz = residual.corrected */
static PetscErrorCode Precondition(Harmonic h, Copies nodes, double rz[N])
{
  PetscFunctionBeginUser;
  for (int c = 0; c < N; c++) {
    double *right;
    const double *left;
    PetscCall(VecGetArrayWrite(h->right, &right));
    for (int i = 0; i < h->nnodes; i++) right[i] = h->residual[i][c];
    PetscCall(VecRestoreArrayWrite(h->right, &right));
    PetscCall(PCApply(h->factor, h->right, h->left));
    PetscCall(VecGetArrayRead(h->left, &left));
    for (int i = 0; i < h->nnodes; i++) h->corrected[i][c] = left[i];
    PetscCall(VecRestoreArrayRead(h->left, &left));
  }
  PetscCall(CopiesSum(nodes, N, (double *)h->corrected));
  PetscCall(Dot(h, (const Fields *)h->residual, (const Fields *)h->corrected, rz));
  PetscFunctionReturn(0);
}

/* From value, and its first residual; a field that has converged stays. */
static PetscErrorCode Iterate(Harmonic h, Copies nodes, Fields value[])
{
  double rz[N], next[N], first[N], pq[N];

  PetscFunctionBeginUser;
  PetscCall(Precondition(h, nodes, rz));
  PetscCall(PetscArraycpy(first, rz, N));
  PetscCall(PetscArraycpy(h->direction, h->corrected, h->nnodes));
  for (int k = 0; k < MAX_ITERATIONS; k++) {
    double step[N];
    if (rz[0] <= TOLERANCE * TOLERANCE * first[0] && rz[1] <= TOLERANCE * TOLERANCE * first[1]) break;
    PetscCall(Apply(h, nodes, (const Fields *)h->direction, h->image));
    PetscCall(Dot(h, (const Fields *)h->direction, (const Fields *)h->image, pq));
    for (int c = 0; c < N; c++) step[c] = pq[c] > 0.0 ? rz[c] / pq[c] : 0.0;
    for (int i = 0; i < h->nnodes; i++)
      for (int c = 0; c < N; c++) {
        value[i][c] += step[c] * h->direction[i][c];
        h->residual[i][c] -= step[c] * h->image[i][c];
      }
    PetscCall(Precondition(h, nodes, next));
    for (int c = 0; c < N; c++) step[c] = rz[c] > 0.0 ? next[c] / rz[c] : 0.0;
    for (int i = 0; i < h->nnodes; i++)
      for (int c = 0; c < N; c++) h->direction[i][c] = h->corrected[i][c] + step[c] * h->direction[i][c];
    PetscCall(PetscArraycpy(rz, next, N));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode HarmonicSolve(Harmonic h, Copies nodes, const double x[], const char is_given[],
                             Fields value[])
{
  PetscFunctionBeginUser;
  PetscCall(SetStiffness(h, nodes, x));
  for (int i = 0; i < h->nnodes; i++) {
    h->is_free[i] = !is_given[i] && h->diagonal[i] > 0.0;
    h->counts[i] = CopiesIsFirst(nodes, i);
    for (int c = 0; c < N && !is_given[i]; c++) value[i][c] = 0.0;
  }
  if (!h->matrix || memcmp(h->is_free, h->was_free, (size_t)h->nnodes)) PetscCall(Factor(h));
  PetscCall(Apply(h, nodes, (const Fields *)value, h->residual));
  for (int i = 0; i < h->nnodes; i++)
    for (int c = 0; c < N; c++) h->residual[i][c] = -h->residual[i][c];
  PetscCall(Iterate(h, nodes, value));
  PetscFunctionReturn(0);
}
