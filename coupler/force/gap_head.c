#include "coupler/force/gap_head.h"
#include <petscksp.h>

#define TOLERANCE 1e-10
/* What the preconditioner's diagonal has more, so that there is a factor where nothing is given. */
#define SHIFT 1e-10

enum { N = SURFACE_HEAD_FIELDS, ENDS = 4 };

/* What is known of a node: its row, -1 where its value is given, and that value. */
typedef struct {
  double row, value[N];
} End;

static const End NO_END = {.row = -1.0};

/* conductance (sum of weight_i v_i)^2 */
typedef struct {
  double conductance, weight[ENDS];
  End end[ENDS];
} Link;

typedef struct {
  int n, nrows, nall; /* rows: of this rank, of all */
  Link *link;
  int *row_of; /* [nnodes] of this rank's rows, -1: none */
  Mat matrix, shifted;
  Vec right, solution;
  KSP solver;
} System;

/* One row for each free node, with the first of its copies; end[nnodes]. */
static PetscErrorCode Number(System *s, const SolidState *solid, MPI_Comm comm, Copies nodes,
                             const char is_free[], const double value[][N], End end[])
{
  double *row;
  int first = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(solid->nnodes, &row));
  for (int i = 0; i < solid->nnodes; i++)
    s->row_of[i] = is_free[i] && CopiesIsFirst(nodes, i) ? s->nrows++ : -1;
  PetscCallMPI(MPI_Exscan(&s->nrows, &first, 1, MPI_INT, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(&s->nrows, &s->nall, 1, MPI_INT, MPI_SUM, comm));
  for (int i = 0; i < solid->nnodes; i++)
    if (s->row_of[i] >= 0) row[i] = first + s->row_of[i];
  PetscCall(CopiesSum(nodes, 1, row));
  for (int i = 0; i < solid->nnodes; i++) {
    end[i] = (End){.row = is_free[i] ? row[i] : -1.0};
    for (int c = 0; c < N && !is_free[i]; c++) end[i].value[c] = value[i][c];
  }
  PetscCall(PetscFree(row));
  PetscFunctionReturn(0);
}

/* The facets, then the close points with another facet. */
static PetscErrorCode FindLinks(System *s, const ClosePoints *points, const SolidState *solid,
                                const Shell shell, const End end[])
{
  End(*there)[2];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(ScatterArriving(points->scatter), &there));
  PetscCall(
      ClosePointsForward(points, solid, sizeof *end / sizeof(double), (const double *)end, (double *)there));
  PetscCall(PetscCalloc1(solid->nfacets + points->n, &s->link));
  for (int f = 0; f < solid->nfacets; f++) {
    if (shell->length[f] == 0.0) continue;
    Link *link = &s->link[s->n++];
    *link = (Link){.conductance = 1.0 / shell->length[f], .weight = {1.0, -1.0}};
    for (int i = 0; i < ENDS; i++) link->end[i] = i < 2 ? end[solid->facet[2 * f + i]] : NO_END;
  }
  for (int k = 0; k < points->n; k++) {
    const ClosePoint *p = &points->point[k];
    if (p->opposite == CLOSE_TO_WALL) continue;
    Link *link = &s->link[s->n++];
    link->conductance = p->weight / (shell->length[p->facet] * shell->length[p->facet]);
    for (int i = 0; i < 2; i++) {
      link->weight[i] = p->n[i];
      link->end[i] = end[solid->facet[2 * p->facet + i]];
      link->weight[2 + i] = -p->opposite_n[i];
      link->end[2 + i] = there[p->opposite][i];
    }
  }
  PetscCall(PetscFree(there));
  PetscFunctionReturn(0);
}

/* Entries of given nodes have row or column -1 and do not count. */
static PetscErrorCode Assemble(System *s, MPI_Comm comm)
{
  const int n = ENDS * ENDS * s->n;
  PetscInt *row, *column;
  double *value;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(n, &row, n, &column, n, &value));
  for (int k = 0; k < n; k++) {
    const Link *link = &s->link[k / (ENDS * ENDS)];
    const int i = k % ENDS, j = k / ENDS % ENDS;
    row[k] = (PetscInt)link->end[i].row;
    column[k] = (PetscInt)link->end[j].row;
    value[k] = link->conductance * link->weight[i] * link->weight[j];
  }
  PetscCall(MatCreate(comm, &s->matrix));
  PetscCall(MatSetSizes(s->matrix, s->nrows, s->nrows, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(s->matrix, MATAIJ));
  PetscCall(MatSetPreallocationCOO(s->matrix, n, row, column));
  PetscCall(MatSetValuesCOO(s->matrix, value, INSERT_VALUES));
  PetscCall(PetscFree3(row, column, value));
  PetscCall(MatCreateVecs(s->matrix, &s->right, &s->solution));
  PetscCall(VecSetOption(s->right, VEC_IGNORE_NEGATIVE_INDICES, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* Conjugate gradients with a factor of each rank's rows: on one rank there is little left to do. */
static PetscErrorCode CreateSolver(System *s, MPI_Comm comm)
{
  Vec diagonal;
  KSP *block;
  PC pc;

  PetscFunctionBeginUser;
  PetscCall(MatDuplicate(s->matrix, MAT_COPY_VALUES, &s->shifted));
  PetscCall(VecDuplicate(s->right, &diagonal));
  PetscCall(MatGetDiagonal(s->matrix, diagonal));
  PetscCall(VecScale(diagonal, 1.0 + SHIFT));
  PetscCall(MatDiagonalSet(s->shifted, diagonal, INSERT_VALUES));
  PetscCall(VecDestroy(&diagonal));
  PetscCall(MatSetOption(s->shifted, MAT_SPD, PETSC_TRUE));
  PetscCall(KSPCreate(comm, &s->solver));
  PetscCall(KSPSetType(s->solver, KSPCG));
  PetscCall(KSPSetTolerances(s->solver, TOLERANCE, PETSC_DEFAULT, PETSC_DEFAULT, s->nall));
  PetscCall(KSPSetOperators(s->solver, s->matrix, s->shifted));
  PetscCall(KSPGetPC(s->solver, &pc));
  PetscCall(PCSetType(pc, PCBJACOBI));
  PetscCall(KSPSetUp(s->solver));
  PetscCall(PCBJacobiGetSubKSP(pc, NULL, NULL, &block));
  PetscCall(KSPGetPC(block[0], &pc));
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatOrderingType(pc, MATORDERINGND));
  PetscFunctionReturn(0);
}

/* Solves for s->right; value[nnodes * stride] where there are rows. */
static PetscErrorCode Solve(System *s, int nnodes, int stride, double value[])
{
  const double *solution;

  PetscFunctionBeginUser;
  PetscCall(VecAssemblyBegin(s->right));
  PetscCall(VecAssemblyEnd(s->right));
  PetscCall(KSPSolve(s->solver, s->right, s->solution));
  PetscCall(VecGetArrayRead(s->solution, &solution));
  for (int i = 0; i < nnodes; i++)
    if (s->row_of[i] >= 0) value[i * stride] = solution[s->row_of[i]];
  PetscCall(VecRestoreArrayRead(s->solution, &solution));
  PetscFunctionReturn(0);
}

/* Field c of the free nodes. */
static PetscErrorCode SolveField(System *s, int nnodes, int c, double value[][N])
{
  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(s->right));
  for (int k = 0; k < s->n; k++) {
    const Link *link = &s->link[k];
    double given = 0.0;
    for (int i = 0; i < ENDS; i++) given += link->weight[i] * link->end[i].value[c];
    if (given == 0.0) continue;
    for (int i = 0; i < ENDS; i++)
      PetscCall(VecSetValue(s->right, (PetscInt)link->end[i].row,
                            -link->conductance * link->weight[i] * given, ADD_VALUES));
  }
  PetscCall(Solve(s, nnodes, N, &value[0][c]));
  PetscFunctionReturn(0);
}

/* The profile, of the length of facets that have close points; of surfaces that no given node is connected with there is none. */
static PetscErrorCode SolveProfile(System *s, const ClosePoints *points, const SolidState *solid,
                                   const End end[], const double value[][N], double profile[])
{
  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(s->right));
  for (int k = 0; k < points->n; k++) {
    const ClosePoint *p = &points->point[k];
    for (int i = 0; i < 2; i++) {
      const int node = solid->facet[2 * p->facet + i];
      if (value[node][SURFACE_REACHED] < 0.5) continue;
      PetscCall(VecSetValue(s->right, (PetscInt)end[node].row, p->weight * p->n[i], ADD_VALUES));
    }
  }
  PetscCall(Solve(s, solid->nnodes, 1, profile));
  PetscFunctionReturn(0);
}

static PetscErrorCode Destroy(System *s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(s->link));
  PetscCall(PetscFree(s->row_of));
  PetscCall(KSPDestroy(&s->solver));
  PetscCall(MatDestroy(&s->matrix));
  PetscCall(MatDestroy(&s->shifted));
  PetscCall(VecDestroy(&s->right));
  PetscCall(VecDestroy(&s->solution));
  PetscFunctionReturn(0);
}

/* Free nodes get the value of the copy that has the row, given ones keep theirs. */
static PetscErrorCode Share(Copies nodes, int nnodes, const char is_free[], double value[][N])
{
  double(*sum)[N];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(nnodes, &sum));
  PetscCall(PetscArraycpy(sum, value, nnodes));
  PetscCall(CopiesSum(nodes, N, (double *)sum));
  for (int i = 0; i < nnodes; i++)
    if (is_free[i]) PetscCall(PetscArraycpy(value[i], sum[i], N));
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}

PetscErrorCode GapHeadSolve(const ClosePoints *points, const SolidState *solid, const Shell shell,
                            Copies nodes, const char is_free[], double value[][N], double profile[])
{
  System s = {0};
  End *end;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(solid->nnodes, &end));
  PetscCall(PetscMalloc1(solid->nnodes, &s.row_of));
  PetscCall(PetscArrayzero(profile, solid->nnodes));
  PetscCall(Number(&s, solid, shell->comm, nodes, is_free, (const double(*)[N])value, end));
  if (s.nall > 0) {
    PetscCall(FindLinks(&s, points, solid, shell, end));
    PetscCall(Assemble(&s, shell->comm));
    PetscCall(CreateSolver(&s, shell->comm));
    for (int i = 0; i < solid->nnodes; i++)
      for (int c = 0; c < N && is_free[i]; c++) value[i][c] = 0.0;
    for (int c = 0; c < N; c++) PetscCall(SolveField(&s, solid->nnodes, c, value));
    PetscCall(Share(nodes, solid->nnodes, is_free, value));
    PetscCall(SolveProfile(&s, points, solid, end, (const double(*)[N])value, profile));
    PetscCall(CopiesSum(nodes, 1, profile));
  }
  PetscCall(PetscFree(end));
  PetscCall(Destroy(&s));
  PetscFunctionReturn(0);
}
