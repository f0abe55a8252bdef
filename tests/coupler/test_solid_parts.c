// ranks: 1 2 3
/* Connected parts of a solid whose nodes have any numbers, as those of outside solids: a square of two triangles, on two ranks where there
 * are, and a triangle apart, whose numbers are equal in double precision; each node knows its part's area. */
#include "coupler/geometry/solid_parts.h"
#include "tests/check.h"

enum { SQUARE = 4, NODES = 7, TRIANGLES = 3 };
static const int CORNER[TRIANGLES][3] = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
static const double PLACE[NODES][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {5, 0}, {9, 0}, {5, 1}};

int main(int argc, char **argv)
{
  int rank, size, element[3 * TRIANGLES], node[NODES];
  long long gid[NODES];
  double x[2 * NODES], area[NODES];
  SolidState solid = {.gid = gid, .x = x, .element = element};
  Copies nodes, parts;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  for (int e = 0; e < TRIANGLES; e++) {
    if (e % size != rank) continue;
    for (int i = 0; i < 3; i++) {
      int k = 0;
      while (k < solid.nnodes && node[k] != CORNER[e][i]) k++;
      element[3 * solid.nelements + i] = k;
      if (k < solid.nnodes) continue;
      node[k] = CORNER[e][i];
      gid[k] = (1LL << 60) + node[k];
      x[2 * k] = PLACE[node[k]][0], x[2 * k + 1] = PLACE[node[k]][1];
      solid.nnodes++;
    }
    solid.nelements++;
  }
  PetscCall(CopiesCreateByNumber(PETSC_COMM_WORLD, solid.nnodes, gid, &nodes));
  PetscCall(SolidPartsCreate(PETSC_COMM_WORLD, &solid, nodes, &parts));
  PetscCall(SolidPartsAreas(&solid, parts, area));
  for (int k = 0; k < solid.nnodes; k++) {
    const double expected = node[k] < SQUARE ? 1.0 : 2.0;
    CHECK(fabs(area[k] - expected) < 1e-14, "node %d is of a part of %g m2, expected %g", node[k], area[k],
          expected);
  }
  PetscCall(CopiesDestroy(&parts));
  PetscCall(CopiesDestroy(&nodes));
  return PetscFinalize();
}
