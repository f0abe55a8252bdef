/* Compressible phases: their masses, and the volumes that follow from the flow's divergence. */
#include "fluid/phases/phases_impl.h"

/* Of an element's area: less of a phase has no density of its own; less is no gap. */
#define VOLUME_TINY 1e-9
#define GAP_TINY 1e-13
/* In which masses follow their volumes, one face each. */
#define ROUNDS 1000

PetscErrorCode PhasesSetStates(Phases f, const EquationOfState state[])
{
  const size_t n =
      (size_t)f->stars->nl * (size_t)f->np + 1; /* one more: not NULL on ranks without elements */
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(f->np, &f->state));
  PetscCall(PetscArraycpy(f->state, state, f->np));
  PetscCall(PetscCalloc1(n, &f->mass));
  PetscCall(PetscCalloc1(n, &f->density));
  PetscFunctionReturn(0);
}

static int IsGas(Phases f, int p)
{
  return f->state && f->state[p].pressure > 0.0;
}

void PhasesStartMasses(Phases f, const double pressure[])
{
  for (int k = 0; k < f->stars->ne * f->np; k++) {
    const int p = k % f->np;
    f->mass[k] = IsGas(f, p) ? f->volume[k] * GasDensity(&f->state[p], pressure[p]) : 0.0;
  }
}

double *PhasesMasses(Phases f)
{
  return f->mass;
}

const double *PhasesDensities(Phases f)
{
  return f->density;
}

PetscErrorCode PhasesUpdateDensities(Phases f)
{
  const Stars *s = f->stars;
  PetscFunctionBeginUser;
  if (!f->mass) PetscFunctionReturn(0);
  PetscCall(StarsExchange(s, (size_t)f->np * sizeof *f->mass, f->mass));
  PetscCall(StarsExchange(s, (size_t)f->np * sizeof *f->volume, f->volume));
  for (int k = 0; k < s->nl * f->np; k++) {
    const double tiny = VOLUME_TINY * StarsArea(s, k / f->np);
    f->density[k] = f->state[k % f->np].density;
    if (IsGas(f, k % f->np) && f->volume[k] > tiny && f->mass[k] > 0.0)
      f->density[k] = f->mass[k] / f->volume[k];
  }
  PetscFunctionReturn(0);
}

/* What an element has of a gas, m2 and kg, and what of it is still to leave through its faces, m2. */
typedef struct {
  double volume, mass, due[3];
} GasStore;

/* What leaves through face i in this round, m2: what is due, as far as the element has it. */
static double Leaves(const GasStore *g, int i)
{
  const double due = g->due[0] + g->due[1] + g->due[2];
  return g->volume > 0.0 && g->due[i] > 0.0 ? g->due[i] * fmin(1.0, g->volume / due) : 0.0;
}

static double LeavingMass(const GasStore *g, int i)
{
  const double volume = Leaves(g, i);
  return volume > 0.0 ? volume * (g->mass / g->volume) : 0.0;
}

/* Gas p before its volumes moved. */
static void SetStores(Phases f, int p, const double before[], const double swept[], GasStore store[])
{
  for (int e = 0; e < f->stars->ne; e++) {
    GasStore *g = &store[e];
    const size_t own = (size_t)e * (size_t)f->np + (size_t)p;
    g->volume = f->volume[own];
    g->mass = f->mass[own];
    for (int i = 0; i < 3; i++) {
      const size_t k = (3 * (size_t)e + (size_t)i) * (size_t)f->np + (size_t)p;
      g->volume += swept[k] - before[k];
      g->due[i] = fmax(swept[k] - before[k], 0.0);
    }
  }
}

/* Element e gives and receives; next: its store afterwards; swept_mass[3][np] of its faces.  1: it gave something. */
static int Pass(Phases f, int p, int e, const GasStore store[], GasStore *next, double swept_mass[])
{
  const Stars *s = f->stars;
  int gave = 0;
  *next = store[e];
  for (int i = 0; i < 3; i++) {
    const double volume = Leaves(&store[e], i);
    double in = 0.0, mass = LeavingMass(&store[e], i);
    const int o = s->neighbor[e][i];
    if (o >= 0) {
      in = Leaves(&store[o], StarsFaceTo(s, o, e));
      mass -= LeavingMass(&store[o], StarsFaceTo(s, o, e));
    }
    next->due[i] -= volume;
    next->volume += in - volume;
    next->mass -= mass;
    swept_mass[i * f->np + p] += mass;
    gave |= volume > GAP_TINY * StarsArea(s, e);
  }
  return gave;
}

/* What elements give at first is theirs, then what has come; until all has left, or, in a circle without gas, nothing can. */
static PetscErrorCode MoveMass(Phases f, int p, GasStore store[], GasStore next[], double swept_mass[])
{
  const Stars *s = f->stars;
  int more = 1;
  PetscFunctionBeginUser;
  for (int round = 0; more && round < ROUNDS; round++) {
    PetscCall(StarsExchange(s, sizeof *store, store));
    more = 0;
    for (int e = 0; e < s->ne; e++)
      more |= Pass(f, p, e, store, &next[e], &swept_mass[3 * (size_t)e * (size_t)f->np]);
    PetscCall(PetscArraycpy(store, next, s->ne));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &more, 1, MPI_INT, MPI_LOR, s->mesh->comm));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode PhasesMoveMasses(Phases f, const double before[], const double swept[], double swept_mass[])
{
  const Stars *s = f->stars;
  GasStore *store, *next;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(s->nl, &store, s->ne, &next));
  for (int p = 0; p < f->np; p++) {
    if (!IsGas(f, p)) continue;
    SetStores(f, p, before, swept, store);
    PetscCall(MoveMass(f, p, store, next, swept_mass));
    for (int e = 0; e < s->ne; e++) f->mass[(size_t)e * (size_t)f->np + (size_t)p] = store[e].mass;
  }
  PetscCall(PetscFree2(store, next));
  PetscFunctionReturn(0);
}

double PhasesCompressibility(Phases f, int e, double solid, int filler, double *pressure)
{
  const double area = StarsArea(f->stars, e);
  double sum = 0.0, weight = 0.0;
  *pressure = 0.0;
  for (int p = 0; f->mass && p < f->np; p++) {
    const size_t k = (size_t)e * (size_t)f->np + (size_t)p;
    const double outside = f->volume[k] - (p == filler ? solid * area : 0.0);
    if (!IsGas(f, p) || !(outside > VOLUME_TINY * area)) continue;
    sum += outside / area * GasCompressibility(&f->state[p], f->density[k]);
    weight += outside;
    *pressure += outside * GasPressure(&f->state[p], f->density[k]);
  }
  if (weight > 0.0) *pressure /= weight;
  return sum;
}

/* Compressible phases of each element take its gap by their volumes; where there is none, `gas` becomes that, also negative. */
static void TakeGaps(Phases f, int gas)
{
  for (int e = 0; e < f->stars->ne; e++) {
    double *v = &f->volume[(size_t)e * (size_t)f->np], gap = StarsArea(f->stars, e), all = 0.0;
    const double area = gap;
    for (int p = 0; p < f->np; p++) {
      gap -= v[p];
      if (IsGas(f, p)) all += fmax(v[p], 0.0);
    }
    if (all > VOLUME_TINY * area) {
      for (int p = 0; p < f->np; p++)
        if (IsGas(f, p)) v[p] += gap * fmax(v[p], 0.0) / all;
    } else if (fabs(gap) > GAP_TINY * area) {
      v[gas] += gap;
    }
  }
}

/* Gas has between half and twice the volume that its mass is expected to have, in its element; what is beyond is exchanged for a
 * liquid. */
static PetscErrorCode Bound(Phases f, int gas, int liquid, const double expected[], double swept[])
{
  const Stars *s = f->stars;
  double *capacity;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->ne, &capacity));
  for (int e = 0; e < s->ne; e++) {
    const size_t k = (size_t)e * (size_t)f->np + (size_t)gas;
    const double others =
        StarsArea(s, e) - f->volume[k] - f->volume[(size_t)e * (size_t)f->np + (size_t)liquid];
    capacity[e] = fmax(StarsArea(s, e) - others - 0.5 * f->mass[k] / expected[k], 0.0);
  }
  PetscCall(PhasesExpel(f, liquid, gas, capacity, NULL, swept));
  for (int e = 0; e < s->ne; e++) {
    const size_t k = (size_t)e * (size_t)f->np + (size_t)gas;
    capacity[e] = fmin(2.0 * fmax(f->mass[k], 0.0) / expected[k],
                       f->volume[k] + f->volume[(size_t)e * (size_t)f->np + (size_t)liquid]);
  }
  PetscCall(PhasesExpel(f, gas, liquid, capacity, NULL, swept));
  PetscCall(PetscFree(capacity));
  PetscFunctionReturn(0);
}

PetscErrorCode PhasesFillGaps(Phases f, const double expected[], double swept[])
{
  int gas = 0;
  PetscFunctionBeginUser;
  while (!IsGas(f, gas)) gas++;
  TakeGaps(f, gas);
  for (int p = 0; p < f->np; p++)
    if (!IsGas(f, p)) PetscCall(Bound(f, gas, p, expected, swept));
  f->has_lines = PETSC_FALSE;
  PetscFunctionReturn(0);
}
