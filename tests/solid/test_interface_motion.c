// ranks: 1 2
/* What the fluid sees of a disc that moves (and spins) and swells: all of it while the step resolves the
 * swelling, hardly more than the rigid motion when it does not, and what an implicit step makes of it in between;
 * and of a bar that has come apart: each piece's own momentum. */
#include "solid/step_response.h"
#include "tests/solid/crack.h"

#define STEP 1e-3
#define SWELLING 0.5 /* 1/s */

/* Largest difference over the nodes between what is seen and rigid motion + swelling (x - centre), m/s. */
static PetscErrorCode Difference(double youngs_modulus, double swelling, double *largest)
{
  const SolidSetup options = {.courant = 0.8};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, youngs_modulus, 0.3, 0.0));
  Model a = {0};
  BodyState b;
  Solid s;
  SolidView view;
  InterfaceMotion interface;
  PetscFunctionBeginUser;
  setup.velocity[0] = 1.0;
  setup.velocity[1] = -2.0;
  setup.angular_velocity = swelling > 0.0 ? 0.0 : 3.0; /* a mean over a turning step has a part of its own */
  AddDisc(&a, 0.3, 0.2, 0.1, 0.02, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  SolidGetView(s, &view);
  double *v = (double *)view.v; /* the test's own solid: writable */
  for (int n = 0; n < view.nnodes; n++) {
    v[2 * n] += SWELLING * (view.x[2 * n] - 0.3);
    v[2 * n + 1] += SWELLING * (view.x[2 * n + 1] - 0.2);
  }
  PetscCall(RunStep(s, STEP, NULL));
  PetscCall(SolidUpdateInterfaceMotion(s, &interface));
  PetscCall(SolidBodies(s, 1, &b));
  *largest = 0.0;
  for (int n = 0; n < view.nnodes; n++) {
    const double r[2] = {view.x[2 * n] - b.x[0], view.x[2 * n + 1] - b.x[1]};
    const double u[2] = {b.v[0] - b.angular_velocity * r[1] + swelling * r[0],
                         b.v[1] + b.angular_velocity * r[0] + swelling * r[1]};
    for (int c = 0; c < 2; c++) *largest = fmax(*largest, fabs(interface.u[2 * n + c] - u[c]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  PetscCall(SolidDestroy(&s));
  PetscCall(ModelDestroy(&a));
  PetscFunctionReturn(0);
}

/* The forces of the model's bodies with their nodes at x. */
static PetscErrorCode ForcesAt(const Model *a, int n, const double x[], double force[])
{
  const SolidSetup options = {.courant = 0.8};
  const double *f;
  SolidView view;
  Solid s;
  PetscFunctionBeginUser;
  PetscCall(SolidCreate(PETSC_COMM_WORLD, a, &options, &s));
  SolidGetView(s, &view);
  CHECK(view.nnodes == n, "%d nodes instead of %d", view.nnodes, n);
  PetscCall(PetscArraycpy((double *)view.x, x, 2 * n));
  PetscCall(SolidForces(s, &f));
  PetscCall(PetscArraycpy(force, f, 2 * n));
  PetscCall(SolidDestroy(&s));
  PetscFunctionReturn(0);
}

#define SPEED 1e-3 /* m/s */

/* image = d + dt^2/4 M^-1 K d = S^-1 d, with K d from the forces of the discs displaced along d. */
static PetscErrorCode Inverse(const Model *a, const SolidView *view, const double mobility[],
                              const double d[], double image[])
{
  const double moved = 1e-7 / SPEED;
  const int n = 2 * view->nnodes;
  double *x, *up, *down;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(n, &x, n, &up, n, &down));
  for (int side = -1; side <= 1; side += 2) {
    for (int k = 0; k < n; k++) x[k] = view->x[k] + side * moved * d[k];
    PetscCall(ForcesAt(a, n / 2, x, side > 0 ? up : down));
  }
  for (int k = 0; k < n; k++)
    image[k] = d[k] - 0.25 * STEP * STEP * mobility[k / 2] * (up[k] - down[k]) / (2.0 * moved);
  PetscCall(PetscFree3(x, up, down));
  PetscFunctionReturn(0);
}

static PetscErrorCode Largest(int n, const double a[], const double b[], double *largest)
{
  PetscFunctionBeginUser;
  *largest = 0.0;
  for (int k = 0; k < n; k++) *largest = fmax(*largest, fabs(a[k] - b[k]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* A disc that starts without stress.  What the velocity at the time of the positions loses is 0.15 of what the response S leaves of it, and
 * S^-1 of that is what the forces say; w = S v + 2 S^2 (1 - S) d, d = v^n - v here.  *change: |w - v| at most, over SPEED. */
static PetscErrorCode CheckResponse(double youngs_modulus, int six_node, double *change)
{
  const SolidSetup options = {.courant = 0.8};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, youngs_modulus, 0.3, 0.0));
  Model a = {0};
  Solid s;
  SolidView view;
  InterfaceMotion interface;
  double h, *d, *now, *w, *left, *image, off;
  PetscFunctionBeginUser;
  setup.six_node = six_node;
  AddDisc(&a, 0.3, 0.2, 0.1, six_node ? 0.04 : 0.02, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  SolidGetView(s, &view);
  const int n = 2 * view.nnodes;
  double *v = (double *)view.v;
  PetscCall(PetscMalloc5(n, &d, n, &now, n, &w, n, &left, n, &image));
  for (int i = 0; i < view.nnodes; i++) {
    const double p = 60.0 * view.x[2 * i], q = 45.0 * view.x[2 * i + 1];
    v[2 * i] = SPEED * sin(p + q);
    v[2 * i + 1] = SPEED * cos(p - 2.0 * q);
  }
  PetscCall(PetscArraycpy(d, view.v, n));
  PetscCall(SolidStart(s, STEP, NULL));
  while (SolidRemaining(s)) PetscCall(SolidSubstep(s, &h));
  PetscCall(PetscArraycpy(now, view.v, n));
  PetscCall(SolidUpdateInterfaceMotion(s, &interface));
  SolidGetView(s, &view);
  PetscCall(PetscArraycpy(w, now, n));
  PetscCall(StepResponseApply(s, 1e-10, w));
  for (int k = 0; k < n; k++) d[k] -= now[k];
  PetscCall(StepResponseApply(s, 1e-10, d));
  PetscCall(PetscArraycpy(image, d, n));
  PetscCall(StepResponseApply(s, 1e-10, image));
  for (int k = 0; k < n; k++) d[k] = 2.0 * (d[k] - image[k]);
  PetscCall(StepResponseApply(s, 1e-10, d));
  for (int k = 0; k < n; k++) w[k] += d[k];
  PetscCall(Largest(n, w, interface.u, &off));
  CHECK(off < 1e-4 * SPEED, "E %g: the interface velocity is %g m/s off", youngs_modulus, off);
  PetscCall(Largest(n, now, interface.u, change));
  *change /= SPEED;
  PetscCall(ForcesAt(&a, view.nnodes, view.x, image));
  for (int k = 0; k < n; k++) {
    const double lost = now[k] - view.v[k];
    now[k] += 0.5 * h * image[k] * interface.mobility[k / 2];
    left[k] = now[k] - lost / 0.15;
  }
  PetscCall(Inverse(&a, &view, interface.mobility, left, image));
  PetscCall(Largest(n, image, now, &off));
  CHECK(off < 1e-3 * SPEED, "E %g: what damping leaves is %g m/s off", youngs_modulus, off);
  PetscCall(PetscFree5(d, now, w, left, image));
  PetscCall(SolidDestroy(&s));
  PetscCall(ModelDestroy(&a));
  PetscFunctionReturn(0);
}

/* Undamped, with steps of one length, a block's vibrations lose energy: a part of those that substeps hardly resolve grew by up to 5 % a
 * step when the velocity half a substep before the positions was damped. */
static PetscErrorCode CheckEnergy(void)
{
  const SolidSetup options = {.courant = 0.8};
  BodySetup setup = BodyAtRest(MaterialOf(1.0, 28800.0, 0.0, 0.0));
  Model a = {0};
  Solid s;
  InterfaceMotion interface;
  BodyState b;
  double *v, start = 0.0;
  PetscFunctionBeginUser;
  setup.six_node = 1;
  AddRectangle(&a, 0.5, 0.5, 0.3, 0.3, 0.0, 0.03, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  const SolidView view = ViewOf(s, NULL, &v);
  for (int i = 0; i < view.nnodes; i++)
    for (int c = 0; c < 2; c++)
      v[2 * i + c] = 1e-3 * sin(1e4 * view.rest[2 * i] + 3e3 * view.rest[2 * i + 1] + c);
  for (int step = 0; step < 600; step++) {
    PetscCall(RunStep(s, 0.006, NULL));
    PetscCall(SolidUpdateInterfaceMotion(s, &interface));
    PetscCall(SolidBodies(s, 1, &b));
    if (step == 100) start = b.kinetic + b.strain;
  }
  if (getenv("VERBOSE"))
    printf("energy %g J, later %g J; %d substeps\n", start, b.kinetic + b.strain, SolidGetStats(s)->substeps);
  CHECK(b.kinetic + b.strain < start, "energy rises from %g to %g J", start, b.kinetic + b.strain);
  PetscCall(SolidDestroy(&s));
  PetscCall(ModelDestroy(&a));
  PetscFunctionReturn(0);
}

/* The preconditioner turns with the material: a disc squeezed by 2 % that has turned by 1 rad takes as many iterations as
 * one that has not; either at most 15 a response on one rank; a step has five. */
static PetscErrorCode CheckIterations(double angle, double dt, long long *iterations)
{
  const SolidSetup options = {.courant = 0.8};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1.0e7, 0.3, 0.0));
  Model a = {0};
  Solid s;
  InterfaceMotion interface;
  double *x, *v;
  PetscFunctionBeginUser;
  AddDisc(&a, 0.3, 0.2, 0.1, 0.01, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  const SolidView view = ViewOf(s, &x, &v);
  for (int i = 0; i < view.nnodes; i++) {
    const double r[2] = {view.rest[2 * i] - 0.3, 0.98 * (view.rest[2 * i + 1] - 0.2)};
    x[2 * i] = 0.3 + cos(angle) * r[0] - sin(angle) * r[1];
    x[2 * i + 1] = 0.2 + sin(angle) * r[0] + cos(angle) * r[1];
    v[2 * i] = sin(60.0 * r[0] + 45.0 * r[1]);
    v[2 * i + 1] = cos(60.0 * r[0] - 90.0 * r[1]);
  }
  PetscCall(RunStep(s, dt, NULL));
  PetscCall(SolidUpdateInterfaceMotion(s, &interface));
  *iterations = SolidGetStats(s)->response_iterations;
  if (getenv("VERBOSE")) printf("turned by %g: %lld iterations for five responses\n", angle, *iterations);
  PetscCall(SolidDestroy(&s));
  PetscCall(ModelDestroy(&a));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckTurned(void)
{
  long long rest, turned;
  int size;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCall(CheckIterations(0.0, STEP, &rest));
  PetscCall(CheckIterations(1.0, STEP, &turned));
  CHECK(turned <= rest + 2, "%lld iterations at rest, %lld turned", rest, turned);
  CHECK(size > 1 || turned <= 75, "%lld iterations for five responses", turned);
  PetscFunctionReturn(0);
}

/* A bar whose halves fly apart, each with a spin of its own. */
static PetscErrorCode Fragmented(Solid *s)
{
  const SolidSetup options = {.courant = 0.8};
  const double box[1][4] = {{-0.02, -1.0, 0.02, 1.0}};
  BodySetup setup = BodyAtRest(RockOf(3e6, 9e6, 5.0, 0.0));
  Model a = {0};
  double *v;
  PetscFunctionBeginUser;
  setup.joints = (JointSetup){.nboxes = 1, .box = box};
  AddRectangle(&a, 0.0, 0.0, 0.4, 0.1, 0.0, 0.02, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, s));
  const SolidView view = ViewOf(*s, NULL, &v);
  for (int n = 0; n < view.nnodes; n++) {
    const double *x = view.x + 2 * n, side = x[0] < 0.0 ? -1.0 : 1.0;
    v[2 * n] = 2.0 * side;
    v[2 * n + 1] = 3.0 + 5.0 * (fabs(x[0]) - 0.1);
  }
  PetscCall(ModelDestroy(&a));
  PetscFunctionReturn(0);
}

/* Of element e moving with v: adds mass (over density) and the momentum of v to sum; largest strain rate. */
static double AddElement(const SolidView *view, int e, const double v[], double sum[4])
{
  const int *node = view->element + 3 * e;
  double twice = 0.0, twice_now = 0.0, g[2][2] = {{0}};
  for (int i = 0; i < 3; i++) {
    const int p = node[(i + 1) % 3], q = node[(i + 2) % 3];
    const double normal[2] = {view->x[2 * p + 1] - view->x[2 * q + 1], view->x[2 * q] - view->x[2 * p]};
    twice += view->rest[2 * p] * view->rest[2 * q + 1] - view->rest[2 * q] * view->rest[2 * p + 1];
    twice_now += view->x[2 * p] * view->x[2 * q + 1] - view->x[2 * q] * view->x[2 * p + 1];
    for (int c = 0; c < 2; c++)
      for (int b = 0; b < 2; b++) g[c][b] += v[2 * node[i] + c] * normal[b];
  }
  for (int i = 0; i < 3; i++) {
    const double *x = view->x + 2 * node[i], *u = v + 2 * node[i], m = twice / 6.0;
    sum[0] += m;
    sum[1] += m * u[0];
    sum[2] += m * u[1];
    sum[3] += m * (x[0] * u[1] - x[1] * u[0]);
  }
  return fmax(fmax(fabs(g[0][0]), fabs(g[1][1])), fabs(g[0][1] + g[1][0])) / twice_now;
}

enum { MOST = 16 };

/* The fastest to the left and to the right must be faster than the bar, which does not move. */
static void CheckMomentum(int pieces, double sum[][2][4])
{
  double slowest = 0.0, fastest = 0.0;
  for (int k = 0; k < pieces; k++) {
    const double *now = sum[k][0], *shown = sum[k][1];
    slowest = fmin(slowest, shown[1] / shown[0]);
    fastest = fmax(fastest, shown[1] / shown[0]);
    /* rigid motions pass unchanged but for round-off, which the stiffness amplifies by (omega STEP / 2)^2, and the
     * tolerance of the iteration, which is of all pieces together */
    for (int c = 1; c < 4; c++)
      CHECK(fabs(shown[c] - now[c]) < 1e-7 * now[0], "piece %d: momentum %d %.15g, seen %.15g", k, c, now[c],
            shown[c]);
  }
  CHECK(slowest < -1.5 && fastest > 1.5, "pieces fly at %g to %g m/s", slowest, fastest);
}

static PetscErrorCode CheckPieces(void)
{
  Solid s;
  InterfaceMotion interface;
  double sum[MOST][2][4] = {{{0}}}, strain = 0.0, actual = 0.0; /* [piece][velocity, seen] */
  int pieces;
  PetscFunctionBeginUser;
  PetscCall(Fragmented(&s));
  PetscCall(Run(s, 1e-3, 1e-4));
  PetscCall(SolidUpdateInterfaceMotion(s, &interface));
  const SolidView view = ViewOf(s, NULL, NULL);
  int *fragment = malloc(((size_t)view.nelements + 1) * sizeof *fragment);
  PetscCall(SolidFragments(s, fragment, &pieces));
  CHECK(pieces >= 2 && pieces <= MOST, "%d pieces", pieces);
  for (int e = 0; e < view.nelements; e++) {
    actual = fmax(actual, AddElement(&view, e, view.v, sum[fragment[e]][0]));
    strain = fmax(strain, AddElement(&view, e, interface.u, sum[fragment[e]][1]));
  }
  free(fragment);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 8 * MOST, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  CheckMomentum(pieces, sum);
  MPI_Allreduce(MPI_IN_PLACE, &actual, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, &strain, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  /* a piece's slowest vibration is about 50 times STEP's inverse: at most 1/600 of it is left, and joints are softer */
  CHECK(strain < 0.01 * actual, "stiff pieces are seen to deform at %g 1/s of %g", strain, actual);
  PetscCall(SolidDestroy(&s));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  double difference;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  /* slowest vibrations: about omega = 2 sqrt(E / rho) / r, 200 and 0.002 times STEP's inverse.  The response leaves
   * 1 / (1 + (omega STEP / 2)^2) = 1e-4 of the stiff disc's swelling, SWELLING r at its rim. */
  PetscCall(Difference(1e11, 0.0, &difference));
  CHECK(difference < 1e-4 * SWELLING * 0.1, "a stiff disc is seen to deform at %g m/s", difference);
  PetscCall(Difference(1e1, SWELLING, &difference));
  CHECK(difference < 1e-3 * SWELLING * 0.1, "a soft disc's swelling is seen wrong by %g m/s", difference);
  for (int six_node = 0; six_node < 2; six_node++) {
    /* fast vibrations of this pattern: about 3 times STEP's inverse */
    PetscCall(CheckResponse(1e6, six_node, &difference));
    CHECK(difference > 0.1, "a step that does not resolve vibrations takes %g of them off", difference);
  }
  PetscCall(CheckTurned());
  PetscCall(CheckEnergy());
  PetscCall(CheckPieces());
  PetscCall(PetscFinalize());
  return 0;
}
