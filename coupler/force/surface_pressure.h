/* The fluid's pressure at the solid's surface, from the pairs of the overlap.
 *
 *     p_s   at the surface, the mean over the shell around a surface node
 *     p_o   outside, the mean over the same pairs of p at the vertex of the fluid element that lies farthest out of the solid
 *
 * All functions are collective; p[nelements][6], Pa, of the overlap's elements. */
#ifndef CORACLE_COUPLER_SURFACE_PRESSURE_H
#define CORACLE_COUPLER_SURFACE_PRESSURE_H
#include "coupler/geometry/overlap.h"

/* Sums over the pairs of a triangle: their area, m2, int p and, of the shell's, int p_o, N. */
enum { SURFACE_AREA, SURFACE_INSIDE, SURFACE_OUTSIDE, SURFACE_SUMS };

/* owned[nowned][SURFACE_SUMS] += the sums of all ranks' pairs. */
PetscErrorCode SurfacePressureSums(Overlap overlap, const double p[], double owned[][SURFACE_SUMS]);
/* value[nnodes][2]: p_s and p_o, Pa, where is_given[nnodes], on the surface where the fluid covers some of the shell; else 0. */
PetscErrorCode SurfacePressureNodes(Overlap overlap, const double owned[][SURFACE_SUMS], int nnodes,
                                    char is_given[], double value[][2]);
/* At nodes of the surface: p_o - rho_o g.x, Pa, x where p_o is, rho_o, the mean density of the phases beside the solid, kg/m3, 1/rho_o, and the
 * viscosity of the elements there, Pa s, means over the shell around the node where no solid is at x; 1 where there is some, all 0 elsewhere.
 * (Not rho_o of outside.h, the density of the element's mass spread over what is beside the solid: where the solid leaves, the water fills that late.) */
enum {
  SURFACE_HEAD,
  SURFACE_DENSITY,
  SURFACE_SPECIFIC_VOLUME,
  SURFACE_VISCOSITY,
  SURFACE_REACHED,
  SURFACE_HEAD_FIELDS
};
PetscErrorCode SurfacePressureHead(Overlap overlap, const double gravity[2], const double p[], int nnodes,
                                   double node[][SURFACE_HEAD_FIELDS]);
/* Of the pairs' weights in what follows.  With 0, 4 and 8 the force beneath a caisson of 0.4 m on the floor between water of 0.5 and 0.3 m, its triangles as wide as
 * three fluid elements, is 21, 6 and 1 % too large after 60 steps (floor.sh ROOT BUILD caisson); with 8 a stone on a pile (tests/coupled/stones.sh) does not come to rest. */
#define SURFACE_NEARNESS 4
/* node[nnodes]: p, linear from each pair of the solid's volume around the node, their mean, by area times the SURFACE_NEARNESS-th power of the node's
 * shape function, which keeps to the pairs at the node where a triangle of the solid has many, Pa; size[nnodes]: the square root of
 * twice the fluid elements' area, m, by area; area[nnodes]: of those pairs, m2.  Of all ranks' pairs; 0 where there are none. */
PetscErrorCode SurfacePressureInside(Overlap overlap, const double p[], int nnodes, double node[],
                                     double size[], double area[]);
#endif
