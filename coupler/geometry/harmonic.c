#include "coupler/geometry/harmonic.h"
#include "common/space/p1.h"
#include "coupler/geometry/nodal_system.h"

struct Harmonic_s {
  MPI_Comm comm;
  int nnodes, nelements;
  int (*node)[3];            /* [nelements] */
  double (*stiffness)[3][3]; /* [nelements] int grad N_i . grad N_j */
  char *is_free, *was_free;  /* [nnodes] now, and in the system */
  NodalSystem system;        /* NULL: none yet */
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
  PetscCall(PetscMalloc2(ne, &h->node, ne, &h->stiffness));
  PetscCall(PetscMalloc2(n, &h->is_free, n, &h->was_free));
  for (size_t t = 0; t < ne; t++) PetscCall(PetscArraycpy(h->node[t], solid->element + 3 * t, 3));
  *harmonic = h;
  PetscFunctionReturn(0);
}

PetscErrorCode HarmonicDestroy(Harmonic *harmonic)
{
  Harmonic h = *harmonic;

  PetscFunctionBeginUser;
  if (!h) PetscFunctionReturn(0);
  PetscCall(NodalSystemDestroy(&h->system));
  PetscCall(PetscFree2(h->node, h->stiffness));
  PetscCall(PetscFree2(h->is_free, h->was_free));
  PetscCall(PetscFree(*harmonic));
  PetscFunctionReturn(0);
}

/* Free are the nodes of elements, on any rank, that are not given; *anew: others than in the system. */
static PetscErrorCode FindFree(Harmonic h, Copies nodes, const char is_given[], PetscBool *anew)
{
  double *nelements;
  int changed;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(h->nnodes, &nelements));
  for (int k = 0; k < 3 * h->nelements; k++) nelements[h->node[k / 3][k % 3]] += 1.0;
  PetscCall(CopiesSum(nodes, 1, nelements));
  for (int i = 0; i < h->nnodes; i++) h->is_free[i] = !is_given[i] && nelements[i] > 0.0;
  PetscCall(PetscFree(nelements));
  changed = !h->system || memcmp(h->is_free, h->was_free, (size_t)h->nnodes) != 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_LOR, h->comm));
  *anew = changed ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSystem(Harmonic h, Copies nodes)
{
  const PetscInt *row;
  PetscInt(*corner)[3];

  PetscFunctionBeginUser;
  PetscCall(NodalSystemDestroy(&h->system));
  PetscCall(NodalSystemCreate(h->comm, nodes, h->nnodes, h->is_free, &h->system));
  row = NodalSystemRows(h->system);
  PetscCall(PetscMalloc1(h->nelements, &corner));
  for (int k = 0; k < 3 * h->nelements; k++) corner[k / 3][k % 3] = row[h->node[k / 3][k % 3]];
  PetscCall(NodalSystemSetBlocks(h->system, h->nelements, 3, (const PetscInt *)corner));
  PetscCall(PetscFree(corner));
  PetscCall(PetscArraycpy(h->was_free, h->is_free, h->nnodes));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetMatrix(Harmonic h, const double x[])
{
  PetscFunctionBeginUser;
  for (int t = 0; t < h->nelements; t++) {
    double corner[3][2], g[3][2];
    for (int i = 0; i < 3; i++) PetscCall(PetscArraycpy(corner[i], &x[2 * h->node[t][i]], 2));
    const double area = P1Gradients((const double(*)[2])corner, g);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) h->stiffness[t][i][j] = area * (g[i][0] * g[j][0] + g[i][1] * g[j][1]);
  }
  PetscCall(NodalSystemSetMatrix(h->system, (const double *)h->stiffness));
  PetscFunctionReturn(0);
}

/* From value[stride * i] of the nodes that are not free. */
static PetscErrorCode SolveField(Harmonic h, int stride, double value[])
{
  double *right;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(h->nnodes, &right));
  for (int t = 0; t < h->nelements; t++)
    for (int j = 0; j < 3; j++) {
      const int given = h->node[t][j];
      for (int i = 0; i < 3 && !h->is_free[given]; i++)
        right[h->node[t][i]] -= h->stiffness[t][i][j] * value[stride * given];
    }
  PetscCall(NodalSystemAdd(h->system, h->nnodes, NodalSystemRows(h->system), right));
  PetscCall(NodalSystemSolve(h->system, stride, value));
  PetscCall(PetscFree(right));
  PetscFunctionReturn(0);
}

PetscErrorCode HarmonicSolve(Harmonic h, Copies nodes, const double x[], const char is_given[], int nfields,
                             double value[])
{
  PetscBool anew;

  PetscFunctionBeginUser;
  PetscCall(FindFree(h, nodes, is_given, &anew));
  if (anew) PetscCall(CreateSystem(h, nodes));
  PetscCall(SetMatrix(h, x));
  for (int k = 0; k < nfields * h->nnodes; k++)
    if (!is_given[k / nfields]) value[k] = 0.0;
  for (int c = 0; c < nfields; c++) PetscCall(SolveField(h, nfields, value + c));
  PetscFunctionReturn(0);
}
