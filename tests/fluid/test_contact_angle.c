// ranks: 1 2
/* A drop on a floor that starts as a half disc comes to rest at the height and the width of the circular cap of its volume and
 * contact angle, 60 and 120 degrees.  contact_angle n angle time: prints. */
#include "tests/fluid/drop.h"

#define START 0.25 /* radius of the half disc, m */

typedef struct {
  double height, width; /* m */
} Extent;

/* Of the cap with the area of the half disc: radius r, area r^2 (angle - sin angle cos angle). */
static Extent Cap(double angle)
{
  const double r = START * sqrt(0.5 * M_PI / (angle - sin(angle) * cos(angle)));
  return (Extent){r * (1.0 - cos(angle)), 2.0 * r * (angle > 0.5 * M_PI ? 1.0 : sin(angle))};
}

/* The highest point of the first phase, and its extent from left to right. */
static Extent Measure(const Drop *d)
{
  double top[3] = {0.0, -1.0, -1.0}; /* y, x, -x */
  for (int e = 0; e < d->mesh->ne; e++) {
    Polygon part;
    (void)PhasesGetPolygon(DropPhases(d), e, 0, &part);
    for (int k = 0; k < part.n && PolygonArea(&part) > 1e-3 * ElementArea(d->mesh, e); k++) {
      top[0] = fmax(top[0], part.x[k][1]);
      top[1] = fmax(top[1], part.x[k][0]);
      top[2] = fmax(top[2], -part.x[k][0]);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, top, 3, MPI_DOUBLE, MPI_MAX, d->mesh->comm);
  return (Extent){top[0], top[1] + top[2]};
}

/* At `end`, s, height and width are those of the cap to this share of them. */
static PetscErrorCode Spread(int n, double degrees, double end, double tolerance, int print)
{
  const double angle = degrees * M_PI / 180.0;
  const DropSetup setup = {.n = n,
                           .seed = 7u,
                           .ratio = 10.0,
                           .viscosity = {0.1, 0.05},
                           .tension = 1.0,
                           .cosine = {0.0, 0.0, cos(angle), 0.0},
                           .wall = BOUNDARY_FREE_SLIP};
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_DISC, .phase = 0, .a = {0.503, 0.0}, .radius = START}};
  const Extent cap = Cap(angle);
  Extent now = {0.0, 0.0};
  double t = 0.0;
  Drop d;
  PetscFunctionBeginUser;
  PetscCall(DropCreate(&setup, 2, region, &d));
  for (int k = 1; t < end; k++) {
    PetscCall(FluidStep(d.fluid, d.dt));
    t += d.dt;
    now = Measure(&d);
    if (print && k % 50 == 0)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                            "t %.3f: height %.4f of %.4f, width %.4f of %.4f, largest |u| %.2e m/s\n", t,
                            now.height, cap.height, now.width, cap.width, DropSpeed(&d)));
  }
  CHECK(fabs(now.height / cap.height - 1.0) < tolerance && fabs(now.width / cap.width - 1.0) < tolerance,
        "%g degrees: height %g of %g, width %g of %g", degrees, now.height, cap.height, now.width, cap.width);
  PetscCall(DropDestroy(&d));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (argc > 3) {
    PetscCall(Spread(atoi(argv[1]), atof(argv[2]), atof(argv[3]), 0.02, 1));
  } else {
    PetscCall(Spread(16, 60.0, 1.0, 0.02, 0));
    PetscCall(Spread(16, 120.0, 1.0, 0.02, 0));
  }
  return PetscFinalize();
}
