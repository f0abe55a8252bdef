/* Where the phases are at a run's start: those of the regions, but for what a solid displaces. */
#include "fluid/phases/cut_of_moment.h"
#include "fluid/transport/phase_transport_impl.h"

/* The volumes are those of the run's start. */
static PetscErrorCode StartVolumes(PhaseTransport t)
{
  PetscFunctionBeginUser;
  if (PhasesMasses(t->phases)) PhasesStartMasses(t->phases, t->properties.initial_pressure);
  PetscCall(PhaseTransportSumVolumes(t, t->budget.initial));
  PetscCall(PhaseTransportReconstruct(t));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportFill(PhaseTransport t, int nregions, const Region region[])
{
  PetscFunctionBeginUser;
  PetscCall(PhasesFill(t->phases, nregions, region));
  PetscCall(StartVolumes(t));
  PetscFunctionReturn(0);
}

/* volume[n] of an element: heavier phases than `light` no more than room, m2, all by the same factor. */
static void MakeRoom(int n, int light, double room, double volume[])
{
  double heavy = 0.0;
  for (int k = 0; k < n; k++)
    if (k != light) heavy += volume[k];
  if (heavy <= room) return;
  for (int k = 0; k < n; k++)
    if (k != light) volume[k] *= room / heavy;
  volume[light] += heavy - room;
}

/* Takes off volume[n] of element e what of phases other than `light` lies within the solid, which is taken for what a straight line
 * cuts off: of area solid, m2, with its mean at centre. */
static PetscErrorCode TakeInside(PhaseTransport t, int e, int n, int light, double solid,
                                 const double centre[2], double volume[])
{
  const double(*x)[2] = (const double(*)[2])t->stars->element[e].x, origin[2] = {0.0, 0.0};
  Polygon whole, part, inside;
  HalfPlane cut;
  PetscFunctionBeginUser;
  PolygonTriangle(x, origin, &whole);
  cut = CutOfMoment(&whole, solid, centre);
  for (int k = 0; k < n; k++) {
    if (k == light || !(volume[k] > 0.0)) continue;
    PetscCall(PhasesGetPolygon(t->phases, e, k, &part));
    PolygonClip(&part, &cut, &inside);
    const double displaced = fmin(PolygonArea(&inside), volume[k]);
    volume[k] -= displaced;
    volume[light] += displaced;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportStartSolid(PhaseTransport t, const double solid[], const double centre[][2])
{
  const int light = PhaseLightest(&t->properties);
  int n;
  const double *filled = PhaseTransportVolumes(t, &n);
  double *volume;
  PetscFunctionBeginUser;
  PetscCall(PhaseTransportSetSolid(t, solid, NULL));
  PetscCall(PetscMalloc1((size_t)n * (size_t)t->stars->ne, &volume));
  PetscCall(PetscArraycpy(volume, filled, (size_t)n * (size_t)t->stars->ne));
  for (int e = 0; e < t->stars->ne; e++) {
    const double area = t->domain->geometry[e].area;
    if (!(solid[e] > 0.0)) continue;
    if (solid[e] < 1.0) PetscCall(TakeInside(t, e, n, light, solid[e] * area, centre[e], volume + n * e));
    MakeRoom(n, light, fmax(1.0 - solid[e], 0.0) * area, volume + n * e);
  }
  PetscCall(PhasesSetVolumes(t->phases, volume));
  PetscCall(PetscFree(volume));
  PetscCall(StartVolumes(t));
  PetscFunctionReturn(0);
}
