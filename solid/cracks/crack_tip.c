/* Nodes on the brink: where the cut of one more edge would split a node.  There the edge's load is not the
 * stress beside it but what its node has to bear.  Let A and B be the corners that the cut would part, with
 * the elements' forces F on them and the masses m; they move together because B pulls A with
 *
 *     H = (m_A F_B - m_B F_A)/(m_A + m_B)
 *
 * whatever else acts on the node (it accelerates both alike).  Over the edges between A and B, half of each,
 * this is a traction; with it a joint comes to life without a jump of any force, and at the tip of a crack it
 * is the one that a joint of infinite stiffness would carry. */
#include "solid/cracks/joints_impl.h"

/* Corners that ties connect with corner c; the joint `without` does not tie. */
static Fan FanOf(const Joints j, int star, int c, int without)
{
  const Tie *tie = j->tie + j->star_tie[star];
  const int n = j->star_tie[star + 1] - j->star_tie[star];
  Fan fan = (Fan)1 << c, before = 0;
  while (fan != before) {
    before = fan;
    for (int k = 0; k < n; k++) {
      const int joint = tie[k].joint;
      if (joint >= 0 && (joint == without || j->memory[joint].stage != JOINT_WHOLE)) continue;
      const Fan both = (Fan)1 << tie[k].corner[0] | (Fan)1 << tie[k].corner[1];
      if (fan & both) fan |= both;
    }
  }
  return fan;
}

/* Half the lengths of the joints between two fans: of the whole one and of those alive whose nodes are still
 * one. */
static double Width(const Joints j, int star, const Fan fan[2], int whole)
{
  double width = 0.0;
  for (int k = j->star_tie[star]; k < j->star_tie[star + 1]; k++) {
    const int joint = j->tie[k].joint, *c = j->tie[k].corner;
    if (joint < 0 || (joint != whole && j->memory[joint].stage != JOINT_LIVE)) continue;
    const Fan one = (Fan)1 << c[0], two = (Fan)1 << c[1];
    const PetscBool between =
        (PetscBool)(((fan[0] & one) && (fan[1] & two)) || ((fan[0] & two) && (fan[1] & one)));
    const int end = j->joint[joint].star[0] == star ? 0 : 1;
    if (between && j->memory[joint].end[end].strong == 0.0) width += 0.5 * j->joint[joint].length;
  }
  return width;
}

static PetscBool OnBrink(const Joints j, const Solid s, int k, int end, Brink *b)
{
  const Joint *joint = &j->joint[k];
  const int star = joint->star[end], first = j->star_corner[star];
  const int one = joint->corner[end][0] - first, two = joint->corner[end][1] - first;
  *b = (Brink){.joint = k, .end = end};
  const int node = j->corner[first + one].node;
  if (s->inverse_mass[node] == 0.0 || s->prescribed[node]) return PETSC_FALSE; /* its parts stay together */
  b->fan[0] = FanOf(j, star, one, k);
  if (b->fan[0] & (Fan)1 << two) return PETSC_FALSE;
  b->fan[1] = FanOf(j, star, two, k);
  b->width = Width(j, star, b->fan, k);
  return PETSC_TRUE;
}

void JointsFindBrinks(Joints j, Solid s, PetscBool all)
{
  Brink b;
  for (int k = 0; k < j->n; k++) {
    const Joint *joint = &j->joint[k];
    for (int end = 0; end < 2 && joint->mine; end++)
      if (all || j->touched[joint->star[end]])
        j->edge[k][end] = j->memory[k].stage == JOINT_WHOLE && OnBrink(j, s, k, end, &b);
  }
  j->nbrinks = 0;
  for (int k = 0; k < j->n; k++)
    for (int end = 0; end < 2 && j->joint[k].mine && j->memory[k].stage == JOINT_WHOLE; end++)
      if (j->edge[k][end] && OnBrink(j, s, k, end, &b)) j->brink[j->nbrinks++] = b;
}

Brink JointsPartedBrink(Joints j, int k, int end)
{
  const Joint *joint = &j->joint[k];
  const int star = joint->star[end], first = j->star_corner[star];
  Brink b = {.joint = k, .end = end};
  for (int c = first; c < j->star_corner[star + 1]; c++)
    for (int i = 0; i < 2; i++)
      if (j->corner[c].node == j->corner[joint->corner[end][i]].node) b.fan[i] |= (Fan)1 << (c - first);
  b.width = Width(j, star, b.fan, -1);
  return b;
}

/* --- forces
 * ------------------------------------------------------------------------------------------------- */

void JointsGhostForces(Joints j, Solid s)
{
  double *const *stress = s->elements.stress;
  for (int g = 0; g < j->nghosts; g++) {
    Ghost *k = &j->ghost[g];
    const int *n = k->node, place = s->elements.n + g;
    const Tensor edges = TensorOfEdges(PointAt(s->x, n[0]), PointAt(s->x, n[1]), PointAt(s->x, n[2]));
    const Tensor rate = TensorOfEdges(PointAt(s->v, n[0]), PointAt(s->v, n[1]), PointAt(s->v, n[2]));
    const Tensor f = TensorProduct(edges, k->inverse);
    const ElementStress t = ElementElasticStress(f, TensorDeterminant(f), k->law);
    const ElementStress d = ElementViscousStress(edges, rate, k->law.eta);
    const ElementForces all = ElementForcesOf(edges, (ElementStress){t.xx + d.xx, t.yy + d.yy, t.xy + d.xy});
    stress[0][place] = t.xx;
    stress[1][place] = t.yy;
    stress[2][place] = t.xy;
    k->force[0] = all.a;
    k->force[1] = all.b;
    k->force[2] = all.c;
  }
}

static Point CornerForce(const Joints j, const Solid s, const Corner *c)
{
  const Elements *e = &s->elements;
  if (c->place >= e->n) return j->ghost[c->place - e->n].force[c->corner];
  const int k = c->corner * e->n + c->place;
  return (Point){e->force[0][k], e->force[1][k]};
}

Point JointsBrinkTraction(Joints j, Solid s, const Brink *b)
{
  const int star = j->joint[b->joint].star[b->end], first = j->star_corner[star];
  Point force[2] = {{0.0, 0.0}, {0.0, 0.0}};
  double mass[2] = {0.0, 0.0};
  for (int c = first; c < j->star_corner[star + 1]; c++)
    for (int i = 0; i < 2; i++) {
      if (!(b->fan[i] & (Fan)1 << (c - first))) continue;
      const Point f = CornerForce(j, s, &j->corner[c]);
      force[i] = (Point){force[i].x + f.x, force[i].y + f.y};
      mass[i] += j->corner[c].mass;
    }
  const double scale = 1.0 / ((mass[0] + mass[1]) * b->width);
  return (Point){scale * (mass[0] * force[1].x - mass[1] * force[0].x),
                 scale * (mass[0] * force[1].y - mass[1] * force[0].y)};
}
