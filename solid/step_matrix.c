/* K of the step's response: 2 x 2 blocks in compressed rows. */
#include "solid/rigid.h"
#include "solid/six_node_kernel.h"
#include "solid/springs.h"
#include "solid/step_response_impl.h"

static int Cells(const StepResponse a)
{
  return a->nelements + a->nsix + a->njoints;
}

/* The nodes that a cell, an element, a six-node triangle or an active joint, couples. */
static int NodesOf(const StepResponse a, int cell, const int **node)
{
  const int six = cell - a->nelements, joint = six - a->nsix;
  *node = six < 0 ? a->element + 3 * cell : joint < 0 ? a->six + 6 * six : a->joint + 4 * joint;
  return six < 0 ? 3 : joint < 0 ? 6 : 4;
}

/* Cells of each node: cell[first[node]] .. cell[first[node + 1]], allocated. */
static PetscErrorCode ListCells(const StepResponse a, int **first, int **list)
{
  const int *node;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)a->nnodes + 2, first));
  PetscCall(PetscMalloc1(3 * (size_t)a->nelements + 6 * (size_t)a->nsix + 4 * (size_t)a->njoints, list));
  for (int cell = 0; cell < Cells(a); cell++)
    for (int n = NodesOf(a, cell, &node), i = 0; i < n; i++) (*first)[node[i] + 2]++;
  for (int i = 2; i < a->nnodes + 2; i++) (*first)[i] += (*first)[i - 1];
  for (int cell = 0; cell < Cells(a); cell++)
    for (int n = NodesOf(a, cell, &node), i = 0; i < n; i++) (*list)[(*first)[node[i] + 1]++] = cell;
  PetscFunctionReturn(0);
}

/* Sorted columns of each row. */
static PetscErrorCode ListColumns(StepResponse a)
{
  const size_t most =
      9 * (size_t)a->nelements + 36 * (size_t)a->nsix + 16 * (size_t)a->njoints + (size_t)a->nnodes;
  int *first, *cell, *row, n = 0;
  PetscFunctionBeginUser;
  PetscCall(ListCells(a, &first, &cell));
  PetscCall(PetscMalloc1(most, &row));
  PetscCall(PetscMalloc1(most, &a->column));
  for (int i = 0; i < a->nnodes; i++) {
    PetscInt m = 0;
    a->start[i] = n;
    row[m++] = i;
    for (int k = first[i]; k < first[i + 1]; k++) {
      const int *node, count = NodesOf(a, cell[k], &node);
      for (int j = 0; j < count; j++) row[m++] = node[j];
    }
    PetscCall(PetscSortRemoveDupsInt(&m, row));
    PetscCall(PetscArraycpy(a->column + n, row, m));
    n += m;
  }
  a->start[a->nnodes] = n;
  PetscCall(PetscFree(row));
  PetscCall(PetscFree(cell));
  PetscCall(PetscFree(first));
  PetscFunctionReturn(0);
}

static PetscErrorCode FindBlock(const StepResponse a, int i, int j, int *block)
{
  PetscInt at = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscFindInt(j, a->start[i + 1] - a->start[i], a->column + a->start[i], &at));
  *block = a->start[i] + (int)at;
  PetscFunctionReturn(0);
}

PetscErrorCode StepMatrixCreate(StepResponse a)
{
  PetscFunctionBeginUser;
  PetscCall(ListColumns(a));
  for (int k = 0; k < 9 * a->nelements; k++)
    PetscCall(FindBlock(a, a->element[k / 3], a->element[k / 9 * 3 + k % 3], &a->slot[k]));
  for (int k = 0; k < 36 * a->nsix; k++)
    PetscCall(FindBlock(a, a->six[k / 6], a->six[k / 36 * 6 + k % 6], &a->six_slot[k]));
  PetscCall(PetscMalloc1((size_t)a->start[a->nnodes], &a->block));
  PetscFunctionReturn(0);
}

/* block[i][j]: that of corners i, j of int sigma(d) grad N_i over element e with its nodes at x, sigma = 2 mu e + lambda tr(e) I. */
static void ElementStiffness(const Elements *e, int k, const double x[], double block[3][3][4])
{
  const Tensor edges = SolidElementEdges(e, k, x);
  const double twice = TensorDeterminant(edges);
  const double normal[3][2] = {
      {edges.yx - edges.yy, edges.xy - edges.xx}, {edges.yy, -edges.xy}, {-edges.yx, edges.xx}};
  const double plane = e->plane_stress[k] > 0.0 ? 2.0 * e->mu[k] / (e->lambda[k] + 2.0 * e->mu[k]) : 1.0;
  const double mu = e->mu[k] / (2.0 * twice), bulk = plane * e->lambda[k] / (2.0 * twice);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const double *m = normal[i], *n = normal[j], both = mu * (m[0] * n[0] + m[1] * n[1]);
      double *b = block[i][j];
      b[0] = both + (mu + bulk) * m[0] * n[0];
      b[1] = mu * m[1] * n[0] + bulk * m[0] * n[1];
      b[2] = mu * m[0] * n[1] + bulk * m[1] * n[0];
      b[3] = both + (mu + bulk) * m[1] * n[1];
    }
}

static void AddElement(StepResponse a, int k, const double block[3][3][4])
{
  for (int i = 0; i < 9; i++)
    for (int c = 0; c < 4; c++) a->block[a->slot[9 * k + i]][c] += block[i / 3][i % 3][c];
}

/* The corner at vertex q of six-node triangle k: what couples the corners that it carries along couples the nodes. */
static void AddCorner(StepResponse a, int k, int q, const double block[3][3][4])
{
  const int *slot = a->six_slot + 36 * k;
  int of[6];
  for (int i = 0; i < 6; i++) of[i] = SixNodeOf(q, i);
  for (int pair = 0; pair < 9; pair++) {
    const int v = pair / 3, w = pair % 3;
    for (int i = 0; i < 9; i++) {
      const int row = of[SIX_NODE_FROM[v][i / 3]], column = of[SIX_NODE_FROM[w][i % 3]];
      const double factor = SIX_NODE_FACTOR[v][i / 3] * SIX_NODE_FACTOR[w][i % 3];
      for (int c = 0; c < 4; c++) a->block[slot[6 * row + column]][c] += factor * block[v][w][c];
    }
  }
}

PetscErrorCode StepMatrixAssemble(StepResponse a, Solid s, const double x[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(a->block, a->start[a->nnodes]));
  const Elements *e = &s->elements;
  double block[3][3][4];
  for (int k = 0; k < a->nelements; k++) {
    if (e->six_node[k] || SolidElementHeld(e, k, s->inverse_mass)) continue;
    ElementStiffness(e, k, x, block);
    AddElement(a, k, (const double(*)[3][4])block);
  }
  for (int k = 0; k < 3 * a->nsix; k++) {
    const int corner = e->six_first[k / 3] + k % 3;
    if (SolidElementHeld(e, corner, s->inverse_mass)) continue;
    ElementStiffness(e, corner, x, block);
    AddCorner(a, k / 3, k % 3, (const double(*)[3][4])block);
  }
  PetscFunctionReturn(0);
}

/* stiffness[2 n][2 n] of n nodes that are together in a cell */
static PetscErrorCode AddNodes(StepResponse a, int n, const int node[], const double *stiffness)
{
  int at = 0;
  PetscFunctionBeginUser;
  for (int i = 0; i < n * n; i++) {
    const int p = i / n, q = i % n;
    PetscCall(FindBlock(a, node[p], node[q], &at));
    for (int c = 0; c < 4; c++) a->block[at][c] += stiffness[(2 * p + c / 2) * 2 * n + 2 * q + c % 2];
  }
  PetscFunctionReturn(0);
}

PetscErrorCode StepMatrixAddJoints(StepResponse a, Solid s)
{
  double stiffness[8][8];
  int node[4];
  PetscFunctionBeginUser;
  for (int k = 0; k < JointsActive(s->joints); k++)
    if (JointsStiffness(s->joints, s, k, node, stiffness)) PetscCall(AddNodes(a, 4, node, stiffness[0]));
  PetscFunctionReturn(0);
}

PetscErrorCode StepMatrixMultiply(StepResponse a, Solid s, const double d[], double kd[])
{
  PetscFunctionBeginUser;
  for (int i = 0; i < a->nnodes; i++) {
    double x = 0.0, y = 0.0;
    for (int k = a->start[i]; k < a->start[i + 1]; k++) {
      const double *b = a->block[k], *u = d + 2 * a->column[k];
      x += b[0] * u[0] + b[1] * u[1];
      y += b[2] * u[0] + b[3] * u[1];
    }
    kd[2 * i] = x;
    kd[2 * i + 1] = y;
  }
  PetscCall(SpringsMultiply(s, a->spring, d, kd));
  PetscCall(CopiesSum(s->copies, 2, kd));
  if (s->setup.nsprings > 0) PetscCall(RigidDistribute(s, kd)); /* what else acts in rigid bodies is zero */
  for (int k = 0; k < 2 * a->nnodes; k++)
    if (a->held[k]) kd[k] = 0.0;
  PetscFunctionReturn(0);
}
