#include "fluid/output/solid_gauge.h"
#include "fluid/output/place_values.h"

/* Of an element: a gauge's place in it is not in the fluid. */
#define MOSTLY_SOLID 0.9

/* x[ngauges][2]: before each gauge, or behind its face, of those alone that are blocked where that is given; one that is out of
 * the mesh's bounds by no more than contact needs, as at the corner of a body that stands on the floor, is put on them. */
static void GaugePoints(const ProbeCase *list, const Mesh *m, const CoracleGauge gauge[], PetscBool before,
                        const double blocked[], double x[][2])
{
  for (int k = 0; k < list->n; k++) {
    const Probe *probe = &list->probe[k];
    if (probe->kind != PROBE_GAUGE && probe->kind != PROBE_FACE) continue;
    for (int i = probe->first; i < probe->first + probe->n; i++)
      for (int c = 0; c < 2; c++) {
        if (blocked && blocked[i] == 0.0) continue;
        const double at = gauge[i].x[c] + (before ? probe->distance : -probe->behind) * gauge[i].normal[c],
                     inside = fmin(fmax(at, m->lower[c]), m->upper[c]);
        x[i][c] = fabs(at - inside) <= probe->behind ? inside : at;
      }
  }
}

/* blocked[n]: whether a place is outside of the mesh, or a solid has most of its element; *any becomes 1 if one is. */
static PetscErrorCode Blocked(const Places *places, Fluid fluid, double blocked[], int *any)
{
  const double *alpha = FluidSolidFraction(fluid);
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(blocked, places->npoints));
  for (int k = 0; k < places->n; k++)
    blocked[places->place[k].point] += alpha[places->place[k].element] > MOSTLY_SOLID;
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, blocked, places->npoints, MPI_DOUBLE, MPI_SUM, FluidMesh(fluid)->comm));
  for (int k = 0; k < places->npoints; k++) {
    blocked[k] += places->outside[k];
    *any |= blocked[k] > 0.0;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SolidGaugeRead(const ProbeCase *list, Fluid fluid, const CoracleGauge gauge[], Places *moving,
                              GaugeReading reading[])
{
  const Mesh *m = FluidMesh(fluid);
  const double *g = FluidGravity(fluid);
  double x[CASE_GAUGES_MAX][2], blocked[CASE_GAUGES_MAX], value[CASE_GAUGES_MAX][PLACE_VALUES];
  int any = 0;
  PetscFunctionBeginUser;
  GaugePoints(list, m, gauge, PETSC_TRUE, NULL, x);
  PetscCall(PlacesLocate(m, list->ngauges, (const double(*)[2])x, moving));
  PetscCall(Blocked(moving, fluid, blocked, &any));
  if (any) {
    GaugePoints(list, m, gauge, PETSC_FALSE, blocked, x);
    PetscCall(PlacesLocate(m, list->ngauges, (const double(*)[2])x, moving));
  }
  PetscCall(PlacesValues(moving, fluid, value));
  for (int k = 0; k < list->ngauges; k++) {
    const double rho = value[k][PLACE_RHO], p = value[k][PLACE_P], *at = gauge[k].x;
    reading[k] =
        (GaugeReading){{at[0], at[1]}, p, p + rho * (g[0] * (at[0] - x[k][0]) + g[1] * (at[1] - x[k][1]))};
  }
  PetscFunctionReturn(0);
}

void SolidGaugeForce(int n, const CoracleGauge gauge[], const GaugeReading reading[], double force[3])
{
  force[0] = force[1] = force[2] = 0.0;
  for (int i = 0; i < n; i++) {
    const double *x = reading[i].x, *before = reading[PetscMax(i - 1, 0)].x,
                 *after = reading[PetscMin(i + 1, n - 1)].x;
    /* at the ends one part for the half of two */
    const double length =
        hypot(after[0] - before[0], after[1] - before[1]) / (i > 0 && i < n - 1 ? 2.0 : 1.0);
    const double f[2] = {-reading[i].at_face * gauge[i].normal[0] * length,
                         -reading[i].at_face * gauge[i].normal[1] * length};
    double arm[2];
    for (int c = 0; c < 2; c++) arm[c] = x[c] - (1.5 * reading[0].x[c] - 0.5 * reading[1].x[c]);
    force[0] += f[0];
    force[1] += f[1];
    force[2] += arm[0] * f[1] - arm[1] * f[0];
  }
}
