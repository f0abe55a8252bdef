/* Large deflection of a cantilever with a dead load P at its end, plane stress, against Bisshopp and Drucker
 * (Quart. Appl. Math. 3, 1945): P L^2/(E I) = 2 gives a deflection of 0.4935 L and a shortening of 0.1606 L.
 * test_deflection [cells through the height]: 6 cells within 5 % (linear triangles are stiff in bending, by
 * O(h^2)), from 12 on within 1 %; the shortening, of second order in the deflection, within 2.5 times that.
 */
#include "tests/solid/build.h"

static const double LENGTH = 1.0, HEIGHT = 0.05, YOUNG = 1.0e6, ALPHA = 2.0;

int main(int argc, char **argv)
{
  static const char *const LEFT[] = {"left"};
  const int cells = argc > 1 ? atoi(argv[1]) : 6;
  const SolidSetup options = {.courant = 0.9};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, YOUNG, 0.3, 0.0));
  const double inertia = HEIGHT * HEIGHT * HEIGHT / 12.0, total = ALPHA * YOUNG * inertia / (LENGTH * LENGTH);
  const double dt = 0.06; /* a hundredth of the first period */
  Model a = {0};
  BodyState b;
  Solid s;
  double *velocity, tip[2] = {0.0, 0.0};
  int nloaded = 0, ntip = 0;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  setup.material.plane_stress = 1;
  setup.nfixed = 1;
  setup.fixed_name = LEFT;
  AddRectangle(&a, 0.5 * LENGTH, 0.0, LENGTH, HEIGHT, 0.0, HEIGHT / cells, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  SolidView v = ViewOf(s, NULL, &velocity);
  double *load = calloc(2 * (size_t)v.nnodes, sizeof *load);
  for (int n = 0; n < v.nnodes; n++) nloaded += v.rest[2 * n] > LENGTH - 1e-9;
  for (int n = 0; n < v.nnodes; n++)
    if (v.rest[2 * n] > LENGTH - 1e-9) load[2 * n + 1] = -total / nloaded;
  for (int k = 0; k < 250; k++) { /* damped critically for the first mode */
    PetscCall(RunStep(s, dt, load));
    for (int n = 0; n < 2 * v.nnodes; n++) velocity[n] *= 0.88;
    PetscCall(SolidBodies(s, 1, &b));
    if (k > 100 && b.kinetic < 1e-9 * b.strain) break;
  }
  for (int n = 0; n < v.nnodes; n++) {
    if (fabs(v.rest[2 * n] - LENGTH) > 1e-9) continue;
    for (int c = 0; c < 2; c++) tip[c] += v.x[2 * n + c];
    ntip++;
  }
  const double down = -tip[1] / ntip / LENGTH, shorter = 1.0 - tip[0] / ntip / LENGTH;
  if (getenv("VERBOSE"))
    printf("%d cells: deflection %.5f (0.49346), shortening %.5f (0.16064), %lld substeps\n", cells, down,
           shorter, SolidGetStats(s)->total);
  const double bound = cells >= 12 ? 0.01 : 0.05;
  CHECK(fabs(down / 0.49346 - 1.0) < bound, "deflection %g, Bisshopp and Drucker 0.49346", down);
  CHECK(fabs(shorter / 0.16064 - 1.0) < 2.5 * bound, "shortening %g, Bisshopp and Drucker 0.16064", shorter);
  free(load);
  PetscCall(ModelDestroy(&a));
  PetscCall(SolidDestroy(&s));
  return PetscFinalize();
}
