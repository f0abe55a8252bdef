/* A polygon of straight sides, its corners in either sense; side k runs from corner k to the next one.  Plain C, no MPI. */
#ifndef CORACLE_OUTLINE_H
#define CORACLE_OUTLINE_H

/* m2; negative where the corners turn clockwise. */
double OutlineArea(int n, const double x[][2]);
/* Whether sides i and j, which are not neighbours, have a point in common: 1 and the first such pair, or 0. */
int OutlineMeets(int n, const double x[][2], int *i, int *j);
/* Ear clipping (Meisters 1975): triangle[n - 2][3], corners counter-clockwise.  Returns the number of triangles; less than n - 2 where the
 * polygon crosses itself, turns back on itself or has no area, or without memory. */
int OutlineTriangles(int n, const double x[][2], int triangle[][3]);
#endif
