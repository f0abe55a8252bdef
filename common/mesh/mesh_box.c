/* The box mesher: root cells, a quadtree on each, 2:1 balance over edges and corners, then every leaf is cut:
 *
 *   +-------+  no neighbour is finer: two triangles,    +-------+  a neighbour is finer: a fan about the
 *   |\      |  the diagonal alternates like a chess     |\     /|  centre; each hanging node (o) splits
 *   |  \    |  board (union jack), so that no           |  \ /  |  one of its triangles in two
 *   |    \  |  direction is preferred                   |  /|\  |
 *   |      \|                                           |/  |  \|
 *   +-------+                                           +---o---+
 *
 * Square cells give angles of 45 and 90 degrees only.  Cells are stretched to fit the box, at most 2:1, which
 * leaves atan(1/2) = 26.6 degrees in the worst case. */
#include "common/mesh/mesh.h"
#include "common/mesh/mesh_table.h"
#include <string.h>

enum { LEFT, RIGHT, BOTTOM, TOP, SIDES };
static const char *const SIDE_NAME[SIDES] = {"left", "right", "bottom", "top"};

#define DEPTH_MAX 24     /* halvings of a root cell */
#define ASPECT_GOOD 1.25 /* stretching of root cells beyond which smaller ones are tried */
#define EVEN_FROM 8      /* from this count on an even number of root cells makes the mesh mirror-symmetric */

typedef struct {
  int x, y;  /* lower left corner; a root cell is 1 << depth wide */
  int level; /* 0: root */
  int child; /* the first of four: x + 2 y; 0: a leaf */
} Cell;

typedef struct {
  double lower[2], upper[2], size_max;
  double (*size)(void *context, const double x[2]);
  void *context;
  int n[2];  /* root cells in x and y: cells 0 .. n[0] n[1] - 1 of the tree */
  int depth; /* the deepest level that coordinates can express */
  int ncell, nleaf;
  size_t capacity;
  Cell *cell;
} Tree;

/* What cutting adds to the mesh. */
typedef struct {
  MeshSerial *mesh;
  MeshTable vertex; /* of a position in the tree */
} Cutting;

static PetscErrorCode Grow(size_t needed, size_t *capacity, Cell **cell)
{
  PetscFunctionBeginUser;
  if (needed > *capacity) {
    *capacity = 2 * needed;
    PetscCall(PetscRealloc(*capacity * sizeof **cell, cell));
  }
  PetscFunctionReturn(0);
}

/* The smallest of size_max and the sizes at 3 x 3 points of a rectangle. */
static PetscErrorCode Wanted(const Tree *t, const double lower[2], const double edge[2], double *wanted)
{
  PetscFunctionBeginUser;
  *wanted = t->size_max;
  for (int j = 0; j < 3; j++) {
    for (int i = 0; i < 3; i++) {
      const double x[2] = {lower[0] + 0.5 * i * edge[0], lower[1] + 0.5 * j * edge[1]};
      const double s = t->size(t->context, x);
      PetscCheck(s > 0.0, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
                 "mesh size %g at (%g, %g) is not positive", s, x[0], x[1]);
      *wanted = PetscMin(*wanted, s);
    }
  }
  PetscFunctionReturn(0);
}

/* The smallest size that halving a rectangle meets on its way down to the wanted sizes. */
static PetscErrorCode SmallestIn(const Tree *t, const double lower[2], const double edge[2], double *smallest)
{
  double wanted;
  PetscFunctionBeginUser;
  PetscCall(Wanted(t, lower, edge, &wanted));
  *smallest = PetscMin(*smallest, wanted);
  if (PetscMax(edge[0], edge[1]) > wanted) {
    const double half[2] = {0.5 * edge[0], 0.5 * edge[1]};
    for (int k = 0; k < 4; k++) {
      const double corner[2] = {lower[0] + (k & 1) * half[0], lower[1] + (k >> 1) * half[1]};
      PetscCall(SmallestIn(t, corner, half, smallest));
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Smallest(const Tree *t, double *smallest)
{
  double edge[2];
  int n[2];
  PetscFunctionBeginUser;
  *smallest = t->size_max;
  for (int d = 0; d < 2; d++) {
    n[d] = (int)ceil((t->upper[d] - t->lower[d]) / t->size_max);
    edge[d] = (t->upper[d] - t->lower[d]) / n[d];
  }
  for (int j = 0; j < n[1]; j++) {
    for (int i = 0; i < n[0]; i++) {
      const double corner[2] = {t->lower[0] + i * edge[0], t->lower[1] + j * edge[1]};
      PetscCall(SmallestIn(t, corner, edge, smallest));
    }
  }
  PetscFunctionReturn(0);
}

/* Counts of root cells of an edge of at most `root`; returns how far from square they are, >= 1. */
static double CountRoots(const double length[2], double root, int n[2])
{
  for (int d = 0; d < 2; d++) {
    n[d] = (int)ceil(length[d] / root * (1.0 - 1e-12));
    if (n[d] >= EVEN_FROM) n[d] += n[d] % 2;
  }
  const double aspect = length[0] / n[0] * n[1] / length[1];
  return PetscMax(aspect, 1.0 / aspect);
}

/* The root edge is the smallest size times the largest 2^k that size_max and the box allow, so that leaves
 * meet the smallest size; a smaller k where the box would stretch them much. */
static PetscErrorCode Roots(Tree *t)
{
  const double length[2] = {t->upper[0] - t->lower[0], t->upper[1] - t->lower[1]};
  const double room = PetscMin(PetscMin(length[0], length[1]), t->size_max);
  double smallest, root;
  PetscFunctionBeginUser;
  PetscCheck(length[0] > 0 && length[1] > 0 && t->size_max > 0, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
             "box mesh of %g x %g with size_max %g: all must be positive", length[0], length[1], t->size_max);
  PetscCheck(length[0] / t->size_max * (length[1] / t->size_max) < 1e8, PETSC_COMM_SELF,
             PETSC_ERR_ARG_OUTOFRANGE, "box mesh of %g x %g with size_max %g: more than 1e8 cells", length[0],
             length[1], t->size_max);
  PetscCall(Smallest(t, &smallest));
  root = smallest = PetscMin(smallest, room);
  while (2.0 * root <= room * (1.0 + 1e-12)) root *= 2.0;
  while (CountRoots(length, root, t->n) > ASPECT_GOOD && root > smallest) root *= 0.5;
  CountRoots(length, root, t->n);
  for (t->depth = DEPTH_MAX; (int64_t)PetscMax(t->n[0], t->n[1]) << t->depth >= INT32_MAX;) t->depth--;
  t->ncell = t->nleaf = t->n[0] * t->n[1];
  PetscCall(Grow((size_t)t->ncell, &t->capacity, &t->cell));
  for (int c = 0; c < t->ncell; c++) {
    t->cell[c] = (Cell){.x = (c % t->n[0]) << t->depth, .y = (c / t->n[0]) << t->depth};
  }
  PetscFunctionReturn(0);
}

static int Width(const Tree *t, int level)
{
  return 1 << (t->depth - level);
}

static double Coordinate(const Tree *t, int d, int position)
{
  const double s = ldexp((double)position, -t->depth) / t->n[d];
  return (1.0 - s) * t->lower[d] + s * t->upper[d];
}

static PetscErrorCode Split(Tree *t, int c)
{
  PetscFunctionBeginUser;
  PetscCheck(t->cell[c].level + 1 < t->depth, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
             "mesh size near (%g, %g) asks for more than %d halvings of a cell",
             Coordinate(t, 0, t->cell[c].x), Coordinate(t, 1, t->cell[c].y), t->depth - 1);
  PetscCall(Grow((size_t)t->ncell + 4, &t->capacity, &t->cell));
  const Cell parent = t->cell[c];
  const int half = Width(t, parent.level + 1);
  t->cell[c].child = t->ncell;
  for (int k = 0; k < 4; k++) {
    t->cell[t->ncell++] =
        (Cell){.x = parent.x + (k & 1) * half, .y = parent.y + (k >> 1) * half, .level = parent.level + 1};
  }
  t->nleaf += 3;
  PetscFunctionReturn(0);
}

/* Splits every cell that is wider than the sizes in it; children come behind and are visited in turn. */
static PetscErrorCode Refine(Tree *t)
{
  PetscFunctionBeginUser;
  for (int c = 0; c < t->ncell; c++) {
    const Cell *cell = &t->cell[c];
    double edge[2], wanted;
    const double lower[2] = {Coordinate(t, 0, cell->x), Coordinate(t, 1, cell->y)};
    for (int d = 0; d < 2; d++) edge[d] = ldexp((t->upper[d] - t->lower[d]) / t->n[d], -cell->level);
    PetscCall(Wanted(t, lower, edge, &wanted));
    if (PetscMax(edge[0], edge[1]) > wanted * (1.0 + 1e-9)) PetscCall(Split(t, c));
  }
  PetscFunctionReturn(0);
}

/* The leaf that holds a position, -1 outside. */
static int Leaf(const Tree *t, int x, int y)
{
  const int i = x >> t->depth, j = y >> t->depth;
  if (x < 0 || y < 0 || i >= t->n[0] || j >= t->n[1]) return -1;
  int c = i + j * t->n[0];
  for (int shift = t->depth - 1; t->cell[c].child; shift--) {
    c = t->cell[c].child + (x >> shift & 1) + 2 * (y >> shift & 1);
  }
  return c;
}

/* The leaf at the place of the equally large cell in direction (i, j). */
static int Beside(const Tree *t, int c, int i, int j)
{
  const int width = Width(t, t->cell[c].level);
  return Leaf(t, t->cell[c].x + i * width, t->cell[c].y + j * width);
}

/* Cells that touch, also in a corner only, differ by one level at most. */
static PetscErrorCode Balance(Tree *t)
{
  PetscFunctionBeginUser;
  for (PetscBool changed = PETSC_TRUE; changed;) {
    changed = PETSC_FALSE;
    for (int c = 0; c < t->ncell; c++) {
      if (t->cell[c].child) continue;
      for (int k = 0; k < 9; k++) {
        int beside = Beside(t, c, k % 3 - 1, k / 3 - 1);
        while (beside >= 0 && t->cell[beside].level < t->cell[c].level - 1) {
          PetscCall(Split(t, beside));
          beside = Beside(t, c, k % 3 - 1, k / 3 - 1);
          changed = PETSC_TRUE;
        }
      }
    }
  }
  PetscFunctionReturn(0);
}

static int AddVertex(const Tree *t, MeshSerial *m, int x, int y)
{
  m->x[2 * m->nv] = Coordinate(t, 0, x);
  m->x[2 * m->nv + 1] = Coordinate(t, 1, y);
  return m->nv++;
}

static int VertexAt(const Tree *t, Cutting *cut, int x, int y)
{
  int *v = MeshTableAt(&cut->vertex, x, y);
  if (*v < 0) *v = AddVertex(t, cut->mesh, x, y);
  return *v;
}

static void AddTriangle(MeshSerial *m, int a, int b, int c)
{
  int *v = &m->vertex[3 * m->ne++];
  v[0] = a;
  v[1] = b;
  v[2] = c;
}

static void AddFacet(MeshSerial *m, int a, int b, int tag)
{
  m->facet[2 * m->nb] = a;
  m->facet[2 * m->nb + 1] = b;
  m->facet_tag[m->nb++] = tag;
}

static void CutLeaf(const Tree *t, Cutting *cut, int c)
{
  static const int DIRECTION[4][2] = {
      {0, -1}, {1, 0}, {0, 1}, {-1, 0}}; /* across side k: from corner k to k + 1 */
  static const int TAG[4] = {BOTTOM, RIGHT, TOP, LEFT};
  const Cell *cell = &t->cell[c];
  const int w = Width(t, cell->level), half = w / 2, ring_x[4] = {0, w, w, 0}, ring_y[4] = {0, 0, w, w};
  int corner[4], middle[4], hanging = 0;
  for (int k = 0; k < 4; k++) corner[k] = VertexAt(t, cut, cell->x + ring_x[k], cell->y + ring_y[k]);
  for (int k = 0; k < 4; k++) {
    const int beside = Beside(t, c, DIRECTION[k][0], DIRECTION[k][1]), next = (k + 1) % 4;
    middle[k] = -1;
    if (beside < 0) AddFacet(cut->mesh, corner[k], corner[next], TAG[k]);
    if (beside < 0 || t->cell[beside].level <= cell->level) continue;
    middle[k] =
        VertexAt(t, cut, cell->x + (ring_x[k] + ring_x[next]) / 2, cell->y + (ring_y[k] + ring_y[next]) / 2);
    hanging++;
  }
  if (!hanging) {
    const int first = (cell->x / w + cell->y / w) & 1; /* where the diagonal starts */
    AddTriangle(cut->mesh, corner[first], corner[first + 1], corner[first + 2]);
    AddTriangle(cut->mesh, corner[first], corner[first + 2], corner[(first + 3) % 4]);
    return;
  }
  const int centre = AddVertex(t, cut->mesh, cell->x + half, cell->y + half);
  for (int k = 0; k < 4; k++) {
    const int next = corner[(k + 1) % 4];
    if (middle[k] >= 0) AddTriangle(cut->mesh, corner[k], middle[k], centre);
    AddTriangle(cut->mesh, middle[k] >= 0 ? middle[k] : corner[k], next, centre);
  }
}

/* Counts are bounded by what every leaf can add: 4 corners and a centre, 8 triangles, 4 boundary edges. */
static PetscErrorCode Cut(const Tree *t, MeshSerial *m)
{
  const size_t n = (size_t)t->nleaf;
  Cutting cut = {.mesh = m};
  PetscFunctionBeginUser;
  PetscCall(MeshTableCreate(&cut.vertex, 4 * n));
  PetscCall(PetscMalloc1(2 * 5 * n, &m->x));
  PetscCall(PetscMalloc1(3 * 8 * n, &m->vertex));
  PetscCall(PetscMalloc1(2 * 4 * n, &m->facet));
  PetscCall(PetscMalloc1(4 * n, &m->facet_tag));
  for (int c = 0; c < t->ncell; c++) {
    if (!t->cell[c].child) CutLeaf(t, &cut, c);
  }
  PetscCall(PetscRealloc(2 * (size_t)m->nv * sizeof *m->x, &m->x));
  PetscCall(PetscRealloc(3 * (size_t)m->ne * sizeof *m->vertex, &m->vertex));
  PetscCall(PetscRealloc(2 * (size_t)m->nb * sizeof *m->facet, &m->facet));
  PetscCall(PetscRealloc((size_t)m->nb * sizeof *m->facet_tag, &m->facet_tag));
  PetscCall(MeshTableDestroy(&cut.vertex));
  m->ntags = SIDES;
  PetscCall(PetscCalloc1(SIDES, &m->tag_name));
  for (int k = 0; k < SIDES; k++) strcpy(m->tag_name[k], SIDE_NAME[k]);
  PetscFunctionReturn(0);
}

PetscErrorCode MeshBox(const double lower[2], const double upper[2], double size_max,
                       double (*size)(void *context, const double x[2]), void *context, MeshSerial *mesh)
{
  Tree t = {.lower = {lower[0], lower[1]},
            .upper = {upper[0], upper[1]},
            .size_max = size_max,
            .size = size,
            .context = context};
  PetscFunctionBeginUser;
  memset(mesh, 0, sizeof *mesh);
  PetscCall(Roots(&t));
  PetscCall(Refine(&t));
  PetscCall(Balance(&t));
  PetscCall(Cut(&t, mesh));
  PetscCall(PetscFree(t.cell));
  PetscFunctionReturn(0);
}
