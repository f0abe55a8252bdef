#include "solid/check_materials.h"
#include "solid/contact/contact_impl.h"

enum { MOST_LINES = 8, INSTANTS = 1000 };

/* Between an element's own nodes: the four parts of a six-node triangle make its area, not the triangles on which
 * their laws are evaluated (six_node_kernel.h). */
static double AreaOf(const Solid s, int e)
{
  Point corner[3];
  for (int i = 0; i < 3; i++) corner[i] = PointAt(s->x, s->elements.node[i][e]);
  return 0.5 * TensorDeterminant(TensorOfEdges(corner[0], corner[1], corner[2]));
}

PetscErrorCode ExpectBodies(Solid s)
{
  const int n = PetscMin(s->nbodies, MOST_LINES), nsprings = PetscMin(s->setup.nsprings, MOST_LINES);
  const double g = hypot(s->setup.gravity[0], s->setup.gravity[1]);
  BodyState state[MOST_LINES];
  SpringState spring[MAX_SPRINGS];
  double area[MOST_LINES] = {0.0};
  PetscFunctionBeginUser;
  PetscCall(SolidBodies(s, n, state));
  PetscCall(SolidSprings(s, spring));
  for (int e = 0; e < s->elements.n; e++)
    if (s->elements.body[e] < n) area[s->elements.body[e]] += AreaOf(s, e);
  for (int b = 0; b < n; b++)
    printf("solid: body %d: %.4g m2, %.4g kg/m, weight %.4g N/m, centre (%.4g, %.4g) m\n", b, area[b],
           state[b].mass, g * state[b].mass, state[b].x[0], state[b].x[1]);
  if (s->nbodies > n) printf("solid: and %d bodies more\n", s->nbodies - n);
  for (int k = 0; k < nsprings; k++)
    printf("solid: spring %d: %.4g m long at the start, tension %.4g N/m\n", k, spring[k].length,
           spring[k].tension);
  PetscFunctionReturn(0);
}

/* Way of the pivot along x and y, m, and angle, rad: the least and the most. */
typedef struct {
  double least[3], most[3];
} MotionRange;

/* When a motion ends of a run that ends then. */
static double EndOf(const PrescribedMotion *d, double end)
{
  return d->release > 0.0 ? fmin(d->release, end) : end;
}

static MotionRange RangeOf(const PrescribedMotion *d, double end)
{
  MotionRange range = {{0.0}, {0.0}};
  for (int i = 1; i <= INSTANTS; i++) {
    const double t = end * i / INSTANTS;
    const double at[3] = {t * PrescribedVelocity(d, 0, 0.0, t), t * PrescribedVelocity(d, 1, 0.0, t),
                          t * PrescribedRotation(d, 0.0, t)};
    for (int c = 0; c < 3; c++) {
      if (c < 2 && !d->prescribed[c]) continue;
      range.least[c] = fmin(range.least[c], at[c]);
      range.most[c] = fmax(range.most[c], at[c]);
    }
  }
  return range;
}

void ExpectMotions(Solid s, double end)
{
  for (int k = 0, motion = -1, lines = 0; k < s->nprescribed && lines < MOST_LINES; k++) {
    if (s->prescribed[k].motion == motion) continue;
    motion = s->prescribed[k].motion;
    const PrescribedMotion *d = &s->motion[motion];
    const MotionRange r = RangeOf(d, EndOf(d, end));
    if (r.most[0] - r.least[0] + r.most[1] - r.least[1] + r.most[2] - r.least[2] == 0.0) continue;
    printf("solid: body %d is moved%s%s by %.3g to %.3g m along x, by %.3g to %.3g m along y",
           s->node_body[s->prescribed[k].node], d->name[0] ? " as " : "", d->name, r.least[0], r.most[0],
           r.least[1], r.most[1]);
    if (PrescribedTurns(d))
      printf(", turned by %.3g to %.3g rad about (%.4g, %.4g) m, which moves with it", r.least[2], r.most[2],
             d->pivot[0], d->pivot[1]);
    printf("\n");
    lines++;
  }
}

/* rad: the fluid beside a body that turns by more in a step is not resolved in time. */
#define FAR_TURN 1.0

void NoteTurns(Solid s, double end, double dt_max)
{
  for (int k = 0; k < s->nprescribed; k++) {
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    double velocity, turn;
    PrescribedLargest(d, 0.0, EndOf(d, end), &velocity, &turn);
    turn *= d->period > 0.0 ? fmin(dt_max, d->period / PETSC_PI) : dt_max; /* there and back */
    if (turn <= FAR_TURN) continue;
    printf(
        "note: solid.bodies[%d] is turned by up to %.3g rad in time.dt_max, %g s: the fluid around it needs "
        "steps in which that is a few degrees\n",
        s->body[s->node_body[s->prescribed[k].node]].entry, turn, dt_max);
    return;
  }
}

/* The coefficient that is given for a material's contacts with another, or with walls (other -1). */
static double Given(Solid s, int m, int other)
{
  const double own = s->material[m].friction;
  if (other >= 0) return fmax(own, s->material[other].friction);
  return s->setup.rough_walls ? fmax(own, s->setup.wall_friction) : own;
}

void NoteFriction(Solid s)
{
  for (int m = 0; m < s->nmaterials && s->setup.nrules == 0; m++)
    for (int other = s->setup.walls ? -1 : 0; other < m; other++) {
      const double given = Given(s, m, other);
      double friction, damping;
      ContactMaterials(s, m, other, &friction, &damping);
      if (friction > 0.0 || given <= 0.0 || s->material[m].joints_alone ||
          (other >= 0 && s->material[other].joints_alone))
        continue;
      printf("note: there is no friction between material '%s' and %s%s%s: one side has the coefficient %g, "
             "the other none, and it is their geometric mean (or that of solid.contact)\n",
             s->material[m].name, other < 0 ? "walls" : "material '",
             other < 0 ? "" : s->material[other].name, other < 0 ? "" : "'", given);
      return;
    }
}

void NoteStrengths(Solid s)
{
  double zone;
  if (JointsResolution(s->joints, s, &zone) > 0) return;
  for (int m = 0; m < s->nmaterials; m++) {
    if (s->material[m].strength[0] <= 0.0) continue;
    printf("note: material '%s' has strengths, but no body has joints: nothing can crack\n",
           s->material[m].name);
    return;
  }
}
