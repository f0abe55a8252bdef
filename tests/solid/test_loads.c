// ranks: 1 2 3
/* Loads on boundaries.  A block under two pressures has their stress, at any size, turned, in plane stress and with six-node triangles;
 * a thick-walled cylinder under internal pressure widens as Lame's does, of second order; a traction that grows makes its impulse and
 * its work; the halves of a bar that is pulled apart go on to be pulled, their new faces are free.  Elements may change ranks meanwhile.
 * VERBOSE: prints. */
#include "tests/solid/crack.h"

enum { MOST = 4 }; /* loads of a body */

/* A load that does not depend on time; row: room for its rows. */
static NamedLoad Constant(const char *boundary, double pressure, double row[2])
{
  row[0] = 0.0;
  row[1] = pressure;
  return (NamedLoad){boundary, {.pressure = {1, 2, row}, .traction = {.width = 3}}};
}

static int Printing(void)
{
  PetscMPIInt rank;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  return rank == 0 && getenv("VERBOSE");
}

/* The largest difference of an element's principal stresses from -low and -high, over high. */
static PetscErrorCode StressError(Solid s, double low, double high, double *error)
{
  const SolidView v = ViewOf(s, NULL, NULL);
  double *stress = malloc(3 * ((size_t)v.nelements + 1) * sizeof *stress);
  SolidStress(s, stress);
  *error = 0.0;
  for (int e = 0; e < v.nelements; e++) {
    const double *t = stress + 3 * e, mean = 0.5 * (t[0] + t[1]), radius = hypot(0.5 * (t[0] - t[1]), t[2]);
    *error = fmax(*error, fmax(fabs(mean + radius + low), fabs(mean - radius + high)) / high);
  }
  free(stress);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, error, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  return 0;
}

static PetscErrorCode Biaxial(int six_node, int plane_stress, double low, double high)
{
  const SolidSetup setup = {.courant = 0.8, .rebalance = 200.0, .decay_rate = 6000.0};
  static const char *const SIDES[MOST] = {"left", "right", "bottom", "top"};
  BodySetup body = BodyAtRest(MaterialOf(1000.0, 1e9, 0.25, 0.2));
  NamedLoad load[MOST];
  double row[MOST][2], error;
  Model a = {0};
  Solid s;
  body.six_node = six_node;
  body.material.plane_stress = plane_stress;
  body.material.thickness = plane_stress ? 0.02 : 1.0;
  for (int k = 0; k < MOST; k++) load[k] = Constant(SIDES[k], k < 2 ? low : high, row[k]);
  body.nloads = MOST;
  body.load = load;
  AddRectangle(&a, 0.3, 0.2, 1.2, 0.8, 0.4, 0.2, 1, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  PetscCall(ModelDestroy(&a));
  PetscCall(Run(s, 0.03, 1e-3));
  PetscCall(StressError(s, low, high, &error));
  if (Printing())
    printf("biaxial, order %d, %s: error %.1e\n", 1 + six_node,
           plane_stress ? "plane stress" : "plane strain", error);
  /* a load is that of the thickness at rest, a stress of that now */
  CHECK(error < (plane_stress ? 1e-3 : 1e-7), "biaxial pressure: stresses differ by %g of it", error);
  PetscCall(SolidDestroy(&s));
  return 0;
}

#define INNER 1.0
#define OUTER 2.0

/* *error: of the mean radial displacement of the inner side, over Lame's. */
static PetscErrorCode Cylinder(int six_node, int layers, double *error)
{
  const double young = 1e9, nu = 0.25, pressure = 1e4, centre[2] = {0.0, 0.0};
  const double exact = (1.0 + nu) / young * pressure * INNER * INNER / (OUTER * OUTER - INNER * INNER) *
                       ((1.0 - 2.0 * nu) * INNER + OUTER * OUTER / INNER);
  const SolidSetup setup = {.courant = 0.8, .rebalance = 200.0, .decay_rate = 1200.0};
  BodySetup body = BodyAtRest(MaterialOf(1000.0, young, nu, 0.2));
  double row[2], sum[2] = {0.0, 0.0};
  const NamedLoad load = Constant("inner", pressure, row);
  MeshSerial mesh;
  Model a = {0};
  Solid s;
  body.six_node = six_node;
  body.nloads = 1;
  body.load = &load;
  (void)ShapeRing(centre, INNER, OUTER, layers, (OUTER - INNER) / layers * 2.0, &mesh);
  AddMesh(&a, &mesh, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  PetscCall(ModelDestroy(&a));
  PetscCall(Run(s, 0.04, 2e-3));
  const SolidView v = ViewOf(s, NULL, NULL);
  for (int k = 0; k < 2 * v.nfacets; k++) {
    const int n = v.facet[k];
    const double r = hypot(v.rest[2 * n], v.rest[2 * n + 1]);
    if (r > 0.5 * (INNER + OUTER)) continue;
    sum[0] += hypot(v.x[2 * n], v.x[2 * n + 1]) - r;
    sum[1] += 1.0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  *error = sum[0] / sum[1] / exact - 1.0;
  if (Printing()) printf("cylinder, order %d, %d layers: error %+.5f\n", 1 + six_node, layers, *error);
  PetscCall(SolidDestroy(&s));
  return 0;
}

/* A traction along x that grows from 0 in RISE, on the left side of a free block: momentum t^2 L T/(2 RISE), and energy its work. */
static PetscErrorCode Traction(void)
{
  const double rise = 0.02, height = 0.5, most = 2e4, rows[6] = {0.0, 0.0, 0.0, rise, most, 0.0};
  const SolidSetup setup = {.courant = 0.8, .rebalance = 200.0};
  const NamedLoad load = {"left", {.pressure = {.width = 2}, .traction = {2, 3, rows}}};
  BodySetup body = BodyAtRest(MaterialOf(1000.0, 1e8, 0.3, 0.0));
  double work = 0.0, energy = 0.0;
  Model a = {0};
  SolidBudget b = {0};
  Solid s;
  body.nloads = 1;
  body.load = &load;
  AddRectangle(&a, 0.0, 0.0, 1.0, height, 0.0, 0.1, 1, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  PetscCall(ModelDestroy(&a));
  for (int k = 1; k <= 20; k++) {
    PetscCall(Run(s, rise / 20, 1.0));
    PetscCall(SolidGetBudget(s, &b));
    work += b.reaction_work;
    for (int c = 0; c < 2; c++)
      CHECK(fabs(b.momentum[c] - b.start[c] - b.reaction[c]) < 1e-12 * most * height * rise,
            "momentum %g, impulse %g", b.momentum[c] - b.start[c], b.reaction[c]);
  }
  PetscCall(TotalEnergy(s, 1, &energy));
  const double momentum = 0.5 * rise * most * height;
  if (Printing())
    printf("traction: momentum %+.1e, energy %+.1e of the work\n", b.momentum[0] / momentum - 1.0,
           energy / work - 1.0);
  CHECK(fabs(b.momentum[0] / momentum - 1.0) < 0.01 && fabs(b.momentum[1]) < 1e-9 * momentum,
        "momentum (%g, %g), expected (%g, 0)", b.momentum[0], b.momentum[1], momentum);
  /* a substep has the load of its start, a part of 1/400 of this one less than in its middle */
  CHECK(fabs(energy / work - 1.0) < 5e-3, "energy %g, work %g", energy, work);
  PetscCall(SolidDestroy(&s));
  return 0;
}

/* Momentum along x of what begins right of the middle, by elements. */
static PetscErrorCode RightHalf(Solid s, double density, double *momentum)
{
  const SolidView v = ViewOf(s, NULL, NULL);
  *momentum = 0.0;
  for (int e = 0; e < v.nelements; e++) {
    const int *n = v.element + 3 * e;
    const double *p = v.rest + 2 * n[0], *q = v.rest + 2 * n[1], *r = v.rest + 2 * n[2];
    const double area = 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
    if (p[0] + q[0] + r[0] > 0.0)
      for (int i = 0; i < 3; i++) *momentum += density * area / 3.0 * v.v[2 * n[i]];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, momentum, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  return 0;
}

/* A bar that a negative pressure of twice its strength pulls apart in the middle. */
static PetscErrorCode Halves(int scatter)
{
  const double strength = 1e6, height = 0.02, box[1][4] = {{-0.011, -1.0, 0.011, 1.0}}, dt = 2e-5;
  const SolidSetup setup = {.courant = 0.8, .rebalance = 200.0};
  BodySetup body = BodyAtRest(RockOf(strength, 4.0 * strength, 5.0, 0.1));
  double row[2][2], before, after;
  NamedLoad load[2] = {Constant("left", -2.0 * strength, row[0]), Constant("right", -2.0 * strength, row[1])};
  Model a = {0};
  FractureState f;
  Solid s;
  body.nloads = 2;
  body.load = load;
  body.joints = (JointSetup){.nboxes = 1, .box = box};
  AddRectangle(&a, 0.0, 0.0, 0.1, height, 0.0, 0.01, 0, &body);
  const int nelements = a.nelements;
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  PetscCall(ModelDestroy(&a));
  for (int k = 0; k < 30; k++) {
    PetscCall(Run(s, dt, dt));
    PetscMPIInt size;
    MPI_Comm_size(PETSC_COMM_WORLD, &size);
    if (scatter && size > 1 && k % 10 == 5) {
      int *part = malloc((size_t)nelements * sizeof *part);
      for (int e = 0; e < nelements; e++) part[e] = (e / 3 + k) % size;
      PetscCall(SolidRedistribute(s, part));
      free(part);
    }
  }
  PetscCall(SolidFracture(s, &f));
  CHECK(f.pieces > 1, "%d piece", f.pieces);
  PetscCall(RightHalf(s, body.material.density, &before));
  PetscCall(Run(s, 10.0 * dt, dt));
  PetscCall(RightHalf(s, body.material.density, &after));
  const double expected = 2.0 * strength * height * 10.0 * dt;
  if (Printing())
    printf("halves: %d pieces, momentum %+.1e of expected\n", f.pieces, (after - before) / expected - 1.0);
  CHECK(fabs((after - before) / expected - 1.0) < 0.02, "the right half gains %g N s/m, expected %g",
        after - before, expected);
  PetscCall(SolidDestroy(&s));
  return 0;
}

int main(int argc, char **argv)
{
  double coarse, fine, six;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Biaxial(0, 0, 1e8, 2e8));
  PetscCall(Biaxial(1, 0, 1e8, 2e8));
  PetscCall(Biaxial(0, 1, 1e5, 2e5));
  PetscCall(Cylinder(0, 4, &coarse));
  PetscCall(Cylinder(0, 8, &fine));
  PetscCall(Cylinder(1, 4, &six));
  CHECK(fabs(fine) < 0.01 && fabs(fine) < fabs(coarse) / 3.0, "cylinder: errors %g, %g with half of the size",
        coarse, fine);
  CHECK(fabs(six) < 0.01, "cylinder of six-node triangles: error %g", six);
  PetscCall(Traction());
  PetscCall(Halves(0));
  PetscCall(Halves(1));
  return PetscFinalize();
}
