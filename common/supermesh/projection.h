/* Galerkin projection of P1DG fields from one set of triangles (sources) to another (targets),
 *
 *     for each target T:   int_T N_i q_T  =  sum over sources S of  int_{S and T} N_i q_S,     i = 0, 1, 2
 *
 * with the exact integrals of the supermesh (Farrell and Maddison 2011).  It is the best approximation in the
 * L2 norm: integrals and first moments over every target are kept to round-off where sources cover it once,
 * P1 fields are reproduced, and int q^2 never grows.  Where nothing covers a target the source counts as 0.
 * Serial, no MPI; 0 is returned, or 1 when there is no memory. */
#ifndef CORACLE_PROJECTION_H
#define CORACLE_PROJECTION_H
#include "common/supermesh/search.h"

typedef struct Projection_s *Projection;

/* target[nt][3][2] and source[][3][2] counter-clockwise; search: made of source by SearchCreateTriangles.
 * Nothing is kept of the arguments. */
int ProjectionCreate(int nt, const double target[][3][2], Search search, const double source[][3][2],
                     Projection *projection);
/* source[ns][ncomp][3] -> target[nt][ncomp][3]; with `place`, target t's values go to target[place[t]]. */
void ProjectionApply(Projection projection, int ncomp, const double source[], const int place[],
                     double target[]);
/* Number of pairs of source and target that share an area. */
int ProjectionPairs(Projection projection);
void ProjectionDestroy(Projection *projection);
#endif
