/* The divergence that the projection removes, as the functions of P2 see it:
 *
 *     d_q  =  int grad N_q . u_bulk  -  int N_q g.n  over the boundaries that prescribe the velocity g,    m2/s
 *
 * u_bulk = u + M^-1 (us - ms u), the solid's velocity where it is held (coracle.h), and a gas's part (compressibility.h). */
#ifndef FLUID_BULK_DIVERGENCE_H
#define FLUID_BULK_DIVERGENCE_H
#include "fluid/pressure/projection.h"

/* Collective.  divergence, a ghosted P2 vector, is overwritten; velocity: [ne][2][3]. */
PetscErrorCode BulkDivergence(const FluidDomain *domain, const ProjectionStep *step, Vec velocity,
                              Vec divergence);
#endif
