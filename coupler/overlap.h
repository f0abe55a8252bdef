/* Where the solid and its shell meet the fluid, over all coupler ranks.
 *
 *   A rank keeps the fluid elements K of its own clients.  The solid's triangles T (volume elements first,
 * then the shell) live at home, the rank of the client that gave them, and travel to every rank whose fluid
 * elements' bounding box they touch; there they are called pieces.  The supermesh of pieces and elements is
 * local:
 *
 *      home triangle T --(x, u_s, normal)--> piece T  x  fluid element K  =  pair (T, K): exact integrals
 * over T and K home triangle T <--(vertex sums)----- piece T
 *
 *   Every part of T that the fluid covers is in one pair on one rank, since each fluid element has one rank;
 * parts outside of the fluid are in none.  Pairs of volume triangles carry the relaxation, pairs of shell
 * triangles the wall term. An entry is a fluid element with at least one pair, in ascending order of
 * elements.
 *
 * Fields are there to be read; functions are collective unless said otherwise. */
#ifndef CORACLE_OVERLAP_H
#define CORACLE_OVERLAP_H
#include "common/link/server.h"
#include "common/supermesh/supermesh.h"
#include "common/transfer/route.h"
#include "coupler/shell.h"

typedef struct {
  double x[3][2], u[3][2]; /* m; m/s, the velocity that the fluid is given */
  double normal[2];        /* shell: unit, out of the solid */
  int is_shell, pad;
} OverlapPiece;

typedef struct {
  MPI_Comm comm;
  /* the fluid's elements of this rank's clients */
  int nelements;
  double (*x)[3][2], *area;  /* [nelements] m (copied), m2 */
  double *rho, *mu;          /* [nelements] kg/m3, Pa s, at the end of the last flow (copied) */
  double lower[2], upper[2]; /* the fluid's whole domain */
  GeometryBox *near;         /* [size] bounding box of each rank's elements */
  Search search;
  /* the solid's triangles at home, and the route from there to the pieces */
  int nhome, nvolume; /* nvolume volume elements, then the shell's triangles */
  int (*node)[3];     /* [nhome] */
  Route route;
  /* the pieces on this rank and the pairs */
  int npieces;
  OverlapPiece *piece;  /* [npieces] */
  SupermeshPairs pairs; /* a: piece, b: element */
  int nentries;
  int *element; /* [nentries] */
  int *entry;   /* [pairs.n] the entry of the pair's element */
} * Overlap;

PetscErrorCode OverlapCreate(MPI_Comm comm, Overlap *overlap);
/* The fluid's elements near the solid, copied.  Pairs made before are void. */
PetscErrorCode OverlapSetElements(Overlap overlap, const ServerElements *elements);
/* Local: density and viscosity as the fluid's last flow has them, rho[nelements], mu[nelements]. */
PetscErrorCode OverlapSetProperties(Overlap overlap, const double rho[], const double mu[]);
/* Distributes the solid and its shell as they are now and finds all pairs. */
PetscErrorCode OverlapBuild(Overlap overlap, const ServerSolid *solid, const Shell shell);
/* home[nhome][ncomp] -> piece[npieces][ncomp] */
PetscErrorCode OverlapForward(Overlap overlap, int ncomp, const double home[], double piece[]);
/* home[nhome][ncomp] += piece[npieces][ncomp] */
PetscErrorCode OverlapReverseAdd(Overlap overlap, int ncomp, const double piece[], double home[]);
/* Nodal values [nnodes][ncomp] to the pieces' vertices [npieces][3][ncomp]. */
PetscErrorCode OverlapNodesToPieces(Overlap overlap, int ncomp, const double node[], double piece[]);
/* Contributions of vertices [npieces][3][ncomp] summed on the nodes [nnodes][ncomp] at home (overwritten). */
PetscErrorCode OverlapPiecesToNodes(Overlap overlap, int ncomp, const double piece[], int nnodes,
                                    double node[]);
PetscErrorCode OverlapDestroy(Overlap *overlap);
#endif
