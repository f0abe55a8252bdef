/* Pairs of overlapping boxes of two sets, in time linear in boxes and pairs: boxes of the first set are
 * entered in the square cells that they touch, those of the second look into theirs (NBS, Munjiza and Andrews
 * 1998, with hashed cells instead of lists of columns).  Cells are as large as the first set's boxes on
 * average; those that are much larger have a grid of their own, with larger cells, and so on.
 *
 *     +---+---+---+     a pair that shares several cells is reported in one of them only: the one
 *     |   |a a|a  |     with the lower left corner of the boxes' common part
 *     +---+---+---+
 *     |   |a*b|b  |     Serial, no MPI. */
#ifndef SOLID_CELL_GRID_H
#define SOLID_CELL_GRID_H
#include "common/supermesh/geometry.h"
#include <petscsys.h>

typedef PetscErrorCode (*CellGridFunction)(void *context, int a, int b);

/* Calls found(context, i, j) for every a[i] and b[j] that overlap or touch; in an order that depends on
 * nothing but the boxes. */
PetscErrorCode CellGridPairs(int na, const GeometryBox a[], int nb, const GeometryBox b[],
                             CellGridFunction found, void *context);
#endif
