#include "fluid/output/flow_gauge.h"
#include "common/supermesh/geometry.h"
#include "fluid/output/surface_gauge.h"

/* s: of the segment what is in owned element e and where the phase moves in it; *share: what this has of that, 0 where it is not. */
static PetscErrorCode ClipToPhase(Fluid fluid, int e, int phase, const double from[2], const double to[2],
                                  double s[2], double *share)
{
  Polygon polygon;
  double part[2];
  int along;
  PetscFunctionBeginUser;
  *share = 1.0;
  if (phase < 0) PetscFunctionReturn(0);
  PetscCall(PhasesGetExtent(PhaseTransportPhases(FluidPhases(fluid)), e, phase, &polygon, share));
  if (!SegmentClip(polygon.n, (const double(*)[2])polygon.x, from, to, part, &along)) *share = 0.0;
  s[0] = fmax(s[0], part[0]);
  s[1] = fmin(s[1], part[1]);
  if (!(s[1] > s[0])) *share = 0.0;
  PetscFunctionReturn(0);
}

PetscErrorCode FlowMeasure(Fluid fluid, int phase, const double from[2], const double to[2], double *flow)
{
  const Mesh *m = FluidMesh(fluid);
  const double across[2] = {to[1] - from[1], from[0] - to[0]};
  PetscFunctionBeginUser;
  *flow = 0.0;
  for (int e = 0; e < m->ne; e++) {
    const double *u = FluidVelocity(fluid) + 6 * e;
    double x[3][2], s[2], share, middle[2], n[3];
    int along;
    MeshCorners(m, e, x);
    if (!SegmentClip(3, (const double(*)[2])x, from, to, s, &along)) continue;
    PetscCall(ClipToPhase(fluid, e, phase, from, to, s, &share));
    if (share == 0.0) continue;
    if (along >= 0 && m->neighbor[3 * e + (along + 2) % 3] >= 0) share *= 0.5;
    for (int c = 0; c < 2; c++) middle[c] = from[c] + 0.5 * (s[0] + s[1]) * (to[c] - from[c]);
    GeometryBarycentric((const double(*)[2])x, middle, n);
    for (int c = 0; c < 2; c++)
      for (int i = 0; i < 3; i++) *flow += share * (s[1] - s[0]) * across[c] * n[i] * u[3 * c + i];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, flow, 1, MPI_DOUBLE, MPI_SUM, m->comm));
  PetscFunctionReturn(0);
}
