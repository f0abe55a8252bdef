// ranks: 1 2 3
/* The shell of a disc and of a square, its surface dealt out to ranks: exact areas, offsets and normals. */
#include "tests/coupler/synthetic.h"

static SyntheticSolid all, part;

static double ShellArea(Shell shell)
{
  double area = 0.0;
  for (int t = 0; t < 2 * shell->nfacets; t++) {
    const double a = GeometryArea((const double(*)[2])shell->x[t]);
    CHECK(a > 0.0, "triangle %d has area %g", t, a);
    area += a;
  }
  MPI_Allreduce(MPI_IN_PLACE, &area, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return area;
}

static void Extrude(double thickness, Shell *shell)
{
  int rank, size;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  SyntheticSolidPart(&all, rank, size, &part);
  CHECK(!ShellCreate(PETSC_COMM_WORLD, thickness, shell), "create");
  CHECK(!ShellExtrude(*shell, &part.view, PETSC_TRUE), "extrude");
}

/* Every outer edge is parallel to its inner one at the distance dr. */
static void CheckParallel(Shell shell, double thickness)
{
  for (int e = 0; e < shell->nfacets; e++) {
    const double *inner = shell->x[2 * e][0], *n = shell->normal[e];
    for (int i = 1; i < 3; i++) {
      const double *outer = shell->x[2 * e][i];
      const double d = n[0] * (outer[0] - inner[0]) + n[1] * (outer[1] - inner[1]);
      CHECK(fabs(d - thickness) < 1e-14, "facet %d: outer node at distance %.17g", e, d);
    }
  }
}

static void CheckDisc(void)
{
  enum { N = 40 };
  const double centre[2] = {0.5, 0.5}, radius = 0.3, dr = 0.004;
  const double side = 2.0 * radius * sin(M_PI / N), exact = N * (side * dr + dr * dr * tan(M_PI / N));
  Shell shell;
  SyntheticDisc(&all, centre, radius, 3, N);
  Extrude(dr, &shell);
  CHECK(fabs(ShellArea(shell) - exact) < 1e-15, "area %.17g, not %.17g", ShellArea(shell), exact);
  CheckParallel(shell, dr);
  for (int i = 0; i < shell->nsurface; i++) {
    const int node = shell->surface[i];
    const double *x = part.x[node], *d = shell->offset[node], length = dr / cos(M_PI / N);
    for (int c = 0; c < 2; c++) {
      CHECK(fabs(d[c] - length * (x[c] - centre[c]) / radius) < 1e-14, "offset of node %d is not radial",
            node);
    }
  }
  CHECK(!ShellDestroy(&shell), "destroy");
}

static void CheckSquare(void)
{
  const double lower[2] = {0.3, 0.4}, side = 0.2, dr = 0.001;
  Shell shell;
  SyntheticSquare(&all, lower, side, 5);
  Extrude(dr, &shell);
  const double exact = (side + 2 * dr) * (side + 2 * dr) - side * side;
  CHECK(fabs(ShellArea(shell) - exact) < 1e-15, "area %.17g, not %.17g", ShellArea(shell), exact);
  CheckParallel(shell, dr);
  CHECK(!ShellDestroy(&shell), "destroy");
}

/* A needle: the offset of its tip is cut at the limit and everything stays finite; a knife has none at its
 * tips. */
static void CheckSharp(void)
{
  const double dr = 0.001, tip[3][2] = {{0.5, 0.5}, {0.9, 0.48}, {0.9, 0.52}};
  Shell shell;
  int rank;
  memset(&all, 0, sizeof all);
  memcpy(all.x, tip, sizeof tip);
  all.nnodes = 3;
  for (int i = 0; i < 3; i++) all.gid[i] = i;
  for (int i = 0; i < 3; i++) SyntheticFacet(&all, i, (i + 1) % 3);
  SyntheticSolidView(&all);
  Extrude(dr, &shell);
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  for (int i = 0; i < shell->nsurface; i++) {
    const double *d = shell->offset[shell->surface[i]], length = hypot(d[0], d[1]);
    CHECK(length >= dr && length <= SHELL_OFFSET_LIMIT * dr * (1 + 1e-14), "offset of length %g", length);
    if (part.gid[shell->surface[i]] == 0) CHECK(fabs(d[0] + 2 * dr) < 1e-15 && fabs(d[1]) < 1e-15, "tip");
  }
  CHECK(!ShellDestroy(&shell), "destroy");
  all.nfacets = 0;
  SyntheticFacet(&all, 0, 1);
  SyntheticFacet(&all, 1, 0);
  Extrude(dr, &shell);
  for (int i = 0; i < shell->nsurface; i++) {
    const double *d = shell->offset[shell->surface[i]];
    CHECK(hypot(d[0], d[1]) == 0.0, "knife edge");
  }
  CHECK(!ShellDestroy(&shell), "destroy");
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL), "PETSc");
  CheckDisc();
  CheckSquare();
  CheckSharp();
  return PetscFinalize();
}
