/* Private to the mesh room: the cells of the box mesher.  Root cells, halved where the size asks for it, balanced so that
 * cells that touch, also in a corner only, differ by one level at most.  Not collective. */
#ifndef CORACLE_MESH_QUADTREE_H
#define CORACLE_MESH_QUADTREE_H
#include <petscsys.h>

typedef struct {
  int x, y;  /* lower left corner; a root cell is 1 << depth wide */
  int level; /* 0: root */
  int child; /* the first of four: x + 2 y; 0: a leaf */
} QuadtreeCell;

typedef struct {
  double lower[2], upper[2], size_max;
  double (*size)(void *context, const double x[2]);
  void *context;
  int n[2];  /* root cells in x and y: cells 0 .. n[0] n[1] - 1 of the tree */
  int depth; /* the deepest level that coordinates can express */
  int ncell, nleaf;
  size_t capacity;
  QuadtreeCell *cell;
} Quadtree;

/* Cells, from the bounds and the size; t->cell is to be PetscFree'd. */
PetscErrorCode QuadtreeBuild(Quadtree *t);
/* Width of a cell of that level, in positions; m, of a position. */
int QuadtreeWidth(const Quadtree *t, int level);
double QuadtreeCoordinate(const Quadtree *t, int d, int position);
/* The leaf at the place of the equally large cell in direction (i, j); -1 outside. */
int QuadtreeBeside(const Quadtree *t, int cell, int i, int j);
#endif
