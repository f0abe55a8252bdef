/* Fluid -> shell -> surface: the Galerkin projections [40]-[42] that the paper's own coupling stands on
 * (modes stress_shell and penalty_shell; the default projects nothing).
 *
 *    fluid -> shell     on each shell triangle T:  int_T N_i q_T = sum over K of int_{K and T} N_i q_K [41]
 *    shell -> surface   on each edge e:            int N_i^e q_e = int N_i^e q_T over both its triangles,
 * [42] N^e the edge's two functions, constant across the shell (dr int_e in a straight shell)
 *
 * Both sides of [41] run over the part of T that the fluid covers, so a shell that reaches out of the fluid
 * uses what it has; where less than half of a triangle is covered its field is taken as constant. */
#ifndef CORACLE_SURFACE_H
#define CORACLE_SURFACE_H
#include "coupler/overlap.h"

enum { SURFACE_FIELDS_MAX = 8 };

/* The P1 values f[ncomp][3] that the fluid element of `pair` has for a piece with this normal. */
typedef void (*SurfaceSource)(void *context, const Overlap overlap, const SupermeshPair *pair, double f[][3]);

/* Collective: surface[nfacets][ncomp][2], values at the two nodes of each of this rank's facets; 0 on a facet
 * whose shell the fluid does not cover at all. */
PetscErrorCode SurfaceFromFluid(Overlap overlap, int ncomp, const Shell shell, SurfaceSource source,
                                void *context, double surface[]);
#endif
