// ranks: 1 2 3
/* Water that is expelled, or fills gaps, among a gas.  The gas's mass goes with the volumes that are exchanged, also through elements that
 * have none of it: it is kept, nowhere negative, in elements of water there is none, and densities stay between those that there were.
 * Gas that fills gaps among water does not take more of an element than there is.  Beside a solid all of a gas
 * counts that does not fill the solid. */
#include "tests/phases/flows.h"
#include "tests/phases/set.h"

enum { WATER, GAS, NPHASES };
#define RHO 1.2 /* at pressure 0, where nothing of the gas is */
#define LEAST 1.5
#define MOST 1.8

static const EquationOfState STATES[NPHASES] = {{1000.0, 0.0, 0.0}, {RHO, 1e4, 1.0}};

typedef struct {
  double *volume, *capacity, *before, *swept, *mass, *expected;
} Work;

static PetscErrorCode WorkMake(int ne, Work *w)
{
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc6(NPHASES * ne, &w->volume, ne, &w->capacity, 3 * NPHASES * ne, &w->before,
                         3 * NPHASES * ne, &w->swept, 3 * NPHASES * ne, &w->mass, NPHASES * ne,
                         &w->expected));
  PetscFunctionReturn(0);
}

static PetscErrorCode WorkDestroy(Work *w)
{
  return PetscFree6(w->volume, w->capacity, w->before, w->swept, w->mass, w->expected);
}

static void Centroid(const Set *s, int e, double x[2])
{
  for (int c = 0; c < 2; c++)
    x[c] = (s->stars->element[e].x[0][c] + s->stars->element[e].x[1][c] + s->stars->element[e].x[2][c]) / 3.0;
}

static double Density(const double x[2])
{
  return LEAST + (MOST - LEAST) * x[0];
}

/* Sets volumes of gas share[ne] and masses of Density. */
static PetscErrorCode Start(Set *s, Work *w, double water, const double gas[])
{
  PetscFunctionBeginUser;
  for (int e = 0; e < s->mesh->ne; e++) {
    const double area = StarsArea(s->stars, e);
    double x[2];
    Centroid(s, e, x);
    w->volume[NPHASES * e + WATER] = (gas[e] > 0.0 ? 1.0 - gas[e] : water) * area;
    w->volume[NPHASES * e + GAS] = gas[e] * area;
    w->expected[NPHASES * e + GAS] = w->expected[NPHASES * e + WATER] = Density(x);
    PhasesMasses(s->phases)[NPHASES * e + GAS] = gas[e] * area * Density(x);
  }
  PetscCall(PhasesSetVolumes(s->phases, w->volume));
  PetscCall(PhasesUpdateDensities(s->phases));
  PetscFunctionReturn(0);
}

/* Sums over all ranks. */
static PetscErrorCode Sum(const Set *s, double sum[NPHASES + 1])
{
  const double *volume;
  PetscFunctionBeginUser;
  PetscCall(PhasesGetVolumes(s->phases, &volume));
  for (int p = 0; p <= NPHASES; p++) sum[p] = 0.0;
  for (int e = 0; e < s->mesh->ne; e++) {
    for (int p = 0; p < NPHASES; p++) sum[p] += volume[NPHASES * e + p];
    sum[NPHASES] += PhasesMasses(s->phases)[NPHASES * e + GAS];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, NPHASES + 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

static void CheckVolumes(const Set *s, const double volume[], int e)
{
  const double area = StarsArea(s->stars, e), *v = &volume[NPHASES * e];
  CHECK(fabs(v[WATER] + v[GAS] - area) < 1e-14, "element %d: %g m2 of %g", e, v[WATER] + v[GAS], area);
  CHECK(v[WATER] > -1e-15 && v[GAS] > -1e-15, "element %d of %g m2: %g m2 of water, %g m2 of gas", e, area,
        v[WATER], v[GAS]);
}

static void CheckMass(const Set *s, const Work *w, const double volume[], double start, int e)
{
  const double v = volume[NPHASES * e + GAS], m = PhasesMasses(s->phases)[NPHASES * e + GAS];
  double left = start - m;
  CHECK(m > -1e-15 && m < MOST * v + 1e-15, "element %d: %g kg in %g m2", e, m, v);
  CHECK(m > LEAST * v - 1e-15, "element %d: %g kg in %g m2", e, m, v);
  for (int i = 0; i < 3; i++) left -= w->mass[NPHASES * (3 * e + i) + GAS];
  CHECK(fabs(left) < 1e-15, "element %d: what passed its faces is not the change of its mass, by %g kg", e,
        left);
}

/* Water up to 0.8; of a body deep in it 0.6 is expelled, past elements that are full of water. */
static PetscErrorCode Expelled(Set *s, Work *w)
{
  double sum[2][NPHASES + 1], *gas, *start;
  const double *volume;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(s->mesh->ne, &gas, s->mesh->ne, &start));
  for (int e = 0; e < s->mesh->ne; e++) {
    double x[2];
    Centroid(s, e, x);
    gas[e] = x[1] > 0.8 ? 1.0 : 0.0;
    w->capacity[e] =
        (x[0] > 0.3 && x[0] < 0.6 && x[1] > 0.3 && x[1] < 0.5 ? 0.4 : 1.0) * StarsArea(s->stars, e);
  }
  PetscCall(Start(s, w, 1.0, gas));
  for (int e = 0; e < s->mesh->ne; e++) start[e] = PhasesMasses(s->phases)[NPHASES * e + GAS];
  PetscCall(Sum(s, sum[0]));
  PetscCall(PhasesExpel(s->phases, WATER, GAS, w->capacity, NULL, w->swept));
  PetscCall(PhasesMoveMasses(s->phases, w->before, w->swept, w->mass));
  PetscCall(Sum(s, sum[1]));
  PetscCall(PhasesGetVolumes(s->phases, &volume));
  for (int e = 0; e < s->mesh->ne; e++) {
    CheckVolumes(s, volume, e);
    CheckMass(s, w, volume, start[e], e);
    CHECK(volume[NPHASES * e + WATER] < w->capacity[e] + 1e-15, "element %d keeps its water", e);
  }
  for (int p = 0; p <= NPHASES; p++)
    CHECK(fabs(sum[1][p] - sum[0][p]) < 1e-14, "%d: %.16g becomes %.16g", p, sum[0][p], sum[1][p]);
  PetscCall(PetscFree2(gas, start));
  PetscFunctionReturn(0);
}

/* Water up to 0.5, where elements have 0.1 of it; below, some lack a fifth of theirs. */
static PetscErrorCode Gaps(Set *s, Work *w)
{
  double sum[2][NPHASES + 1], *gas;
  const double *volume;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->mesh->ne, &gas));
  for (int e = 0; e < s->mesh->ne; e++) {
    double x[2];
    Centroid(s, e, x);
    gas[e] = x[1] > 0.56 ? 1.0 : x[1] > 0.5 ? 0.9 : 0.0;
  }
  PetscCall(Start(s, w, 1.0, gas));
  for (int e = 0; e < s->mesh->ne; e++) {
    double x[2];
    Centroid(s, e, x);
    if (x[0] > 0.3 && x[0] < 0.5 && x[1] > 0.3 && x[1] < 0.4) w->volume[NPHASES * e + WATER] *= 0.8;
  }
  PetscCall(PhasesSetVolumes(s->phases, w->volume));
  PetscCall(Sum(s, sum[0]));
  PetscCall(PhasesFillGaps(s->phases, w->expected, w->swept));
  PetscCall(Sum(s, sum[1]));
  PetscCall(PhasesGetVolumes(s->phases, &volume));
  for (int e = 0; e < s->mesh->ne; e++) CheckVolumes(s, volume, e);
  CHECK(fabs(sum[1][WATER] - sum[0][WATER]) < 1e-14 && sum[1][NPHASES] == sum[0][NPHASES],
        "%.16g m2 of water become %.16g, %.16g kg of gas %.16g", sum[0][WATER], sum[1][WATER],
        sum[0][NPHASES], sum[1][NPHASES]);
  PetscCall(PetscFree(gas));
  PetscFunctionReturn(0);
}

/* The solid's part of an element is its filler's: what is compressible beside a tenth of a solid that water, or gas, fills. */
static PetscErrorCode Beside(Set *s, Work *w)
{
  double *gas, pressure;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->mesh->ne, &gas));
  for (int e = 0; e < s->mesh->ne; e++) gas[e] = 0.6;
  PetscCall(Start(s, w, 0.4, gas));
  for (int e = 0; e < s->mesh->ne; e++) {
    for (int filler = 0; filler < NPHASES; filler++) {
      const double rho = PhasesDensities(s->phases)[NPHASES * e + GAS];
      const double expected = (filler == GAS ? 0.5 : 0.6) * GasCompressibility(&STATES[GAS], rho);
      const double found = PhasesCompressibility(s->phases, e, 0.1, filler, &pressure);
      CHECK(fabs(found - expected) < 1e-12 * expected,
            "element %d beside a solid full of phase %d: %g 1/Pa, expected %g", e, filler, found, expected);
      CHECK(fabs(pressure - GasPressure(&STATES[GAS], rho)) < 1e-9 * STATES[GAS].pressure,
            "element %d: %g Pa", e, pressure);
    }
  }
  PetscCall(PetscFree(gas));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const Shaken shaken = {.n = 14, .seed = 3u, .radius = 1.0};
  Mesh *mesh;
  Set s;
  Work w;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(SetMake(mesh, NPHASES, &s));
  PetscCall(PhasesSetStates(s.phases, STATES));
  PetscCall(WorkMake(mesh->ne, &w));
  PetscCall(Expelled(&s, &w));
  PetscCall(Gaps(&s, &w));
  PetscCall(Beside(&s, &w));
  PetscCall(WorkDestroy(&w));
  PetscCall(SetDestroy(&s));
  return PetscFinalize();
}
