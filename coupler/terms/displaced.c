#include "coupler/terms/displaced.h"

/* Of a node: the integrals of rho_o - rho_f and of 1 over the pairs around it, of the solid and of its shell. */
enum { DENSITY, AREA, NSUMS };

static PetscErrorCode SumsAtNodes(const Overlap o, int nnodes, const ElementTerm element[],
                                  const SourceTerm source[], double node[][NSUMS])
{
  double(*vertex)[3][NSUMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nsources, &vertex));
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    const ElementTerm *k = &element[o->coupled_index[p]];
    if (!source[pair->a].held || !k->open) continue;
    for (int v = 0; v < 3; v++) {
      vertex[pair->a][v][DENSITY] += pair->area * k->outside;
      vertex[pair->a][v][AREA] += pair->area;
    }
  }
  PetscCall(OverlapSourcesToNodes(o, NSUMS, (const double *)vertex, nnodes, (double *)node));
  PetscCall(CopiesSum(o->nodes, NSUMS, (double *)node));
  PetscCall(PetscFree(vertex));
  PetscFunctionReturn(0);
}

PetscErrorCode DisplacedDensity(const Overlap o, const SolidState *solid, const ElementTerm element[],
                                const SourceTerm source[], Harmonic *harmonic, double displaced[])
{
  const int n = solid->nnodes;
  double(*node)[NSUMS];
  char *is_given;
  int any = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(displaced, n));
  if (!o->phases) PetscFunctionReturn(0);
  for (int t = 0; t < o->nsources; t++) any |= IsHeldByInertia(&source[t]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_LOR, o->comm));
  if (!any) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(n, &node, n, &is_given));
  PetscCall(SumsAtNodes(o, n, element, source, node));
  for (int i = 0; i < n; i++) {
    is_given[i] = node[i][AREA] > 0.0;
    displaced[i] = is_given[i] ? node[i][DENSITY] / node[i][AREA] : 0.0;
  }
  if (!*harmonic) PetscCall(HarmonicCreate(o->comm, solid, harmonic));
  PetscCall(HarmonicSolve(*harmonic, o->nodes, solid->x, is_given, 1, displaced));
  PetscCall(PetscFree2(node, is_given));
  PetscFunctionReturn(0);
}
