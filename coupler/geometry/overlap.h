/* The overlap of the solid and its shell with the fluid's elements, over all coupler ranks.
 *
 * A rank has the fluid elements K of its own clients.  The solid's triangles T (volume elements, then the
 * shell's) are owned by the rank whose client sent them.  A copy of each goes to every rank whose fluid
 * elements' bounding box T touches: the source triangles there.  The supermesh of source triangles and
 * elements is local:
 *
 *        owner rank                              rank of fluid element K
 *      owned triangle T  ---(x, u_s, normal)--->  source triangle T
 *                                                       |   x  fluid element K  =  pair (T, K):
 *                                                       |   moments of T and K's polygon
 *      owned triangle T  <---(sums at vertices)---  source triangle T
 *
 * Every part of T that the fluid covers is in exactly one pair on one rank, since each fluid element is on
 * one rank; parts outside of the fluid are in none.  A coupled element is a fluid element with at least one
 * pair.
 *
 *      pairs.pair[p].a = T   in 0 .. nsources - 1        coupled_index[p]    = e   in 0 .. ncoupled - 1
 *      pairs.pair[p].b = K   in 0 .. nelements - 1       coupled_element[e]  = K   ascending
 *
 * The pairs of coupled element e are pairs.pair[of_element[k]], k = first_of_element[e] .. first_of_element[e + 1] - 1; those of a
 * source triangle follow each other.
 *
 * Fields are for reading.  Functions are collective. */
#ifndef CORACLE_OVERLAP_H
#define CORACLE_OVERLAP_H
#include "common/exchange/copies.h"
#include "common/supermesh/supermesh.h"
#include "coupler/geometry/fluid_state.h"
#include "coupler/geometry/shell.h"

typedef struct {
  double x[3][2], u[3][2]; /* vertices, m; the solid's velocity there at the step's start, m/s */
  double normal[2];        /* shell: unit, out of the solid; else 0 */
  double part;             /* m2, the area of the connected part of the solid that it belongs to */
  int is_shell, pad;
} SourceTriangle;

typedef struct {
  MPI_Comm comm;
  /* the fluid elements of this rank's clients */
  int nelements;
  double (*x)[3][2], *area; /* [nelements] m (copied), m2 */
  SupermeshBasis *basis;    /* [nelements] */
  /* [nelements] kg/m3, Pa s, of the last flow or exchange of elements (copied): rho of what fills the solid, rho_mean of the
   * element, rho_beside of the other phases; all equal with one fluid */
  double *rho, *mu, *rho_mean, *rho_beside;
  double *kept;        /* [4][nelements] them as the step began */
  PetscBool phases;    /* the fluid has several, on any rank */
  GeometryBox *bounds; /* [size] bounding box of each rank's elements */
  Search search;
  Copies parts; /* of the solid (solid_parts.h) */
  Copies nodes; /* of the solid's nodes on this rank, by gid: sums over the ranks that have a node */
  /* the solid's triangles that this rank owns, and the scatter from there to the source triangles */
  int nowned, nvolume; /* nvolume volume elements, then the shell's triangles */
  int (*node)[3];      /* [nowned] their nodes in SolidState */
  Scatter scatter;
  /* the source triangles on this rank, the pairs and the coupled elements */
  int nsources;
  SourceTriangle *source;       /* [nsources] */
  SupermeshBasis *source_basis; /* [nsources] */
  SupermeshPairs pairs;
  int ncoupled;
  int *coupled_element;               /* [ncoupled] */
  int *coupled_index;                 /* [pairs.n] */
  int *first_of_element, *of_element; /* [ncoupled + 1], [pairs.n] */
  double *solid_area;                 /* [ncoupled] m2, of the pairs in the solid's volume */
} * Overlap;

PetscErrorCode OverlapCreate(MPI_Comm comm, Overlap *overlap);
PetscErrorCode OverlapDestroy(Overlap *overlap);
/* The fluid's elements near the solid, copied.  Pairs made before are void. */
PetscErrorCode OverlapSetElements(Overlap overlap, const FluidElements *elements);
/* Local: densities and viscosity of the fluid's last flow (copied). */
PetscErrorCode OverlapSetProperties(Overlap overlap, const CoracleFlow *flow);
/* Local: densities and viscosities of the step's start are kept, and are there again when the step is made again from there. */
PetscErrorCode OverlapKeepProperties(Overlap o);
PetscErrorCode OverlapRestoreProperties(Overlap o);
/* Distributes the solid and its shell as they are now and finds all pairs.  new_mesh: nodes are others than at
 * the last call, not just moved. */
PetscErrorCode OverlapBuild(Overlap overlap, const SolidState *solid, const Shell shell, PetscBool new_mesh);

/* owned[nowned][ncomp] -> source[nsources][ncomp] */
PetscErrorCode OverlapForward(Overlap overlap, int ncomp, const double owned[], double source[]);
/* owned[nowned][ncomp] += source[nsources][ncomp] */
PetscErrorCode OverlapReverseAdd(Overlap overlap, int ncomp, const double source[], double owned[]);
/* node[nnodes][ncomp] -> source[nsources][3][ncomp], the values at the source triangles' vertices. */
PetscErrorCode OverlapNodesToSources(Overlap overlap, int ncomp, const double node[], double source[]);
/* source[nsources][3][ncomp], contributions of vertices, summed to node[nnodes][ncomp] (overwritten) on the
 * owner ranks; copies of a node on several ranks each get their own triangles' sum. */
PetscErrorCode OverlapSourcesToNodes(Overlap overlap, int ncomp, const double source[], int nnodes,
                                     double node[]);
#endif
