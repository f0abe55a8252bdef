// ranks: 1 2 3
/* The mean velocity is that of the volume, however the solid is dealt out; of the surface when there is no
 * volume. */
#include "coupler/geometry/bulk_motion.h"
#include "tests/coupler/synthetic.h"

int main(int argc, char **argv)
{
  static SyntheticSolid all, part;
  const double lower[2] = {0.2, 0.3}, side = 0.5;
  BulkMotion motion;
  int rank, size;
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL), "PETSc");
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  SyntheticSquare(&all, lower, side, 6);
  for (int i = 0; i < all.nnodes; i++) {
    all.u[i][0] = 2.0 * all.x[i][1];
    all.u[i][1] = all.x[i][1] < lower[1] + 1e-9
                      ? 12.0
                      : 0.0; /* the lowest row: weight 1/12 of the volume, 1/4 + 1/24 of the rim */
  }
  SyntheticSolidPart(&all, rank, size, &part);
  CHECK(!BulkMotionOf(PETSC_COMM_WORLD, &part.view, &motion), "motion");
  CHECK(motion.nelements == 72 && motion.nfacets == 24, "%lld elements, %lld facets", motion.nelements,
        motion.nfacets);
  CHECK(fabs(motion.velocity[0] - 2.0 * (lower[1] + 0.5 * side)) < 1e-14, "u_x %.17g", motion.velocity[0]);
  CHECK(fabs(motion.velocity[1] - 1.0) < 1e-14, "u_y %.17g", motion.velocity[1]);
  static double mobility[sizeof part.x / sizeof *part.x];
  part.view.mobility = NULL;
  CHECK(!BulkMotionOf(PETSC_COMM_WORLD, &part.view, &motion) && !motion.held, "without inertia it is held");
  part.view.mobility = mobility;
  for (int i = 0; i < part.nnodes; i++) mobility[i] = 1.0;
  CHECK(!BulkMotionOf(PETSC_COMM_WORLD, &part.view, &motion) && !motion.held, "a free solid is held");
  for (int i = 0; i < part.nnodes; i++)
    mobility[i] = part.x[i][0] > lower[0] + 1e-9; /* the left side is fixed */
  CHECK(!BulkMotionOf(PETSC_COMM_WORLD, &part.view, &motion) && motion.held, "what is fixed is free");
  part.view.nelements = 0;
  CHECK(!BulkMotionOf(PETSC_COMM_WORLD, &part.view, &motion), "motion");
  CHECK(fabs(motion.velocity[1] - 3.5) < 1e-14, "of the surface: u_y %.17g", motion.velocity[1]);
  return PetscFinalize();
}
