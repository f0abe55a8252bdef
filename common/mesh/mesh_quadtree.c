#include "common/mesh/mesh_quadtree.h"

#define DEPTH_MAX 24     /* halvings of a root cell */
#define ASPECT_GOOD 1.25 /* stretching of root cells beyond which smaller ones are tried */
#define EVEN_FROM 8      /* from this count on an even number of root cells makes the mesh mirror-symmetric */

static PetscErrorCode Grow(size_t needed, size_t *capacity, QuadtreeCell **cell)
{
  PetscFunctionBeginUser;
  if (needed > *capacity) {
    *capacity = 2 * needed;
    PetscCall(PetscRealloc(*capacity * sizeof **cell, cell));
  }
  PetscFunctionReturn(0);
}

/* The smallest of size_max and the sizes at 3 x 3 points of a rectangle. */
static PetscErrorCode Wanted(const Quadtree *t, const double lower[2], const double edge[2], double *wanted)
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
static PetscErrorCode SmallestIn(const Quadtree *t, const double lower[2], const double edge[2],
                                 double *smallest)
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

static PetscErrorCode Smallest(const Quadtree *t, double *smallest)
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
static PetscErrorCode Roots(Quadtree *t)
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
    t->cell[c] = (QuadtreeCell){.x = (c % t->n[0]) << t->depth, .y = (c / t->n[0]) << t->depth};
  }
  PetscFunctionReturn(0);
}

int QuadtreeWidth(const Quadtree *t, int level)
{
  return 1 << (t->depth - level);
}

double QuadtreeCoordinate(const Quadtree *t, int d, int position)
{
  const double s = ldexp((double)position, -t->depth) / t->n[d];
  return (1.0 - s) * t->lower[d] + s * t->upper[d];
}

static PetscErrorCode Split(Quadtree *t, int c)
{
  PetscFunctionBeginUser;
  PetscCheck(t->cell[c].level + 1 < t->depth, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
             "mesh size near (%g, %g) asks for more than %d halvings of a cell",
             QuadtreeCoordinate(t, 0, t->cell[c].x), QuadtreeCoordinate(t, 1, t->cell[c].y), t->depth - 1);
  PetscCall(Grow((size_t)t->ncell + 4, &t->capacity, &t->cell));
  const QuadtreeCell parent = t->cell[c];
  const int half = QuadtreeWidth(t, parent.level + 1);
  t->cell[c].child = t->ncell;
  for (int k = 0; k < 4; k++) {
    t->cell[t->ncell++] = (QuadtreeCell){
        .x = parent.x + (k & 1) * half, .y = parent.y + (k >> 1) * half, .level = parent.level + 1};
  }
  t->nleaf += 3;
  PetscFunctionReturn(0);
}

/* Splits every cell that is wider than the sizes in it; children come behind and are visited in turn. */
static PetscErrorCode Refine(Quadtree *t)
{
  PetscFunctionBeginUser;
  for (int c = 0; c < t->ncell; c++) {
    const QuadtreeCell *cell = &t->cell[c];
    double edge[2], wanted;
    const double lower[2] = {QuadtreeCoordinate(t, 0, cell->x), QuadtreeCoordinate(t, 1, cell->y)};
    for (int d = 0; d < 2; d++) edge[d] = ldexp((t->upper[d] - t->lower[d]) / t->n[d], -cell->level);
    PetscCall(Wanted(t, lower, edge, &wanted));
    if (PetscMax(edge[0], edge[1]) > wanted * (1.0 + 1e-9)) PetscCall(Split(t, c));
  }
  PetscFunctionReturn(0);
}

/* The leaf that holds a position, -1 outside. */
static int Leaf(const Quadtree *t, int x, int y)
{
  const int i = x >> t->depth, j = y >> t->depth;
  if (x < 0 || y < 0 || i >= t->n[0] || j >= t->n[1]) return -1;
  int c = i + j * t->n[0];
  for (int shift = t->depth - 1; t->cell[c].child; shift--) {
    c = t->cell[c].child + (x >> shift & 1) + 2 * (y >> shift & 1);
  }
  return c;
}

int QuadtreeBeside(const Quadtree *t, int c, int i, int j)
{
  const int width = QuadtreeWidth(t, t->cell[c].level);
  return Leaf(t, t->cell[c].x + i * width, t->cell[c].y + j * width);
}

/* Cells that touch, also in a corner only, differ by one level at most. */
static PetscErrorCode Balance(Quadtree *t)
{
  PetscFunctionBeginUser;
  for (PetscBool changed = PETSC_TRUE; changed;) {
    changed = PETSC_FALSE;
    for (int c = 0; c < t->ncell; c++) {
      if (t->cell[c].child) continue;
      for (int k = 0; k < 9; k++) {
        int beside = QuadtreeBeside(t, c, k % 3 - 1, k / 3 - 1);
        while (beside >= 0 && t->cell[beside].level < t->cell[c].level - 1) {
          PetscCall(Split(t, beside));
          beside = QuadtreeBeside(t, c, k % 3 - 1, k / 3 - 1);
          changed = PETSC_TRUE;
        }
      }
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode QuadtreeBuild(Quadtree *t)
{
  PetscFunctionBeginUser;
  PetscCall(Roots(t));
  PetscCall(Refine(t));
  PetscCall(Balance(t));
  PetscFunctionReturn(0);
}
