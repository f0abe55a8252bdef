// ranks: 1 2 3
/* Rigid bodies: a slab that is thrown and spins keeps its shape, its momentum and its angular momentum to round-off, also where its elements change ranks, and turns by the angle that
 * it should; on a spring that holds its end it is a pendulum of its own inertia; on the floor it comes to rest with its weight on the floor; what is redone has the same bits. */
#include "tests/solid/build.h"

static Material Rigid(void)
{
  Material m = MaterialOf(2000.0, 0.0, 0.0, 0.0);
  m.penalty = 1e7;
  m.rigid = 1;
  m.friction = 0.4;
  m.contact_damping = 0.5;
  return m;
}

/* Largest difference between distances from node 0 of this rank now and at rest, m. */
static double Strained(Solid s)
{
  const SolidView v = ViewOf(s, NULL, NULL);
  double largest = 0.0;
  for (int n = 1; n < v.nnodes; n++) {
    const double now = hypot(v.x[2 * n] - v.x[0], v.x[2 * n + 1] - v.x[1]),
                 rest = hypot(v.rest[2 * n] - v.rest[0], v.rest[2 * n + 1] - v.rest[1]);
    largest = fmax(largest, fabs(now - rest));
  }
  return largest;
}

/* Elements to ranks in turns. */
static PetscErrorCode Redistribute(Solid s, int n)
{
  PetscMPIInt size;
  int *part = malloc((size_t)n * sizeof *part);
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  for (int e = 0; e < n; e++) part[e] = e % size;
  PetscCall(SolidRedistribute(s, part));
  free(part);
  return 0;
}

static PetscErrorCode Flies(void)
{
  const SolidSetup setup = {.gravity = {0.0, -9.81}, .courant = 0.8, .rebalance = 200.0};
  const double spin = 6.0, dt = 0.01;
  BodySetup body = BodyAtRest(Rigid());
  Model a = {0};
  BodyState before, now;
  Solid s;
  body.velocity[0] = 0.7;
  body.angular_velocity = spin;
  AddRectangle(&a, 3.0, 1.0, 0.4, 0.1, 0.3, 0.03, 1, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  PetscCall(SolidBodies(s, 1, &before));
  for (int k = 0; k < 100; k++) {
    if (k == 50) PetscCall(Redistribute(s, a.nelements));
    PetscCall(RunStep(s, dt, NULL));
  }
  PetscCall(SolidBodies(s, 1, &now));
  CHECK(Strained(s) < 1e-12, "strained by %g m", Strained(s));
  CHECK(fabs(now.v[0] - 0.7) < 1e-11 && fabs(now.v[1] + 9.81) < 1e-10, "velocity (%.14g, %.14g)", now.v[0],
        now.v[1]);
  CHECK(fabs(now.inertia * now.angular_velocity / (before.inertia * before.angular_velocity) - 1.0) < 1e-10,
        "angular velocity %.14g, at first %.14g", now.angular_velocity, before.angular_velocity);
  CHECK(fabs(remainder(now.angle - spin, 2.0 * M_PI)) < 1e-4 * spin, "turned by %g, expected %g", now.angle,
        spin);
  CHECK(fabs(now.x[1] - (1.0 - 0.5 * 9.81)) < 9.81 * 0.5 * dt, "at %g", now.x[1]);
  CHECK(now.strain == 0.0, "strain energy %g", now.strain);
  CHECK(SolidGetStats(s)->total == 1000, "%lld substeps, expected ten a step", SolidGetStats(s)->total);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* It falls 5 mm flat, and stands. */
static PetscErrorCode Stands(void)
{
  const SolidSetup setup = {.gravity = {0.0, -9.81},
                            .courant = 0.8,
                            .walls = PETSC_TRUE,
                            .lower = {-1.0, 0.0},
                            .upper = {1.0, 2.0}};
  const BodySetup body = BodyAtRest(Rigid());
  Model a = {0};
  BodyState state[2];
  SolidBudget budget;
  Solid s;
  AddRectangle(&a, 0.0, 0.055, 0.2, 0.1, 0.0, 0.05, 1, &body);
  AddRectangle(&a, 0.02, 0.16, 0.2, 0.1, 0.0, 0.05, 1, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  PetscCall(Run(s, 2.0, 0.01));
  PetscCall(SolidState(s, 1));
  PetscCall(RunStep(s, 0.01, NULL));
  PetscCall(SolidBodies(s, 2, state));
  PetscCall(SolidGetBudget(s, &budget));
  const double weight = 2 * 2000.0 * 0.02 * 9.81, speed = state[1].v[1], x = state[1].x[0];
  CHECK(fabs(budget.walls[1] / 0.01 / weight - 1.0) < 1e-3, "the floor bears %g N/m, expected %g",
        budget.walls[1] / 0.01, weight);
  CHECK(fabs(speed) < 1e-5 && fabs(state[1].angle) < 1e-3 && fabs(state[1].x[1] - 0.15) < 1e-3,
        "stands at %g with %g m/s, turned by %g", state[1].x[1], speed, state[1].angle);
  PetscCall(SolidState(s, 0));
  PetscCall(RunStep(s, 0.01, NULL));
  PetscCall(SolidBodies(s, 2, state));
  CHECK(state[1].v[1] == speed && state[1].x[0] == x, "redone it has %.17g m/s, not %.17g", state[1].v[1],
        speed);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* What the coupler receives is rigid, and the acceleration by all but the load. */
static PetscErrorCode Answers(void)
{
  const SolidSetup setup = {.gravity = {0.0, -9.81}, .courant = 0.8};
  const BodySetup body = BodyAtRest(Rigid());
  Model a = {0};
  InterfaceMotion motion;
  Solid s;
  AddRectangle(&a, 0.0, 0.0, 0.4, 0.1, 0.0, 0.05, 1, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  const SolidView v = ViewOf(s, NULL, NULL);
  double *load = calloc(2 * (size_t)v.nnodes, sizeof *load), worst[2] = {0.0, 0.0};
  for (int n = 0; n < v.nnodes; n++) load[2 * n + 1] = 40.0 * (v.rest[2 * n] > 0.1);
  PetscCall(RunStep(s, 0.005, load));
  PetscCall(SolidUpdateInterfaceMotion(s, &motion));
  BodyState now;
  PetscCall(SolidBodies(s, 1, &now));
  for (int n = 0; n < v.nnodes; n++) {
    const double r[2] = {v.x[2 * n] - now.x[0], v.x[2 * n + 1] - now.x[1]}, w = now.angular_velocity;
    const double u[2] = {now.v[0] - w * r[1], now.v[1] + w * r[0]};
    const double alpha = now.moment / now.inertia, m = 1.0 / motion.mobility[n];
    const double total[2] = {now.load[0] / now.mass - alpha * r[1] - w * w * r[0],
                             now.load[1] / now.mass - 9.81 + alpha * r[0] - w * w * r[1]};
    for (int c = 0; c < 2; c++) {
      worst[0] = fmax(worst[0], fabs(motion.u[2 * n + c] - u[c]));
      worst[1] = fmax(worst[1], fabs(motion.acceleration[2 * n + c] + v.load[2 * n + c] / m - total[c]));
    }
  }
  CHECK(worst[0] < 1e-3 * fabs(now.angular_velocity), "velocity not rigid by %g m/s of %g 1/s", worst[0],
        now.angular_velocity);
  CHECK(worst[1] < 1e-9 * 1e3, "acceleration off by %g m/s2", worst[1]);
  free(load);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* A bar that hangs on a stiff spring at the middle of its upper end swings as a compound pendulum, with the coupler's questions in each step; what the coupler receives is rigid. */
static PetscErrorCode Swings(void)
{
  SolidSetup setup = {.gravity = {0.0, -9.81}, .courant = 0.8, .nsprings = 1};
  const BodySetup body = BodyAtRest(Rigid());
  const double length = 0.4, width = 0.05, start = 0.02, dt = 0.005, stiffness = 1e6;
  Model a = {0};
  BodyState now;
  InterfaceMotion motion;
  Solid s;
  AddRectangle(&a, 0.0, 0.0, width, length, 0.0, 0.025, 0, &body);
  setup.spring[0] = (Spring){.anchored = 1, .stiffness = stiffness, .anchor = {0.0, 0.5 * length}};
  for (int n = 0; n < a.nnodes; n++) { /* turned about the end that is held */
    const double r[2] = {a.x[2 * n], a.x[2 * n + 1] - 0.5 * length};
    a.x[2 * n] = cos(start) * r[0] - sin(start) * r[1];
    a.x[2 * n + 1] = 0.5 * length + sin(start) * r[0] + cos(start) * r[1];
  }
  EndAt(&a, 0.0, 0.5 * length, &setup.spring[0].end[0]);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  PetscCall(SolidBodies(s, 1, &now));
  const double arm = 0.5 * length, omega = sqrt(now.mass * 9.81 * arm / (now.inertia + now.mass * arm * arm));
  const int steps = (int)round(4.0 * 2.0 * M_PI / omega / dt);
  double worst = 0.0, fastest = 0.0;
  for (int k = 0; k < steps; k++) {
    PetscCall(RunStep(s, dt, NULL));
    PetscCall(SolidUpdateInterfaceMotion(s, &motion));
    PetscCall(SolidBodies(s, 1, &now));
    const SolidView v = ViewOf(s, NULL, NULL);
    for (int n = 1; n < v.nnodes; n++) { /* no distance from node 0 changes */
      const double d[2] = {v.x[2 * n] - v.x[0], v.x[2 * n + 1] - v.x[1]};
      worst = fmax(worst,
                   fabs(d[0] * (motion.u[2 * n] - motion.u[0]) + d[1] * (motion.u[2 * n + 1] - motion.u[1])) /
                       hypot(d[0], d[1]));
    }
    fastest = fmax(fastest, hypot(now.v[0], now.v[1]));
  }
  const double angle = start * cos(omega * steps * dt);
  CHECK(fabs(now.angle - angle) < 0.03 * start, "swings to %g, expected %g", now.angle, angle);
  CHECK(worst < 1e-3 * fastest, "the velocity that is sent strains it by %g m/s of %g", worst, fastest);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* One of two turns as prescribed: all ranks make the same substeps, and it is where it should be. */
static PetscErrorCode Turns(void)
{
  const SolidSetup setup = {.courant = 0.8, .rebalance = 200.0};
  const double row[3] = {0.0, 0.0, 0.0}, spin = 100.0, t = 0.1;
  const BoundaryMotion motion = {NULL, {{1, 1}, 1, row, 0.0, 0.0, 0.0, spin, {0.0, 0.0}, {0}, ""}};
  BodySetup body = BodyAtRest(Rigid());
  Model a = {0};
  BodyState state[2];
  Solid s;
  AddRectangle(&a, 2.0, 0.0, 0.4, 0.1, 0.0, 0.05, 0, &body);
  body.nprescribed = 1;
  body.prescribed = &motion;
  AddRectangle(&a, 0.0, 0.0, 0.4, 0.1, 0.0, 0.05, 0, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  PetscCall(Run(s, t, 0.01));
  PetscCall(SolidBodies(s, 2, state));
  long long total[2] = {SolidGetStats(s)->total, -SolidGetStats(s)->total};
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, total, 2, MPI_LONG_LONG, MPI_MAX, PETSC_COMM_WORLD));
  CHECK(total[0] == -total[1], "ranks make %lld to %lld substeps", -total[1], total[0]);
  CHECK(fabs(remainder(state[1].angle - spin * t, 2.0 * M_PI)) < 1e-9, "turned by %g, expected %g",
        state[1].angle, spin * t);
  CHECK(fabs(state[0].x[0] - 2.0) < 1e-13, "the other is at %.17g", state[0].x[0]);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* On rails along x it rises with the load, and does not turn: the motion has the load's moment. */
static PetscErrorCode Guided(void)
{
  const SolidSetup setup = {.courant = 0.8};
  const double row[3] = {0.0, 0.5, 0.0};
  const BoundaryMotion motion = {NULL, {{1, 0}, 1, row, 0.0, 0.0, 0.0, 0.0, {0.0, 0.0}, {0}, "rail"}};
  BodySetup body = BodyAtRest(Rigid());
  Model a = {0};
  BodyState now;
  Solid s;
  double reaction[4];
  body.nprescribed = 1;
  body.prescribed = &motion;
  AddRectangle(&a, 0.0, 0.0, 0.4, 0.1, 0.0, 0.05, 0, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  const SolidView v = ViewOf(s, NULL, NULL);
  double *load = calloc(2 * (size_t)v.nnodes, sizeof *load);
  for (int n = 0; n < v.nnodes; n++) load[2 * n + 1] = 40.0 * (v.rest[2 * n] > 0.1);
  for (int k = 1; k <= 3; k++) { /* steps of several lengths */
    PetscCall(RunStep(s, 0.001 * k, load));
    PetscCall(SolidBodies(s, 1, &now));
    PetscCall(SolidMotionReaction(s, "rail", reaction));
    CHECK(now.moment > 1.0 && fabs(reaction[2] + now.moment) < 1e-9 * now.moment,
          "the rail has the moment %.14g N, the load %.14g", reaction[2], now.moment);
    CHECK(fabs(now.angle) < 1e-14, "turned by %g", now.angle);
  }
  free(load);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Flies());
  PetscCall(Stands());
  PetscCall(Answers());
  PetscCall(Swings());
  PetscCall(Turns());
  PetscCall(Guided());
  return PetscFinalize();
}
