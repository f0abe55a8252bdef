#include "fluid/remeshing/adaptation.h"
#include "common/supermesh/geometry.h"
#include "fluid/adapt/adapt_parallel.h"
#include "fluid/adapt/metric.h"
#include "fluid/adapt/metric_share.h"
#include "fluid/discretization/ghosted.h"
#include "fluid/flow/fluid_impl.h"
#include "fluid/remeshing/fine_band.h"

/* Tries to meet the budget of elements. */
#define BUDGET_ROUNDS 10

typedef struct {
  int steps;       /* since the last adaptation */
  PetscBool first; /* none has been made yet */
  double moved;    /* at most, since then, m */
  double reach;    /* how far the solid may move before the next, m */
} AdaptationHistory;

struct Adaptation_s {
  AdaptationSetup setup;
  AdaptationHistory history, history_before; /* before: when AdaptationDue was asked last */
};

const AdaptationSetup *AdaptationGetSetup(Adaptation a)
{
  return &a->setup;
}

PetscErrorCode AdaptationCreate(const AdaptationSetup *setup, Adaptation *adaptation)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(adaptation));
  (*adaptation)->setup = *setup;
  (*adaptation)->history.first = PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptationDestroy(Adaptation *adaptation)
{
  return PetscFree(*adaptation);
}

PetscErrorCode AdaptationSave(Adaptation a, Checkpoint to)
{
  PetscFunctionBeginUser;
  if (!a) PetscFunctionReturn(0);
  PetscCall(CheckpointPutNumber(to, "adaptation steps", a->history.steps));
  PetscCall(CheckpointPutNumber(to, "adaptation first", a->history.first));
  PetscCall(CheckpointPutNumber(to, "adaptation moved", a->history.moved));
  PetscCall(CheckpointPutNumber(to, "adaptation reach", a->history.reach));
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptationLoad(Adaptation a, Checkpoint from)
{
  double steps, first;
  PetscFunctionBeginUser;
  if (!a || !CheckpointHasNumber(from, "adaptation steps")) PetscFunctionReturn(0);
  PetscCall(CheckpointGetNumber(from, "adaptation steps", &steps));
  PetscCall(CheckpointGetNumber(from, "adaptation first", &first));
  PetscCall(CheckpointGetNumber(from, "adaptation moved", &a->history.moved));
  PetscCall(CheckpointGetNumber(from, "adaptation reach", &a->history.reach));
  a->history.steps = (int)steps;
  a->history.first = first ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptationDue(Adaptation a, Fluid f, PetscBool *due)
{
  double speed;
  PetscFunctionBeginUser;
  PetscCall(FineBandSpeed(f, &speed));
  a->history_before = a->history;
  a->history.steps++;
  a->history.moved += speed * f->stats.dt;
  *due = a->history.first || a->history.steps >= a->setup.every ||
         a->history.moved + speed * f->stats.dt > a->history.reach;
  if (!*due) PetscFunctionReturn(0);
  a->history.first = PETSC_FALSE;
  a->history.steps = 0;
  a->history.moved = 0.0;
  /* at rest the solid may start with an acceleration that nobody knows here: hence the least */
  a->history.reach = fmax(speed * a->setup.every * f->stats.dt, FINE_BAND * a->setup.corner_size);
  PetscFunctionReturn(0);
}

void AdaptationDiscard(Adaptation a)
{
  a->history = a->history_before;
}

/* Means around the vertices, weighted by area, of the projected velocity of the current step: mean[2][nv]. */
static PetscErrorCode VertexVelocity(Fluid f, double *mean[2], double weight[])
{
  const Mesh *m = f->domain.mesh;
  const PetscScalar *u;
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(weight, m->nv));
  for (int c = 0; c < 2; c++) PetscCall(PetscArrayzero(mean[c], m->nv));
  PetscCall(GhostedUpdate(f->u_projected));
  PetscCall(GhostedGetArrayRead(f->u_projected, &u));
  for (int e = 0; e < m->ne + m->ng; e++)
    for (int i = 0; i < 3; i++) {
      const int v = m->vertex[3 * e + i];
      weight[v] += f->domain.geometry[e].area;
      for (int c = 0; c < 2; c++) mean[c][v] += f->domain.geometry[e].area * u[6 * e + 3 * c + i];
    }
  PetscCall(GhostedRestoreArrayRead(f->u_projected, &u));
  for (int v = 0; v < m->nv; v++)
    for (int c = 0; c < 2; c++) mean[c][v] /= weight[v];
  PetscFunctionReturn(0);
}

/* With phases: the share of the velocity's error that counts at vertices in those lighter than the mean of all. */
static PetscErrorCode WeighLightPhase(const AdaptationSetup *s, Fluid f, double *hessian[2], double weight[])
{
  const Mesh *m = f->domain.mesh;
  const double *rho = MaterialDensity(f->material, MATERIAL_NEW);
  const PhaseProperties *p = &f->setup.phases;
  const double limit = 0.5 * (p->rho[PhaseLightest(p)] + p->rho[PhaseHeaviest(p)]);
  const double share = s->light_velocity_error > 0.0 ? s->velocity_error / s->light_velocity_error : 0.0;
  PetscFunctionBeginUser;
  if (!f->phases) PetscFunctionReturn(0);
  PetscCall(PetscArrayzero(weight, m->nv));
  for (int e = 0; e < m->ne + m->ng; e++)
    for (int i = 0; i < 3; i++) weight[m->vertex[3 * e + i]] = fmax(weight[m->vertex[3 * e + i]], rho[e]);
  for (int v = 0; v < m->nv; v++)
    for (int k = 0; k < 6 && weight[v] < limit; k++) hessian[k / 3][3 * v + k % 3] *= share;
  PetscFunctionReturn(0);
}

/* --- the metric ----------------------------------------------------------------------------------------- */

/* What goes into a metric, on the vertices of this rank's elements. */
typedef struct {
  MeshSerial part; /* a view of this rank's elements */
  SharedVertices shared;
  double *hessian[2];   /* [nv][3] of each component of the velocity */
  double *near, *other; /* [nv][3] for the sizes near the solid; scratch */
} Sizing;

/* The metric for an error of the velocity, within the bounds, le in the solid's band, graded. */
static PetscErrorCode Compose(const AdaptationSetup *s, MPI_Comm comm, const Sizing *sizing, double error,
                              double metric[])
{
  const int nv = sizing->part.nv;
  PetscFunctionBeginUser;
  PetscCall(MetricFromHessian(nv, sizing->hessian[0], error, s->size_max, metric));
  PetscCall(MetricFromHessian(nv, sizing->hessian[1], error, s->size_max, sizing->other));
  PetscCall(MetricBound(nv, s->size_min, s->size_max, s->anisotropy, metric));
  PetscCall(MetricBound(nv, s->size_min, s->size_max, s->anisotropy, sizing->other));
  PetscCall(MetricIntersect(nv, sizing->other, metric));
  PetscCall(MetricIntersect(nv, sizing->near, metric));
  PetscCall(MetricGradeParallel(comm, &sizing->part, &sizing->shared, s->growth, metric));
  PetscCall(MetricBound(nv, s->corner_size, s->size_max, s->anisotropy, metric));
  PetscFunctionReturn(0);
}

static PetscErrorCode SizingCreate(Adaptation a, Fluid f, Sizing *n)
{
  const AdaptationSetup *s = &a->setup;
  const Mesh *m = f->domain.mesh;
  const FineBand band = {
      .size_min = s->size_min,
      .size_max = s->size_max,
      .interface_size = s->interface_size,
      .corner_size = s->corner_size,
      .slope = log(s->growth),
      .ahead = (s->every + 1) * f->stats.dt,
      .reach = a->history.reach,
  };
  /* with the ghosts, which lend their values to the second derivatives */
  const MeshSerial view = {.nv = m->nv, .ne = m->ne + m->ng, .x = m->x, .vertex = m->vertex};
  double *mean[2], *scratch;
  PetscFunctionBeginUser;
  n->part = view;
  n->part.ne = m->ne;
  n->part.nv = 0;
  for (int k = 0; k < 3 * m->ne; k++) n->part.nv = PetscMax(n->part.nv, m->vertex[k] + 1);
  PetscCall(SharedVerticesCreate(m, &n->shared));
  PetscCall(PetscMalloc4(3 * m->nv, &n->hessian[0], 3 * m->nv, &n->hessian[1], 3 * m->nv, &n->near, 3 * m->nv,
                         &n->other));
  PetscCall(PetscMalloc3(m->nv, &mean[0], m->nv, &mean[1], m->nv, &scratch));
  PetscCall(FineBandSizes(f, &band, n->part.nv, scratch));
  PetscCall(MetricFromSizes(n->part.nv, scratch, n->near));
  PetscCall(VertexVelocity(f, mean, scratch));
  PetscCall(HessianRecover(&view, 2, (const double *const *)mean, n->hessian));
  PetscCall(WeighLightPhase(s, f, n->hessian, scratch));
  PetscCall(PetscFree3(mean[0], mean[1], scratch));
  PetscFunctionReturn(0);
}

static PetscErrorCode SizingDestroy(Sizing *n)
{
  PetscFunctionBeginUser;
  PetscCall(SharedVerticesDestroy(&n->shared));
  PetscCall(PetscFree4(n->hessian[0], n->hessian[1], n->near, n->other));
  PetscFunctionReturn(0);
}

/* Within the budget: the error is raised, the band near the solid stays. */
static PetscErrorCode Metric(const AdaptationSetup *s, MPI_Comm comm, const Sizing *sizing, double metric[])
{
  double error = s->velocity_error, count;
  PetscFunctionBeginUser;
  for (int k = 0; k < BUDGET_ROUNDS; k++) {
    PetscCall(Compose(s, comm, sizing, error, metric));
    PetscCall(MetricCount(&sizing->part, metric, &count));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_DOUBLE, MPI_SUM, comm));
    if (count <= s->elements_max) break;
    error *= 1.1 * count / s->elements_max; /* their number goes with 1/error */
  }
  PetscCall(AdaptationCheckBudget(s, comm, count));
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptationMesh(Adaptation a, Fluid f, Mesh **mesh)
{
  const double start = MPI_Wtime();
  Sizing sizing;
  double *metric;
  PetscFunctionBeginUser;
  PetscCall(SizingCreate(a, f, &sizing));
  PetscCall(PetscMalloc1(3 * f->domain.mesh->nv, &metric));
  PetscCall(Metric(&a->setup, f->domain.mesh->comm, &sizing, metric));
  PetscCall(MeshAdaptParallel(f->domain.mesh, metric, mesh, NULL));
  PetscCall(PetscFree(metric));
  PetscCall(SizingDestroy(&sizing));
  f->stats.seconds[ADAPTATION] += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}
