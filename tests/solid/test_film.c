// ranks: 1 2 3
/* Films that yield move a body beside its velocity: as a whole under a load in the middle of its lower side, with a turn under one aside of it,
 * to where resistance and load agree; one that is fixed not at all, one that is held in x in y alone.  Velocities and shape stay. */
#include "tests/solid/build.h"

#define SIDE 0.1
#define DT 1e-3
#define LOAD 3.0         /* N/m */
#define RESISTANCE 150.0 /* N s/m2 */

/* -1 for the lower left corner of the block, 1 for the lower right one, else 0. */
static int CornerOf(const SolidView *v, int node)
{
  const double *x = v->rest + 2 * node;
  if (x[1] > -0.5 * SIDE + 1e-9 || fabs(x[0]) < 0.5 * SIDE - 1e-9) return 0;
  return x[0] < 0.0 ? -1 : 1;
}

/* Two films, in the lower corners, of which the left one has `left` of the load; the parts of ranks are as their elements there. */
static void Films(const SolidView *v, double left, double load[], double resistance[])
{
  double here[2] = {0.0, 0.0}, all[2];
  memset(load, 0, 2 * (size_t)v->nnodes * sizeof *load);
  memset(resistance, 0, 4 * (size_t)v->nnodes * sizeof *resistance);
  for (int k = 0; k < 3 * v->nelements; k++)
    if (CornerOf(v, v->element[k])) here[CornerOf(v, v->element[k]) > 0] += 1.0;
  MPI_Allreduce(here, all, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  for (int i = 0; i < v->nnodes; i++) {
    const int corner = CornerOf(v, i);
    if (!corner) continue;
    const double part = here[corner > 0] / all[corner > 0];
    load[2 * i + 1] = -part * LOAD * (corner < 0 ? left : 1.0 - left);
    resistance[4 * i + 3] = part * 0.5 * RESISTANCE;
    resistance[4 * i] = 0.1 * resistance[4 * i + 3];
  }
}

typedef enum { FREE, FIXED, HELD_IN_X } Holding;

typedef struct {
  const char *name;
  Holding holding;
  double left, speed;     /* of the load; along x, m/s */
  double shift[2], omega; /* expected, over the step and beside the speed: m/s, rad/s */
} Case;

/* A block of a material so stiff that it keeps its shape. */
static PetscErrorCode Block(const Case *c, Solid *s)
{
  static const double REST[3] = {0.0, 0.0, 0.0};
  const BoundaryMotion motion = {.motion = {.prescribed = {1, 0}, .nrows = 1, .row = REST}};
  SolidSetup setup = {.courant = 0.8, .rebalance = 200.0};
  BodySetup body = BodyAtRest(MaterialOf(1000.0, 1e7, 0.3, 0.0));
  Model a = {0};
  body.velocity[0] = c->speed;
  body.fixed = c->holding == FIXED;
  body.nprescribed = c->holding == HELD_IN_X;
  body.prescribed = &motion;
  AddRectangle(&a, 0.0, 0.0, SIDE, SIDE, 0.0, 0.03, 0, &body);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, s));
  return ModelDestroy(&a);
}

/* The films are of one step: a second one has none. */
static PetscErrorCode Check(const Case *c)
{
  BodyState body;
  SolidView v;
  Solid s;
  double *load, *resistance;
  PetscCall(Block(c, &s));
  SolidGetView(s, &v);
  PetscCall(PetscMalloc2(2 * v.nnodes, &load, 4 * v.nnodes, &resistance));
  Films(&v, c->left, load, resistance);
  SolidSetFilm(s, load, resistance);
  for (int step = 1; step <= 2; step++) {
    const double turn = DT * c->omega;
    PetscCall(Run(s, DT, DT));
    for (int i = 0; i < v.nnodes; i++) {
      const double *r = v.rest + 2 * i,
                   x[2] = {r[0] * cos(turn) - r[1] * sin(turn) + DT * (c->shift[0] + step * c->speed),
                           r[0] * sin(turn) + r[1] * cos(turn) + DT * c->shift[1]};
      for (int d = 0; d < 2; d++)
        CHECK(fabs(v.x[2 * i + d] - x[d]) < 1e-7 * SIDE, "%s: a node is at %.12g, expected %.12g", c->name,
              v.x[2 * i + d], x[d]);
    }
    PetscCall(SolidBodies(s, 1, &body));
    CHECK(fabs(body.v[0] - c->speed) < 1e-9 && fabs(body.v[1]) < 1e-9 && fabs(body.angular_velocity) < 1e-8,
          "%s: velocity %g, %g, %g", c->name, body.v[0], body.v[1], body.angular_velocity);
    CHECK(body.strain < 1e-12, "%s: a strain energy of %g", c->name, body.strain);
  }
  PetscCall(PetscFree2(load, resistance));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  const double sink = LOAD / RESISTANCE, omega = 2.0 * sink / SIDE; /* about the lower corner */
  const Case cases[] = {{"a load in the middle", FREE, 0.5, 0.0, {0.0, -sink}, 0.0},
                        {"while it moves", FREE, 0.5, 0.2, {0.0, -sink}, 0.0},
                        {"a load aside", FREE, 1.0, 0.0, {-0.5 * SIDE * omega, -sink}, omega},
                        {"fixed", FIXED, 1.0, 0.0, {0.0, 0.0}, 0.0},
                        {"held in x", HELD_IN_X, 1.0, 0.0, {0.0, -sink}, 0.0}};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) PetscCall(Check(&cases[k]));
  return PetscFinalize();
}
