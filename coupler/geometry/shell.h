/* The shell: the solid's surface extruded outwards by the thickness dr, two triangles per edge.
 *
 *      solid (on the left of a -> b)        triangle 2e:      a  a' b'    nodes on the surface: a a b
 *      a ----------------> b                triangle 2e + 1:  a  b' b                           a b b
 *      |  `.      2e + 1   |
 *      |     `.            |   dr           a' = a + d_a, where the offset d_a has d_a . n_e = dr for the
 *      |  2e     `.        |                edges e that meet in a: the outer surface is parallel
 *      a'----------------- b'
 *
 * An outer node carries the value of its surface node: the shell's functions collapse to the edge's two. */
#ifndef CORACLE_SHELL_H
#define CORACLE_SHELL_H
#include "common/exchange/copies.h"
#include "coupler/geometry/solid_state.h"

/* At sharp corners the offset is cut to this many thicknesses (the surface turns by 120 degrees there). */
#define SHELL_OFFSET_LIMIT 2.0

typedef struct {
  MPI_Comm comm;
  double thickness; /* dr, m */
  int nfacets;
  double (*normal)[2]; /* [nfacets] unit, out of the solid; 0 for a facet without length */
  double *length;      /* [nfacets] m */
  double (*x)[3][2];   /* [2 nfacets] the triangles, counter-clockwise */
  int (*node)[3];      /* [2 nfacets] surface node of each vertex */
  int *surface;        /* [nsurface] nodes of this rank that are on the surface */
  int nsurface, nnodes;
  double (*offset)[3]; /* [nnodes] the offset (2), 0 inside the solid; the third entry is scratch */
  Copies copies;       /* of the surface nodes, by gid */
} * Shell;

/* Collective. */
PetscErrorCode ShellCreate(MPI_Comm comm, double thickness, Shell *shell);
/* Collective: the shell of the surface as it is now.  Nodal normals are completed over the copies of a node
 * by gid.  new_surface: nodes or facets are others than at the last call, not just moved. */
PetscErrorCode ShellExtrude(Shell shell, const SolidState *solid, PetscBool new_surface);
PetscErrorCode ShellDestroy(Shell *shell);
#endif
