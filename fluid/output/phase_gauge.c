#include "fluid/output/phase_gauge.h"
#include "common/supermesh/geometry.h"

enum { AREA, CENTRE, VELOCITY = CENTRE + 2, SUMS = VELOCITY + 2 };

/* This share of the polygon in element e, of velocity u[2][3]. */
static void AddPolygon(const Mesh *m, int e, const Polygon *part, double share, const double u[6],
                       double sum[SUMS])
{
  double corner[3][2];
  MeshCorners(m, e, corner);
  for (int k = 1; k + 1 < part->n; k++) {
    const double *x[3] = {part->x[0], part->x[k], part->x[k + 1]};
    const double area = 0.5 * share * GeometryTurn(x[0], x[1], x[2]);
    double n[3];
    sum[AREA] += area;
    for (int i = 0; i < 3; i++) {
      GeometryBarycentric((const double(*)[2])corner, x[i], n);
      for (int c = 0; c < 2; c++) {
        sum[CENTRE + c] += area / 3.0 * x[i][c];
        for (int j = 0; j < 3; j++) sum[VELOCITY + c] += area / 3.0 * n[j] * u[3 * c + j];
      }
    }
  }
}

PetscErrorCode PhaseMeasureOf(Fluid fluid, int phase, PhaseMeasure *measure)
{
  const Mesh *m = FluidMesh(fluid);
  const Phases phases = PhaseTransportPhases(FluidPhases(fluid));
  const double *u = FluidVelocity(fluid);
  double sum[SUMS] = {0.0};
  PetscFunctionBeginUser;
  for (int e = 0; e < m->ne; e++) {
    Polygon part;
    double share;
    PetscCall(PhasesGetExtent(phases, e, phase, &part, &share));
    if (part.n) AddPolygon(m, e, &part, share, u + 6 * e, sum);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, SUMS, MPI_DOUBLE, MPI_SUM, m->comm));
  *measure = (PhaseMeasure){.area = sum[AREA]};
  PetscCall(PhasesInterfaceLength(phases, phase, &measure->interface));
  for (int c = 0; c < 2 && sum[AREA] > 0.0; c++) {
    measure->centre[c] = sum[CENTRE + c] / sum[AREA];
    measure->velocity[c] = sum[VELOCITY + c] / sum[AREA];
  }
  PetscFunctionReturn(0);
}
