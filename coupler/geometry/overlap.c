#include "coupler/geometry/overlap.h"
#include "common/exchange/box_scatter.h"
#include "coupler/geometry/solid_parts.h"

PetscErrorCode OverlapCreate(MPI_Comm comm, Overlap *overlap)
{
  int size;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(overlap));
  (*overlap)->comm = comm;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc1(size, &(*overlap)->bounds));
  PetscFunctionReturn(0);
}

/* A fluid that is one has the same density inside and beside the solid. */
static PetscErrorCode SetProperties(Overlap o, const double rho[], const double mu[],
                                    const double rho_inside[], const double rho_beside[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(o->rho, rho_inside ? rho_inside : rho, o->nelements));
  PetscCall(PetscArraycpy(o->mu, mu, o->nelements));
  PetscCall(PetscArraycpy(o->rho_mean, rho, o->nelements));
  PetscCall(PetscArraycpy(o->rho_beside, rho_beside ? rho_beside : rho, o->nelements));
  PetscFunctionReturn(0);
}

static PetscErrorCode FreeElements(Overlap o)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree5(o->x, o->area, o->basis, o->rho, o->kept));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapSetElements(Overlap o, const FluidElements *elements)
{
  const size_t n = (size_t)elements->n;
  GeometryBox box = GeometryBoxEmpty();
  int phases = 0;

  PetscFunctionBeginUser;
  SearchDestroy(&o->search);
  PetscCall(FreeElements(o));
  PetscCall(PetscMalloc5(n, &o->x, n, &o->area, n, &o->basis, 4 * n, &o->rho, 4 * n, &o->kept));
  o->mu = o->rho + n, o->rho_mean = o->mu + n, o->rho_beside = o->rho_mean + n;
  PetscCall(PetscMemcpy(o->x, elements->x, n * sizeof *o->x));
  o->nelements = elements->n;
  PetscCall(SetProperties(o, elements->rho, elements->mu, elements->rho_inside, elements->rho_beside));
  o->pairs.n = o->ncoupled = 0;
  for (int k = 0; k < o->nelements; k++) {
    o->area[k] = GeometryArea((const double(*)[2])o->x[k]);
    o->basis[k] = SupermeshBasisOf((const double(*)[2])o->x[k]);
    for (int i = 0; i < 3; i++) GeometryBoxGrow(&box, o->x[k][i]);
  }
  PetscCheck(!SearchCreateTriangles(o->nelements, (const double(*)[3][2])o->x, &o->search), PETSC_COMM_SELF,
             PETSC_ERR_MEM, "no memory for the search tree of %d elements", o->nelements);
  for (int k = 0; k < o->nelements; k++) phases |= o->rho_beside[k] != o->rho[k];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &phases, 1, MPI_INT, MPI_LOR, o->comm));
  o->phases = (PetscBool)phases;
  PetscCallMPI(MPI_Allgather(&box, 4, MPI_DOUBLE, o->bounds, 4, MPI_DOUBLE, o->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapSetProperties(Overlap o, const CoracleFlow *flow)
{
  PetscFunctionBeginUser;
  PetscCall(SetProperties(o, flow->rho, flow->mu, flow->rho_inside, flow->rho_beside));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapKeepProperties(Overlap o)
{
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(o->kept, o->rho, 4 * (size_t)o->nelements));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapRestoreProperties(Overlap o)
{
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(o->rho, o->kept, 4 * (size_t)o->nelements));
  PetscFunctionReturn(0);
}

/* The triangles that this rank owns: volume elements, then the shell's. */
static PetscErrorCode OwnedTriangles(Overlap o, const SolidState *solid, const Shell shell,
                                     SourceTriangle owned[])
{
  double *part;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(solid->nnodes, &part));
  PetscCall(SolidPartsAreas(solid, o->parts, part));
  for (int t = 0; t < o->nowned; t++) {
    SourceTriangle *source = &owned[t];
    const int s = t - o->nvolume;
    source->is_shell = s >= 0;
    source->pad = 0;
    PetscCall(PetscArraycpy(o->node[t], s >= 0 ? shell->node[s] : solid->element + 3 * t, 3));
    source->part = part[o->node[t][0]];
    for (int c = 0; c < 2; c++) {
      for (int i = 0; i < 3; i++) {
        source->x[i][c] = s >= 0 ? shell->x[s][i][c] : solid->x[2 * o->node[t][i] + c];
        source->u[i][c] = solid->u[2 * o->node[t][i] + c];
      }
      source->normal[c] = s >= 0 ? shell->normal[s / 2][c] : 0.0;
    }
  }
  PetscCall(PetscFree(part));
  PetscFunctionReturn(0);
}

/* Which triangles go where: to every rank whose elements' bounding box they touch. */
static PetscErrorCode MakeScatter(Overlap o, const SourceTriangle owned[])
{
  GeometryBox *box;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(o->nowned, &box));
  for (int t = 0; t < o->nowned; t++) box[t] = GeometryBoxOf(owned[t].x);
  PetscCall(BoxScatterCreate(o->comm, o->nowned, box, o->bounds, &o->scatter));
  PetscCall(PetscFree(box));
  PetscFunctionReturn(0);
}

static PetscErrorCode FindPairs(Overlap o)
{
  double(*x)[3][2];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(o->nsources, &x));
  PetscCall(PetscFree(o->source_basis));
  PetscCall(PetscMalloc1(o->nsources, &o->source_basis));
  for (int t = 0; t < o->nsources; t++) {
    PetscCall(PetscMemcpy(x[t], o->source[t].x, sizeof x[t]));
    o->source_basis[t] = SupermeshBasisOf((const double(*)[2])x[t]);
  }
  PetscCheck(!SupermeshIntersect(o->nsources, (const double(*)[3][2])x, o->search,
                                 (const double(*)[3][2])o->x, &o->pairs),
             PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for the pairs of solid and fluid");
  PetscCall(PetscFree(x));
  PetscFunctionReturn(0);
}

/* Counts, then fills; while it does, that of e is first[e + 1]. */
static void ListPairsOfElements(Overlap o)
{
  int *first = o->first_of_element;
  for (int e = 0; e < o->ncoupled + 2; e++) first[e] = 0;
  for (int p = 0; p < o->pairs.n; p++) first[o->coupled_index[p] + 2]++;
  for (int e = 2; e < o->ncoupled + 2; e++) first[e] += first[e - 1];
  for (int p = 0; p < o->pairs.n; p++) o->of_element[first[o->coupled_index[p] + 1]++] = p;
}

static PetscErrorCode FindCoupledElements(Overlap o)
{
  int *index_of;

  PetscFunctionBeginUser;
  PetscCall(
      PetscFree5(o->coupled_element, o->coupled_index, o->first_of_element, o->of_element, o->solid_area));
  PetscCall(PetscMalloc5(o->nelements, &o->coupled_element, o->pairs.n, &o->coupled_index,
                         (size_t)o->nelements + 2, &o->first_of_element, o->pairs.n, &o->of_element,
                         o->nelements, &o->solid_area));
  PetscCall(PetscCalloc1(o->nelements, &index_of));
  for (int p = 0; p < o->pairs.n; p++) index_of[o->pairs.pair[p].b] = 1;
  o->ncoupled = 0;
  for (int k = 0; k < o->nelements; k++) {
    if (!index_of[k]) continue;
    o->coupled_element[o->ncoupled] = k;
    index_of[k] = o->ncoupled++;
  }
  for (int p = 0; p < o->pairs.n; p++) o->coupled_index[p] = index_of[o->pairs.pair[p].b];
  PetscCall(PetscFree(index_of));
  ListPairsOfElements(o);
  PetscCall(PetscArrayzero(o->solid_area, o->ncoupled));
  for (int p = 0; p < o->pairs.n; p++)
    if (!o->source[o->pairs.pair[p].a].is_shell) o->solid_area[o->coupled_index[p]] += o->pairs.pair[p].area;
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapBuild(Overlap o, const SolidState *solid, const Shell shell, PetscBool new_mesh)
{
  SourceTriangle *owned;

  PetscFunctionBeginUser;
  if (new_mesh) {
    PetscCall(CopiesDestroy(&o->nodes));
    PetscCall(CopiesCreateByNumber(o->comm, solid->nnodes, solid->gid, &o->nodes));
    PetscCall(CopiesDestroy(&o->parts));
    PetscCall(SolidPartsCreate(o->comm, solid, o->nodes, &o->parts));
  }
  o->nvolume = solid->nelements;
  o->nowned = solid->nelements + 2 * shell->nfacets;
  PetscCall(PetscFree(o->node));
  PetscCall(PetscFree(o->source));
  PetscCall(PetscMalloc1(o->nowned, &o->node));
  PetscCall(PetscMalloc1(o->nowned, &owned));
  PetscCall(OwnedTriangles(o, solid, shell, owned));
  PetscCall(MakeScatter(o, owned));
  o->nsources = ScatterArriving(o->scatter);
  PetscCall(PetscMalloc1(o->nsources, &o->source));
  PetscCall(ScatterForward(o->scatter, sizeof *owned, owned, o->source));
  PetscCall(PetscFree(owned));
  PetscCall(FindPairs(o));
  PetscCall(FindCoupledElements(o));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapForward(Overlap o, int ncomp, const double owned[], double source[])
{
  PetscFunctionBeginUser;
  PetscCall(ScatterForward(o->scatter, (size_t)ncomp * sizeof *owned, owned, source));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapReverseAdd(Overlap o, int ncomp, const double source[], double owned[])
{
  PetscFunctionBeginUser;
  PetscCall(ScatterReverseAdd(o->scatter, ncomp, source, owned));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapNodesToSources(Overlap o, int ncomp, const double node[], double source[])
{
  double *owned;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)o->nowned * 3 * (size_t)ncomp, &owned));
  for (int t = 0; t < o->nowned; t++) {
    for (int i = 0; i < 3; i++) {
      for (int c = 0; c < ncomp; c++) owned[(3 * t + i) * ncomp + c] = node[ncomp * o->node[t][i] + c];
    }
  }
  PetscCall(OverlapForward(o, 3 * ncomp, owned, source));
  PetscCall(PetscFree(owned));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapSourcesToNodes(Overlap o, int ncomp, const double source[], int nnodes, double node[])
{
  double *owned;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)o->nowned * 3 * (size_t)ncomp, &owned));
  PetscCall(OverlapReverseAdd(o, 3 * ncomp, source, owned));
  PetscCall(PetscArrayzero(node, (size_t)nnodes * (size_t)ncomp));
  for (int t = 0; t < o->nowned; t++) {
    for (int i = 0; i < 3; i++) {
      for (int c = 0; c < ncomp; c++) node[ncomp * o->node[t][i] + c] += owned[(3 * t + i) * ncomp + c];
    }
  }
  PetscCall(PetscFree(owned));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapDestroy(Overlap *overlap)
{
  Overlap o = *overlap;

  PetscFunctionBeginUser;
  if (!o) PetscFunctionReturn(0);
  SearchDestroy(&o->search);
  SupermeshPairsDestroy(&o->pairs);
  PetscCall(PetscFree(o->bounds));
  PetscCall(FreeElements(o));
  PetscCall(PetscFree(o->node));
  PetscCall(PetscFree(o->source));
  PetscCall(PetscFree(o->source_basis));
  PetscCall(
      PetscFree5(o->coupled_element, o->coupled_index, o->first_of_element, o->of_element, o->solid_area));
  PetscCall(ScatterDestroy(&o->scatter));
  PetscCall(CopiesDestroy(&o->nodes));
  PetscCall(CopiesDestroy(&o->parts));
  PetscCall(PetscFree(*overlap));
  PetscFunctionReturn(0);
}
