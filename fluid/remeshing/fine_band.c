#include "fluid/remeshing/fine_band.h"
#include "common/exchange/box_scatter.h"
#include "common/supermesh/search.h"
#include "fluid/flow/fluid_impl.h"

/* Of an element, what of all phases but one is the tail of a smeared interface. */
#define TAIL 1e-3

/* Where a piece of the surface is and where it will be at the next adaptation, and the size that it wants. */
typedef struct {
  double from[2], to[2], size;
} Sweep;

/* Whether element e has more than one phase, or the interface lies along its faces; of what is smeared or spread, more than its tail or a cloud. */
static PetscBool OfInterface(Fluid f, int e)
{
  const Phases phases = PhaseTransportPhases(f->phases);
  int n;
  const double *volume = PhaseTransportVolumes(f->phases, &n);
  const PetscBool smeared = (PetscBool)(f->setup.phases.advection != PHASES_GEOMETRIC);
  double most = 0.0;
  if (PhasesSingle(phases, e) >= 0) return PhasesEndAt(phases, e);
  if (!smeared && !PhasesSpread(phases, e)) return PETSC_TRUE;
  for (int p = 0; p < n; p++) most = fmax(most, volume[n * e + p]);
  return (PetscBool)(most < (1.0 - (smeared ? TAIL : PHASES_CLOUD)) * f->domain.geometry[e].area);
}

/* Mean velocity of element e in the flow of the current step, if the interface cuts it; light elements follow the others,
 * whose motion it is. */
static PetscBool InterfaceVelocity(Fluid f, int e, double velocity[2])
{
  const double *u = FluidVelocityProjected(f) + 6 * e;
  double low, high;
  if (!f->phases || !OfInterface(f, e)) return PETSC_FALSE;
  FluidDensityRange(f, e, &low, &high);
  const double heavy = FluidDensity(f)[e] < 0.25 * (low + high) ? 0.0 : 1.0;
  for (int c = 0; c < 2; c++) velocity[c] = heavy / 3.0 * (u[3 * c] + u[3 * c + 1] + u[3 * c + 2]);
  return PETSC_TRUE;
}

PetscErrorCode FineBandSpeed(Fluid f, double *speed)
{
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(f->solid, &n);
  PetscFunctionBeginUser;
  *speed = 0.0;
  for (int k = 0; k < n; k++) {
    const double *u = entry[k].velocity;
    *speed = fmax(*speed, hypot(u[0], u[1]));
  }
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    double u[2];
    if (InterfaceVelocity(f, e, u)) *speed = fmax(*speed, hypot(u[0], u[1]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, speed, 1, MPI_DOUBLE, MPI_MAX, f->domain.mesh->comm));
  PetscFunctionReturn(0);
}

static Sweep SweepOf(const Mesh *m, int e, const double velocity[2], double ahead, double size)
{
  Sweep s = {.size = size};
  for (int c = 0; c < 2; c++) {
    for (int i = 0; i < 3; i++) s.from[c] += ElementVertex(m, e, i)[c] / 3.0;
    s.to[c] = s.from[c] + ahead * velocity[c];
  }
  return s;
}

/* This rank's part of the surfaces, and how far they go until the next adaptation; sweep has room for all elements. */
static int LocalSweeps(Fluid f, const FineBand *b, Sweep sweep[])
{
  const Mesh *m = f->domain.mesh;
  int n = 0, nentries;
  const CoracleCoupling *entry = SolidCouplingEntries(f->solid, &nentries);
  for (int k = 0; k < nentries; k++)
    if (entry[k].flags & CORACLE_HAS_SHELL)
      sweep[n++] = SweepOf(m, entry[k].element, entry[k].velocity, b->ahead,
                           entry[k].flags & CORACLE_HAS_CORNER ? b->corner_size : b->size_min);
  for (int e = 0; e < m->ne; e++) {
    double velocity[2];
    if (InterfaceVelocity(f, e, velocity)) sweep[n++] = SweepOf(m, e, velocity, b->ahead, b->interface_size);
  }
  return n;
}

static GeometryBox BoxOf(const Sweep *s, double near)
{
  GeometryBox box = GeometryBoxEmpty();
  GeometryBoxGrow(&box, s->from);
  GeometryBoxGrow(&box, s->to);
  return GeometryBoxWidened(box, near);
}

/* Of the surfaces of all ranks what is near the first nv vertices; *sweep is allocated. */
static PetscErrorCode Sweeps(Fluid f, const FineBand *b, double near, int nv, int *n, Sweep **sweep)
{
  const Mesh *m = f->domain.mesh;
  GeometryBox *box, bounds = GeometryBoxEmpty();
  Sweep *local;
  void *arrived;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * m->ne, &local));
  const int mine = LocalSweeps(f, b, local);
  PetscCall(PetscMalloc1(mine, &box));
  for (int k = 0; k < mine; k++) box[k] = BoxOf(&local[k], near);
  for (int v = 0; v < nv; v++) GeometryBoxGrow(&bounds, m->x + 2 * v);
  PetscCall(BoxScatterRecords(m->comm, mine, box, &bounds, sizeof *local, local, n, &arrived));
  *sweep = arrived;
  PetscCall(PetscFree(box));
  PetscCall(PetscFree(local));
  PetscFunctionReturn(0);
}

static double Distance(const Sweep *s, const double x[2])
{
  return GeometryDistanceAt(s->from, s->to, GeometrySegmentPlace(s->from, s->to, x), x);
}

PetscErrorCode FineBandSizes(Fluid f, const FineBand *b, int nv, double size[])
{
  const double near = b->reach + 2.0 * FINE_BAND * fmax(b->size_min, b->interface_size);
  Sweep *sweep;
  GeometryBox *box;
  Search search;
  int n;
  PetscFunctionBeginUser;
  PetscCall(Sweeps(f, b, near, nv, &n, &sweep));
  PetscCall(PetscMalloc1(n, &box));
  for (int k = 0; k < n; k++) box[k] = BoxOf(&sweep[k], near);
  PetscCheck(!SearchCreate(n, box, &search), PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for the surface");
  for (int v = 0; v < nv; v++) {
    const double *x = f->domain.mesh->x + 2 * v;
    const GeometryBox point = {{x[0], x[1]}, {x[0], x[1]}};
    const int *hit, nhit = SearchQuery(search, &point, &hit);
    size[v] = b->size_max;
    for (int h = 0; h < nhit; h++) {
      const Sweep *k = sweep + hit[h];
      size[v] = fmin(size[v], k->size + b->slope * fmax(Distance(k, x) - FINE_BAND * k->size, 0.0));
    }
  }
  SearchDestroy(&search);
  PetscCall(PetscFree(box));
  PetscCall(PetscFree(sweep));
  PetscFunctionReturn(0);
}
