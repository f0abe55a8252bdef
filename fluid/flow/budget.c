#include "fluid/flow/budget.h"
#include "common/link/coupling_gain.h"
#include "fluid/discretization/ghosted.h"
#include "fluid/flow/budget_step.h"

/* Sums over elements and faces, in the order in which ranks add them: P^{n+1}, energy, terms, boundaries' forces. */
enum { END, ENERGY = END + 2, TERMS, FORCES = TERMS + 2 * BUDGET_TERMS };

PetscErrorCode FluidBudgetCreate(Fluid f)
{
  const size_t n = (size_t)f->domain.mesh->ntags;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(n + 1, &f->budget.boundary));
  PetscCall(PetscCalloc1(FORCES + n * FORCE_PARTS * 2, &f->budget_sum));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidBudgetDestroy(Fluid f)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(f->budget.boundary));
  PetscCall(PetscFree(f->budget_sum));
  PetscFunctionReturn(0);
}

const FluidBudget *FluidGetBudget(Fluid f)
{
  return &f->budget;
}

double BudgetDefect(const FluidBudget *b)
{
  return b->scale > 0.0 ? hypot(b->rest[0], b->rest[1]) / b->scale : 0.0;
}

PetscErrorCode FluidBudgetChanged(Fluid f)
{
  PetscFunctionBeginUser;
  PetscCall(FluidMomentumTotal(f, f->budget_start, NULL));
  PetscFunctionReturn(0);
}

static double *Term(Fluid f, int term)
{
  return f->budget_sum + TERMS + 2 * term;
}

/* rho (weight - R^-1 grad p) - (rho g - grad p) over all elements. */
static PetscErrorCode AddInterface(Fluid f)
{
  const InverseDensity *r = FluidInverseDensity(f);
  const double *rho = MaterialDensity(f->material, MATERIAL_STEP), *g = f->setup.gravity;
  double *sum = Term(f, BUDGET_INTERFACE);
  const PetscScalar *p;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(f->p, &p));
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    double grad[3][2], mean[2], acceleration[2];
    DomainGradient(&f->domain, e, p, grad);
    for (int c = 0; c < 2; c++) mean[c] = (grad[0][c] + grad[1][c] + grad[2][c]) / 3.0;
    InverseDensityAcceleration(&r[e], mean, acceleration);
    for (int c = 0; c < 2; c++)
      sum[c] += f->domain.geometry[e].area * (rho[e] * (acceleration[c] - g[c]) + mean[c]);
  }
  PetscCall(GhostedRestoreArrayRead(f->p, &p));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidBudgetBegin(Fluid f)
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(f->budget_sum, FORCES + f->domain.mesh->ntags * FORCE_PARTS * 2));
  if (f->phases) PetscCall(AddInterface(f));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidBudgetSolid(Fluid f, double dt, const CoracleCorrection correction[])
{
  const double *rho = MaterialDensity(f->material, MATERIAL_STEP),
               *end = MaterialDensity(f->material, MATERIAL_NEW);
  const PetscScalar *u, *u_star, *u_projected;
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(f->solid, &n);
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(f->u, &u));
  PetscCall(VecGetArrayRead(f->u_star, &u_star));
  PetscCall(VecGetArrayRead(f->u_projected, &u_projected));
  for (int k = 0; k < n; k++) {
    const int e = entry[k].element;
    double start[6];
    SolidCouplingStart(f->solid, e, u + 6 * e, start);
    CouplingAddGain(&entry[k], rho[e] * f->domain.geometry[e].area / dt, start, u_star + 6 * e,
                    u_projected + 6 * e, Term(f, BUDGET_SOLID));
    for (int i = 0; i < 6 && correction; i++)
      Term(f, BUDGET_CORRECTION)[i / 3] += end[e] / dt * correction[k].r[i / 3][i % 3];
  }
  PetscCall(VecRestoreArrayRead(f->u_projected, &u_projected));
  PetscCall(VecRestoreArrayRead(f->u_star, &u_star));
  PetscCall(VecRestoreArrayRead(f->u, &u));
  PetscFunctionReturn(0);
}

/* The body force at the step's theta, N/m. */
static void AddSource(Fluid f, const BudgetStep *s)
{
  double *weight = Term(f, BUDGET_WEIGHT);
  for (int k = 0; k < 3 * f->domain.mesh->ne; k++) {
    const double *x = ElementVertex(f->domain.mesh, k / 3, k % 3),
                 third = f->domain.geometry[k / 3].area / 3.0;
    double now[2], next[2];
    f->setup.source(f->setup.source_context, s->t, x, now);
    f->setup.source(f->setup.source_context, s->t + s->dt, x, next);
    for (int c = 0; c < 2; c++) weight[c] += third * (s->theta * next[c] + (1.0 - s->theta) * now[c]);
  }
}

static double Sum(const double v[3])
{
  return v[0] + v[1] + v[2];
}

static void AddAbsorption(Fluid f, const BudgetStep *s)
{
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    const AbsorptionAt a = f->absorption[e];
    for (int c = 0; c < 2; c++) {
      const double u =
          ((1.0 - s->theta) * Sum(s->u + 6 * e + 3 * c) + s->theta * Sum(s->u_star + 6 * e + 3 * c)) / 3.0;
      Term(f, BUDGET_ABSORPTION)[c] += s->step[e] * f->domain.geometry[e].area * (a.push[c] - a.rate * u);
    }
  }
}

static void AddElements(Fluid f, const BudgetStep *s)
{
  double start[2], end[2] = {0.0}, advected[2] = {0.0}, energy = 0.0, mass = 0.0;
  const double(*divergence)[3] = MomentumSolverDivergence(f->momentum, start);
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    const double area = f->domain.geometry[e].area, third = s->new[e] * area / 3.0, *d = divergence[e];
    mass += s->step[e] * area;
    for (int c = 0; c < 2; c++) {
      const PetscScalar *star = s->u_star + 6 * e + 3 * c, *v = s->end + 6 * e + 3 * c;
      const double all = Sum(v);
      end[c] += third * all;
      energy += 0.125 * third * (all * all + v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      advected[c] += d[0] * star[0] + d[1] * star[1] + d[2] * star[2];
    }
  }
  for (int c = 0; c < 2; c++) {
    f->budget_sum[END + c] = end[c];
    Term(f, BUDGET_DIVERGENCE)[c] += s->theta * advected[c] + (1.0 - s->theta) * start[c];
    Term(f, BUDGET_WEIGHT)[c] += mass * f->setup.gravity[c];
  }
  f->budget_sum[ENERGY] = energy;
}

/* Where mass moves: the mass flux has a divergence, as much as the density changes. */
static void AddChange(Fluid f, const BudgetStep *s)
{
  for (int e = 0; e < f->domain.mesh->ne; e++)
    for (int c = 0; c < 2; c++) {
      const double u =
          (1.0 - s->theta) * Sum(s->u + 6 * e + 3 * c) + s->theta * Sum(s->u_star + 6 * e + 3 * c);
      Term(f, BUDGET_DIVERGENCE)[c] += (s->new[e] - s->old[e]) / s->dt * f->domain.geometry[e].area / 3.0 * u;
    }
}

static double Length(const double v[2])
{
  return hypot(v[0], v[1]);
}

/* From the sums of all ranks. */
static void SetBudget(Fluid f, double dt)
{
  FluidBudget *b = &f->budget;
  const double *sum = f->budget_sum;
  const int n = f->domain.mesh->ntags;
  b->dt = dt;
  b->energy = sum[ENERGY];
  b->scale = 0.0;
  memcpy(b->term, sum + TERMS, sizeof b->term);
  memcpy(b->boundary, sum + FORCES, (size_t)n * sizeof *b->boundary);
  for (int c = 0; c < 2; c++) {
    b->start[c] = b->momentum[c];
    b->momentum[c] = sum[END + c];
    b->term[BUDGET_ADAPTATION][c] = (f->budget_start[c] - b->start[c]) / dt;
    b->rest[c] = (b->momentum[c] - b->start[c]) / dt;
    f->budget_start[c] = b->momentum[c];
    for (int k = 0; k < BUDGET_TERMS; k++) b->rest[c] -= b->term[k][c];
    for (int k = 0; k < n * FORCE_PARTS; k++) b->rest[c] += b->boundary[k / FORCE_PARTS][k % FORCE_PARTS][c];
  }
  for (int k = 0; k < BUDGET_TERMS; k++) b->scale += Length(b->term[k]);
  for (int k = 0; k < n * FORCE_PARTS; k++) b->scale += Length(b->boundary[k / FORCE_PARTS][k % FORCE_PARTS]);
}

PetscErrorCode FluidBudgetEnd(Fluid f, double dt)
{
  BudgetStep s = {.t = f->t,
                  .dt = dt,
                  .theta = f->theta,
                  .old = MaterialDensity(f->material, MATERIAL_OLD),
                  .new = MaterialDensity(f->material, MATERIAL_NEW),
                  .step = MaterialDensity(f->material, MATERIAL_STEP),
                  .mu = MaterialViscosity(f->material, MATERIAL_STEP)};
  const Mesh *m = f->domain.mesh;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(f->p, &s.p));
  PetscCall(VecGetArrayRead(f->u, &s.u));
  PetscCall(VecGetArrayRead(f->u_star, &s.u_star));
  PetscCall(VecGetArrayRead(f->u_projected, &s.end));
  PetscCall(VecGetArrayRead(f->mass_flux, &s.flux));
  AddElements(f, &s);
  if (MaterialRevision(f->material) > 0) AddChange(f, &s);
  if (f->setup.source) AddSource(f, &s);
  if (f->setup.absorption.n) AddAbsorption(f, &s);
  BudgetAddBoundaries(f, &s, (BoundaryForce *)(f->budget_sum + FORCES));
  PetscCall(VecRestoreArrayRead(f->mass_flux, &s.flux));
  PetscCall(VecRestoreArrayRead(f->u_projected, &s.end));
  PetscCall(VecRestoreArrayRead(f->u_star, &s.u_star));
  PetscCall(VecRestoreArrayRead(f->u, &s.u));
  PetscCall(GhostedRestoreArrayRead(f->p, &s.p));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, f->budget_sum, FORCES + m->ntags * FORCE_PARTS * 2, MPI_DOUBLE,
                             MPI_SUM, m->comm));
  SetBudget(f, dt);
  PetscFunctionReturn(0);
}
