/* Compressible phases: their masses, and the volumes that follow from the flow's divergence. */
#include "fluid/phases/phases_impl.h"

/* Of an element's area: less of a phase has no density of its own; less is no gap. */
#define VOLUME_TINY 1e-9
#define GAP_TINY 1e-13

PetscErrorCode PhasesSetStates(Phases f, const EquationOfState state[])
{
  const size_t n = (size_t)f->stars->nl * (size_t)f->np;
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

void PhasesStartMasses(Phases f)
{
  for (int k = 0; k < f->stars->ne * f->np; k++)
    f->mass[k] = IsGas(f, k % f->np) ? f->volume[k] * f->state[k % f->np].density : 0.0;
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

void PhasesMoveMasses(Phases f, const double before[], const double swept[], double swept_mass[])
{
  for (int k = 0; k < 3 * f->stars->ne * f->np; k++) {
    const int face = k / f->np, e = face / 3, p = k % f->np, o = f->stars->neighbor[e][face % 3];
    const double moved = swept[k] - before[k];
    if (!IsGas(f, p) || moved == 0.0) continue;
    const double mass = moved * f->density[(moved > 0.0 ? e : o) * f->np + p];
    f->mass[e * f->np + p] -= mass;
    swept_mass[k] += mass;
  }
}

double PhasesCompressibility(Phases f, int e, double solid, double *pressure)
{
  const double area = StarsArea(f->stars, e);
  double sum = 0.0, weight = 0.0;
  *pressure = 0.0;
  for (int p = 0; f->mass && p < f->np; p++) {
    const size_t k = (size_t)e * (size_t)f->np + (size_t)p;
    if (!IsGas(f, p) || !(f->volume[k] > VOLUME_TINY * area)) continue;
    sum += f->volume[k] / area * GasCompressibility(&f->state[p], f->density[k]);
    weight += f->volume[k];
    *pressure += f->volume[k] * GasPressure(&f->state[p], f->density[k]);
  }
  if (weight > 0.0) *pressure /= weight;
  return weight > solid * area ? sum * (1.0 - solid * area / weight) : 0.0;
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

/* Gas has between half and twice the volume that its mass is expected to have; what is beyond is exchanged for a liquid. */
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
  PetscCall(PhasesExpel(f, liquid, gas, capacity, swept));
  for (int e = 0; e < s->ne; e++) {
    const size_t k = (size_t)e * (size_t)f->np + (size_t)gas;
    capacity[e] = 2.0 * fmax(f->mass[k], 0.0) / expected[k];
  }
  PetscCall(PhasesExpel(f, gas, liquid, capacity, swept));
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
