#include "solid/check_materials.h"
#include "solid/contact/contact_impl.h"

enum { MOST_LINES = 8 };

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
