#include "coupler/force/gap_head.h"
#include "coupler/geometry/nodal_system.h"

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

static void SetEnds(NodalSystem system, int nnodes, const double value[][N], End end[])
{
  const PetscInt *row = NodalSystemRows(system);
  for (int i = 0; i < nnodes; i++) {
    end[i] = (End){.row = (double)row[i]};
    for (int c = 0; c < N && row[i] < 0; c++) end[i].value[c] = value[i][c];
  }
}

/* The facets, then the close points with another facet. */
static PetscErrorCode FindLinks(const ClosePoints *points, const SolidState *solid, const Shell shell,
                                const End end[], int *n, Link **links)
{
  End(*there)[2];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(ScatterArriving(points->scatter), &there));
  PetscCall(
      ClosePointsForward(points, solid, sizeof *end / sizeof(double), (const double *)end, (double *)there));
  PetscCall(PetscCalloc1(solid->nfacets + points->n, links));
  *n = 0;
  for (int f = 0; f < solid->nfacets; f++) {
    if (shell->length[f] == 0.0) continue;
    Link *link = &(*links)[(*n)++];
    *link = (Link){.conductance = 1.0 / shell->length[f], .weight = {1.0, -1.0}};
    for (int i = 0; i < ENDS; i++) link->end[i] = i < 2 ? end[solid->facet[2 * f + i]] : NO_END;
  }
  for (int k = 0; k < points->n; k++) {
    const ClosePoint *p = &points->point[k];
    if (p->opposite == CLOSE_TO_WALL) continue;
    Link *link = &(*links)[(*n)++];
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

static PetscErrorCode SetMatrix(NodalSystem system, int n, const Link link[])
{
  PetscInt(*row)[ENDS];
  double(*value)[ENDS][ENDS];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n, &row, n, &value));
  for (int k = 0; k < n; k++)
    for (int i = 0; i < ENDS; i++) {
      row[k][i] = (PetscInt)link[k].end[i].row;
      for (int j = 0; j < ENDS; j++)
        value[k][i][j] = link[k].conductance * link[k].weight[i] * link[k].weight[j];
    }
  PetscCall(NodalSystemSetBlocks(system, n, ENDS, (const PetscInt *)row));
  PetscCall(NodalSystemSetMatrix(system, (const double *)value));
  PetscCall(PetscFree2(row, value));
  PetscFunctionReturn(0);
}

/* Field c of the free nodes. */
static PetscErrorCode SolveField(NodalSystem system, int n, const Link link[], int c, double value[][N])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) {
    PetscInt row[ENDS];
    double given = 0.0, right[ENDS];
    for (int i = 0; i < ENDS; i++) given += link[k].weight[i] * link[k].end[i].value[c];
    if (given == 0.0) continue;
    for (int i = 0; i < ENDS; i++) {
      row[i] = (PetscInt)link[k].end[i].row;
      right[i] = -link[k].conductance * link[k].weight[i] * given;
    }
    PetscCall(NodalSystemAdd(system, ENDS, row, right));
  }
  PetscCall(NodalSystemSolve(system, N, &value[0][c]));
  PetscFunctionReturn(0);
}

/* The profile, of the length of facets that have close points; of surfaces that no given node is connected with there is none. */
static PetscErrorCode SolveProfile(NodalSystem system, const ClosePoints *points, const SolidState *solid,
                                   const double value[][N], double profile[])
{
  const PetscInt *row = NodalSystemRows(system);

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(profile, solid->nnodes));
  for (int k = 0; k < points->n; k++) {
    const ClosePoint *p = &points->point[k];
    for (int i = 0; i < 2; i++) {
      const int node = solid->facet[2 * p->facet + i];
      const double right = p->weight * p->n[i];
      if (value[node][SURFACE_REACHED] >= 0.5) PetscCall(NodalSystemAdd(system, 1, &row[node], &right));
    }
  }
  PetscCall(NodalSystemSolve(system, 1, profile));
  PetscFunctionReturn(0);
}

PetscErrorCode GapHeadSolve(const ClosePoints *points, const SolidState *solid, const Shell shell,
                            Copies nodes, const char is_free[], double value[][N], double profile[])
{
  NodalSystem system;
  Link *link;
  End *end;
  int n;

  PetscFunctionBeginUser;
  PetscCall(NodalSystemCreate(shell->comm, nodes, solid->nnodes, is_free, &system));
  PetscCall(PetscMalloc1(solid->nnodes, &end));
  SetEnds(system, solid->nnodes, (const double(*)[N])value, end);
  PetscCall(FindLinks(points, solid, shell, end, &n, &link));
  PetscCall(SetMatrix(system, n, link));
  for (int c = 0; c < N; c++) PetscCall(SolveField(system, n, link, c, value));
  PetscCall(SolveProfile(system, points, solid, (const double(*)[N])value, profile));
  PetscCall(PetscFree(end));
  PetscCall(PetscFree(link));
  PetscCall(NodalSystemDestroy(&system));
  PetscFunctionReturn(0);
}
