// ranks: 1 2 3
/* The first mesh is fine along an interface, also where the mesh of the case has its faces there and no element is cut. */
#include "fluid/remeshing/adaptation.h"
#include "tests/check.h"
#include "tests/fluid/box_mesh.h"

#define SIZE 0.02

/* The longest edge of the owned elements whose box has the interface y = level. */
static double LongestEdge(const Mesh *m, double level)
{
  double longest = 0.0;
  for (int e = 0; e < m->ne; e++) {
    double lower = HUGE_VAL, upper = -HUGE_VAL, edge = 0.0;
    for (int i = 0; i < 3; i++) {
      const double *a = m->x + 2 * m->vertex[3 * e + i], *b = m->x + 2 * m->vertex[3 * e + (i + 1) % 3];
      lower = fmin(lower, a[1]);
      upper = fmax(upper, a[1]);
      edge = fmax(edge, hypot(a[0] - b[0], a[1] - b[1]));
    }
    if (lower <= level && upper >= level) longest = fmax(longest, edge);
  }
  return longest;
}

static PetscErrorCode CheckLevel(double level)
{
  const Region region[] = {{.shape = REGION_BOX, .phase = 0, .a = {-10.0, -10.0}, .b = {10.0, 10.0}},
                           {.shape = REGION_BOX, .phase = 1, .a = {-10.0, -10.0}, .b = {10.0, level}}};
  const AdaptationSetup setup = {.size_min = SIZE,
                                 .corner_size = SIZE,
                                 .size_max = 0.25,
                                 .velocity_error = 1.0,
                                 .interface_size = SIZE,
                                 .growth = 1.5,
                                 .anisotropy = 5.0,
                                 .elements_max = 1e5,
                                 .every = 10};
  const AdaptationStart start = {.nphases = 2, .nregions = 2, .region = region};
  double longest;
  Mesh *start_mesh, *mesh;
  Adaptation adaptation;
  PetscFunctionBeginUser;
  PetscCall(SquareMesh(0.25, &start_mesh));
  PetscCall(AdaptationCreate(&setup, &adaptation));
  PetscCall(AdaptationFirstMesh(adaptation, start_mesh, &start, &mesh));
  longest = LongestEdge(mesh, level);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &longest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  CHECK(longest < 2.5 * SIZE, "an edge of %g m at the interface y = %g, %g was asked for", longest, level,
        SIZE);
  PetscCall(AdaptationDestroy(&adaptation));
  PetscCall(MeshDestroy(&start_mesh));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(CheckLevel(0.5));
  PetscCall(CheckLevel(0.4123));
  return PetscFinalize();
}
