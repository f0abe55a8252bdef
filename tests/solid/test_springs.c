// ranks: 1 2 3
/* A stiff block on springs does what a mass on springs does: it swings in all directions alike on one of length 0, it is thrown back
 * by a line that was slack and by a fender, it decays with a dashpot; two with a spring between them swing about their common centre.  Momentum is in the
 * budget. */
#include "tests/solid/build.h"

#define SIDE 0.1
#define MASS (1000.0 * SIDE * SIDE) /* kg/m */
#define STIFFNESS 1e4               /* N/m: 31.6 rad/s, where the block's own lowest is 7000 */
#define DT 1e-3

/* A block in the origin, with an anchored spring in its middle. */
static PetscErrorCode Block(const Spring *spring, const double velocity[2], Solid *s)
{
  SolidSetup setup = {.courant = 0.8, .rebalance = 200.0, .nsprings = 1};
  Model a = {0};
  BodySetup body = BodyAtRest(MaterialOf(1000.0, 1e9, 0.3, 0.0));
  body.velocity[0] = velocity[0];
  body.velocity[1] = velocity[1];
  AddRectangle(&a, 0.0, 0.0, SIDE, SIDE, 0.0, 0.05, 0, &body);
  setup.spring[0] = *spring;
  setup.spring[0].anchored = 1;
  EndAt(&a, 0.0, 0.0, &setup.spring[0].end[0]);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, s));
  PetscCall(ModelDestroy(&a));
  return 0;
}

/* Runs to t and compares the mass centre; the momentum of all steps is the springs' impulse. */
static PetscErrorCode Check(Solid s, double t, const double x[2], double bound, const char *what)
{
  const double left = t - SolidGetStats(s)->t;
  BodyState body;
  for (int k = 0, n = (int)round(left / DT); k < n; k++) {
    SolidBudget b;
    PetscCall(Run(s, left / n, DT));
    PetscCall(SolidGetBudget(s, &b));
    for (int c = 0; c < 2; c++)
      CHECK(fabs(b.momentum[c] - b.start[c] - b.reaction[c]) < 1e-12 * MASS, "%s: momentum %g, impulse %g",
            what, b.momentum[c] - b.start[c], b.reaction[c]);
  }
  PetscCall(SolidBodies(s, 1, &body));
  for (int c = 0; c < 2; c++)
    CHECK(fabs(body.x[c] - x[c]) < bound, "%s, t %g: at (%g, %g), expected (%g, %g)", what, t, body.x[0],
          body.x[1], x[0], x[1]);
  return 0;
}

/* About an anchor aside of it, with a velocity across: an ellipse. */
static PetscErrorCode Swing(void)
{
  const double omega = sqrt(STIFFNESS / MASS), amplitude = 0.01, velocity[2] = {0.0, 0.2};
  const Spring spring = {.anchor = {amplitude, 0.0}, .stiffness = STIFFNESS};
  Solid s;
  PetscCall(Block(&spring, velocity, &s));
  for (int k = 1; k <= 16; k++) {
    const double t = 2.0 * PETSC_PI / omega * k / 8.0,
                 x[2] = {amplitude * (1.0 - cos(omega * t)), velocity[1] / omega * sin(omega * t)};
    PetscCall(Check(s, t, x, 2e-3 * amplitude, "swing"));
  }
  PetscCall(SolidDestroy(&s));
  return 0;
}

/* With 0.5 m/s against a spring that acts after 0.05 m, pulling or pushing: free, then half a swing, then free again with the opposite velocity. */
static PetscErrorCode ThrownBack(const char *what, const Spring *spring)
{
  const double omega = sqrt(STIFFNESS / MASS), velocity[2] = {0.5, 0.0}, free_time = 0.05 / velocity[0];
  const double back = free_time + PETSC_PI / omega, most = STIFFNESS * velocity[0] / omega;
  const double tension = spring->acts == SPRING_PULLS ? most : -most;
  SpringState state;
  Solid s;
  PetscCall(Block(spring, velocity, &s));
  PetscCall(Check(s, 0.9 * free_time, (const double[2]){0.045, 0.0}, 1e-9, what));
  PetscCall(SolidSprings(s, &state));
  CHECK(fabs(state.length - fabs(spring->anchor[0] - 0.045)) < 1e-9 && state.tension == 0.0,
        "%s, before it acts: %g m, %g N/m", what, state.length, state.tension);
  PetscCall(Check(s, free_time + 0.5 * PETSC_PI / omega, (const double[2]){0.05 + velocity[0] / omega, 0.0},
                  5e-5, what));
  PetscCall(SolidSprings(s, &state));
  CHECK(fabs(state.tension - tension) < 0.01 * fabs(state.tension), "%s: %g N/m, expected %g", what,
        state.tension, tension);
  PetscCall(Check(s, back + 0.1, (const double[2]){0.05 - 0.1 * velocity[0], 0.0}, 2e-4, what));
  PetscCall(SolidDestroy(&s));
  return 0;
}

/* A block and one of half its width, with a spring between their middles and a dashpot, pulled apart: they swing about their common centre, which stays
 * at rest, and the spring's work is the energy's change. */
static PetscErrorCode Pair(void)
{
  const double ratio = 0.05, reduced = MASS / 3.0, omega = sqrt(STIFFNESS / reduced);
  const double damped = omega * sqrt(1.0 - ratio * ratio), apart = 0.2, stretched = 0.01;
  SolidSetup setup = {.courant = 0.8, .rebalance = 200.0, .nsprings = 1};
  Model a = {0};
  BodySetup body = BodyAtRest(MaterialOf(1000.0, 1e9, 0.3, 0.0));
  SolidBudget b;
  Solid s;
  AddRectangle(&a, 0.0, 0.0, SIDE, SIDE, 0.0, 0.05, 0, &body);
  AddRectangle(&a, apart, 0.0, 0.5 * SIDE, SIDE, 0.0, 0.025, 0, &body);
  setup.spring[0] =
      (Spring){.stiffness = STIFFNESS, .length = apart - stretched, .damping = 2.0 * ratio * omega * reduced};
  EndAt(&a, 0.0, 0.0, &setup.spring[0].end[0]);
  EndAt(&a, apart, 0.0, &setup.spring[0].end[1]);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, &s));
  PetscCall(ModelDestroy(&a));
  for (int k = 1; k <= 200; k++) {
    const double t = k * DT, x = stretched * exp(-ratio * omega * t) *
                                 (cos(damped * t) + ratio * omega / damped * sin(damped * t));
    BodyState now[2];
    SpringState spring;
    PetscCall(Run(s, DT, DT));
    PetscCall(SolidBodies(s, 2, now));
    PetscCall(SolidSprings(s, &spring));
    PetscCall(SolidGetBudget(s, &b));
    CHECK(fabs(now[1].x[0] - now[0].x[0] - (apart - stretched + x)) < 5e-3 * stretched,
          "pair, t %g: %g m apart, expected %g", t, now[1].x[0] - now[0].x[0], apart - stretched + x);
    CHECK(fabs(2.0 * now[0].x[0] + now[1].x[0] - apart) < 1e-12, "pair, t %g: centre at %.17g", t,
          (2.0 * now[0].x[0] + now[1].x[0]) / 3.0);
    CHECK(fabs(spring.length - (apart - stretched + x)) < 5e-3 * stretched, "pair, t %g: a spring of %g m", t,
          spring.length);
    CHECK(fabs(b.reaction[0]) + fabs(b.reaction[1]) < 1e-12 * MASS, "pair: impulse (%g, %g)", b.reaction[0],
          b.reaction[1]);
  }
  PetscCall(SolidDestroy(&s));
  return 0;
}

/* A tenth of the critical damping. */
static PetscErrorCode Decay(void)
{
  const double omega = sqrt(STIFFNESS / MASS), ratio = 0.1, damped = omega * sqrt(1.0 - ratio * ratio);
  const double t = 2.0 * 2.0 * PETSC_PI / damped, amplitude = 0.01, still[2] = {0.0, 0.0};
  const Spring spring = {.anchor = {-1.0 + amplitude, 0.0},
                         .stiffness = STIFFNESS,
                         .length = 1.0,
                         .damping = 2.0 * ratio * omega * MASS};
  Solid s;
  PetscCall(Block(&spring, still, &s));
  PetscCall(Check(s, t, (const double[2]){amplitude * (1.0 - exp(-ratio * omega * t)), 0.0}, 2e-3 * amplitude,
                  "decay"));
  PetscCall(SolidDestroy(&s));
  return 0;
}

/* -d(force)/dx, by central differences, of springs of 0.5 m with different lengths without tension: one that pushes
 * has nothing across it, and one that does not act nothing at all. */
static void Stiffness(void)
{
  static const struct {
    Spring spring;
    double along, lateral;
  } CASES[] = {{{.length = 0.0}, 1.0, 1.0},
               {{.length = 0.3}, 1.0, 0.4},
               {{.length = 0.3, .acts = SPRING_PULLS}, 1.0, 0.4},
               {{.length = 0.8}, 1.0, 0.0},
               {{.length = 0.8, .acts = SPRING_PULLS}, 0.0, 0.0},
               {{.length = 0.8, .acts = SPRING_PUSHES}, 1.0, 0.0},
               {{.length = 0.3, .acts = SPRING_PUSHES}, 0.0, 0.0}};
  const double moved = 1e-6;
  for (int k = 0; k < 7; k++) {
    const int pushes = k == 3 || k == 5;
    Spring spring = CASES[k].spring;
    double stiffness[4], force[2][2];
    spring.stiffness = STIFFNESS;
    SpringStiffness(&spring, &(SpringExtent){.d = {0.3, 0.4}}, stiffness);
    for (int direction = 0; direction < 2; direction++) {
      const double d[2] = {direction ? -0.8 : 0.6, direction ? 0.6 : 0.8};
      const double expected = STIFFNESS * (direction ? CASES[k].lateral : CASES[k].along);
      for (int side = 0; side < 2; side++) {
        const double by = side ? moved : -moved;
        const SpringExtent at = {.d = {0.3 + by * d[0], 0.4 + by * d[1]}};
        (void)SpringForce(&spring, &at, force[side]);
      }
      for (int c = 0; c < 2; c++) {
        const double is = stiffness[2 * c] * d[0] + stiffness[2 * c + 1] * d[1];
        const double pulled = (force[1][c] - force[0][c]) / (2.0 * moved);
        CHECK(fabs(is - expected * d[c]) < 1e-12 * STIFFNESS, "spring %d: %g N/m instead of %g", k, is,
              expected * d[c]);
        CHECK((pushes && direction) || fabs(is - pulled) < 1e-6 * STIFFNESS,
              "spring %d: %g N/m, its force changes by %g", k, is, pulled);
      }
    }
  }
}

static const Spring LINE = {.anchor = {-0.2, 0.0},
                            .stiffness = STIFFNESS,
                            .length = 0.25,
                            .acts = SPRING_PULLS},
                    FENDER = {
                        .anchor = {0.2, 0.0}, .stiffness = STIFFNESS, .length = 0.15, .acts = SPRING_PUSHES};

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  Stiffness();
  PetscCall(Swing());
  PetscCall(ThrownBack("a line", &LINE));
  PetscCall(ThrownBack("a fender", &FENDER));
  PetscCall(Pair());
  PetscCall(Decay());
  return PetscFinalize();
}
