// ranks: 1 2 3
/* The boxes hold the solid with its margin, are the same on all ranks, and are renewed when a node has left
 * its margin; a node outside of the fluid is found by its smallest global id.  Those of many bodies do not hold what is between them. */
#include "coupler/region.h"
#include "tests/coupler/synthetic.h"

static SyntheticSolid all, part;

static void CheckBoxes(Region region)
{
  double other[REGION_BOXES][2][2];
  int n = region->nbox;
  CHECK(n > 0 && n <= REGION_BOXES, "%d boxes", n);
  memcpy(other, region->box, sizeof other);
  CHECK(!MPI_Bcast(&n, 1, MPI_INT, 0, PETSC_COMM_WORLD), "bcast");
  CHECK(!MPI_Bcast(other, 4 * n, MPI_DOUBLE, 0, PETSC_COMM_WORLD), "bcast");
  CHECK(n == region->nbox && !memcmp(other, region->box, sizeof(double[2][2]) * (size_t)n), "boxes differ");
  for (int t = 0; t < all.nelements; t++) {
    int inside = 0;
    for (int b = 0; b < n && !inside; b++) {
      inside = 1;
      for (int i = 0; i < 3; i++) {
        for (int c = 0; c < 2; c++) {
          const double x = all.x[all.element[t][i]][c];
          inside &= x - region->margin >= other[b][0][c] && x + region->margin <= other[b][1][c];
        }
      }
    }
    CHECK(inside, "element %d and its margin are in no box", t);
  }
}

/* A square of side x side triangles, one a unit, whose boxes are `size` wide and high. */
static void SetTriangles(int side, double size)
{
  all.nnodes = all.nfacets = all.nelements = 0;
  for (int b = 0; b < side * side; b++) {
    const int first = all.nnodes;
    for (int i = 0; i < 3; i++, all.nnodes++) {
      all.gid[all.nnodes] = all.nnodes;
      all.x[all.nnodes][0] = b % side + (i == 1 ? size : 0.0);
      all.x[all.nnodes][1] = b / side + (i == 2 ? size : 0.0);
      SyntheticFacet(&all, first + i, first + (i + 1) % 3);
    }
    SyntheticElement(&all, first, first + 1, first + 2);
  }
  SyntheticSolidView(&all);
}

static void CheckManyBodies(Region region, int rank, int size)
{
  enum { SIDE = 30 };
  double area = 0.0;
  SetTriangles(SIDE, 0.2);
  SyntheticSolidPart(&all, rank, size, &part);
  CHECK(!RegionUpdate(region, &part.view, 0.0), "update");
  CheckBoxes(region);
  for (int b = 0; b < region->nbox; b++)
    area += (region->box[b][1][0] - region->box[b][0][0]) * (region->box[b][1][1] - region->box[b][0][1]);
  CHECK(area < 0.25 * SIDE * SIDE, "boxes of %g in %d", area, SIDE * SIDE);
}

/* Before a step of dt. */
static PetscBool Stale(Region region, double dt)
{
  PetscBool stale;
  CHECK(!RegionStale(region, &part.view, dt, &stale), "stale");
  return stale;
}

int main(int argc, char **argv)
{
  const double centre[2] = {0.5, 0.6}, dr = 0.001;
  const FluidElements tank = {0, NULL, NULL, NULL, NULL, NULL, {0.0, 0.0}, {1.0, 1.0}},
                      low = {0, NULL, NULL, NULL, NULL, NULL, {0.0, 0.0}, {1.0, 0.75}};
  Region region;
  long long gid;
  int rank, size, local, found;
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL), "PETSc");
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  SyntheticDisc(&all, centre, 0.2, 8, 60);
  SyntheticSolidPart(&all, rank, size, &part);
  part.view.changed = 0;
  CHECK(!RegionCreate(PETSC_COMM_WORLD, dr, &region), "create");
  CHECK(!RegionUpdate(region, &part.view, 0.0), "update");
  CHECK(region->margin == 8.0 * dr, "at rest: margin %g", region->margin);
  for (int i = 0; i < part.nnodes; i++) part.u[i][0] = part.nnodes > 0 && rank == 0 ? 1.0 : 0.0;
  CHECK(!RegionUpdate(region, &part.view, 1e-3), "update");
  CHECK(fabs(region->margin - 1e-3 * REGION_STEPS) < 1e-15, "slow: margin %g", region->margin);
  CHECK(!RegionUpdate(region, &part.view, 0.05), "update");
  CheckBoxes(region);
  CHECK(region->margin > 0.2 * 0.3 && region->margin < 0.2 * 0.6, "margin %g", region->margin);
  CHECK(!Stale(region, 0.0), "nothing has moved");
  CHECK(!Stale(region, 1.9 * region->margin), "the middle of the step is within the margin");
  CHECK(Stale(region, 2.1 * region->margin), "the middle of the step is beyond the margin");
  if (part.nnodes) part.x[part.nnodes - 1][1] -= 0.99 * region->margin;
  CHECK(!Stale(region, 0.0), "still within the margin");
  if (part.nnodes && rank == 0) part.x[part.nnodes - 1][1] -= 0.02 * region->margin;
  CHECK(Stale(region, 0.0), "a node has left its margin");
  SyntheticSolidPart(&all, rank, size, &part);
  CHECK(!RegionOutside(region, &part.view, &tank, 0.0, &gid, &local) && gid == -1 && local == -1, "inside");
  CHECK(!RegionOutside(region, &part.view, &low, 10.0, &gid, &local) && gid == -1 && local == -1,
        "within the margin");
  CHECK(!RegionOutside(region, &part.view, &low, 0.0, &gid, &local), "outside");
  found = local >= 0;
  MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
  CHECK(found == 1, "%d ranks report", found);
  if (local >= 0) CHECK(part.gid[local] == gid && part.x[local][1] > 0.75, "node %lld", gid);
  for (int i = 0; i < all.nnodes; i++)
    CHECK(all.x[i][1] <= 0.75 || all.gid[i] >= gid, "%lld is smaller", all.gid[i]);
  CheckManyBodies(region, rank, size);
  CHECK(!RegionDestroy(&region), "destroy");
  return PetscFinalize();
}
