/* Fluid -> shell -> surface: the Galerkin projections [40]-[42] of fluid fields to the solid's surface (mode
 * stress_shell; the default mode projects nothing).
 *
 *    fluid -> shell     shell triangle T:  int_T N_i q_T   = sum over K of int_{K and T} N_i q_K     [41]
 *    shell -> surface   edge e:            int_e N_i^e q_e = int N_i^e q_T over its two triangles    [42]
 *
 * N^e: the edge's two functions, constant across the shell, so that dr int_e stands for the integral over a
 * straight shell.  Both sides of [41] run over the part of T that the fluid covers, so a shell that reaches
 * out of the fluid uses the covered part; where less than half of a triangle is covered its field is
 * constant. */
#ifndef CORACLE_SURFACE_H
#define CORACLE_SURFACE_H
#include "coupler/geometry/overlap.h"

enum { SURFACE_FIELDS_MAX = 8 };

/* Sets f[ncomp][3], the fields' P1 values at the vertices of the fluid element of `pair`. */
typedef void (*SurfaceFields)(void *context, const Overlap overlap, const SupermeshPair *pair, double f[][3]);

/* Collective: surface[nfacets][ncomp][2], values at the two nodes of each of this rank's facets; 0 on a facet
 * whose shell the fluid does not cover at all. */
PetscErrorCode SurfaceFromFluid(Overlap overlap, int ncomp, const Shell shell, SurfaceFields fields,
                                void *context, double surface[]);
#endif
