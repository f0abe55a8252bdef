/* What stays: frozen vertices and lines bit by bit, a hole, an adapted mesh when it is adapted again; the
 * same bits twice; wrong input is refused. */
#include "tests/adapt/kept.h"

static const double LOWER[2] = {0.0, 0.0}, UPPER[2] = {1.0, 1.0};

static void Fine(const void *context, const double x[2], double m[3])
{
  const double h = 0.01 + 0.1 * fabs(x[0] + x[1] - 0.9);
  MetricOf(h, 0.3 * h, 0.8, m);
}

/* log M is linear: its interpolation is exact. */
static void LogLinear(const void *context, const double x[2], double m[3])
{
  const double h = *(const double *)context * exp(2.0 * x[0] - x[1]);
  MetricOf(h, 0.4 * h, 0.8, m);
}

static void Coarse(const void *context, const double x[2], double m[3])
{
  MetricOf(0.4, 0.4, 0.0, m);
}

static int IsFacet(const MeshSerial *m, int p, int q)
{
  int k = 0;
  while (k < m->nb && (m->facet[2 * k] != p || m->facet[2 * k + 1] != q)) k++;
  return k < m->nb;
}

/* Adds facets of a new tag on all edges for which `is` holds. */
static void AddTag(MeshSerial *m, const char *name, int (*is)(const double p[2], const double q[2]))
{
  CHECK(!PetscRealloc((size_t)(m->ntags + 1) * sizeof *m->tag_name, &m->tag_name), "no memory");
  snprintf(m->tag_name[m->ntags], sizeof *m->tag_name, "%s", name);
  CHECK(!PetscRealloc((size_t)(m->nb + 3 * m->ne) * 2 * sizeof(int), &m->facet), "no memory");
  CHECK(!PetscRealloc((size_t)(m->nb + 3 * m->ne) * sizeof(int), &m->facet_tag), "no memory");
  for (int c = 0; c < 3 * m->ne; c++) {
    const int p = m->vertex[c], q = m->vertex[c - c % 3 + (c + 1) % 3];
    if (!is(&m->x[2 * p], &m->x[2 * q]) || IsFacet(m, q, p)) continue; /* an inner edge comes twice */
    m->facet[2 * m->nb] = p;
    m->facet[2 * m->nb + 1] = q;
    m->facet_tag[m->nb++] = m->ntags;
  }
  m->ntags++;
}

static int OnCut(const double p[2], const double q[2])
{
  return p[1] == 0.5 && q[1] == 0.5;
}

static int CountTag(const MeshSerial *m, int tag)
{
  int n = 0;
  for (int k = 0; k < m->nb; k++) n += m->facet_tag[k] == tag;
  return n;
}

/* A frozen line through the middle and a frozen side, refined and coarsened: no facet comes or goes. */
static void CheckFrozenLines(MetricAt at)
{
  MeshSerial m;
  AdaptResult r;
  Box(LOWER, UPPER, 0.0625, &m);
  AddTag(&m, "cut", OnCut);
  char *frozen = calloc((size_t)m.ntags, 1);
  frozen[0] = frozen[m.ntags - 1] = 1;
  const AdaptOptions options = {.frozen_tag = frozen};
  double *metric = SampleMetric(&m, at, NULL);
  CHECK(!MeshAdapt(&m, metric, &options, &r), "not adapted");
  CheckKept(&m, &r);
  for (int tag = 0; tag < m.ntags; tag += m.ntags - 1) {
    CHECK(CountTag(&m, tag) == 16 && CountTag(&r.mesh, tag) == 16, "%s: %d facets", m.tag_name[tag],
          CountTag(&r.mesh, tag));
  }
  for (int k = 0; k < r.mesh.nb; k++) {
    const int v = r.mesh.facet[2 * k];
    CHECK(!frozen[r.mesh.facet_tag[k]] || r.origin[v] >= 0, "vertex %d of a frozen line moved", v);
  }
  free(metric);
  free(frozen);
  AdaptResultDestroy(&r);
  MeshSerialDestroy(&m);
}

static int OnHole(const double p[2], const double q[2])
{
  const double x = 0.5 * (p[0] + q[0]) - 0.5, y = 0.5 * (p[1] + q[1]) - 0.5;
  return fabs(fmax(fabs(x), fabs(y)) - 0.25) < 1e-12;
}

/* The metric on every new or moved vertex is that of its place, wherever the walk to it in the old mesh
 * began. */
static void CheckMetricKept(const MeshSerial *from, double size)
{
  AdaptResult r;
  double *metric = SampleMetric(from, LogLinear, &size), exact[3];
  CHECK(!MeshAdapt(from, metric, NULL, &r), "not adapted");
  CheckKept(from, &r);
  for (int v = 0; v < r.mesh.nv; v++) {
    LogLinear(&size, &r.mesh.x[2 * v], exact);
    for (int k = 0; k < 3; k++) {
      const double error = fabs(r.metric[3 * v + k] - exact[k]) / (exact[0] + exact[2]);
      CHECK(error < 1e-10, "metric at (%g, %g) is wrong by %g", r.mesh.x[2 * v], r.mesh.x[2 * v + 1], error);
    }
  }
  free(metric);
  AdaptResultDestroy(&r);
}

/* A square hole: lines end at its corners, and walks in the old mesh must get around it. */
static void CheckHole(void)
{
  MeshSerial m;
  AdaptResult fine, coarse;
  int ne = 0;
  Box(LOWER, UPPER, 0.0625, &m);
  for (int e = 0; e < m.ne; e++) {
    double x = -0.5, y = -0.5;
    for (int i = 0; i < 3; i++)
      x += m.x[2 * m.vertex[3 * e + i]] / 3.0, y += m.x[2 * m.vertex[3 * e + i] + 1] / 3.0;
    if (fmax(fabs(x), fabs(y)) < 0.25) continue;
    memmove(&m.vertex[3 * ne++], &m.vertex[3 * e], 3 * sizeof(int));
  }
  m.ne = ne;
  AddTag(&m, "hole", OnHole);
  AdaptTo(&m, Fine, NULL, 3, &fine);
  CHECK(fabs(TagLength(&fine.mesh, m.ntags - 1) - 2.0) < 1e-12, "the hole's side is %g",
        TagLength(&m, m.ntags - 1));
  CheckMetricKept(&m, 0.01);
  CheckMetricKept(&fine.mesh, 0.05);
  CheckMetricKept(&fine.mesh, 0.2);
  AdaptTo(&fine.mesh, Coarse, NULL, 2, &coarse);
  CHECK(coarse.mesh.ne < 60, "%d triangles are left", coarse.mesh.ne);
  AdaptResultDestroy(&fine);
  AdaptResultDestroy(&coarse);
  MeshSerialDestroy(&m);
}

static void CheckAgain(void)
{
  MeshSerial m;
  AdaptResult first, again, twin;
  Box(LOWER, UPPER, 0.0625, &m);
  AdaptTo(&m, Fine, NULL, 3, &first);
  CHECK(!MeshAdapt(&first.mesh, first.metric, NULL, &again), "not adapted");
  CHECK(!MeshAdapt(&first.mesh, first.metric, NULL, &twin), "not adapted");
  const AdaptReport *r = &again.report;
  CHECK(50 * (r->splits + r->collapses) < first.mesh.nv, "%d splits and %d collapses of %d vertices",
        r->splits, r->collapses, first.mesh.nv);
  CHECK(10 * (r->moves + r->swaps) < first.mesh.nv, "%d moves and %d swaps", r->moves, r->swaps);
  CHECK(again.mesh.nv == twin.mesh.nv && again.mesh.ne == twin.mesh.ne &&
            !memcmp(again.mesh.x, twin.mesh.x, (size_t)again.mesh.nv * 2 * sizeof(double)) &&
            !memcmp(again.mesh.vertex, twin.mesh.vertex, (size_t)again.mesh.ne * 3 * sizeof(int)),
        "the same input twice, two meshes");
  AdaptResultDestroy(&first);
  AdaptResultDestroy(&again);
  AdaptResultDestroy(&twin);
  MeshSerialDestroy(&m);
}

/* What is refused leaves nothing behind. */
static void Refuse(const MeshSerial *m, const double metric[], PetscErrorCode code, const char *what)
{
  PetscLogDouble before, after;
  AdaptResult r;
  PetscMallocGetCurrentUsage(&before);
  PetscPushErrorHandler(PetscReturnErrorHandler, NULL);
  CHECK(MeshAdapt(m, metric, NULL, &r) == code, "%s is taken", what);
  PetscPopErrorHandler();
  PetscMallocGetCurrentUsage(&after);
  CHECK(after == before, "%s: %g bytes are left", what, after - before);
}

static void CheckRefused(void)
{
  MeshSerial m;
  Box(LOWER, UPPER, 0.5, &m);
  double *metric = SampleMetric(&m, Coarse, NULL);
  metric[0] = -1.0;
  Refuse(&m, metric, PETSC_ERR_ARG_OUTOFRANGE, "a negative metric");
  metric[0] = metric[2];
  const int first = m.vertex[0];
  m.vertex[0] = m.vertex[1];
  m.vertex[1] = first;
  Refuse(&m, metric, PETSC_ERR_ARG_WRONG, "a clockwise triangle");
  memcpy(m.vertex, &m.vertex[3], 3 * sizeof(int));
  Refuse(&m, metric, PETSC_ERR_ARG_WRONG, "a triangle twice");
  free(metric);
  MeshSerialDestroy(&m);
}

int main(int argc, char **argv)
{
  PetscCall(PetscOptionsSetValue(NULL, "-malloc_debug", "1")); /* so that it counts what is allocated */
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  CheckFrozenLines(Fine);
  CheckFrozenLines(Coarse);
  CheckHole();
  CheckAgain();
  CheckRefused();
  return PetscFinalize();
}
