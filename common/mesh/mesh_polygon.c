/* Delaunay refinement (Chew 1989, Ruppert 1995): a triangle that is too large or misshapen gets a vertex at the centre of its circle; where that
 * lies beyond a side, or sees one at a wide angle, the side is halved instead.  Where all features of the polygon are as large as the wanted size no
 * side is halved, and no angle is below 30 degrees but at sharp corners. */
#include "common/mesh/mesh.h"
#include "common/mesh/mesh_delaunay.h"
#include "common/supermesh/geometry.h"
#include "common/supermesh/outline.h"

#define LARGE 0.6     /* radius of the largest circle over the wanted size */
#define MISSHAPEN 1.2 /* radius over the shortest edge: an angle below 24.6 degrees */
#define WIDE (-0.5)   /* cosine of 120 degrees */
#define SHORTEST 0.01 /* sides are not halved below so much of the size */
enum { SMOOTHINGS = 4 };

typedef struct {
  Delaunay d;
  int n; /* corners of the polygon */
  const double (*corner)[2];
  double size;
} Refined;

/* --- sides ---------------------------------------------------------------------------------------------- */

/* At this share of the way along face i of triangle t. */
static PetscErrorCode SplitSide(Refined *r, int t, int i, double share)
{
  const double *from = DelaunayCorner(&r->d, t, i + 1), *to = DelaunayCorner(&r->d, t, i + 2),
               at[2] = {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
  PetscFunctionBeginUser;
  PetscCall(DelaunaySplitSide(&r->d, t, i, at));
  PetscFunctionReturn(0);
}

/* Each side into the fewest equal parts that are not longer than the size; here at the middle one. */
static PetscErrorCode DivideSide(Refined *r, int t, int i)
{
  const int side = -1 - r->d.across[t][i];
  const double *a = r->corner[side], *b = r->corner[(side + 1) % r->n],
               *from = DelaunayCorner(&r->d, t, i + 1), *to = DelaunayCorner(&r->d, t, i + 2);
  const double length = hypot(b[0] - a[0], b[1] - a[1]), part = length / ceil(length / r->size - 1e-9),
               parts = round(hypot(to[0] - from[0], to[1] - from[1]) / part);
  PetscFunctionBeginUser;
  if (parts < 2.0) PetscFunctionReturn(0);
  PetscCall(SplitSide(r, t, i, floor(0.5 * parts) / parts));
  PetscFunctionReturn(0);
}

static PetscErrorCode DivideSides(Refined *r)
{
  int before;
  PetscFunctionBeginUser;
  do {
    before = r->d.nv;
    for (int t = 0; t < r->d.ne; t++)
      for (int i = 0; i < 3; i++)
        if (r->d.across[t][i] < 0) PetscCall(DivideSide(r, t, i));
  } while (r->d.nv > before);
  PetscFunctionReturn(0);
}

/* At the middle; next to a corner at a power of 2 from it, so that two sides that meet at a sharp angle are divided alike. */
static PetscErrorCode HalveSide(Refined *r, int t, int i)
{
  const double *from = DelaunayCorner(&r->d, t, i + 1), *to = DelaunayCorner(&r->d, t, i + 2);
  const double length = hypot(to[0] - from[0], to[1] - from[1]);
  const int first = r->d.vertex[t][(i + 1) % 3] < r->n, second = r->d.vertex[t][(i + 2) % 3] < r->n;
  double share = 0.5;
  PetscFunctionBeginUser;
  if (length < 2.0 * SHORTEST * r->size) PetscFunctionReturn(0);
  if (first != second) {
    share = r->size * exp2(round(log2(0.5 * length / r->size))) / length;
    if (second) share = 1.0 - share;
  }
  PetscCall(SplitSide(r, t, i, share));
  PetscFunctionReturn(0);
}

/* --- triangles ------------------------------------------------------------------------------------------ */

/* The centre of the circle through the corners, its radius, the shortest edge's length; that edge is opposite to corner *shortest. */
static void Circle(const Delaunay *d, int t, double centre[2], double *radius, double *edge, int *shortest)
{
  const double *a = DelaunayCorner(d, t, 0), *b = DelaunayCorner(d, t, 1), *c = DelaunayCorner(d, t, 2);
  const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1], bb = bx * bx + by * by,
               cc = cx * cx + cy * cy, twice = bx * cy - by * cx;
  const double x = 0.5 * (bb * cy - cc * by) / twice, y = 0.5 * (cc * bx - bb * cx) / twice;
  centre[0] = a[0] + x;
  centre[1] = a[1] + y;
  *radius = hypot(x, y);
  *edge = HUGE_VAL;
  for (int i = 0; i < 3; i++) {
    const double *p = DelaunayCorner(d, t, i + 1), *q = DelaunayCorner(d, t, i + 2),
                 length = hypot(q[0] - p[0], q[1] - p[1]);
    if (length < *edge) *edge = length, *shortest = i;
  }
}

/* Whether the triangle at a corner of the polygon ends at both its sides: its angle is the polygon's. */
static int IsAtCorner(const Refined *r, int t, int i)
{
  return r->d.vertex[t][i] < r->n && r->d.across[t][(i + 1) % 3] < 0 && r->d.across[t][(i + 2) % 3] < 0;
}

/* A side of this triangle or the three around it that is seen from the point at a wide angle. */
static int SeesWide(const Delaunay *d, int t, const double from[2], int *triangle, int *face)
{
  for (int k = -1; k < 3; k++) {
    *triangle = k < 0 ? t : d->across[t][k];
    if (*triangle < 0) continue;
    for (*face = 0; *face < 3; ++*face) {
      if (d->across[*triangle][*face] >= 0) continue;
      const double *a = DelaunayCorner(d, *triangle, *face + 1), *b = DelaunayCorner(d, *triangle, *face + 2);
      const double ax = a[0] - from[0], ay = a[1] - from[1], bx = b[0] - from[0], by = b[1] - from[1];
      if (ax * bx + ay * by < WIDE * hypot(ax, ay) * hypot(bx, by)) return 1;
    }
  }
  return 0;
}

static PetscErrorCode Improve(Refined *r, int t)
{
  Delaunay *d = &r->d;
  double centre[2], radius, edge;
  int shortest = 0, face, at, beside;
  PetscFunctionBeginUser;
  Circle(d, t, centre, &radius, &edge, &shortest);
  const int misshapen = radius > MISSHAPEN * edge && edge > SHORTEST * r->size && !IsAtCorner(r, t, shortest);
  if (radius <= LARGE * r->size && !misshapen) PetscFunctionReturn(0);
  at = DelaunayWalk(d, t, centre, &face);
  if (at < 0) PetscFunctionReturn(0);
  if (face >= 0)
    PetscCall(HalveSide(r, at, face));
  else if (SeesWide(d, at, centre, &beside, &face))
    PetscCall(HalveSide(r, beside, face));
  else
    PetscCall(DelaunaySplitTriangle(d, at, centre));
  PetscFunctionReturn(0);
}

static PetscErrorCode Refine(Refined *r)
{
  int before;
  PetscFunctionBeginUser;
  do {
    before = r->d.nv;
    for (int t = 0; t < r->d.ne; t++) PetscCall(Improve(r, t));
  } while (r->d.nv > before);
  PetscFunctionReturn(0);
}

/* --- smoothing ------------------------------------------------------------------------------------------ */

/* Area over the squares of the edges; 0.144 at most. */
static double Quality(const double a[2], const double b[2], const double c[2])
{
  double squares = 0.0;
  for (int k = 0; k < 2; k++)
    squares += (b[k] - a[k]) * (b[k] - a[k]) + (c[k] - b[k]) * (c[k] - b[k]) + (a[k] - c[k]) * (a[k] - c[k]);
  return 0.5 * GeometryTurn(a, b, c) / squares;
}

/* Of the worst triangle around a vertex, corner i of triangle t, were it at x; adds its centre times area, relative to x, and area to sum[3].  Negative:
 * the vertex is on a side. */
static double WorstAround(const Delaunay *d, int t, int i, const double x[2], double sum[3])
{
  const int vertex = d->vertex[t][i], first = t;
  double worst = HUGE_VAL;
  do {
    const double *a = DelaunayCorner(d, t, i + 1), *b = DelaunayCorner(d, t, i + 2);
    const double area = 0.5 * GeometryTurn(x, a, b);
    for (int k = 0; k < 2; k++) sum[k] += area * (a[k] - x[k] + b[k] - x[k]) / 3.0;
    sum[2] += area;
    worst = fmin(worst, Quality(x, a, b));
    t = d->across[t][(i + 1) % 3];
    if (t < 0) return -1.0;
    for (i = 0; i < 2 && d->vertex[t][i] != vertex;) i++;
  } while (t != first);
  return worst;
}

/* Each vertex to the centre of mass of the triangles around it, where that makes the worst of them better. */
static PetscErrorCode Smooth(Refined *r)
{
  Delaunay *d = &r->d;
  char *seen;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(d->nv, &seen));
  for (int t = 0; t < d->ne; t++)
    for (int i = 0; i < 3; i++) {
      double *x = d->x[d->vertex[t][i]], sum[3] = {0.0, 0.0, 0.0}, unused[3];
      if (seen[d->vertex[t][i]]++) continue;
      const double worst = WorstAround(d, t, i, x, sum);
      if (worst < 0.0) continue;
      const double to[2] = {x[0] + sum[0] / sum[2], x[1] + sum[1] / sum[2]};
      if (WorstAround(d, t, i, to, unused) > worst) x[0] = to[0], x[1] = to[1];
    }
  PetscCall(PetscFree(seen));
  PetscCall(DelaunayRestore(d));
  PetscFunctionReturn(0);
}

/* --- the mesh ------------------------------------------------------------------------------------------- */

/* The sides' names, each once, and which of them side k has. */
static PetscErrorCode NameSides(const Refined *r, const char *const name[], MeshSerial *mesh, int tag[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(r->n, &mesh->tag_name));
  for (int k = 0; k < r->n; k++) {
    int j = 0;
    while (j < mesh->ntags && strcmp(mesh->tag_name[j], name[k])) j++;
    if (j == mesh->ntags)
      PetscCall(PetscStrncpy(mesh->tag_name[mesh->ntags++], name[k], sizeof *mesh->tag_name));
    tag[k] = j;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Fill(const Refined *r, const char *const name[], MeshSerial *mesh)
{
  const Delaunay *d = &r->d;
  int *tag;
  PetscFunctionBeginUser;
  *mesh = (MeshSerial){.nv = d->nv, .ne = d->ne};
  for (int t = 0; t < d->ne; t++) {
    for (int i = 0; i < 3; i++) mesh->nb += d->across[t][i] < 0;
  }
  PetscCall(PetscMalloc1(r->n, &tag));
  PetscCall(NameSides(r, name, mesh, tag));
  PetscCall(PetscMalloc1(2 * (size_t)mesh->nv, &mesh->x));
  PetscCall(PetscMalloc1(3 * (size_t)mesh->ne, &mesh->vertex));
  PetscCall(PetscMalloc1(2 * (size_t)mesh->nb, &mesh->facet));
  PetscCall(PetscMalloc1((size_t)mesh->nb, &mesh->facet_tag));
  memcpy(mesh->x, d->x, (size_t)d->nv * sizeof *d->x);
  memcpy(mesh->vertex, d->vertex, (size_t)d->ne * sizeof *d->vertex);
  for (int t = 0, b = 0; t < d->ne; t++)
    for (int i = 0; i < 3; i++) {
      if (d->across[t][i] >= 0) continue;
      mesh->facet[2 * b] = d->vertex[t][(i + 1) % 3];
      mesh->facet[2 * b + 1] = d->vertex[t][(i + 2) % 3];
      mesh->facet_tag[b++] = tag[-1 - d->across[t][i]];
    }
  PetscCall(PetscFree(tag));
  PetscFunctionReturn(0);
}

/* 0.26 size^2 a triangle. */
double MeshPolygonCount(int n, const double corner[][2], double size)
{
  return 4.0 * fabs(OutlineArea(n, corner)) / (size * size);
}

PetscErrorCode MeshPolygon(int n, const double corner[][2], const char *const name[], double size,
                           MeshSerial *mesh)
{
  Refined r = {.n = n, .corner = corner, .size = size};
  PetscFunctionBeginUser;
  PetscCall(DelaunayCreate(n, corner, &r.d));
  PetscCall(DivideSides(&r));
  PetscCall(Refine(&r));
  for (int k = 0; k < SMOOTHINGS; k++) PetscCall(Smooth(&r));
  PetscCall(Fill(&r, name, mesh));
  PetscCall(DelaunayDestroy(&r.d));
  PetscFunctionReturn(0);
}
