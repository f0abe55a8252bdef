#include "fluid/phases/region.h"
#include "common/supermesh/search.h"
#include "fluid/phases/phases_impl.h"

enum { SIDES = 2048 };

typedef struct {
  int n;
  double (*x)[3][2]; /* [n] counter-clockwise */
} Triangles;

/* What of an element has which phase; -1: none yet. */
typedef struct {
  Polygon polygon;
  int phase;
} Part;

typedef struct {
  int n, capacity;
  Part *part;
} Parts;

static void Set(double x[3][2], const double a[2], const double b[2], const double c[2])
{
  for (int d = 0; d < 2; d++) x[0][d] = a[d], x[1][d] = b[d], x[2][d] = c[d];
}

static PetscErrorCode Fan(const Polygon *p, Triangles *t)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(PetscMax(p->n - 2, 0), &t->x));
  for (int k = 1; k + 1 < p->n; k++) Set(t->x[t->n++], p->x[0], p->x[k], p->x[k + 1]);
  PetscFunctionReturn(0);
}

static Polygon BoxPolygon(const double lower[2], const double upper[2])
{
  return (Polygon){4,
                   {{lower[0], lower[1]}, {upper[0], lower[1]}, {upper[0], upper[1]}, {lower[0], upper[1]}}};
}

static PetscErrorCode HalfPlaneTriangles(const Mesh *m, const Region *r, Triangles *t)
{
  const double l = hypot(r->b[0], r->b[1]), margin = m->upper[0] - m->lower[0] + m->upper[1] - m->lower[1];
  double lower[2], upper[2];
  PetscFunctionBeginUser;
  for (int c = 0; c < 2; c++) lower[c] = m->lower[c] - margin, upper[c] = m->upper[c] + margin;
  const Polygon box = BoxPolygon(lower, upper);
  HalfPlane h = {{r->b[0] / l, r->b[1] / l}, 0.0};
  Polygon part;
  h.d = h.n[0] * r->a[0] + h.n[1] * r->a[1];
  PolygonClip(&box, &h, &part);
  PetscCall(Fan(&part, t));
  PetscFunctionReturn(0);
}

/* The regular polygon between corners i and j: halved again and again, so that triangles are as large as they
 * can be away from its outline. */
static void Halve(const double corner[][2], int i, int j, Triangles *t)
{
  const int middle = (i + j) / 2;
  if (j - i < 2) return;
  Set(t->x[t->n++], corner[i], corner[middle], corner[j % SIDES]);
  Halve(corner, i, middle, t);
  Halve(corner, middle, j, t);
}

/* A regular polygon with the disc's area. */
static PetscErrorCode DiscTriangles(const Region *r, Triangles *t)
{
  const double step = 2.0 * PETSC_PI / SIDES, radius = r->radius * sqrt(step / sin(step));
  double(*corner)[2];
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(SIDES, &t->x));
  PetscCall(PetscMalloc1(SIDES, &corner));
  for (int k = 0; k < SIDES; k++) {
    corner[k][0] = r->a[0] + radius * cos(step * k);
    corner[k][1] = r->a[1] + radius * sin(step * k);
  }
  Halve((const double(*)[2])corner, 0, SIDES / 2, t);
  Halve((const double(*)[2])corner, SIDES / 2, SIDES, t);
  PetscCall(PetscFree(corner));
  PetscFunctionReturn(0);
}

static int Inside(const double x[3][2], const double p[2])
{
  return GeometryTurn(x[0], x[1], p) >= 0.0 && GeometryTurn(x[1], x[2], p) >= 0.0 &&
         GeometryTurn(x[2], x[0], p) >= 0.0;
}

/* An ear: corner k of those left, in front of which no other corner lies. */
static int IsEar(int n, const int left[], const double x[][2], int k)
{
  double t[3][2];
  const int a = left[(k + n - 1) % n], b = left[k], c = left[(k + 1) % n];
  Set(t, x[a], x[b], x[c]);
  if (GeometryArea((const double(*)[2])t) <= 0.0) return 0;
  for (int i = 0; i < n; i++) {
    const int v = left[i];
    if (v != a && v != b && v != c && Inside((const double(*)[2])t, x[v])) return 0;
  }
  return 1;
}

/* Ear clipping (Meisters 1975); *simple is 0 when no ear is left before the end. */
static PetscErrorCode PolygonTriangles(const Region *r, Triangles *t, int *simple)
{
  int *left, n = r->n;
  double twice = 0.0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &t->x));
  PetscCall(PetscMalloc1(n, &left));
  for (int k = 0; k < n; k++) {
    const double *p = r->x[k], *q = r->x[(k + 1) % n];
    twice += (p[0] - r->x[0][0]) * (q[1] - r->x[0][1]) - (p[1] - r->x[0][1]) * (q[0] - r->x[0][0]);
  }
  for (int k = 0; k < n; k++) left[k] = twice > 0.0 ? k : n - 1 - k;
  *simple = 1;
  while (n > 2 && *simple) {
    int k = 0;
    while (k < n && !IsEar(n, left, r->x, k)) k++;
    *simple = k < n;
    if (!*simple) break;
    Set(t->x[t->n++], r->x[left[(k + n - 1) % n]], r->x[left[k]], r->x[left[(k + 1) % n]]);
    for (n--; k < n; k++) left[k] = left[k + 1];
  }
  PetscCall(PetscFree(left));
  PetscFunctionReturn(0);
}

static PetscErrorCode MakeTriangles(const Mesh *m, const Region *r, Triangles *t)
{
  int simple = 1;
  PetscFunctionBeginUser;
  *t = (Triangles){0};
  if (r->shape == REGION_BOX) {
    PetscCheck(r->b[0] > r->a[0] && r->b[1] > r->a[1], PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
               "the box from (%g, %g) to (%g, %g) has no area", r->a[0], r->a[1], r->b[0], r->b[1]);
    const Polygon box = BoxPolygon(r->a, r->b);
    PetscCall(Fan(&box, t));
  } else if (r->shape == REGION_HALF_PLANE) {
    PetscCheck(hypot(r->b[0], r->b[1]) > 0.0, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
               "the half plane at (%g, %g) has the normal (0, 0)", r->a[0], r->a[1]);
    PetscCall(HalfPlaneTriangles(m, r, t));
  } else if (r->shape == REGION_DISC) {
    PetscCheck(r->radius > 0.0, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
               "the disc at (%g, %g) has the radius %g", r->a[0], r->a[1], r->radius);
    PetscCall(DiscTriangles(r, t));
  } else {
    PetscCheck(r->n >= 3, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "a polygon of %d corners", r->n);
    PetscCall(PolygonTriangles(r, t, &simple));
    PetscCheck(simple, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
               "the polygon that begins at (%g, %g) crosses itself or has no area", r->x[0][0], r->x[0][1]);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode AddPart(Parts *list, const Polygon *polygon, int phase)
{
  PetscFunctionBeginUser;
  if (list->n == list->capacity) {
    list->capacity = 2 * list->capacity + 64;
    PetscCall(PetscRealloc((size_t)list->capacity * sizeof *list->part, &list->part));
  }
  list->part[list->n++] = (Part){*polygon, phase};
  PetscFunctionReturn(0);
}

/* Part k becomes what lies in the triangle, with its phase; what lies outside is added. */
static PetscErrorCode PaintPart(Parts *list, int k, const HalfPlane side[3], int phase)
{
  const Part whole = list->part[k];
  const int n = list->n;
  Polygon in = whole.polygon, next, out;
  PetscFunctionBeginUser;
  if (whole.phase == phase) PetscFunctionReturn(0);
  for (int i = 0; i < 3; i++) {
    const HalfPlane other = HalfPlaneOther(&side[i]);
    PolygonClip(&in, &other, &out);
    PolygonClip(&in, &side[i], &next);
    if (!next.n || !(PolygonArea(&next) > 0.0)) { /* the triangle does not reach it */
      list->n = n;
      PetscFunctionReturn(0);
    }
    if (out.n && PolygonArea(&out) > 0.0) PetscCall(AddPart(list, &out, whole.phase));
    in = next;
  }
  list->part[k] = (Part){in, phase};
  PetscFunctionReturn(0);
}

static PetscErrorCode Paint(Parts *list, const double x[3][2], const double origin[2], int phase)
{
  const int n = list->n;
  Polygon t;
  PetscFunctionBeginUser;
  PolygonTriangle(x, origin, &t);
  const HalfPlane side[3] = {HalfPlaneLeft(t.x[0], t.x[1]), HalfPlaneLeft(t.x[1], t.x[2]),
                             HalfPlaneLeft(t.x[2], t.x[0])};
  for (int k = 0; k < n; k++) PetscCall(PaintPart(list, k, side, phase));
  PetscFunctionReturn(0);
}

/* All regions on one element: volume[np]; *bare is the area in no region. */
static PetscErrorCode FillElement(const Stars *s, int e, int nregions, const Region region[],
                                  const Triangles triangles[], Search search[], Parts *list, int np,
                                  double volume[], double *bare)
{
  const double(*x)[2] = (const double(*)[2])s->element[e].x;
  const GeometryBox box = GeometryBoxOf(x);
  Polygon element;
  PetscFunctionBeginUser;
  list->n = 0;
  PolygonTriangle(x, x[0], &element);
  PetscCall(AddPart(list, &element, -1));
  for (int r = 0; r < nregions; r++) {
    const int *hit, n = SearchQuery(search[r], &box, &hit);
    PetscCheck(n >= 0, PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory to search a region");
    for (int k = 0; k < n; k++)
      PetscCall(Paint(list, (const double(*)[2])triangles[r].x[hit[k]], x[0], region[r].phase));
  }
  for (int p = 0; p < np; p++) volume[p] = 0.0;
  for (int k = 0; k < list->n; k++) {
    double *to = list->part[k].phase < 0 ? bare : &volume[list->part[k].phase];
    *to += PolygonArea(&list->part[k].polygon);
  }
  PetscFunctionReturn(0);
}

/* The sum over the phases is the element's area to the last bit or two. */
static void Close(double area, int np, double volume[])
{
  int largest = 0;
  for (int p = 0; p < np; p++) {
    if (volume[p] > volume[largest]) largest = p;
  }
  for (int p = 0; p < np; p++) area -= volume[p];
  volume[largest] += area;
}

PetscErrorCode PhasesFill(Phases f, int nregions, const Region region[])
{
  const Stars *s = f->stars;
  Triangles *triangles;
  Search *search;
  Parts list = {0};
  double bare = 0.0, total = 0.0;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(nregions, &triangles, nregions, &search));
  for (int r = 0; r < nregions; r++) {
    PetscCheck(region[r].phase >= 0 && region[r].phase < f->np, s->mesh->comm, PETSC_ERR_ARG_OUTOFRANGE,
               "region %d is of phase %d, but there are %d phases", r, region[r].phase, f->np);
    PetscCall(MakeTriangles(s->mesh, &region[r], &triangles[r]));
    PetscCheck(!SearchCreateTriangles(triangles[r].n, (const double(*)[3][2])triangles[r].x, &search[r]),
               PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for a region of %d triangles", triangles[r].n);
  }
  for (int e = 0; e < s->ne; e++) {
    double *v = &f->volume[(size_t)e * (size_t)f->np];
    PetscCall(FillElement(s, e, nregions, region, triangles, search, &list, f->np, v, &bare));
    Close(StarsArea(s, e), f->np, v);
    total += StarsArea(s, e);
  }
  for (int r = 0; r < nregions; r++) {
    PetscCall(PetscFree(triangles[r].x));
    SearchDestroy(&search[r]);
  }
  PetscCall(PetscFree2(triangles, search));
  PetscCall(PetscFree(list.part));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &bare, 1, MPI_DOUBLE, MPI_SUM, s->mesh->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, s->mesh->comm));
  f->has_lines = PETSC_FALSE;
  PetscCheck(bare <= 1e-10 * total, s->mesh->comm, PETSC_ERR_ARG_INCOMP,
             "%.6g m2 of the domain's %.6g are in no phase: give a region that covers the rest first", bare,
             total);
  PetscFunctionReturn(0);
}
