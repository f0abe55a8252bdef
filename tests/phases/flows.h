/* Meshes, prescribed solenoidal flows and one driver for advecting phases on them. */
#ifndef TESTS_PHASES_FLOWS_H
#define TESTS_PHASES_FLOWS_H
#include "common/mesh/part.h"
#include "fluid/adapt/adapt_parallel.h"
#include "fluid/adapt/metric.h"
#include "fluid/phases/phases.h"
#include "fluid/phases/region.h"
#include "tests/check.h"
#include "tests/transfer/shaken.h"
#include <time.h>

/* u = (d psi/dy, -d psi/dx), times factor(t). */
typedef struct {
  double (*psi)(const double x[2]);
  void (*velocity)(const double x[2], double u[2]);
  double period; /* of the factor; 0: it is 1 */
  int sine;      /* sin(2 pi t / period); else cos(pi t / period) */
  double speed;  /* largest |u|, m/s */
  double end;    /* s: the interface should be back then */
} Flow;

static inline double FlowFactor(const Flow *flow, double t)
{
  if (!(flow->period > 0.0)) return 1.0;
  return flow->sine ? sin(2.0 * M_PI * t / flow->period) : cos(M_PI * t / flow->period);
}

static inline int OnWall(const double x[2])
{
  return fmin(fmin(x[0], 1.0 - x[0]), fmin(x[1], 1.0 - x[1])) < 1e-12;
}

/* The time-reversed vortex of Basilisk's test reversed.c: it slides along the walls. */
static inline double SlidingPsi(const double x[2])
{
  return OnWall(x) ? 0.0 : 1.5 * sin(M_PI * x[0]) * sin(M_PI * x[1]) / M_PI;
}

static inline void SlidingVelocity(const double x[2], double u[2])
{
  u[0] = 1.5 * sin(M_PI * x[0]) * cos(M_PI * x[1]);
  u[1] = -1.5 * cos(M_PI * x[0]) * sin(M_PI * x[1]);
}

/* Rider and Kothe (1998): the single vortex of the unit square. */
static inline double VortexPsi(const double x[2])
{
  const double s = sin(M_PI * x[0]), c = sin(M_PI * x[1]);
  return OnWall(x) ? 0.0 : s * s * c * c / M_PI;
}

static inline void VortexVelocity(const double x[2], double u[2])
{
  const double s = sin(M_PI * x[0]), c = sin(M_PI * x[1]);
  u[0] = s * s * sin(2.0 * M_PI * x[1]);
  u[1] = -c * c * sin(2.0 * M_PI * x[0]);
}

/* Solid rotation about the middle of the unit square, once in 1 s. */
static inline double RotationPsi(const double x[2])
{
  return -M_PI * ((x[0] - 0.5) * (x[0] - 0.5) + (x[1] - 0.5) * (x[1] - 0.5));
}

static inline void RotationVelocity(const double x[2], double u[2])
{
  u[0] = -2.0 * M_PI * (x[1] - 0.5);
  u[1] = 2.0 * M_PI * (x[0] - 0.5);
}

static inline Flow VortexFlow(double period)
{
  return (Flow){VortexPsi, VortexVelocity, period, 0, 1.0, period};
}

static inline Flow RotationFlow(void)
{
  return (Flow){RotationPsi, RotationVelocity, 0.0, 0, 2.0 * M_PI * M_SQRT1_2, 1.0};
}

static inline Flow SlidingFlow(void)
{
  return (Flow){SlidingPsi, SlidingVelocity, 15.0, 1, 1.5, 15.0};
}

/* A disc of phase 0 in phase 1. */
enum { BODY_REGIONS = 3 };
static inline int DiscRegions(Region region[BODY_REGIONS])
{
  region[0] = (Region){.shape = REGION_BOX, .phase = 1, .a = {-1.0, -1.0}, .b = {2.0, 2.0}};
  region[1] = (Region){.shape = REGION_DISC, .phase = 0, .a = {0.5, 0.75}, .radius = 0.15};
  return 2;
}

/* That of reversed.c. */
static inline int SlidingRegions(Region region[BODY_REGIONS])
{
  DiscRegions(region);
  region[1] = (Region){.shape = REGION_DISC, .phase = 0, .a = {0.3, 0.263662}, .radius = 0.2};
  return 2;
}

/* Zalesak (1979): the disc with a slot of a third of its radius, up to two thirds of its height. */
static inline int ZalesakRegions(Region region[BODY_REGIONS])
{
  DiscRegions(region);
  region[2] = (Region){.shape = REGION_BOX, .phase = 1, .a = {0.475, 0.5}, .b = {0.525, 0.85}};
  return 3;
}

/* An unstructured mesh of the unit square with edges of about h.  Free with MeshDestroy. */
static inline PetscErrorCode UnstructuredMesh(MPI_Comm comm, double h, Mesh **mesh)
{
  const Shaken start = {.n = (int)(1.0 / h), .seed = 7u, .radius = 1.0};
  double *size, *metric;
  Mesh *first;
  PetscFunctionBeginUser;
  PetscCall(ShakenMesh(comm, &start, &first));
  PetscCall(PetscMalloc2(first->nv, &size, 3 * first->nv, &metric));
  for (int v = 0; v < first->nv; v++) size[v] = h;
  PetscCall(MetricFromSizes(first->nv, size, metric));
  PetscCall(MeshAdaptParallel(first, metric, mesh, NULL));
  PetscCall(PetscFree2(size, metric));
  PetscCall(MeshDestroy(&first));
  PetscFunctionReturn(0);
}

/* flux[ne][3] and velocity[ne][3][2] at time t. */
static inline void FlowAt(const Flow *flow, const Mesh *m, double t, double flux[], double velocity[])
{
  const double factor = FlowFactor(flow, t);
  for (int k = 0; k < 3 * m->ne; k++) {
    const double *a = Corner(m, k / 3, (k + 1) % 3), *b = Corner(m, k / 3, (k + 2) % 3);
    flux[k] = factor * flow->psi(b) - factor * flow->psi(a);
    flow->velocity(Corner(m, k / 3, k % 3), &velocity[2 * k]);
    for (int c = 0; c < 2; c++) velocity[2 * k + c] *= factor;
  }
}

static inline double CpuSeconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Steps from t to t + steps * dt; lowest and highest fraction met, and the largest gap, in *worst.  *seconds,
 * or NULL: of this rank's processor in lines and advection. */
static inline PetscErrorCode March(Phases phases, const Mesh *m, const Flow *flow, double t, double dt,
                                   int steps, PhasesStats *worst, double *seconds)
{
  static const double OUTER[4][PHASES_MAX] = {{0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}};
  const PhasesInflow inflow = {.fraction = OUTER};
  double *flux, *velocity;
  PhasesStats stats;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(3 * m->ne, &flux, 6 * m->ne, &velocity));
  for (int k = 0; k < steps; k++) {
    FlowAt(flow, m, t + (k + 0.5) * dt, flux, velocity);
    const double begin = CpuSeconds();
    PetscCall(PhasesReconstruct(phases));
    PetscCall(PhasesAdvect(phases, dt, flux, velocity, &inflow, NULL, NULL));
    if (seconds) *seconds += CpuSeconds() - begin;
    PetscCall(PhasesGetStats(phases, &stats));
    worst->lowest = fmin(worst->lowest, stats.lowest);
    worst->highest = fmax(worst->highest, stats.highest);
    worst->gap = fmax(worst->gap, stats.gap);
    worst->courant = fmax(worst->courant, stats.courant);
    for (int p = 0; p < PHASES_MAX; p++) worst->volume[p] = stats.volume[p];
    worst->cut = stats.cut;
  }
  PetscCall(PetscFree2(flux, velocity));
  PetscFunctionReturn(0);
}

/* sum |V - start| of phase 0 over all ranks, m2 */
static inline double Difference(const Mesh *m, int np, const double start[], const double now[])
{
  double sum = 0.0;
  for (int e = 0; e < m->ne; e++) sum += fabs(now[e * np] - start[e * np]);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, m->comm);
  return sum;
}
#endif
