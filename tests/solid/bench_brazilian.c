/* The Brazilian test: a disc pressed between two jaws splits along the diameter between them when the tension
 * across it, 2 P/(pi D) per metre of depth (Hertz), reaches the tensile strength.  Jaws hold arcs of 7.5
 * degrees and close slowly; joints everywhere but close to the jaws, whose edges would cut into
 * the disc at a load that falls with the mesh, and strong in shear for the same reason.
 *
 *     bench_brazilian [rings ...]      prints a table and fails if the finest disc's strength is off by more
 * than 5 %, if its load curve up to the first peak differs from the last but one's by more than 3 % of the
 * peak, or if the disc does not split */
#include "crack.h"

#define RADIUS 0.025 /* m */
#define TENSILE 5e6  /* Pa */
#define SPEED 0.02   /* of each jaw, m/s */
enum { SAMPLES = 135 };

typedef struct {
  double load[SAMPLES];       /* N/m, at closings of the jaws that are the same for all */
  double peak, least, length; /* least: after the peak */
} Curve;

/* A disc of that many rings, whose facets within 3.75 degrees of the x axis are called jaws. */
static PetscErrorCode DiscWithJaws(int rings, MeshSerial *m)
{
  const double centre[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  PetscCall(ShapeDisc(centre, RADIUS, M_PI * RADIUS / (3.0 * rings) * (1.0 + 1e-9), m));
  m->ntags = 2;
  PetscCall(PetscRealloc(2 * sizeof *m->tag_name, &m->tag_name));
  PetscCall(PetscStrncpy(m->tag_name[1], "jaws", sizeof m->tag_name[1]));
  for (int k = 0; k < m->nb; k++) {
    const double *p = m->x + 2 * m->facet[2 * k], *q = m->x + 2 * m->facet[2 * k + 1];
    const double angle = atan(fabs((p[1] + q[1]) / (p[0] + q[0])));
    m->facet_tag[k] = angle < 3.75 * M_PI / 180.0;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Press(int rings, Curve *curve)
{
  static const char *const JAWS[] = {"jaws"};
  const SolidSetup options = {.courant = 0.8};
  const double box[1][4] = {{-0.85 * RADIUS, -RADIUS, 0.85 * RADIUS, RADIUS}};
  BodySetup setup = BodyAtRest(RockOf(TENSILE, 10.0 * TENSILE, 4.0, 0.3));
  MeshSerial mesh;
  Assembly a = {0};
  FractureState f;
  Solid s;
  PetscFunctionBeginUser;
  setup.joints = (JointSetup){.nboxes = 1, .box = box};
  setup.nfixed = 1;
  setup.fixed_name = JAWS;
  PetscCall(DiscWithJaws(rings, &mesh));
  AddMesh(&a, &mesh, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  Draw(s, &a, 0, 0.0, -SPEED);
  *curve = (Curve){.peak = 0.0};
  for (int k = 0; k < SAMPLES; k++) {
    PetscCall(Run(s, 1e-5, 1e-5));
    PetscCall(Held(s, 0, SPEED, &curve->load[k]));
    curve->least = curve->load[k] > curve->peak ? curve->load[k] : fmin(curve->least, curve->load[k]);
    curve->peak = fmax(curve->peak, curve->load[k]);
    if (getenv("VERBOSE")) {
      PetscCall(SolidFracture(s, &f));
      printf("%g %g %d %d %g\n", 2 * SPEED * SolidGetStats(s)->t, curve->load[k], f.live, f.broken, f.energy);
    }
  }
  PetscCall(SolidFracture(s, &f));
  curve->length = f.length;
  PetscCall(AssemblyDestroy(&a));
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

int main(int argc, char **argv)
{
  const int standard[] = {16, 32, 48};
  const int n = argc > 1 ? argc - 1 : 3;
  Curve last = {.peak = 0.0}, curve;
  double error = 1.0, difference = 1.0;
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  printf(
      "rings  elements  P_max [N/m]  2P/(pi D f_t)  broken [D]  least/P_max  curve differs from the last\n");
  for (int k = 0; k < n; k++, last = curve) {
    const int rings = argc > 1 ? atoi(argv[k + 1]) : standard[k];
    PetscCall(Press(rings, &curve));
    error = curve.peak / (M_PI * RADIUS * TENSILE) - 1.0;
    difference = k ? Difference(&curve, &last) : 1.0;
    printf("%5d  %8d  %11.4g  %13.4f  %10.2f  %10.3f  %g\n", rings, 6 * rings * rings, curve.peak,
           1.0 + error, curve.length / (2.0 * RADIUS), curve.least / curve.peak, k ? difference : NAN);
  }
  CHECK(fabs(error) < 0.05, "strength off by %g", error);
  CHECK(difference < 0.03, "load curves differ by %g", difference);
  CHECK(curve.length > 1.6 * RADIUS && curve.least < 0.75 * curve.peak, "%g m broken, load falls to %g N/m",
        curve.length, curve.least);
  return PetscFinalize();
}
