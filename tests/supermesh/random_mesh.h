/* Random triangulations for the tests: a jittered n x n grid of the unit square, each cell cut along a random
 * diagonal. */
#ifndef TESTS_RANDOM_MESH_H
#define TESTS_RANDOM_MESH_H
#include "common/supermesh/geometry.h"
#include "tests/check.h"

static inline double Random(double lower, double upper)
{
  return lower + (upper - lower) * ((double)rand() / (double)RAND_MAX);
}

/* Corner (i, j) of the grid; corners on the rim stay on it. */
static inline void RandomMeshCorner(int n, unsigned seed, int i, int j, double x[2])
{
  const double h = 1.0 / n;
  srand(seed + 7919u * (unsigned)(i + (n + 1) * j));
  (void)rand();
  x[0] = h * i + (i > 0 && i < n ? Random(-0.3 * h, 0.3 * h) : 0.0);
  x[1] = h * j + (j > 0 && j < n ? Random(-0.3 * h, 0.3 * h) : 0.0);
}

/* 2 n n triangles, counter-clockwise; free with free(). */
static inline double (*RandomMesh(int n, unsigned seed))[3][2]
{
  double(*x)[3][2] = malloc(sizeof(double[3][2]) * 2 * (size_t)(n * n));
  for (int j = 0; j < n; j++) {
    for (int i = 0; i < n; i++) {
      double corner[4][2]; /* counter-clockwise from the lower left */
      RandomMeshCorner(n, seed, i, j, corner[0]);
      RandomMeshCorner(n, seed, i + 1, j, corner[1]);
      RandomMeshCorner(n, seed, i + 1, j + 1, corner[2]);
      RandomMeshCorner(n, seed, i, j + 1, corner[3]);
      const int turn = rand() & 1;
      for (int t = 0; t < 2; t++) {
        const int corners[3] = {turn + 2 * t, turn + 2 * t + 1, turn + 2 * t + 2};
        for (int v = 0; v < 3; v++)
          memcpy(x[2 * (i + n * j) + t][v], corner[corners[v] % 4], sizeof corner[0]);
      }
    }
  }
  return x;
}
#endif
