// ranks: 1 2
/* A plate whose rotation is prescribed, about a pivot that moves: after any time its nodes are where a rigid plate's are, and so are
 * its velocities, and the angle that it has turned; also when the rotation swings and rises, or is a table, or the velocity is one; what turns it has
 * the moment of its weight.  And the moment of a load. */
#include "tests/solid/build.h"

#define SPIN 3.0
#define DT 0.01 /* s */

typedef struct {
  double period, rise;
  TimeTable spin; /* over SPIN */
  TimeTable path; /* of the pivot's velocity; nrows 0: constant */
} Way;

/* How far the pivot has moved, over its velocity, by short intervals; or how far the plate has turned, over SPIN. */
static double Integral(const Way *w, double t, int of_spin)
{
  enum { MANY = 100000 };
  double sum = 0.0;
  for (int i = 0; i < MANY; i++) {
    const double at = t * (i + 0.5) / MANY;
    if (of_spin && w->spin.nrows) {
      sum += TimeTableValue(&w->spin, 1, at) / SPIN * t / MANY;
      continue;
    }
    if (!of_spin && w->path.nrows) {
      sum += TimeTableValue(&w->path, 1, at) / 0.4 * t / MANY;
      continue;
    }
    sum += (w->period > 0.0 ? sin(2.0 * M_PI * at / w->period) : 1.0) * (at < w->rise ? at / w->rise : 1.0) *
           t / MANY;
  }
  return sum;
}

/* Of a plate that turns steadily: the moment of its weight, and the power of force and moment.  middle: its angle in the middle of the last step. */
static PetscErrorCode CheckReaction(Solid s, double mass, double middle, double rate, double speed)
{
  const double weight = 9.81 * mass, arm = -0.3 * cos(middle) + 0.1 * sin(middle);
  double q[4];
  PetscFunctionBeginUser;
  PetscCall(SolidMotionReaction(s, "spin", q));
  const double power = q[2] * rate + speed * (0.4 * q[0] - 0.2 * q[1]);
  CHECK(fabs(q[2] - weight * arm) < 1e-3 * weight * 0.3, "moment %g, expected %g", q[2], weight * arm);
  CHECK(fabs(q[3] - power) < 1e-3 * weight, "power %g, expected %g", q[3], power);
  PetscFunctionReturn(0);
}

static PetscErrorCode Rotate(const Way *w)
{
  const SolidSetup setup = {.courant = 0.8, .rebalance = 200.0, .gravity = {0.0, -9.81}};
  const double row[3] = {0.0, 0.4, -0.2}, t = 0.7;
  const BoundaryMotion motion = {NULL,
                                 {{1, 1},
                                  w->path.nrows ? w->path.nrows : 1,
                                  w->path.nrows ? w->path.row : row,
                                  0.0,
                                  w->period,
                                  w->rise,
                                  SPIN,
                                  {0.3, 0.1},
                                  w->spin,
                                  "spin"}};
  BodySetup body = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.1));
  Model a = {0};
  Solid s;
  body.nprescribed = 1;
  body.prescribed = &motion;
  AddRectangle(&a, 0.0, 0.0, 0.2, 0.1, 0.0, 0.05, 1, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  PetscCall(Run(s, t, DT));
  const double moved = Integral(w, t, 0), angle = SPIN * Integral(w, t, 1),
               speed = (moved - Integral(w, t - 1e-4, 0)) / 1e-4,
               rate = (angle - SPIN * Integral(w, t - 1e-4, 1)) / 1e-4;
  const SolidView v = ViewOf(s, NULL, NULL);
  BodyState state;
  PetscCall(SolidBodies(s, 1, &state));
  CHECK(fabs(state.angle - angle) < 1e-8, "turned by %.12g, expected %.12g", state.angle, angle);
  if (w->period == 0.0) PetscCall(CheckReaction(s, state.mass, angle - 0.5 * DT * rate, rate, speed));
  for (int n = 0; n < v.nnodes; n++) {
    const double r[2] = {v.rest[2 * n] - 0.3, v.rest[2 * n + 1] - 0.1};
    const double arm[2] = {cos(angle) * r[0] - sin(angle) * r[1], sin(angle) * r[0] + cos(angle) * r[1]};
    const double x[2] = {0.3 + 0.4 * moved + arm[0], 0.1 - 0.2 * moved + arm[1]};
    const double u[2] = {0.4 * speed - rate * arm[1], -0.2 * speed + rate * arm[0]};
    for (int c = 0; c < 2; c++) {
      CHECK(fabs(v.x[2 * n + c] - x[c]) < 1e-8, "node %d at (%g, %g), expected (%g, %g)", n, v.x[2 * n],
            v.x[2 * n + 1], x[0], x[1]);
      CHECK(fabs(v.v[2 * n + c] - u[c]) < 2e-3, "node %d moves with (%g, %g), expected (%g, %g)", n,
            v.v[2 * n], v.v[2 * n + 1], u[0], u[1]);
    }
  }
  PetscCall(SolidDestroy(&s));
  PetscCall(ModelDestroy(&a));
  return 0;
}

/* The moment of a load that is given element by element. */
static PetscErrorCode Moment(void)
{
  const SolidSetup setup = {.courant = 0.8};
  BodySetup body = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.1));
  double sum[2] = {0.0, 0.0}; /* of x f_y and of y f_x about the centre */
  Model a = {0};
  BodyState state;
  Solid s;
  AddRectangle(&a, 0.3, -0.2, 0.2, 0.1, 0.4, 0.05, 1, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  const SolidView v = ViewOf(s, NULL, NULL);
  double *load = calloc(2 * (size_t)v.nnodes + 1, sizeof *load);
  for (int k = 0; k < 3 * v.nelements; k++) {
    const double *x = v.rest + 2 * v.element[k], force[2] = {1.0 + x[1], 2.0 - 3.0 * x[0]};
    for (int c = 0; c < 2; c++) load[2 * v.element[k] + c] += force[c];
    sum[0] += (x[0] - 0.3) * force[1];
    sum[1] += (x[1] + 0.2) * force[0];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  PetscCall(SolidStart(s, 1e-9, load));
  PetscCall(SolidBodies(s, 1, &state));
  CHECK(fabs(state.moment - (sum[0] - sum[1])) < 1e-9, "moment %g, expected %g", state.moment,
        sum[0] - sum[1]);
  free(load);
  PetscCall(SolidDestroy(&s));
  PetscCall(ModelDestroy(&a));
  return 0;
}

int main(int argc, char **argv)
{
  static const double SPINS[] = {0.0, 0.0, 0.3, SPIN, 0.45, -0.5 * SPIN};
  static const double PATH[] = {0.0, 0.0, 0.0, 0.2, 0.4, -0.2, 0.55, -0.2, 0.1};
  static const Way WAYS[] = {{0.0, 0.0, {0}, {0}},
                             {0.0, 0.3, {0}, {0}},
                             {0.5, 0.0, {0}, {0}},
                             {0.5, 0.3, {0}, {0}},
                             {0.0, 0.0, {3, 2, SPINS}, {0}},
                             {0.0, 0.0, {0}, {3, 3, PATH}},
                             {0.0, 0.0, {3, 2, SPINS}, {3, 3, PATH}}};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (size_t k = 0; k < sizeof WAYS / sizeof *WAYS; k++) PetscCall(Rotate(&WAYS[k]));
  PetscCall(Moment());
  return PetscFinalize();
}
