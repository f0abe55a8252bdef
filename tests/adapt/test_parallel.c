// ranks: 1 2 3
/* Adaptation of a distributed mesh: as good as on one rank, cuts between ranks included; everything kept,
 * parts of equal size, the same bits twice; 20 times in a row.  parallel print: also says how good. */
#include "fluid/adapt/adapt_parallel.h"
#include "tests/adapt/kept.h"
#include "tests/mesh/distributed.h"

typedef struct {
  const char *name;
  MetricAt at;
  double start; /* size of the first mesh */
  int times;
} Field;

typedef struct {
  double center;
} Ring;

static const BoxCase UNIT = {.upper = {1.0, 1.0}};
static int rank, size, print;

/* Isotropic, 0.008 on a circle, growing by 0.2 m/m. */
static void RingAt(const void *context, const double x[2], double m[3])
{
  const Ring *ring = context;
  const double h = 0.008 + 0.2 * fabs(hypot(x[0] - ring->center, x[1] - 0.4) - 0.2);
  MetricOf(h, h, 0.0, m);
}

/* 4e-4 across the inclined line y = 0.35 + 0.3 x, 0.1 along it. */
static void ShearAt(const void *context, const double x[2], double m[3])
{
  const double d = fabs(x[1] - 0.35 - 0.3 * x[0]) / hypot(1.0, 0.3);
  MetricOf(0.1, fmin(0.1, 4e-4 + 0.2 * d), atan(0.3), m);
}

static double *SampleOn(const Mesh *mesh, MetricAt at, const void *context)
{
  double *metric = malloc((3 * (size_t)mesh->nv + 1) * sizeof *metric);
  for (int v = 0; v < mesh->nv; v++) at(context, &mesh->x[2 * v], &metric[3 * v]);
  return metric;
}

/* What a report says, worked out from the mesh alone, with a metric on its vertices. */
static void Measure(const Mesh *m, const double metric[], AdaptReport *r)
{
  double low[3] = {INFINITY, INFINITY, INFINITY};
  int count[2] = {0};
  for (int k = 0; k < 3 * m->ne; k++) {
    const int *v = &m->vertex[k - k % 3], p = v[(k + 1) % 3], q = v[(k + 2) % 3], o = m->neighbor[k];
    const double *x[3] = {&m->x[2 * v[0]], &m->x[2 * v[1]], &m->x[2 * v[2]]}, *t[3];
    double square;
    for (int i = 0; i < 3; i++) t[i] = &metric[3 * v[i]];
    low[2] = fmin(low[2], MetricQuality(x, t, &square));
    if (o >= 0 && m->egid[o] < m->egid[k / 3]) continue;
    const double l = MetricLength(&m->x[2 * p], &m->x[2 * q], &metric[3 * p], &metric[3 * q]);
    count[0]++;
    count[1] += l >= sqrt(0.5) && l <= sqrt(2.0);
    low[0] = fmin(low[0], l);
    low[1] = fmin(low[1], -l);
  }
  MPI_Allreduce(MPI_IN_PLACE, low, 3, MPI_DOUBLE, MPI_MIN, m->comm);
  MPI_Allreduce(MPI_IN_PLACE, count, 2, MPI_INT, MPI_SUM, m->comm);
  *r = (AdaptReport){.edges = count[0],
                     .edges_unit = count[1],
                     .shortest = low[0],
                     .longest = -low[1],
                     .quality_worst = low[2]};
}

static void CheckFit(const char *name, const AdaptReport *r, const char *which)
{
  const double share = (double)r->edges_unit / r->edges;
  if (print && !rank)
    printf("%-6s %-8s %7d edges, %.2f %% unit, in [%.3f, %.3f], quality worst %.3f mean %.3f, %d rounds\n",
           name, which, r->edges, 100.0 * share, r->shortest, r->longest, r->quality_worst, r->quality_mean,
           r->rounds);
  CHECK(share > 0.95, "%s: %.2f %% of the edges are unit in the %s metric", name, 100.0 * share, which);
  CHECK(r->longest < 2.0, "%s: edges up to %g in the %s metric", name, r->longest, which);
  CHECK(r->quality_worst > 0.2, "%s: worst quality %g in the %s metric", name, r->quality_worst, which);
}

/* Conforms across ranks, area and sides to 1e-12, no number twice or missing, parts of equal size. */
static void CheckMesh(const Mesh *m)
{
  double area = 0.0, side[4] = {0.0};
  int sides = 0;
  CHECK(m->ntags == 4, "%d tags", m->ntags);
  for (int e = 0; e < m->ne; e++) area += TriangleArea(m->x, &m->vertex[3 * e]);
  for (int k = 0; k < 3 * m->ne; k++) {
    if (m->tag[k] < 0) continue;
    const int *v = &m->vertex[k - k % 3];
    const double *a = &m->x[2 * v[(k + 1) % 3]], *b = &m->x[2 * v[(k + 2) % 3]];
    side[m->tag[k]] += hypot(b[0] - a[0], b[1] - a[1]);
    sides++;
  }
  MPI_Allreduce(MPI_IN_PLACE, &area, 1, MPI_DOUBLE, MPI_SUM, m->comm);
  MPI_Allreduce(MPI_IN_PLACE, side, 4, MPI_DOUBLE, MPI_SUM, m->comm);
  MPI_Allreduce(MPI_IN_PLACE, &sides, 1, MPI_INT, MPI_SUM, m->comm);
  CHECK(fabs(area - 1.0) < 1e-12, "the area is %.17g", area);
  for (int k = 0; k < 4; k++) CHECK(fabs(side[k] - 1.0) < 1e-12, "%s: %.17g", m->tag_name[k], side[k]);
  CheckDistributed(m, &UNIT, 1 + ((int)m->nglobal + sides) / 2); /* Euler: V = 1 + E - F */
  int most = m->ne;
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, m->comm);
  CHECK((double)most * size < 1.05 * (double)m->nglobal + size, "%d of %d triangles on one of %d ranks", most,
        (int)m->nglobal, size);
}

static Mesh *Start(double h)
{
  MeshSerial serial = {0};
  Mesh *mesh;
  if (!rank) Box(LOWER, UNIT.upper, h, &serial);
  CHECK(!MeshDistribute(PETSC_COMM_WORLD, &serial, &mesh), "not distributed");
  CHECK(!MeshSerialDestroy(&serial), "not freed");
  return mesh;
}

/* Replaces the mesh; the report must be what the mesh itself says, in a metric that was sampled on the old
 * one. */
static void Adapt(Mesh **mesh, MetricAt at, const void *context, AdaptReport *report)
{
  double *metric = SampleOn(*mesh, at, context);
  Mesh *adapted;
  CHECK(!MeshAdaptParallel(*mesh, metric, &adapted, report), "adaptation failed");
  CheckMesh(adapted);
  CHECK(report->edges == (int)(adapted->nv_global + adapted->nglobal - 1), "%d edges in the report",
        report->edges);
  free(metric);
  CHECK(!MeshDestroy(mesh), "not freed");
  *mesh = adapted;
}

/* As many triangles as one rank makes of the same start. */
static void CheckNumber(const Field *f, const Ring *ring, const Mesh *mesh)
{
  MeshSerial start;
  AdaptResult alone;
  Box(LOWER, UNIT.upper, f->start, &start);
  AdaptTo(&start, f->at, ring, f->times, &alone);
  const double ratio = (double)mesh->nglobal / alone.mesh.ne;
  if (print && !rank)
    printf("%-6s %d triangles, %d on one rank\n", f->name, (int)mesh->nglobal, alone.mesh.ne);
  CHECK(fabs(ratio - 1.0) < 0.05, "%s: %d triangles, %d on one rank", f->name, (int)mesh->nglobal,
        alone.mesh.ne);
  AdaptResultDestroy(&alone);
  MeshSerialDestroy(&start);
}

static void Run(const Field *f)
{
  const Ring ring = {0.5};
  AdaptReport report, measured;
  Mesh *mesh = Start(f->start);
  for (int k = 0; k < f->times; k++) {
    Adapt(&mesh, f->at, &ring, &report);
    /* the first metrics of a layer are sampled on meshes that do not see it */
    CHECK(report.longest < 2.0 && report.quality_worst > 0.2,
          "%s, adaptation %d: longest edge %g, worst quality %g", f->name, k, report.longest,
          report.quality_worst);
    if (k > 1) CheckFit(f->name, &report, "given");
  }
  double *metric = SampleOn(mesh, f->at, &ring);
  Measure(mesh, metric, &measured);
  CheckFit(f->name, &measured, "analytic");
  free(metric);
  CheckNumber(f, &ring, mesh);
  CHECK(!MeshDestroy(&mesh), "not freed");
}

/* A ring that moves by about its size each time, 20 times. */
static void CheckSequence(void)
{
  Mesh *mesh = Start(0.05);
  for (int k = 0; k < 20; k++) {
    const Ring ring = {0.35 + 0.015 * k};
    AdaptReport report;
    Adapt(&mesh, RingAt, &ring, &report);
    CheckFit("moving", &report, "given");
  }
  CHECK(!MeshDestroy(&mesh), "not freed");
}

static void CheckTwice(void)
{
  const Ring ring = {0.5};
  Mesh *mesh[2];
  AdaptReport report;
  for (int k = 0; k < 2; k++) {
    mesh[k] = Start(0.05);
    Adapt(&mesh[k], RingAt, &ring, &report);
  }
  const Mesh *a = mesh[0], *b = mesh[1];
  CHECK(a->ne == b->ne && a->nv == b->nv && !memcmp(a->x, b->x, 2 * (size_t)a->nv * sizeof *a->x) &&
            !memcmp(a->vertex, b->vertex, 3 * (size_t)(a->ne + a->ng) * sizeof *a->vertex) &&
            !memcmp(a->vgid, b->vgid, (size_t)a->nv * sizeof *a->vgid),
        "the same input twice, two meshes");
  for (int k = 0; k < 2; k++) CHECK(!MeshDestroy(&mesh[k]), "not freed");
}

/* A metric that is wrong on the last rank alone is an error everywhere. */
static void CheckRefused(void)
{
  const Ring ring = {0.5};
  Mesh *mesh = Start(0.2), *adapted;
  double *metric = SampleOn(mesh, RingAt, &ring);
  if (rank == size - 1) metric[0] = -1.0;
  PetscPushErrorHandler(PetscReturnErrorHandler, NULL);
  CHECK(MeshAdaptParallel(mesh, metric, &adapted, NULL) == PETSC_ERR_ARG_OUTOFRANGE, "it is taken");
  PetscPopErrorHandler();
  free(metric);
  CHECK(!MeshDestroy(&mesh), "not freed");
}

int main(int argc, char **argv)
{
  /* the last starts with two triangles: from three ranks on some have none */
  const Field field[] = {{"ring", RingAt, 0.05, 4}, {"shear", ShearAt, 0.05, 8}, {"few", RingAt, 10.0, 5}};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  print = argc > 1;
  for (int k = 0; k < 3; k++) Run(&field[k]);
  CheckSequence();
  CheckTwice();
  CheckRefused();
  return PetscFinalize();
}
