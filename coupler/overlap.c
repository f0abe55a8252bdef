#include "coupler/overlap.h"

PetscErrorCode OverlapCreate(MPI_Comm comm, Overlap *overlap)
{
  int size;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(overlap));
  (*overlap)->comm = comm;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc1(size, &(*overlap)->near));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapSetElements(Overlap o, const ServerElements *elements)
{
  const size_t n = (size_t)elements->n;
  GeometryBox box = GeometryBoxEmpty();

  PetscFunctionBeginUser;
  SearchDestroy(&o->search);
  PetscCall(PetscFree4(o->x, o->area, o->rho, o->mu));
  PetscCall(PetscMalloc4(n, &o->x, n, &o->area, n, &o->rho, n, &o->mu));
  PetscCall(PetscMemcpy(o->x, elements->x, n * sizeof *o->x));
  PetscCall(PetscArraycpy(o->rho, elements->rho, n));
  PetscCall(PetscArraycpy(o->mu, elements->mu, n));
  PetscCall(PetscArraycpy(o->lower, elements->lower, 2));
  PetscCall(PetscArraycpy(o->upper, elements->upper, 2));
  o->nelements = elements->n;
  o->pairs.n = o->nentries = 0;
  for (int k = 0; k < o->nelements; k++) {
    o->area[k] = GeometryArea((const double(*)[2])o->x[k]);
    for (int i = 0; i < 3; i++) GeometryBoxGrow(&box, o->x[k][i]);
  }
  PetscCheck(!SearchCreateTriangles(o->nelements, (const double(*)[3][2])o->x, &o->search), PETSC_COMM_SELF,
             PETSC_ERR_MEM, "no memory for the search tree of %d elements", o->nelements);
  PetscCallMPI(MPI_Allgather(&box, 4, MPI_DOUBLE, o->near, 4, MPI_DOUBLE, o->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapSetProperties(Overlap o, const double rho[], const double mu[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(o->rho, rho, o->nelements));
  PetscCall(PetscArraycpy(o->mu, mu, o->nelements));
  PetscFunctionReturn(0);
}

/* The solid's triangles at home: volume elements, then the shell. */
static PetscErrorCode HomePieces(Overlap o, const ServerSolid *solid, const Shell shell, OverlapPiece home[])
{
  PetscFunctionBeginUser;
  for (int t = 0; t < o->nhome; t++) {
    OverlapPiece *piece = &home[t];
    const int s = t - o->nvolume;
    piece->is_shell = s >= 0;
    piece->pad = 0;
    PetscCall(PetscArraycpy(o->node[t], s >= 0 ? shell->node[s] : solid->element + 3 * t, 3));
    for (int c = 0; c < 2; c++) {
      for (int i = 0; i < 3; i++) {
        piece->x[i][c] = s >= 0 ? shell->x[s][i][c] : solid->x[2 * o->node[t][i] + c];
        piece->u[i][c] = solid->u[2 * o->node[t][i] + c];
      }
      piece->normal[c] = s >= 0 ? shell->normal[s / 2][c] : 0.0;
    }
  }
  PetscFunctionReturn(0);
}

/* Which triangles go where: to every rank whose elements' bounding box they touch. */
static PetscErrorCode MakeRoute(Overlap o, const OverlapPiece home[])
{
  int size, n = 0, *rank, *source;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(o->comm, &size));
  PetscCall(PetscMalloc2((size_t)o->nhome * (size_t)size, &rank, (size_t)o->nhome * (size_t)size, &source));
  for (int t = 0; t < o->nhome; t++) {
    const GeometryBox box = GeometryBoxOf(home[t].x);
    for (int p = 0; p < size; p++) {
      if (!GeometryBoxOverlap(&box, &o->near[p])) continue;
      rank[n] = p;
      source[n++] = t;
    }
  }
  PetscCall(RouteDestroy(&o->route));
  PetscCall(RouteCreate(o->comm, n, rank, source, &o->route));
  PetscCall(PetscFree2(rank, source));
  PetscFunctionReturn(0);
}

static PetscErrorCode FindPairs(Overlap o)
{
  double(*x)[3][2];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(o->npieces, &x));
  for (int t = 0; t < o->npieces; t++) PetscCall(PetscMemcpy(x[t], o->piece[t].x, sizeof x[t]));
  PetscCheck(!SupermeshIntersect(o->npieces, (const double(*)[3][2])x, o->search, (const double(*)[3][2])o->x,
                                 &o->pairs),
             PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for the pairs of solid and fluid");
  PetscCall(PetscFree(x));
  PetscFunctionReturn(0);
}

static PetscErrorCode MakeEntries(Overlap o)
{
  int *entry_of;

  PetscFunctionBeginUser;
  PetscCall(PetscFree2(o->element, o->entry));
  PetscCall(PetscMalloc2(o->nelements, &o->element, o->pairs.n, &o->entry));
  PetscCall(PetscCalloc1(o->nelements, &entry_of));
  for (int p = 0; p < o->pairs.n; p++) entry_of[o->pairs.pair[p].b] = 1;
  o->nentries = 0;
  for (int k = 0; k < o->nelements; k++) {
    if (!entry_of[k]) continue;
    o->element[o->nentries] = k;
    entry_of[k] = o->nentries++;
  }
  for (int p = 0; p < o->pairs.n; p++) o->entry[p] = entry_of[o->pairs.pair[p].b];
  PetscCall(PetscFree(entry_of));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapBuild(Overlap o, const ServerSolid *solid, const Shell shell)
{
  OverlapPiece *home;

  PetscFunctionBeginUser;
  o->nvolume = solid->nelements;
  o->nhome = solid->nelements + 2 * shell->nfacets;
  PetscCall(PetscFree(o->node));
  PetscCall(PetscFree(o->piece));
  PetscCall(PetscMalloc1(o->nhome, &o->node));
  PetscCall(PetscMalloc1(o->nhome, &home));
  PetscCall(HomePieces(o, solid, shell, home));
  PetscCall(MakeRoute(o, home));
  o->npieces = RouteArriving(o->route);
  PetscCall(PetscMalloc1(o->npieces, &o->piece));
  PetscCall(RouteForward(o->route, sizeof *home, home, o->piece));
  PetscCall(PetscFree(home));
  PetscCall(FindPairs(o));
  PetscCall(MakeEntries(o));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapForward(Overlap o, int ncomp, const double home[], double piece[])
{
  PetscFunctionBeginUser;
  PetscCall(RouteForward(o->route, (size_t)ncomp * sizeof *home, home, piece));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapReverseAdd(Overlap o, int ncomp, const double piece[], double home[])
{
  PetscFunctionBeginUser;
  PetscCall(RouteReverseAdd(o->route, ncomp, piece, home));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapNodesToPieces(Overlap o, int ncomp, const double node[], double piece[])
{
  double *home;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)o->nhome * 3 * (size_t)ncomp, &home));
  for (int t = 0; t < o->nhome; t++) {
    for (int i = 0; i < 3; i++) {
      for (int c = 0; c < ncomp; c++) home[(3 * t + i) * ncomp + c] = node[ncomp * o->node[t][i] + c];
    }
  }
  PetscCall(OverlapForward(o, 3 * ncomp, home, piece));
  PetscCall(PetscFree(home));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapPiecesToNodes(Overlap o, int ncomp, const double piece[], int nnodes, double node[])
{
  double *home;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)o->nhome * 3 * (size_t)ncomp, &home));
  PetscCall(OverlapReverseAdd(o, 3 * ncomp, piece, home));
  PetscCall(PetscArrayzero(node, (size_t)nnodes * (size_t)ncomp));
  for (int t = 0; t < o->nhome; t++) {
    for (int i = 0; i < 3; i++) {
      for (int c = 0; c < ncomp; c++) node[ncomp * o->node[t][i] + c] += home[(3 * t + i) * ncomp + c];
    }
  }
  PetscCall(PetscFree(home));
  PetscFunctionReturn(0);
}

PetscErrorCode OverlapDestroy(Overlap *overlap)
{
  Overlap o = *overlap;

  PetscFunctionBeginUser;
  if (!o) PetscFunctionReturn(0);
  SearchDestroy(&o->search);
  SupermeshPairsDestroy(&o->pairs);
  PetscCall(PetscFree(o->near));
  PetscCall(PetscFree4(o->x, o->area, o->rho, o->mu));
  PetscCall(PetscFree(o->node));
  PetscCall(PetscFree(o->piece));
  PetscCall(PetscFree2(o->element, o->entry));
  PetscCall(RouteDestroy(&o->route));
  PetscCall(PetscFree(*overlap));
  PetscFunctionReturn(0);
}
