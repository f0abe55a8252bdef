#include "fluid/input/phase_case.h"
#include "common/output/output.h"
#include "common/program/outline_case.h"
#include "fluid/input/fluid_case.h"

/* Of phase k, which is incompressible unless it says otherwise. */
static void ReadState(CoracleCase c, int k, double density, EquationOfState *state, double *initial_pressure)
{
  static const char *const SPEED[] = {"sound_speed", NULL};
  char key[CASE_KEY], gas[CASE_KEY];
  CoracleCaseNotBeside(c, CaseKey(key, "fluid.phases[%d]", k), "gas", SPEED);
  *state = (EquationOfState){density, 0.0, 1.0};
  (void)CaseKey(gas, "fluid.phases[%d].gas", k);
  if (CoracleCaseHas(c, CaseKey(key, "fluid.phases[%d].sound_speed", k))) {
    const double speed = CoracleCasePositive(c, key);
    state->pressure = density * speed * speed;
  }
  if (!CoracleCaseHas(c, gas)) return;
  state->pressure = CoracleCasePositive(c, CaseKey(key, "%s.pressure", gas));
  state->exponent = CoracleCaseNumberOr(c, CaseKey(key, "%s.exponent", gas), 1.0, 1.0, 10.0);
  *initial_pressure =
      CoracleCaseNumberOr(c, CaseKey(key, "%s.initial_pressure", gas), 0.0, -HUGE_VAL, HUGE_VAL);
  if (state->pressure + *initial_pressure <= 0.0)
    CoracleCaseRefuse(c, key, "expected more than %g Pa, with which the absolute pressure is 0, found %g",
                      -state->pressure, *initial_pressure);
}

/* Item k of fluid.phases becomes phase k. */
static void ReadPhase(CoracleCase c, int k, PhaseNames *names, PhaseProperties *p)
{
  /* what fluid/output/writer.c writes beside them */
  static const char *const FIELDS[] = {"alpha", "density", "pressure", "rank", "velocity"};
  char key[CASE_KEY];
  names->name[k] = CoracleCaseString(c, CaseKey(key, "fluid.phases[%d].name", k));
  if (!SeriesCanName(names->name[k]) || !OutputCanName(names->name[k]) ||
      strlen(names->name[k]) >= sizeof p->name[k])
    CoracleCaseRefuse(c, key, "expected a name of at most %d letters, digits, '_', '-' and blanks",
                      (int)sizeof p->name[k] - 1);
  for (size_t j = 0; j < sizeof FIELDS / sizeof *FIELDS; j++)
    if (!strcmp(FIELDS[j], names->name[k]))
      CoracleCaseRefuse(c, key, "fluid.h5 has another field of the name '%s'", names->name[k]);
  for (int j = 0; j < k; j++)
    if (!strcmp(names->name[j], names->name[k]))
      CoracleCaseRefuse(c, key, "two phases are called '%s'", names->name[k]);
  p->rho[k] = CoracleCasePositive(c, CaseKey(key, "fluid.phases[%d].density", k));
  p->mu[k] = CoracleCasePositive(c, CaseKey(key, "fluid.phases[%d].viscosity", k));
  ReadState(c, k, p->rho[k], &p->state[k], &p->initial_pressure[k]);
}

static void Swap(double *a, double *b)
{
  const double other = *a;
  *a = *b;
  *b = other;
}

/* The heaviest first; those of equal density stay in the order of the case. */
static void SortByDensity(PhaseNames *names, PhaseProperties *p)
{
  for (int k = 1; k < p->n; k++)
    for (int j = k; j > 0 && p->rho[j - 1] < p->rho[j]; j--) {
      const char *name = names->name[j];
      names->name[j] = names->name[j - 1];
      names->name[j - 1] = name;
      Swap(&p->rho[j], &p->rho[j - 1]);
      Swap(&p->mu[j], &p->mu[j - 1]);
      Swap(&p->initial_pressure[j], &p->initial_pressure[j - 1]);
      const EquationOfState state = p->state[j];
      p->state[j] = p->state[j - 1];
      p->state[j - 1] = state;
    }
}

/* A number for each pair of phases: that at key for all, or its list of items {between: [first, second], value}, 0 for the others.
 * antisymmetric: value[second][first] = -value[first][second].  convert(number): what is kept; NULL: itself. */
typedef struct {
  const char *key;
  double lower, upper;
  double (*convert)(double);
  PetscBool antisymmetric;
} PhasePairsKey;

static void SetPair(const PhasePairsKey *key, int first, int second, double number, PhasesPairs *pairs)
{
  const double value = key->convert ? key->convert(number) : number;
  pairs->value[first][second] = value;
  pairs->value[second][first] = key->antisymmetric ? -value : value;
}

/* Item k of the list. */
static void ReadPair(CoracleCase c, const PhasePairsKey *key, int k, const PhaseNames *names,
                     PetscBool seen[PHASES_MAX][PHASES_MAX], PhasesPairs *pairs)
{
  int phase[2];
  char sub[CASE_KEY];
  if (CoracleCaseCount(c, CaseKey(sub, "%s[%d].between", key->key, k)) != 2)
    CoracleCaseRefuse(c, sub, "expected the names of two phases");
  for (int i = 0; i < 2; i++) {
    phase[i] = PhaseCaseIndex(c, CaseKey(sub, "%s[%d].between[%d]", key->key, k, i), names);
  }
  if (phase[0] == phase[1] || seen[phase[0]][phase[1]])
    CoracleCaseRefuse(c, sub,
                      phase[0] == phase[1] ? "expected another phase than the first"
                                           : "an item before this one is of the same two phases");
  seen[phase[0]][phase[1]] = seen[phase[1]][phase[0]] = PETSC_TRUE;
  SetPair(key, phase[0], phase[1],
          CoracleCaseNumber(c, CaseKey(sub, "%s[%d].value", key->key, k), key->lower, key->upper), pairs);
}

static void ReadPairs(CoracleCase c, const PhasePairsKey *key, const PhaseNames *names, PhasesPairs *pairs)
{
  PetscBool seen[PHASES_MAX][PHASES_MAX] = {{PETSC_FALSE}};
  char first[CASE_KEY];
  *pairs = (PhasesPairs){{{0.0}}};
  if (CoracleCaseHas(c, CaseKey(first, "%s[0]", key->key))) {
    for (int k = 0; k < CoracleCaseCount(c, key->key); k++) ReadPair(c, key, k, names, seen, pairs);
  } else if (CoracleCaseHas(c, key->key)) {
    const double number = CoracleCaseNumber(c, key->key, key->lower, key->upper);
    for (int k = 0; names->name[k]; k++)
      for (int j = 0; j < k; j++) SetPair(key, j, k, number, pairs);
  }
}

static double CosineOfDegrees(double angle)
{
  return cos(angle * M_PI / 180.0);
}

void PhaseCaseAngles(CoracleCase c, const char *key, const PhaseNames *names, PhasesPairs *cosine)
{
  const PhasePairsKey angle = {key, 0.0, 180.0, CosineOfDegrees, PETSC_TRUE};
  if (CoracleCaseHas(c, key) && !CoracleCaseHas(c, "fluid.surface_tension"))
    CoracleCaseRefuse(c, key, "without fluid.surface_tension interfaces have no contact angle");
  ReadPairs(c, &angle, names, cosine);
}

int PhaseCaseIndex(CoracleCase c, const char *key, const PhaseNames *names)
{
  const char *name = CoracleCaseString(c, key);
  char known[256] = "";
  for (int k = 0; names->name[k]; k++) {
    const size_t used = strlen(known);
    if (!strcmp(name, names->name[k])) return k;
    (void)snprintf(known + used, sizeof known - used, "%s%s", k ? ", " : "", names->name[k]);
  }
  CoracleCaseRefuse(c, key, "expected a phase (%s), found '%s'", known, name);
}

/* fluid.regions[k].what */
static const char *KeyOf(int k, const char *what, char key[CASE_KEY])
{
  return CaseKey(key, "fluid.regions[%d].%s", k, what);
}

static PetscErrorCode ReadPolygon(CoracleCase c, int k, Region *r)
{
  double(*x)[2];
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  PetscCall(CaseReadOutline(c, KeyOf(k, "polygon", key), &r->n, &x));
  r->x = (const double(*)[2])x;
  PetscFunctionReturn(0);
}

static void ReadBox(CoracleCase c, int k, Region *r)
{
  char key[CASE_KEY];
  CoracleCaseVector(c, KeyOf(k, "lower", key), 2, r->a);
  CoracleCaseVector(c, KeyOf(k, "upper", key), 2, r->b);
  if (!(r->b[0] > r->a[0] && r->b[1] > r->a[1]))
    CoracleCaseRefuse(c, key,
                      "the box is empty: expected a corner above and right of lower (%g, %g), found (%g, %g)",
                      r->a[0], r->a[1], r->b[0], r->b[1]);
}

/* Whether region k has a shape; else it is everywhere. */
static PetscBool HasShape(CoracleCase c, int k)
{
  static const char *const SHAPES[] = {"lower", "upper", "centre", "polygon", "point", "normal", NULL};
  char key[CASE_KEY];
  for (int i = 0; SHAPES[i]; i++)
    if (CoracleCaseHas(c, KeyOf(k, SHAPES[i], key))) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* The shape follows from the keys that are there. */
static PetscErrorCode ReadRegion(CoracleCase c, const PhaseNames *names, int k, Region *r)
{
  static const char *const FIRST[] = {"lower", "centre", "polygon", "point", NULL};
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  for (int i = 0; FIRST[i]; i++)
    CoracleCaseNotBeside(c, CaseKey(key, "fluid.regions[%d]", k), FIRST[i], FIRST + i + 1);
  *r = (Region){.phase = PhaseCaseIndex(c, KeyOf(k, "phase", key), names)};
  if (!HasShape(c, k)) {
    r->shape = REGION_BOX;
    for (int d = 0; d < 2; d++) r->a[d] = -HUGE_VAL, r->b[d] = HUGE_VAL;
  } else if (CoracleCaseHas(c, KeyOf(k, "lower", key)) || CoracleCaseHas(c, KeyOf(k, "upper", key))) {
    r->shape = REGION_BOX;
    ReadBox(c, k, r);
  } else if (CoracleCaseHas(c, KeyOf(k, "centre", key))) {
    r->shape = REGION_DISC;
    CoracleCaseVector(c, key, 2, r->a);
    r->radius = CoracleCasePositive(c, KeyOf(k, "radius", key));
  } else if (CoracleCaseHas(c, KeyOf(k, "polygon", key))) {
    r->shape = REGION_POLYGON;
    PetscCall(ReadPolygon(c, k, r));
  } else {
    r->shape = REGION_HALF_PLANE;
    CoracleCaseVector(c, KeyOf(k, "point", key), 2, r->a);
    CoracleCaseVector(c, KeyOf(k, "normal", key), 2, r->b);
    if (r->b[0] == 0.0 && r->b[1] == 0.0) CoracleCaseRefuse(c, key, "expected a direction, found (0, 0)");
  }
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCaseRegions(CoracleCase c, int *nregions, Region **region)
{
  PhaseNames names;
  PhaseProperties properties;
  PetscFunctionBeginUser;
  *nregions = 0;
  *region = NULL;
  PhaseCaseRead(c, &names, &properties);
  if (!properties.n) PetscFunctionReturn(0);
  *nregions = CoracleCaseCount(c, "fluid.regions");
  if (!*nregions) CoracleCaseRefuse(c, "fluid.regions", "expected a list of where the phases are");
  PetscCall(PetscCalloc1(*nregions, region));
  for (int k = 0; k < *nregions; k++) PetscCall(ReadRegion(c, &names, k, *region + k));
  if (HasShape(c, 0))
    CoracleCaseRefuse(c, "fluid.regions", "the first region is everywhere: expected the key phase alone");
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCaseFreeRegions(int nregions, Region **region)
{
  PetscFunctionBeginUser;
  for (int k = 0; k < nregions; k++) PetscCall(PetscFree((*region)[k].x));
  PetscCall(PetscFree(*region));
  PetscFunctionReturn(0);
}

void PhaseCaseRead(CoracleCase c, PhaseNames *names, PhaseProperties *p)
{
  static const char *const ADVECTIONS[] = {
      [PHASES_GEOMETRIC] = "geometric", [PHASES_COMPRESSIVE] = "compressive", NULL};
  const PhasePairsKey tension = {"fluid.surface_tension", 0.0, HUGE_VAL, NULL, PETSC_FALSE};
  *names = (PhaseNames){{NULL}};
  *p = (PhaseProperties){0};
  if (!CoracleCaseHas(c, "fluid.phases")) return;
  p->n = CoracleCaseCount(c, "fluid.phases");
  if (p->n < 2 || p->n > PHASES_MAX)
    CoracleCaseRefuse(c, "fluid.phases", "expected from 2 to %d phases, found %d", PHASES_MAX, p->n);
  for (int k = 0; k < p->n; k++) ReadPhase(c, k, names, p);
  if (p->n > 2) SortByDensity(names, p);
  for (int k = 0; k < p->n; k++) (void)snprintf(p->name[k], sizeof p->name[k], "%s", names->name[k]);
  ReadPairs(c, &tension, names, &p->surface_tension);
  if (p->n == PHASES_MAX && CoracleCaseHas(c, "fluid.surface_tension"))
    CoracleCaseRefuse(c, "fluid.surface_tension",
                      "with it there are at most %d phases, the solid being one more", PHASES_MAX - 1);
  PhaseCaseAngles(c, "fluid.contact_angle", names, &p->solid_cosine);
  p->advection = (PhasesAdvection)CoracleCaseWord(c, "fluid.phases_advection", PHASES_GEOMETRIC, ADVECTIONS);
}
