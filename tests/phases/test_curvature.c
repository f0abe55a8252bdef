// ranks: 1 2 3
/* Curvature at the vertices of cut elements, on random meshes: that of a line is 0 to round-off, that of a circle converges, also
 * where it meets a wall at a contact angle; that of an ellipse converges.  Any argument: prints. */
#include "fluid/phases/phases_impl.h"
#include "tests/phases/flows.h"
#include "tests/phases/set.h"

enum { CORNERS = 400 };

/* A circle (b = a) or an ellipse of half axes a, b. */
typedef struct {
  double centre[2], a, b;
  PhasesPairs cosine[8]; /* of the contact angle at all boundaries */
} Shape;

/* Curvature in the point of the ellipse that is next to x, by Newton's method from the angle that x has on stretched axes. */
static double Exact(const Shape *s, const double x[2])
{
  const double y[2] = {x[0] - s->centre[0], x[1] - s->centre[1]}, excess = s->a * s->a - s->b * s->b;
  double t = atan2(y[1] / s->b, y[0] / s->a);
  for (int k = 0; k < 20; k++) { /* the derivative of the square of the distance, over 2 */
    const double sine = sin(t), cosine = cos(t);
    t -= (s->a * y[0] * sine - s->b * y[1] * cosine - excess * sine * cosine) /
         (s->a * y[0] * cosine + s->b * y[1] * sine - excess * (cosine * cosine - sine * sine));
  }
  const double p = s->a * sin(t), q = s->b * cos(t);
  return s->a * s->b / pow(p * p + q * q, 1.5);
}

/* The largest and the root mean square error, of the mean curvature. */
static PetscErrorCode Errors(const Shape *shape, int n, unsigned seed, double *worst, double *rms)
{
  const Shaken shaken = {.n = n, .seed = seed, .radius = 1.0};
  double x[CORNERS][2], sum[2] = {0.0, 0.0};
  Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}}};
  Set s;
  Mesh *mesh;
  PetscFunctionBeginUser;
  for (int i = 0; i < CORNERS; i++) {
    x[i][0] = shape->centre[0] + shape->a * cos(2.0 * M_PI * i / CORNERS);
    x[i][1] = shape->centre[1] + shape->b * sin(2.0 * M_PI * i / CORNERS);
  }
  region[1] = (Region){.shape = REGION_POLYGON, .phase = 0, .n = CORNERS, .x = (const double(*)[2])x};
  if (shape->a == shape->b)
    region[1] = (Region){
        .shape = REGION_DISC, .phase = 0, .a = {shape->centre[0], shape->centre[1]}, .radius = shape->a};
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(SetMake(mesh, 2, &s));
  PetscCall(PhasesFill(s.phases, 2, region));
  PetscCall(PhasesReconstruct(s.phases));
  *worst = 0.0;
  for (int e = 0; e < s.stars->ne; e++)
    for (int i = 0; i < 3 && PhasesSingle(s.phases, e) < 0; i++) {
      double kappa;
      CHECK(PhasesCurvature(s.phases, 0, s.stars->vertex[e][i], shape->cosine, &kappa), "no curvature");
      const double error = (kappa - Exact(shape, s.stars->element[e].x[i])) * sqrt(shape->a * shape->b);
      *worst = fmax(*worst, fabs(error));
      sum[0] += error * error;
      sum[1] += 1.0;
    }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, worst, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  *rms = sqrt(sum[0] / sum[1]);
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

/* The errors on meshes of n and 2 n cells, of three seeds, stay below bounds of the finer one, and shrink by `rate`. */
static PetscErrorCode Converges(const char *what, const Shape *shape, int n, double bound, double rate,
                                int print)
{
  double worst[2] = {0.0, 0.0}, rms[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  for (int k = 0; k < 2; k++)
    for (unsigned seed = 1; seed <= 3; seed++) {
      double w, r;
      PetscCall(Errors(shape, n << k, seed, &w, &r));
      worst[k] = fmax(worst[k], w);
      rms[k] = fmax(rms[k], r);
    }
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: worst %.2e and %.2e, rms %.2e and %.2e\n", what, worst[0],
                          worst[1], rms[0], rms[1]));
  CHECK(rms[1] < bound && rms[0] > rate * rms[1], "%s: rms errors %g and %g", what, rms[0], rms[1]);
  PetscFunctionReturn(0);
}

static PetscErrorCode Straight(void)
{
  const Shaken shaken = {.n = 16, .seed = 2, .radius = 1.0};
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.51, 0.47}, .b = {0.4, 0.7}}};
  const double normal[2] = {0.4 / hypot(0.4, 0.7), 0.7 / hypot(0.4, 0.7)};
  PhasesPairs cosine[8];
  double kappa;
  Set s;
  Mesh *mesh;
  PetscFunctionBeginUser;
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  for (int b = 0; b < mesh->ntags; b++) { /* the angle at which the line meets this wall */
    const int axis = b < 2 ? 0 : 1;
    cosine[b].value[0][1] = (b % 2 ? -1.0 : 1.0) * normal[axis];
  }
  PetscCall(SetMake(mesh, 2, &s));
  PetscCall(PhasesFill(s.phases, 2, region));
  PetscCall(PhasesReconstruct(s.phases));
  for (int e = 0; e < s.stars->ne; e++)
    for (int i = 0; i < 3 && PhasesSingle(s.phases, e) < 0; i++) {
      CHECK(PhasesCurvature(s.phases, 0, s.stars->vertex[e][i], cosine, &kappa), "no curvature");
      CHECK(fabs(kappa) < 1e-6, "a straight interface has the curvature %g", kappa);
    }
  PetscCall(SetDestroy(&s));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const double angle = M_PI / 3.0;
  const Shape circle = {.centre = {0.51, 0.507}, .a = 0.3, .b = 0.3},
              ellipse = {.centre = {0.51, 0.507}, .a = 0.3, .b = 0.2};
  Shape cap = {.centre = {0.503, -0.4 * cos(angle)}, .a = 0.4, .b = 0.4};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int b = 0; b < 8; b++) cap.cosine[b].value[0][1] = cos(angle);
  PetscCall(Straight());
  PetscCall(Converges("circle", &circle, 16, 2e-4, 6.0, argc > 1));
  PetscCall(Converges("cap, 60 degrees", &cap, 16, 4e-3, 3.0, argc > 1));
  PetscCall(Converges("ellipse", &ellipse, 20, 3e-2, 1.5, argc > 1));
  return PetscFinalize();
}
