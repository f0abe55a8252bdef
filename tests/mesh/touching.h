/* Two squares that touch in a corner, which no face tells their ranks: 7 vertices, 10 edges. */
#ifndef TESTS_MESH_TOUCHING_H
#define TESTS_MESH_TOUCHING_H
#include "common/mesh/part.h"
#include "tests/check.h"
#include <string.h>

/* Collective over PETSC_COMM_WORLD: the first square on one rank, the second on the next. */
static inline Mesh *TouchingSquares(int rank, int size)
{
  static const int VERTEX[4][3] = {{0, 1, 2}, {0, 2, 3}, {2, 4, 5}, {2, 5, 6}};
  double x[] = {0, 0, 1, 0, 1, 1, 0, 1, 2, 1, 2, 2, 1, 2};
  char name[1][64] = {"side"};
  int vertex[12], facet[24], tag[12] = {0}, ne = 0;
  long long gid[7];
  Mesh *mesh;
  for (int v = 0; v < 7; v++) gid[v] = v;
  for (int k = 0; k < 4; k++) {
    if (k / 2 % size != rank) continue;
    for (int i = 0; i < 3; i++) {
      vertex[3 * ne + i] = facet[6 * ne + 2 * i] = VERTEX[k][i];
      facet[6 * ne + 2 * i + 1] = VERTEX[k][(i + 1) % 3];
    }
    ne++;
  }
  const MeshPart part = {{.nv = 7,
                          .ne = ne,
                          .nb = 3 * ne,
                          .x = x,
                          .vertex = vertex,
                          .facet = facet,
                          .facet_tag = tag,
                          .ntags = 1,
                          .tag_name = name},
                         gid};
  CHECK(!MeshBuild(PETSC_COMM_WORLD, &part, &mesh), "not built");
  return mesh;
}
#endif
