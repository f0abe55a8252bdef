#include "coupler/step/coupler_impl.h"
#include "coupler/terms/inertia.h"
#include "coupler/terms/viscous_response.h"

PetscErrorCode CouplerCreate(MPI_Comm comm, const CouplerOptions *options, Coupler *coupler)
{
  Coupler c;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&c));
  c->comm = c->history.comm = comm;
  c->options = *options;
  c->mode = CouplerModeGet(options->mode);
  PetscCall(ShellCreate(comm, options->thickness, &c->shell));
  PetscCall(OverlapCreate(comm, &c->overlap));
  if (options->uplift)
    PetscCall(UpliftCreate(comm, options->lower, options->upper, c->options.gravity, &c->uplift));
  *coupler = c;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerUsePressureLoad(Coupler c)
{
  PetscFunctionBeginUser;
  PetscCall(PressureLoadCreate(c->comm, &c->pressure_load));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerSetElements(Coupler c, const FluidElements *elements)
{
  PetscFunctionBeginUser;
  PetscCall(OverlapSetElements(c->overlap, elements));
  PetscFunctionReturn(0);
}

static PetscErrorCode FreeStep(Coupler c)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree3(c->term, c->coupling, c->element));
  PetscCall(PetscFree3(c->vertex, c->source, c->force));
  PetscCall(PetscFree5(c->node, c->start, c->predicted, c->acceleration, c->explicit_fraction));
  PetscCall(PetscFree3(c->mobility, c->displaced, c->given));
  PetscFunctionReturn(0);
}

static PetscErrorCode NewStep(Coupler c, const SolidState *solid)
{
  const Overlap o = c->overlap;
  const size_t nsources = (size_t)o->nsources, n = (size_t)solid->nnodes;

  PetscFunctionBeginUser;
  PetscCall(FreeStep(c));
  PetscCall(PetscMalloc3(o->pairs.n, &c->term, o->ncoupled, &c->coupling, o->ncoupled, &c->element));
  PetscCall(PetscMalloc3(3 * nsources, &c->vertex, nsources, &c->source, 2 * n, &c->force));
  PetscCall(PetscMalloc5(n, &c->node, 2 * n, &c->start, 2 * n, &c->predicted, 2 * n, &c->acceleration, n,
                         &c->explicit_fraction));
  PetscCall(PetscCalloc3(n, &c->mobility, n, &c->displaced, n, &c->given));
  PetscCall(PetscArrayzero(c->term, o->pairs.n));
  PetscCall(PetscArrayzero(c->element, o->ncoupled));
  PetscCall(PetscArrayzero(c->source, nsources));
  for (size_t t = 0; t < nsources; t++)
    c->source[t].start = LinearFieldOnSource(&o->source_basis[t], (const double(*)[2])o->source[t].u);
  PetscCall(PetscArraycpy(c->start, solid->u, 2 * n));
  PetscCall(PetscArraycpy(c->mobility, solid->mobility, n));
  c->nnodes = solid->nnodes;
  PetscFunctionReturn(0);
}

/* From the step before, or, of a node that is held, from the motion it is held to: the velocity at the end of this one; and the
 * acceleration by all but the fluid inside the solid, which the shell's reaction and the pressure outside are part of. */
static void Predict(Coupler c, const SolidState *solid)
{
  const History *h = &c->history;
  const PetscBool known = h->known && c->options.mode == COUPLER_REACTION ? PETSC_TRUE : PETSC_FALSE;
  for (int k = 0; k < 2 * c->nnodes; k++) {
    const int i = k / 2;
    const double *a = solid->acceleration + 2 * i;
    c->given[i] =
        c->options.mode == COUPLER_REACTION && solid->mobility[i] == 0.0 && (a[0] != 0.0 || a[1] != 0.0);
    c->predicted[k] = c->start[k] + c->dt * (c->given[i] ? a[k % 2] : known ? h->lasting[i][k % 2] : 0.0);
    c->acceleration[k] = solid->acceleration[k] + (known ? h->outside[i][k % 2] : 0.0);
  }
}

/* Shell, overlap and coefficients with the solid at x. */
static PetscErrorCode BuildAt(Coupler c, const SolidState *solid, const double x[])
{
  const PetscBool new_mesh = solid->changed || !c->built ? PETSC_TRUE : PETSC_FALSE;
  SolidState at = *solid;

  PetscFunctionBeginUser;
  at.x = x;
  PetscCall(ShellExtrude(c->shell, &at, new_mesh));
  PetscCall(OverlapBuild(c->overlap, &at, c->shell, new_mesh));
  PetscCall(NewStep(c, &at));
  if (c->pressure_load) PetscCall(PressureLoadBuild(c->pressure_load, &at));
  if (c->uplift) PetscCall(UpliftBuild(c->uplift, &at, c->shell, c->overlap));
  if (new_mesh) PetscCall(HarmonicDestroy(&c->harmonic));
  c->built = 1;
  c->single_iteration_step = 0.0;
  PetscCall(c->mode->coefficients(c, &at));
  PetscCall(InertiaExplicitFraction(c->overlap, &at, c->source, c->explicit_fraction));
  if (c->options.mode == COUPLER_REACTION)
    PetscCall(ViscousExplicitFraction(c->overlap, &at, c->term, c->options.thickness, c->dt,
                                      c->explicit_fraction, &c->single_iteration_step));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerBuild(Coupler c, const SolidState *solid, double t, double dt, int *n,
                            const CoracleCoupling **coupling)
{
  const double ahead = c->options.mode == COUPLER_REACTION ? 0.5 * dt : 0.0;
  double *x;

  PetscFunctionBeginUser;
  c->dt = dt;
  GravityOver(&c->options.gravity_table, t, dt, c->options.gravity);
  PetscCall(PetscMalloc1(2 * (size_t)solid->nnodes, &x));
  for (int k = 0; k < 2 * solid->nnodes; k++) x[k] = solid->x[k] + ahead * solid->u[k];
  PetscCall(BuildAt(c, solid, x));
  PetscCall(PetscFree(x));
  Predict(c, solid);
  PetscCall(InertiaNodalForces(c->overlap, solid, c->acceleration));
  PetscCall(CouplerSetInterfaceVelocity(c, c->predicted, n, coupling));
  PetscFunctionReturn(0);
}

/* What SetSourceTerms takes from nodes to the vertices of source triangles. */
enum {
  VELOCITY,
  ACCELERATION = 2,
  INTERFACE = 4,
  WEIGHT = 6,
  GIVEN = 8,
  FREE,
  AGAINST,
  NVALUES = AGAINST + 2
};

/* Of a triangle with both, held vertices get the mean of what holds the free ones against the fluid (history.h): it holds all of the triangle.  In one
 * fluid: where phases differ in density a thousandfold a wall of rubber that swings in air is torn with it (tests/coupled/air.sh). */
static void HoldAsTheRest(double vertex[3][NVALUES])
{
  double sum[2] = {0.0, 0.0};
  int n = 0;
  for (int i = 0; i < 3; i++) {
    if (vertex[i][FREE] == 0.0) continue;
    for (int d = 0; d < 2; d++) sum[d] += vertex[i][AGAINST + d];
    n++;
  }
  for (int i = 0; i < 3 && n > 0; i++)
    for (int d = 0; d < 2 && vertex[i][FREE] == 0.0; d++) vertex[i][ACCELERATION + d] = sum[d] / n;
}

/* The source triangles' velocity, force and interface acceleration of this rank's nodes. */
static PetscErrorCode SetSourceTerms(Coupler c, const double u[])
{
  const Overlap o = c->overlap;
  double(*node)[NVALUES], (*vertex)[3][NVALUES];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(c->nnodes, &node, o->nsources, &vertex));
  for (int k = 0; k < 2 * c->nnodes; k++) {
    node[k / 2][VELOCITY + k % 2] = u[k];
    node[k / 2][ACCELERATION + k % 2] = c->acceleration[k];
    node[k / 2][INTERFACE + k % 2] = (u[k] - c->start[k]) / c->dt;
    node[k / 2][WEIGHT + k % 2] = c->displaced[k / 2] * c->options.gravity[k % 2];
    node[k / 2][GIVEN] = c->given[k / 2];
    node[k / 2][FREE] = c->mobility[k / 2] > 0.0;
    node[k / 2][AGAINST + k % 2] = c->history.known ? c->history.against[k / 2][k % 2] : 0.0;
  }
  PetscCall(OverlapNodesToSources(o, NVALUES, (const double *)node, (double *)vertex));
  for (int t = 0; t < o->nsources; t++) {
    const SupermeshBasis *basis = &o->source_basis[t];
    const double *p = vertex[t][0], *q = vertex[t][1], *r = vertex[t][2];
    if (!o->phases) HoldAsTheRest(vertex[t]);
    c->source[t].velocity = LinearFieldOf(basis, p + VELOCITY, q + VELOCITY, r + VELOCITY);
    c->source[t].given = (PetscBool)(p[GIVEN] * q[GIVEN] * r[GIVEN] > 0.0);
    const LinearField a = LinearFieldOf(basis, p + ACCELERATION, q + ACCELERATION, r + ACCELERATION);
    c->source[t].force = (LinearField){{0.0}, {{0.0}}};
    LinearFieldAdd(c->source[t].density, &a, &c->source[t].force);
    if (IsHeldByInertia(&c->source[t]))
      c->source[t].force = LinearFieldOf(basis, p + WEIGHT, q + WEIGHT, r + WEIGHT);
    c->source[t].interface_acceleration = LinearFieldOf(basis, p + INTERFACE, q + INTERFACE, r + INTERFACE);
  }
  PetscCall(PetscFree2(node, vertex));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerSetInterfaceVelocity(Coupler c, const double u[], int *n,
                                           const CoracleCoupling **coupling)
{
  PetscFunctionBeginUser;
  PetscCall(SetSourceTerms(c, u));
  c->us = u;
  PetscCall(WallTermAssemble(c->overlap, c->term, c->element, c->source, c->options.gravity, c->coupling));
  *n = c->overlap->ncoupled;
  *coupling = c->coupling;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerSetAcceleration(Coupler c, const SolidState *end)
{
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(c->acceleration, end->acceleration, 2 * c->nnodes));
  PetscCall(InertiaNodalForces(c->overlap, end, c->acceleration));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerComputeForce(Coupler c, const CoracleFlow *flow, const double **force,
                                   ForceTotals *totals)
{
  PetscFunctionBeginUser;
  c->flow = *flow;
  PetscCall(OverlapSetProperties(c->overlap, flow));
  PetscCall(PetscArrayzero(c->vertex, 3 * (size_t)c->overlap->nsources));
  PetscCall(c->mode->force(c));
  for (int i = 0; i < c->nnodes; i++) {
    for (int d = 0; d < 2; d++) c->force[2 * i + d] = c->node[i].reaction[d] + c->node[i].other[d];
  }
  PetscCall(ForceSum(c->overlap, c->dt, c->coupling, flow, c->nnodes, c->node, totals));
  if (c->pressure_load) PetscCall(PressureLoadAdd(c->pressure_load, c->overlap, flow->p, c->force));
  if (c->uplift) PetscCall(UpliftAdd(c->uplift, c->overlap, flow->p, c->dt, c->force, totals->uplift));
  *force = c->force;
  PetscFunctionReturn(0);
}

/* acceleration[nnodes][2] of the nodes by the shell's reaction in the last CouplerComputeForce, m/s2. */
static PetscErrorCode ShellAcceleration(Coupler c, double acceleration[])
{
  const Overlap o = c->overlap;
  double(*vertex)[3][2];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nsources, &vertex));
  for (int t = 0; t < o->nsources; t++)
    for (int i = 0; i < 3 && o->source[t].is_shell; i++)
      PetscCall(PetscArraycpy(vertex[t][i], c->vertex[3 * t + i].reaction, 2));
  PetscCall(OverlapSourcesToNodes(o, 2, (const double *)vertex, c->nnodes, acceleration));
  PetscCall(CopiesSum(o->nodes, 2, acceleration));
  for (int k = 0; k < 2 * c->nnodes; k++) acceleration[k] *= c->mobility[k / 2];
  PetscCall(PetscFree(vertex));
  PetscFunctionReturn(0);
}

static PetscErrorCode StoreHistory(Coupler c, const SolidState *moved)
{
  double *outside, *against;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(2 * (size_t)c->nnodes, &outside, 2 * (size_t)c->nnodes, &against));
  PetscCall(PetscArraycpy(against, c->force, 2 * (size_t)c->nnodes));
  PetscCall(CopiesSum(c->overlap->nodes, 2, against));
  PetscCall(ShellAcceleration(c, outside));
  for (int k = 0; k < 2 * c->nnodes; k++) against[k] = outside[k] - c->mobility[k / 2] * against[k];
  if (c->pressure_load) PetscCall(PressureLoadAccept(c->pressure_load, c->overlap, c->mobility, outside));
  PetscCall(HistoryStep(&c->history, moved, c->dt, c->start, outside, against));
  PetscCall(PetscFree2(outside, against));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerCorrect(Coupler c, const SolidState *moved, int *n,
                              const CoracleCorrection **correction)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(c->correction));
  PetscCall(PetscCalloc1(c->overlap->ncoupled, &c->correction));
  for (int e = 0; e < c->overlap->ncoupled; e++) c->correction[e].element = c->overlap->coupled_element[e];
  PetscCall(StoreHistory(c, moved));
  if (!moved->lost) PetscCall(CouplerSolidCorrection(c, moved));
  *n = c->overlap->ncoupled;
  *correction = c->correction;
  PetscFunctionReturn(0);
}

void CouplerFilm(Coupler c, const double **load, const double **resistance)
{
  *load = *resistance = NULL;
  if (c->uplift) UpliftFilm(c->uplift, load, resistance);
}

const double *CouplerPredictedVelocity(Coupler c)
{
  return c->predicted;
}

const char *CouplerGiven(Coupler c)
{
  return c->given;
}

const double *CouplerExplicitFraction(Coupler c)
{
  return c->explicit_fraction;
}

double CouplerSingleIterationStep(Coupler c)
{
  return c->single_iteration_step;
}

PetscErrorCode CouplerSave(Coupler c, Checkpoint to)
{
  PetscFunctionBeginUser;
  PetscCall(HistorySave(&c->history, to));
  if (c->pressure_load) PetscCall(PressureLoadSave(c->pressure_load, to));
  PetscFunctionReturn(0);
}
PetscErrorCode CouplerLoad(Coupler c, const SolidState *solid, Checkpoint from)
{
  PetscFunctionBeginUser;
  PetscCall(HistoryLoad(&c->history, solid, from));
  if (c->pressure_load) PetscCall(PressureLoadLoad(c->pressure_load, solid, from));
  PetscFunctionReturn(0);
}
Shell CouplerShell(Coupler c)
{
  return c->shell;
}
Overlap CouplerOverlap(Coupler c)
{
  return c->overlap;
}

PetscErrorCode CouplerDestroy(Coupler *coupler)
{
  PetscFunctionBeginUser;
  if (!*coupler) PetscFunctionReturn(0);
  PetscCall(FreeStep(*coupler));
  PetscCall(HistoryDestroy(&(*coupler)->history));
  PetscCall(PressureLoadDestroy(&(*coupler)->pressure_load));
  PetscCall(UpliftDestroy(&(*coupler)->uplift));
  PetscCall(HarmonicDestroy(&(*coupler)->harmonic));
  PetscCall(PetscFree((*coupler)->correction));
  PetscCall(ShellDestroy(&(*coupler)->shell));
  PetscCall(OverlapDestroy(&(*coupler)->overlap));
  PetscCall(PetscFree(*coupler));
  PetscFunctionReturn(0);
}
