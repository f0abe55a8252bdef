/* What every adapted mesh must keep, and analytic metrics to adapt to. */
#ifndef TEST_ADAPT_KEPT_H
#define TEST_ADAPT_KEPT_H
#include "fluid/adapt/adapt.h"
#include "fluid/adapt/metric.h"
#include "fluid/adapt/metric_tensor.h"
#include "tests/check.h"
#include <math.h>
#include <string.h>

/* Uniform random numbers in [0, 1): Marsaglia's xorshift64*. */
static inline double Random(unsigned long long *state)
{
  *state ^= *state >> 12;
  *state ^= *state << 25;
  *state ^= *state >> 27;
  return (double)((*state * 2685821657736338717ULL) >> 11) / 9007199254740992.0;
}

static inline double UniformSize(void *context, const double x[2])
{
  return *(const double *)context;
}

/* A box of roughly equal triangles. */
static inline void Box(const double lower[2], const double upper[2], double size, MeshSerial *mesh)
{
  CHECK(!MeshBox(lower, upper, size, UniformSize, &size, mesh), "no box");
}

/* metric is multiplied so that a mesh of it has so many triangles (MetricCount). */
static inline void ScaleTo(const MeshSerial *mesh, double triangles, double metric[])
{
  double count;
  CHECK(!MetricCount(mesh, metric, &count), "not counted");
  for (int k = 0; k < 3 * mesh->nv; k++) metric[k] *= triangles / count;
}

static inline double Area(const MeshSerial *m, int e)
{
  const double *a = &m->x[2 * m->vertex[3 * e]], *b = &m->x[2 * m->vertex[3 * e + 1]];
  const double *c = &m->x[2 * m->vertex[3 * e + 2]];
  return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

static inline double TagLength(const MeshSerial *m, int tag)
{
  double sum = 0.0;
  for (int k = 0; k < m->nb; k++) {
    const double *p = &m->x[2 * m->facet[2 * k]], *q = &m->x[2 * m->facet[2 * k + 1]];
    if (m->facet_tag[k] == tag) sum += hypot(q[0] - p[0], q[1] - p[1]);
  }
  return sum;
}

static inline double RegionArea(const MeshSerial *m, int region)
{
  double sum = 0.0;
  for (int e = 0; e < m->ne; e++) sum += (!m->region || m->region[e] == region) ? Area(m, e) : 0.0;
  return sum;
}

typedef struct {
  int lower, upper, up; /* up: +1 if the face runs from lower to upper, -1 otherwise, 0 for a facet */
} TestEdge;

static inline int CompareEdges(const void *p, const void *q)
{
  const TestEdge *a = p, *b = q;
  if (a->lower != b->lower) return a->lower < b->lower ? -1 : 1;
  if (a->upper != b->upper) return a->upper < b->upper ? -1 : 1;
  return (a->up > b->up) - (a->up < b->up);
}

static inline TestEdge MakeEdge(int a, int b, int is_facet)
{
  const TestEdge edge = {a < b ? a : b, a < b ? b : a, is_facet ? 0 : a < b ? 1 : -1};
  return edge;
}

/* Every edge belongs to one triangle and a facet, or to two that run opposite ways. */
static inline void CheckConforms(const MeshSerial *m)
{
  const int n = 3 * m->ne + m->nb;
  TestEdge *edge = malloc((size_t)n * sizeof *edge);
  for (int e = 0; e < m->ne; e++) {
    const int *v = &m->vertex[3 * e];
    for (int i = 0; i < 3; i++) edge[3 * e + i] = MakeEdge(v[i], v[(i + 1) % 3], 0);
  }
  for (int k = 0; k < m->nb; k++) edge[3 * m->ne + k] = MakeEdge(m->facet[2 * k], m->facet[2 * k + 1], 1);
  qsort(edge, (size_t)n, sizeof *edge, CompareEdges);
  for (int i = 0, end; i < n; i = end) {
    int faces = 0, facets = 0, turn = 0;
    for (end = i; end < n && edge[end].lower == edge[i].lower && edge[end].upper == edge[i].upper; end++) {
      faces += edge[end].up != 0;
      facets += edge[end].up == 0;
      turn += edge[end].up;
    }
    CHECK(facets <= 1 && ((faces == 1 && facets == 1) || (faces == 2 && turn == 0)),
          "edge %d %d: %d triangles, %d facets, turn %d", edge[i].lower, edge[i].upper, faces, facets, turn);
  }
  free(edge);
}

/* What any adaptation keeps: orientation, the area of every region, the length of every tag, conformity;
 * every vertex is used, and one with an origin is where it was. */
static inline void CheckKept(const MeshSerial *before, const AdaptResult *result)
{
  const MeshSerial *after = &result->mesh;
  char *used = calloc((size_t)after->nv + 1, 1);
  for (int e = 0; e < after->ne; e++) {
    CHECK(Area(after, e) > 0.0, "triangle %d has area %g", e, Area(after, e));
    for (int i = 0; i < 3; i++) used[after->vertex[3 * e + i]] = 1;
  }
  for (int r = 0; r < (before->region ? before->nregions : 1); r++) {
    const double was = RegionArea(before, r), is = RegionArea(after, r);
    CHECK(fabs(is - was) < 1e-12 * was, "region %d: area %.17g, was %.17g", r, is, was);
  }
  CHECK(after->ntags == before->ntags && after->nregions == before->nregions, "names are lost");
  for (int k = 0; k < before->ntags; k++) {
    const double was = TagLength(before, k), is = TagLength(after, k);
    CHECK(fabs(is - was) < 1e-12 * was, "%s: length %.17g, was %.17g", before->tag_name[k], is, was);
    CHECK(!strcmp(after->tag_name[k], before->tag_name[k]), "name %s", after->tag_name[k]);
  }
  CheckConforms(after);
  for (int v = 0; v < after->nv; v++) {
    const int o = result->origin[v];
    CHECK(used[v], "vertex %d belongs to no triangle", v);
    CHECK(MetricIsValid(&result->metric[3 * v]), "metric at vertex %d", v);
    CHECK(o < 0 || !memcmp(&after->x[2 * v], &before->x[2 * o], 2 * sizeof(double)), "origin of vertex %d",
          v);
  }
  free(used);
}

typedef void (*MetricAt)(const void *context, const double x[2], double m[3]);

/* Ellipse sizes h0 along (cos angle, sin angle), h1 across. */
static inline void MetricOf(double h0, double h1, double angle, double m[3])
{
  const double lambda[2] = {1.0 / (h0 * h0), 1.0 / (h1 * h1)}, axis[2] = {cos(angle), sin(angle)};
  MetricCompose(lambda, axis, m);
}

static inline double *SampleMetric(const MeshSerial *mesh, MetricAt at, const void *context)
{
  double *metric = malloc((size_t)mesh->nv * 3 * sizeof *metric);
  for (int v = 0; v < mesh->nv; v++) at(context, &mesh->x[2 * v], &metric[3 * v]);
  return metric;
}

/* Adapts `times` times to an analytic metric, sampled anew on each mesh, and checks what must be kept. */
static inline void AdaptTo(const MeshSerial *start, MetricAt at, const void *context, int times,
                           AdaptResult *result)
{
  const MeshSerial *from = start;
  AdaptResult last;
  for (int k = 0; k < times; k++) {
    double *metric = SampleMetric(from, at, context);
    CHECK(!MeshAdapt(from, metric, NULL, result), "adaptation failed");
    CheckKept(from, result);
    free(metric);
    if (k > 0) AdaptResultDestroy(&last);
    last = *result;
    from = &last.mesh;
  }
}
#endif
