/* Pressure gauges on the solid: the entries of fluid.probes with a solid_point or a solid_line.  The coupler follows the points, for
 * it has the surface of any solid; the fluid gets them with the coupling and has the pressure there.
 *
 *      solid (on the left of a -> b)
 *      a ------ x ----------> b        x = (1 - s) x_a + s x_b
 *               |
 *               v normal
 *
 * A gauge is held by the facet that was nearest to it at the start, known by the ids of its ends.  Where a crack has
 * given the facet another node, the nearest facet holds it from then on. */
#ifndef CORACLE_GAUGES_H
#define CORACLE_GAUGES_H
#include "common/link/coracle.h"
#include "common/output/checkpoint.h"
#include "common/program/gauge_case.h"
#include "coupler/geometry/solid_state.h"

typedef struct {
  const char *path;                 /* of the case file, borrowed */
  int n, probe[CASE_GAUGES_MAX];    /* index in fluid.probes */
  double point[CASE_GAUGES_MAX][2]; /* m, at the start of the run */
} GaugesCase;

/* Not collective. */
void GaugesReadCase(CoracleCase file, GaugesCase *c);

typedef struct Gauges_s *Gauges;

/* Collective.  solid: as at the start, or as at the checkpoint `from`. *fault: the first gauge that is farther from the
 * surface than half of the facet there is long, *distance m away, or -1. */
PetscErrorCode GaugesCreate(MPI_Comm comm, const GaugesCase *c, const SolidState *solid, Checkpoint from,
                            Gauges *gauges, int *fault, double *distance);
/* Collective: to where the solid is now. */
PetscErrorCode GaugesMove(Gauges gauges, const SolidState *solid);
/* Not collective: gauge[*n], the same on all ranks; borrowed until the next move. */
const CoracleGauge *GaugesGet(Gauges gauges, int *n);
PetscErrorCode GaugesSave(Gauges gauges, Checkpoint to);
PetscErrorCode GaugesDestroy(Gauges *gauges);
#endif
