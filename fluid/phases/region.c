#include "fluid/phases/region.h"
#include "common/supermesh/outline.h"
#include "common/supermesh/search.h"
#include "fluid/phases/phases_impl.h"

enum { SIDES = 2048 };

/* A piece of an element with more than so many triangles of regions is quartered where that divides them, so many times at most: what a
 * piece costs grows with the square of their number. */
enum { PIECE_MOST = 64, QUARTERED_MOST = 12 };

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

static PetscErrorCode PolygonTriangles(const Region *r, Triangles *t)
{
  int(*corner)[3];
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(r->n, &t->x));
  PetscCall(PetscMalloc1(r->n, &corner));
  t->n = OutlineTriangles(r->n, r->x, corner);
  for (int k = 0; k < t->n; k++) Set(t->x[k], r->x[corner[k][0]], r->x[corner[k][1]], r->x[corner[k][2]]);
  PetscCall(PetscFree(corner));
  PetscFunctionReturn(0);
}

/* Of the part of the box in the mesh's bounds, widened by their size. */
static PetscErrorCode BoxTriangles(const Mesh *m, const Region *r, Triangles *t)
{
  const double size = hypot(m->upper[0] - m->lower[0], m->upper[1] - m->lower[1]);
  double lower[2], upper[2];
  PetscFunctionBeginUser;
  for (int c = 0; c < 2; c++) {
    lower[c] = fmax(r->a[c], m->lower[c] - size);
    upper[c] = fmin(r->b[c], m->upper[c] + size);
    if (!(upper[c] > lower[c])) PetscFunctionReturn(0);
  }
  const Polygon box = BoxPolygon(lower, upper);
  PetscCall(Fan(&box, t));
  PetscFunctionReturn(0);
}

static PetscErrorCode MakeTriangles(const Mesh *m, const Region *r, Triangles *t)
{
  PetscFunctionBeginUser;
  *t = (Triangles){0};
  if (r->shape == REGION_BOX) {
    PetscCheck(r->b[0] > r->a[0] && r->b[1] > r->a[1], PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
               "the box from (%g, %g) to (%g, %g) has no area", r->a[0], r->a[1], r->b[0], r->b[1]);
    PetscCall(BoxTriangles(m, r, t));
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
    PetscCall(PolygonTriangles(r, t));
    PetscCheck(t->n == r->n - 2, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
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

/* Not if one of the triangle's sides has all of the polygon outside. */
static int MayReach(const HalfPlane side[3], const Polygon *p)
{
  for (int i = 0; i < 3; i++) {
    int k = 0;
    while (k < p->n && side[i].n[0] * p->x[k][0] + side[i].n[1] * p->x[k][1] >= side[i].d) k++;
    if (k == p->n) return 0;
  }
  return 1;
}

/* Part k becomes what lies in the triangle, with its phase; what lies outside is added. */
static PetscErrorCode PaintPart(Parts *list, int k, const HalfPlane side[3], int phase)
{
  if (list->part[k].phase == phase || !MayReach(side, &list->part[k].polygon)) return 0;
  const Part whole = list->part[k];
  const int n = list->n;
  Polygon in = whole.polygon, next, out;
  PetscFunctionBeginUser;
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

/* All regions, and the parts of the piece that is filled. */
typedef struct {
  int n;
  const Region *region;
  Triangles *triangles; /* [n] */
  Search *search;       /* [n] */
  Parts parts;
} Filling;

/* By the middles of its sides. */
static void Quarter(const double x[3][2], double quarter[4][3][2])
{
  double middle[3][2];
  for (int i = 0; i < 3; i++) {
    for (int d = 0; d < 2; d++) middle[i][d] = 0.5 * (x[i][d] + x[(i + 1) % 3][d]);
  }
  for (int i = 0; i < 3; i++) Set(quarter[i], x[i], middle[i], middle[(i + 2) % 3]);
  Set(quarter[3], middle[0], middle[1], middle[2]);
}

/* Triangles of region r that may reach the triangle x. */
static PetscErrorCode FindTriangles(Filling *f, int r, const double x[3][2], const int **hit, int *n)
{
  const GeometryBox box = GeometryBoxOf(x);
  PetscFunctionBeginUser;
  *n = SearchQuery(f->search[r], &box, hit);
  PetscCheck(*n >= 0, PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory to search a region");
  PetscFunctionReturn(0);
}

static PetscErrorCode CountTriangles(Filling *f, const double x[3][2], int *count)
{
  PetscFunctionBeginUser;
  *count = 0;
  for (int r = 0; r < f->n; r++) {
    const int *hit;
    int n;
    PetscCall(FindTriangles(f, r, x, &hit, &n));
    *count += n;
  }
  PetscFunctionReturn(0);
}

/* All regions on the triangle x: adds to volume[np], and to *bare the area in no region. */
static PetscErrorCode PaintPiece(Filling *f, const double x[3][2], double volume[], double *bare)
{
  Polygon piece;
  PetscFunctionBeginUser;
  f->parts.n = 0;
  PolygonTriangle(x, x[0], &piece);
  PetscCall(AddPart(&f->parts, &piece, -1));
  for (int r = 0; r < f->n; r++) {
    const int *hit;
    int n;
    PetscCall(FindTriangles(f, r, x, &hit, &n));
    for (int k = 0; k < n; k++)
      PetscCall(Paint(&f->parts, (const double(*)[2])f->triangles[r].x[hit[k]], x[0], f->region[r].phase));
  }
  for (int k = 0; k < f->parts.n; k++) {
    double *to = f->parts.part[k].phase < 0 ? bare : &volume[f->parts.part[k].phase];
    *to += PolygonArea(&f->parts.part[k].polygon);
  }
  PetscFunctionReturn(0);
}

/* The same, of a triangle that `count` triangles of regions may reach, quarter by quarter where most of them reach few quarters.  (Not where many
 * meet at a corner, as in a polygon that is a fan.) */
static PetscErrorCode FillPiece(Filling *f, const double x[3][2], int count, int quartered, double volume[],
                                double *bare)
{
  double quarter[4][3][2];
  int of_quarter[4], all = 0;
  PetscFunctionBeginUser;
  if (count > PIECE_MOST && quartered < QUARTERED_MOST) {
    Quarter(x, quarter);
    for (int k = 0; k < 4; k++) {
      PetscCall(CountTriangles(f, (const double(*)[2])quarter[k], &of_quarter[k]));
      all += of_quarter[k];
    }
    if (all <= 2 * count) {
      for (int k = 0; k < 4; k++)
        PetscCall(FillPiece(f, (const double(*)[2])quarter[k], of_quarter[k], quartered + 1, volume, bare));
      PetscFunctionReturn(0);
    }
  }
  PetscCall(PaintPiece(f, x, volume, bare));
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
  Filling filling = {.n = nregions, .region = region};
  double bare = 0.0, total = 0.0;
  int count;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(nregions, &filling.triangles, nregions, &filling.search));
  for (int r = 0; r < nregions; r++) {
    PetscCheck(region[r].phase >= 0 && region[r].phase < f->np, s->mesh->comm, PETSC_ERR_ARG_OUTOFRANGE,
               "region %d is of phase %d, but there are %d phases", r, region[r].phase, f->np);
    Triangles *t = &filling.triangles[r];
    PetscCall(MakeTriangles(s->mesh, &region[r], t));
    PetscCheck(!SearchCreateTriangles(t->n, (const double(*)[3][2])t->x, &filling.search[r]), PETSC_COMM_SELF,
               PETSC_ERR_MEM, "no memory for a region of %d triangles", t->n);
  }
  for (int e = 0; e < s->ne; e++) {
    double *v = &f->volume[(size_t)e * (size_t)f->np];
    for (int p = 0; p < f->np; p++) v[p] = 0.0;
    const double(*x)[2] = (const double(*)[2])s->element[e].x;
    PetscCall(CountTriangles(&filling, x, &count));
    PetscCall(FillPiece(&filling, x, count, 0, v, &bare));
    Close(StarsArea(s, e), f->np, v);
    total += StarsArea(s, e);
  }
  for (int r = 0; r < nregions; r++) {
    PetscCall(PetscFree(filling.triangles[r].x));
    SearchDestroy(&filling.search[r]);
  }
  PetscCall(PetscFree2(filling.triangles, filling.search));
  PetscCall(PetscFree(filling.parts.part));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &bare, 1, MPI_DOUBLE, MPI_SUM, s->mesh->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, s->mesh->comm));
  f->has_lines = PETSC_FALSE;
  PetscCheck(bare <= 1e-10 * total, s->mesh->comm, PETSC_ERR_ARG_INCOMP,
             "%.6g m2 of the domain's %.6g are in no phase: give a region that covers the rest first", bare,
             total);
  PetscFunctionReturn(0);
}
