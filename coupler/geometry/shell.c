#include "coupler/geometry/shell.h"
#include <math.h>

PetscErrorCode ShellCreate(MPI_Comm comm, double thickness, Shell *shell)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(shell));
  (*shell)->comm = comm;
  (*shell)->thickness = thickness;
  PetscFunctionReturn(0);
}

static PetscErrorCode FreeArrays(Shell s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(s->normal, s->length));
  PetscCall(PetscFree2(s->x, s->node));
  PetscCall(PetscFree2(s->surface, s->offset));
  PetscCall(CopiesDestroy(&s->copies));
  PetscFunctionReturn(0);
}

/* surface[]: the facets' nodes, each once, and their copies on all ranks. */
static PetscErrorCode FindSurfaceNodes(Shell s, const SolidState *solid)
{
  PetscBool *found;
  long long *gid;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(solid->nnodes, &found));
  PetscCall(PetscMalloc1(solid->nnodes, &gid));
  s->nsurface = 0;
  for (int i = 0; i < 2 * solid->nfacets; i++) {
    const int node = solid->facet[i];
    if (found[node]) continue;
    found[node] = PETSC_TRUE;
    gid[s->nsurface] = solid->gid[node];
    s->surface[s->nsurface++] = node;
  }
  PetscCall(CopiesCreateByNumber(s->comm, s->nsurface, gid, &s->copies));
  PetscCall(PetscFree(gid));
  PetscCall(PetscFree(found));
  PetscFunctionReturn(0);
}

static PetscErrorCode Allocate(Shell s, const SolidState *solid)
{
  const size_t nf = (size_t)solid->nfacets, nn = (size_t)solid->nnodes;

  PetscFunctionBeginUser;
  PetscCall(FreeArrays(s));
  s->nfacets = solid->nfacets;
  s->nnodes = solid->nnodes;
  PetscCall(PetscMalloc2(nf, &s->normal, nf, &s->length));
  PetscCall(PetscMalloc2(2 * nf, &s->x, 2 * nf, &s->node));
  PetscCall(PetscMalloc2(nn, &s->surface, nn, &s->offset));
  for (int e = 0; e < s->nfacets; e++) {
    const int a = solid->facet[2 * e], b = solid->facet[2 * e + 1];
    const int nodes[2][3] = {{a, a, b}, {a, b, b}};
    PetscCall(PetscArraycpy(s->node[2 * e], nodes[0], 3));
    PetscCall(PetscArraycpy(s->node[2 * e + 1], nodes[1], 3));
  }
  PetscCall(FindSurfaceNodes(s, solid));
  PetscFunctionReturn(0);
}

/* The facets' normals; offset[node] = (sum of the adjacent facets' normals, their number). */
static void Normals(Shell s, const SolidState *solid)
{
  for (int e = 0; e < s->nfacets; e++) {
    const double *a = &solid->x[2 * solid->facet[2 * e]], *b = &solid->x[2 * solid->facet[2 * e + 1]];
    const double t[2] = {b[0] - a[0], b[1] - a[1]}, length = hypot(t[0], t[1]);
    s->length[e] = length;
    s->normal[e][0] = length > 0.0 ? t[1] / length : 0.0;
    s->normal[e][1] = length > 0.0 ? -t[0] / length : 0.0;
    for (int i = 0; i < 2; i++) {
      double *sum = s->offset[solid->facet[2 * e + i]];
      sum[0] += s->normal[e][0];
      sum[1] += s->normal[e][1];
      sum[2] += length > 0.0;
    }
  }
}

/* With m the sum of k unit normals, d = dr k m / |m|^2 has d . n_e = dr for each of two edges; at knife edges
 * |m| -> 0. */
static void ScaleOffset(double thickness, double sum[3])
{
  const double m = hypot(sum[0], sum[1]), k = sum[2];
  const double length = m > 0.0 ? fmin(k / m, SHELL_OFFSET_LIMIT) * thickness : 0.0;
  for (int c = 0; c < 2; c++) sum[c] *= m > 1e-12 * k ? length / m : 0.0;
}

static PetscErrorCode Offsets(Shell s)
{
  double(*shared)[3];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->nsurface, &shared));
  for (int i = 0; i < s->nsurface; i++) PetscCall(PetscArraycpy(shared[i], s->offset[s->surface[i]], 3));
  PetscCall(CopiesSum(s->copies, 3, (double *)shared));
  for (int i = 0; i < s->nsurface; i++) {
    ScaleOffset(s->thickness, shared[i]);
    PetscCall(PetscArraycpy(s->offset[s->surface[i]], shared[i], 3));
  }
  PetscCall(PetscFree(shared));
  PetscFunctionReturn(0);
}

PetscErrorCode ShellExtrude(Shell s, const SolidState *solid, PetscBool new_surface)
{
  PetscFunctionBeginUser;
  if (new_surface) PetscCall(Allocate(s, solid));
  PetscCall(PetscArrayzero(s->offset, s->nnodes));
  Normals(s, solid);
  PetscCall(Offsets(s));
  for (int e = 0; e < s->nfacets; e++) {
    const int a = solid->facet[2 * e], b = solid->facet[2 * e + 1];
    for (int c = 0; c < 2; c++) {
      const double inner[2] = {solid->x[2 * a + c], solid->x[2 * b + c]};
      const double outer[2] = {inner[0] + s->offset[a][c], inner[1] + s->offset[b][c]};
      s->x[2 * e][0][c] = s->x[2 * e + 1][0][c] = inner[0];
      s->x[2 * e][1][c] = outer[0];
      s->x[2 * e][2][c] = s->x[2 * e + 1][1][c] = outer[1];
      s->x[2 * e + 1][2][c] = inner[1];
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode ShellDestroy(Shell *shell)
{
  PetscFunctionBeginUser;
  if (!*shell) PetscFunctionReturn(0);
  PetscCall(FreeArrays(*shell));
  PetscCall(PetscFree(*shell));
  PetscFunctionReturn(0);
}
