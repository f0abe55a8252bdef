/* The Brazilian test: a disc pressed between two jaws splits along the diameter between them when the tension
 * across it, 2 P/(pi D) per metre of depth (Hertz), reaches the tensile strength.  Jaws without friction, as
 * round as the disc, hold arcs of 7.5 degrees and close slowly; joints are everywhere, also at the jaws,
 * where the pressure is 24 times the strength: what lets the rock bear it is that its shear strength grows
 * with pressure (Mohr and Coulomb).
 *
 *     bench_brazilian [rings ...]
 *
 * prints a table, first two discs whose shear strength does not grow, and fails if the finest disc's strength
 * is off by more than 5 %, if its load curve up to the first peak differs from the last but one's by more
 * than 3 % of the peak, or if the disc does not split. */
#include "solid/solid_impl.h"
#include "tests/solid/crack.h"

#define RADIUS 0.025 /* m */
#define TENSILE 5e6  /* Pa */
#define SPEED 0.02   /* of each jaw, m/s */
#define RAMP 3e-4    /* s, within which they come to it */
#define JAW (3.75 * M_PI / 180.0)
#define SHEAR 3.5    /* cohesion over the tensile strength, as that of rock */
#define FRICTION 0.7 /* internal */
enum { SAMPLES = 180 };

typedef struct {
  double load[SAMPLES];       /* N/m, at closings of the jaws that are the same for all */
  double peak, least, length; /* least: after the peak */
} Curve;

/* A disc of that many rings, whose facets within JAW of the x axis lie on a jaw. */
static PetscErrorCode DiscWithJaws(int rings, MeshSerial *m)
{
  static const char *const NAMES[] = {"left", "right"};
  const double centre[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  PetscCall(ShapeDisc(centre, RADIUS, M_PI * RADIUS / (3.0 * rings) * (1.0 + 1e-9), m));
  m->ntags = 3;
  PetscCall(PetscRealloc(3 * sizeof *m->tag_name, &m->tag_name));
  for (int k = 0; k < 2; k++)
    PetscCall(PetscStrncpy(m->tag_name[1 + k], NAMES[k], sizeof m->tag_name[1 + k]));
  for (int k = 0; k < m->nb; k++) {
    const double *p = m->x + 2 * m->facet[2 * k], *q = m->x + 2 * m->facet[2 * k + 1];
    const double angle = atan(fabs((p[1] + q[1]) / (p[0] + q[0])));
    m->facet_tag[k] = angle > JAW ? 0 : p[0] < 0.0 ? 1 : 2;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode MakeDisc(int rings, double friction, Model *a)
{
  static const double ROW[2][6] = {{0.0, 0.0, 0.0, RAMP, SPEED, 0.0}, {0.0, 0.0, 0.0, RAMP, -SPEED, 0.0}};
  const BoundaryMotion prescribed[] = {{"left", {.prescribed = {1, 0}, .nrows = 2, .row = ROW[0]}},
                                       {"right", {.prescribed = {1, 0}, .nrows = 2, .row = ROW[1]}}};
  BodySetup setup = BodyAtRest(RockOf(TENSILE, SHEAR * TENSILE, 4.0, 0.3));
  MeshSerial mesh;
  PetscFunctionBeginUser;
  setup.material.internal_friction = friction;
  setup.joints.all = 1;
  setup.nprescribed = 2;
  setup.prescribed = prescribed;
  PetscCall(DiscWithJaws(rings, &mesh));
  AddMesh(a, &mesh, &setup);
  PetscFunctionReturn(0);
}

/* What the right jaw presses with. */
static PetscErrorCode Load(Solid s, double *load)
{
  const SolidView v = ViewOf(s, NULL, NULL);
  const double *force;
  PetscCall(SolidForces(s, &force));
  *load = 0.0;
  for (int n = 0; n < v.nnodes; n++)
    if (s->is_prescribed[n] && v.rest[2 * n] > 0.0) *load += force[2 * n];
  return 0;
}

static PetscErrorCode Press(int rings, double friction, Curve *curve)
{
  const SolidSetup options = {.courant = 0.8};
  Model a = {0};
  FractureState f;
  Solid s;
  PetscFunctionBeginUser;
  PetscCall(MakeDisc(rings, friction, &a));
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  *curve = (Curve){.peak = 0.0};
  for (int k = 0; k < SAMPLES; k++) {
    PetscCall(Run(s, 1e-5, 1e-5));
    PetscCall(Load(s, &curve->load[k]));
    curve->least = curve->load[k] > curve->peak ? curve->load[k] : fmin(curve->least, curve->load[k]);
    curve->peak = fmax(curve->peak, curve->load[k]);
    if (getenv("VERBOSE")) {
      PetscCall(SolidFracture(s, &f));
      printf("%g %g %d %d %g\n", SolidGetStats(s)->t, curve->load[k] / (M_PI * RADIUS * TENSILE), f.active,
             f.broken, f.energy);
    }
  }
  PetscCall(SolidFracture(s, &f));
  curve->length = f.length;
  PetscCall(ModelDestroy(&a));
  PetscCall(SolidDestroy(&s));
  PetscFunctionReturn(0);
}

/* Largest difference of two load curves until one of them has its peak, over the peak. */
static double Difference(const Curve *a, const Curve *b)
{
  double largest = 0.0;
  for (int k = 0; k < SAMPLES && a->load[k] < a->peak && b->load[k] < b->peak; k++)
    largest = fmax(largest, fabs(a->load[k] - b->load[k]));
  return largest / a->peak;
}

static double Strength(const Curve *c)
{
  return c->peak / (M_PI * RADIUS * TENSILE);
}

static void Row(int rings, double friction, const Curve *c, double difference)
{
  printf("%5d  %8d  %8g  %11.4g  %13.4f  %10.2f  %10.3f  %g\n", rings, 6 * rings * rings, friction, c->peak,
         Strength(c), c->length / (2.0 * RADIUS), c->least / c->peak, difference);
  (void)fflush(stdout);
}

int main(int argc, char **argv)
{
  const int standard[] = {16, 32, 48};
  const int n = argc > 1 ? argc - 1 : 3;
  Curve last = {.peak = 0.0}, curve;
  double difference = NAN;
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  printf("rings  elements  friction  P_max [N/m]  2P/(pi D f_t)  broken [D]  least/P_max  curve differs\n");
  for (int k = 0; k < 2 && argc == 1; k++) {
    PetscCall(Press(standard[k], 0.0, &curve));
    Row(standard[k], 0.0, &curve, NAN);
  }
  for (int k = 0; k < n; k++, last = curve) {
    const int rings = argc > 1 ? atoi(argv[k + 1]) : standard[k];
    PetscCall(Press(rings, FRICTION, &curve));
    if (k) difference = Difference(&curve, &last);
    Row(rings, FRICTION, &curve, difference);
  }
  CHECK(fabs(Strength(&curve) - 1.0) < 0.05, "strength off by %g", Strength(&curve) - 1.0);
  CHECK(difference < 0.03, "load curves differ by %g", difference);
  CHECK(curve.length > 1.6 * RADIUS && curve.least < 0.75 * curve.peak, "%g m broken, load falls to %g N/m",
        curve.length, curve.least);
  return PetscFinalize();
}
