/* Which rank gets what: many bodies whole, a body that is larger than a share cut, few that do not balance cut; all with
 * shares of equal work, and bodies that are dealt out by where they are. */
#include "solid/ranks/partition.h"
#include "tests/handlers.h"
#include "tests/solid/build.h"

/* Cuts the model; the bodies that are cut, and the largest share over the mean. */
static PetscErrorCode Partition(const Model *a, int parts, int part[], int *cut, double *largest)
{
  double load[8] = {0.0}, all = 0.0;
  PartitionGraph g;
  int *work;
  PetscFunctionBeginUser;
  PetscCall(PartitionGraphCreate(a, &g));
  PetscCall(PartitionGraphNear(&g, a));
  for (int e = 0; e < a->nelements; e++) all += g.work[e];
  PetscCall(PetscMalloc1((size_t)a->nelements, &work));
  PetscCall(PetscArraycpy(work, g.work, (size_t)a->nelements));
  PetscCall(PartitionGraphCut(&g, a, parts, part));
  *cut = 0;
  for (int b = 0; b < a->nbodies; b++) {
    int first = -1, is_cut = 0;
    for (int e = 0; e < a->nelements; e++) {
      if (a->element_body[e] != b) continue;
      if (first < 0) first = part[e];
      is_cut |= part[e] != first;
    }
    *cut += is_cut;
  }
  for (int e = 0; e < a->nelements; e++) load[part[e]] += work[e];
  *largest = 0.0;
  for (int p = 0; p < parts; p++) *largest = fmax(*largest, load[p] * parts / all);
  PetscCall(PetscFree(work));
  PetscFunctionReturn(0);
}

/* nx x ny discs of diameter 0.01; a beam under them of that height, 0: none. */
static PetscErrorCode Bodies(int nx, int ny, double pitch, double beam, int parts, int expected_cut,
                             double most)
{
  const BodySetup setup = BodyAtRest(MaterialOf(2500.0, 1e6, 0.3, 0.2));
  Model a = {0};
  double largest;
  int *part, cut;
  PetscFunctionBeginUser;
  for (int k = 0; k < nx * ny; k++) AddDisc(&a, pitch * (k % nx), pitch * (k / nx), 0.005, 0.0027, &setup);
  if (beam > 0.0)
    AddRectangle(&a, 0.5 * nx * pitch, -0.01 - 0.5 * beam, nx * pitch, beam, 0.0, 0.0027, 0, &setup);
  PetscCall(PetscMalloc1((size_t)a.nelements, &part));
  PetscCall(Partition(&a, parts, part, &cut, &largest));
  CHECK(cut == expected_cut, "%d discs, beam %g, %d parts: %d bodies are cut", nx * ny, beam, parts, cut);
  CHECK(largest < 1.0 + most, "%d discs, beam %g, %d parts: the largest share is %g of the mean", nx * ny,
        beam, parts, largest);
  PetscCall(PetscFree(part));
  PetscCall(ModelDestroy(&a));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  HandlersSet();
  for (int parts = 1; parts <= 5; parts++) {
    PetscCall(Bodies(12, 12, 0.0105, 0.0, parts, 0, WHOLE_EXCESS)); /* packed */
    PetscCall(Bodies(12, 12, 0.03, 0.0, parts, 0, WHOLE_EXCESS));   /* apart */
  }
  PetscCall(Bodies(12, 12, 0.015, 0.1, 3, 1, WHOLE_EXCESS)); /* a beam of more than a share */
  PetscCall(Bodies(2, 2, 0.0105, 0.0, 4, 0, WHOLE_EXCESS));  /* a disc each */
  PetscCall(Bodies(3, 1, 0.0105, 0.0, 2, 1, WHOLE_EXCESS));  /* whole they would be two and one */
  PetscCall(Bodies(1, 1, 0.0105, 0.0, 3, 1, 0.5));
  HandlersCheck();
  return PetscFinalize();
}
