/* A ring given stretched keeps its wall: whatever the law, what it bears across the wall is of order h/R of
 * what it bears along it, its middle line encloses pi R^2 s_x s_y, and when it is let go it moves as a hoop
 * (without Poisson's effect and with the corotated law as a line membrane) and does not ring through its
 * thickness, as one does that is stretched affinely. */
#include "tests/solid/build.h"

static const double RADIUS = 0.5, E = 1e4, DENSITY = 1000.0, STRETCH[2] = {1.5, 1.0}, CENTRE[2] = {3.0, -2.0};
enum { LAYERS = 4 };

typedef enum { STRAIN, STRESS, BIOT_STRAIN, BIOT_STRESS, NLAWS } Law;

static PetscErrorCode Build(Law law, double poisson, double wall, int affine, MeshSerial *mesh, Model *a,
                            Solid *s)
{
  const SolidSetup options = {.courant = 0.8};
  BodySetup setup = BodyAtRest(MaterialOf(DENSITY, E, poisson, 0.0));
  const char *why = NULL;
  setup.material.plane_stress = law % 2;
  setup.material.law = law >= BIOT_STRAIN;
  for (int c = 0; c < 2; c++) setup.stretch[c] = STRETCH[c];
  PetscCall(ShapeRing(CENTRE, RADIUS - 0.5 * wall, RADIUS + 0.5 * wall, LAYERS, wall / LAYERS, mesh));
  double *x = malloc(2 * (size_t)mesh->nv * sizeof *x);
  ShapeRingStretched(CENTRE, STRETCH, MaterialLaw(&setup.material), mesh, x);
  setup.position = affine ? NULL : x;
  CHECK(!ModelAdd(a, mesh, &setup, &why), "%s", why);
  free(x);
  PetscCall(SolidCreate(PETSC_COMM_SELF, a, &options, s));
  return 0;
}

static Point RestCentred(const SolidView *v, int n)
{
  return (Point){v->rest[2 * n] - CENTRE[0], v->rest[2 * n + 1] - CENTRE[1]};
}

/* Largest stress through the wall over the largest along it. */
static double Across(Solid s)
{
  const SolidView v = ViewOf(s, NULL, NULL);
  double *stress = malloc(3 * (size_t)v.nelements * sizeof *stress), thickness_stretch = 0.0, along = 0.0;
  SolidStress(s, stress);
  for (int e = 0; e < v.nelements; e++) {
    Point r = {0.0, 0.0};
    for (int i = 0; i < 3; i++) {
      const Point p = RestCentred(&v, v.element[3 * e + i]);
      r = (Point){r.x + p.x, r.y + p.y};
    }
    const double nx = STRETCH[1] * r.x / hypot(STRETCH[1] * r.x, STRETCH[0] * r.y);
    const double ny = STRETCH[0] * r.y / hypot(STRETCH[1] * r.x, STRETCH[0] * r.y), *t = stress + 3 * e;
    thickness_stretch = fmax(thickness_stretch, fabs(t[0] * nx * nx + 2.0 * t[2] * nx * ny + t[1] * ny * ny));
    along = fmax(along, fabs(t[0] * ny * ny - 2.0 * t[2] * nx * ny + t[1] * nx * nx));
  }
  free(stress);
  return thickness_stretch / along;
}

/* Within the nodes that lie in the wall's middle at rest; the mesh has them row by row. */
static double AreaWithin(const MeshSerial *m, const Model *a)
{
  const int sides = m->nb / 2;
  Point *line = calloc((size_t)sides, sizeof *line);
  double area = 0.0;
  for (int n = 0; n < a->nnodes; n++)
    for (int i = 0; i < sides; i++) {
      const double *middle = m->x + 2 * (LAYERS / 2 * sides + i);
      if (a->rest[2 * n] == middle[0] && a->rest[2 * n + 1] == middle[1])
        line[i] = (Point){a->x[2 * n] - CENTRE[0], a->x[2 * n + 1] - CENTRE[1]};
    }
  for (int i = 0; i < sides; i++) area += 0.5 * PointCross(line[i], line[(i + 1) % sides]);
  free(line);
  return area;
}

/* Kinetic energy of the columns' (the nodes of one angle) mean motion, and of motion within them. */
static void Energies(Solid s, int sides, double *hoop, double *within)
{
  typedef double Sums[3];
  const SolidView v = ViewOf(s, NULL, NULL);
  Sums *sum = calloc((size_t)sides, sizeof *sum);
  double *mass = calloc((size_t)v.nnodes, sizeof *mass);
  *hoop = *within = 0.0;
  for (int e = 0; e < v.nelements; e++) {
    const int *n = v.element + 3 * e;
    const Tensor d = TensorOfEdges(PointAt(v.rest, n[0]), PointAt(v.rest, n[1]), PointAt(v.rest, n[2]));
    for (int i = 0; i < 3; i++) mass[n[i]] += DENSITY * TensorDeterminant(d) / 6.0;
  }
  for (int n = 0; n < v.nnodes; n++) {
    const Point r = RestCentred(&v, n);
    double *k = sum[(int)lround(sides * (atan2(r.y, r.x) / (2.0 * M_PI) + 1.0)) % sides];
    k[0] += mass[n];
    for (int c = 0; c < 2; c++) k[1 + c] += mass[n] * v.v[2 * n + c];
    *within += 0.5 * mass[n] * (v.v[2 * n] * v.v[2 * n] + v.v[2 * n + 1] * v.v[2 * n + 1]);
  }
  for (int i = 0; i < sides; i++) *hoop += 0.5 * (sum[i][1] * sum[i][1] + sum[i][2] * sum[i][2]) / sum[i][0];
  *within -= *hoop;
  free(sum);
  free(mass);
}

/* Of a line membrane T = E h (l - 1) let go from this ellipse, at the small time t: t^2/2 int
 * |dT/dtheta|^2/(rho h R) dtheta, T = E h (l - 1) m'/|m'|; differences of the force between neighbours. */
static double Membrane(double wall, double t)
{
  enum { SIDES = 2000 };
  const double step = 2.0 * M_PI / SIDES;
  Point before = {0.0, 0.0};
  double sum = 0.0;
  for (int k = 0; k <= SIDES; k++) {
    const double x = -STRETCH[0] * sin((k + 0.5) * step), y = STRETCH[1] * cos((k + 0.5) * step),
                 l = hypot(x, y);
    const Point now = {E * wall * (l - 1.0) * x / l, E * wall * (l - 1.0) * y / l};
    const Point d = PointMinus(now, before);
    if (k > 0) sum += (d.x * d.x + d.y * d.y) / step;
    before = now;
  }
  return 0.5 * t * t * sum / (DENSITY * wall * RADIUS);
}

/* Let go for half a period of the vibration through the wall (when an affine one's is largest a little before
 * and after), and then for a whole one. */
static PetscErrorCode LetGo(Solid s, int sides, double period, double hoop[2], double within[2])
{
  PetscCall(Run(s, 0.5 * period, 0.5 * period));
  Energies(s, sides, &hoop[0], &within[0]);
  PetscCall(Run(s, 0.5 * period, 0.5 * period));
  Energies(s, sides, &hoop[1], &within[1]);
  return 0;
}

static PetscErrorCode Ring(Law law, double poisson, double thickness, int affine)
{
  const double wall = thickness * RADIUS;
  MeshSerial mesh;
  Model a = {0};
  Solid s;
  double hoop[2], within[2];
  PetscCall(Build(law, poisson, wall, affine, &mesh, &a, &s));
  const int sides = mesh.nb / 2;
  const double thickness_stretch = Across(s), area = AreaWithin(&mesh, &a) / (M_PI * RADIUS * RADIUS * 1.5);
  const ElementLaw l = MaterialLaw(&a.material[0]);
  const double period = 2.0 * wall / sqrt((l.lambda + 2.0 * l.mu) / DENSITY);
  PetscCall(LetGo(s, sides, period, hoop, within));
  const double membrane = Membrane(wall, 0.5 * period);
  if (getenv("VERBOSE"))
    printf("law %d, nu %.1f, h/R %.3f%s: across %.3f h/R; within the wall %.4f, later %.4f of the hoop's "
           "energy, which "
           "grows by %.2f and is %.4f of a membrane's\n",
           law, poisson, thickness, affine ? ", affine" : "", thickness_stretch / thickness,
           within[0] / hoop[0], within[1] / hoop[1], hoop[1] / hoop[0], hoop[0] / membrane);
  CHECK(fabs(area - 1.0) < 1e-13, "area off by %g", area - 1.0);
  if (affine) {
    CHECK(thickness_stretch > 0.5 && within[1] > 5.0 * hoop[1], "an affine ring does not ring: %g %g",
          thickness_stretch, within[1] / hoop[1]);
  } else {
    /* bending changes the stretch along by up to h/4R at the faces, (kappa - 1/R) h/2 at the ellipse's ends
     */
    CHECK(thickness_stretch < 0.5 * thickness, "%g h/R of the stress along the wall acts across",
          thickness_stretch / thickness);
    CHECK(within[0] < 0.06 * hoop[0] && within[1] < 0.02 * hoop[1],
          "within the wall %g and %g of the hoop's energy", within[0] / hoop[0], within[1] / hoop[1]);
    CHECK(fabs(hoop[1] / (4.0 * hoop[0]) - 1.0) < 0.06, "the hoop's energy grows by %g", hoop[1] / hoop[0]);
    /* the linear law pulled along the wall: E (l - 1) in plane stress, E/(1 - nu^2) (l - 1) in plane strain
     */
    const double stiffness = law == BIOT_STRAIN ? 1.0 / (1.0 - poisson * poisson) : 1.0;
    CHECK(law < BIOT_STRAIN || fabs(hoop[0] / (membrane * stiffness * stiffness) - 1.0) < 0.01,
          "%g of a membrane's energy", hoop[0] / membrane);
  }
  PetscCall(MeshSerialDestroy(&mesh));
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (Law law = STRAIN; law < NLAWS; law++) {
    PetscCall(Ring(law, 0.3, 0.1, 0));
    PetscCall(Ring(law, 0.3, 0.05, 0));
  }
  PetscCall(Ring(STRAIN, 0.3, 0.05, 1));
  PetscCall(Ring(BIOT_STRAIN, 0.0, 0.05, 0));
  PetscCall(Ring(BIOT_STRAIN, 0.0, 0.025, 0));
  return PetscFinalize();
}
