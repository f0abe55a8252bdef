/* Crack-tip nodes: where the cut of one more edge would split a node.  There the edge's load is not the
 * stress beside it but what its node has to bear.  Let A and B be the corners that the cut would part, with
 * the elements' forces F on them and the masses m; they move together because B exerts on A
 *
 *     H = (m_A F_B - m_B F_A)/(m_A + m_B)
 *
 * whatever else acts on the node (it accelerates both alike).  Over the edges between A and B, half of each,
 * this is a traction; with it a joint activates without a jump of any force, and at the tip of a crack it
 * is the one that a joint of infinite stiffness would carry. */
#include "solid/cracks/joints_impl.h"

/* Corners that bonds connect with corner c; the bond of joint `without` does not count. */
static CornerSet CornerSetOf(const Joints j, int star, int c, int without)
{
  const Bond *bond = j->bond + j->star_bond[star];
  const int n = j->star_bond[star + 1] - j->star_bond[star];
  CornerSet corners = (CornerSet)1 << c, before = 0;
  while (corners != before) {
    before = corners;
    for (int k = 0; k < n; k++) {
      const int joint = bond[k].joint;
      if (joint >= 0 && (joint == without || j->memory[joint].stage != JOINT_INTACT)) continue;
      const CornerSet both = (CornerSet)1 << bond[k].corner[0] | (CornerSet)1 << bond[k].corner[1];
      if (corners & both) corners |= both;
    }
  }
  return corners;
}

/* Half the lengths of the joints between two corner sets: of the intact one and of those active whose nodes are still
 * one. */
static double Width(const Joints j, int star, const CornerSet corners[2], int intact)
{
  double width = 0.0;
  for (int k = j->star_bond[star]; k < j->star_bond[star + 1]; k++) {
    const int joint = j->bond[k].joint, *c = j->bond[k].corner;
    if (joint < 0 || (joint != intact && j->memory[joint].stage != JOINT_ACTIVE)) continue;
    const CornerSet one = (CornerSet)1 << c[0], two = (CornerSet)1 << c[1];
    const PetscBool between =
        (PetscBool)(((corners[0] & one) && (corners[1] & two)) || ((corners[0] & two) && (corners[1] & one)));
    const int end = j->joint[joint].star[0] == star ? 0 : 1;
    if (between && j->memory[joint].end[end].begun == 0.0) width += 0.5 * j->joint[joint].length;
  }
  return width;
}

/* A prescribed motion acts on the node, or on the one that it is a part of. */
static PetscBool IsMoved(const Solid s, int node)
{
  for (int k = 0; k < s->nprescribed_first && s->is_prescribed[node]; k++)
    if (s->prescribed[k].node == s->base[node] &&
        PrescribedActs(&s->motion[s->prescribed[k].motion], s->stats.t))
      return PETSC_TRUE;
  return PETSC_FALSE;
}

static int CountActing(const Solid s)
{
  int n = 0;
  for (int k = 0; k < s->nmotions; k++) n += PrescribedActs(&s->motion[k], s->stats.t);
  return n;
}

static PetscBool AtCrackTip(const Joints j, const Solid s, int k, int end, CrackTip *b)
{
  const Joint *joint = &j->joint[k];
  const int star = joint->star[end], first = j->star_corner[star];
  const int one = joint->corner[end][0] - first, two = joint->corner[end][1] - first;
  *b = (CrackTip){.joint = k, .end = end};
  const int node = j->corner[first + one].node;
  if (s->inverse_mass[node] == 0.0 || IsMoved(s, node)) return PETSC_FALSE; /* its parts stay together */
  b->corners[0] = CornerSetOf(j, star, one, k);
  if (b->corners[0] & (CornerSet)1 << two) return PETSC_FALSE;
  b->corners[1] = CornerSetOf(j, star, two, k);
  b->width = Width(j, star, b->corners, k);
  return PETSC_TRUE;
}

void JointsFindCrackTips(Joints j, Solid s, PetscBool all)
{
  CrackTip b;
  if (all) j->nacting = CountActing(s);
  for (int k = 0; k < j->n; k++) {
    const Joint *joint = &j->joint[k];
    for (int end = 0; end < 2 && joint->mine; end++)
      if (all || j->marked[joint->star[end]])
        j->at_tip[k][end] = j->memory[k].stage == JOINT_INTACT && AtCrackTip(j, s, k, end, &b);
  }
  j->ntips = 0;
  for (int k = 0; k < j->n; k++)
    for (int end = 0; end < 2 && j->joint[k].mine && j->memory[k].stage == JOINT_INTACT; end++)
      if (j->at_tip[k][end] && AtCrackTip(j, s, k, end, &b)) j->tip[j->ntips++] = b;
}

void JointsFollowMotions(Joints j, Solid s)
{
  if (CountActing(s) == j->nacting) return;
  JointsFindCrackTips(j, s, PETSC_TRUE);
  JointsList(j);
}

CrackTip JointsPartedCrackTip(Joints j, int k, int end)
{
  const Joint *joint = &j->joint[k];
  const int star = joint->star[end], first = j->star_corner[star];
  CrackTip b = {.joint = k, .end = end};
  for (int c = first; c < j->star_corner[star + 1]; c++)
    for (int i = 0; i < 2; i++)
      if (j->corner[c].node == j->corner[joint->corner[end][i]].node)
        b.corners[i] |= (CornerSet)1 << (c - first);
  b.width = Width(j, star, b.corners, -1);
  return b;
}

/* --- forces ------------------------------------------------------------------------------------------- */

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

Point JointsCrackTipTraction(Joints j, Solid s, const CrackTip *b)
{
  const int star = j->joint[b->joint].star[b->end], first = j->star_corner[star];
  Point force[2] = {{0.0, 0.0}, {0.0, 0.0}};
  double mass[2] = {0.0, 0.0};
  for (int c = first; c < j->star_corner[star + 1]; c++)
    for (int i = 0; i < 2; i++) {
      if (!(b->corners[i] & (CornerSet)1 << (c - first))) continue;
      const Point f = CornerForce(j, s, &j->corner[c]);
      force[i] = (Point){force[i].x + f.x, force[i].y + f.y};
      mass[i] += j->corner[c].mass;
    }
  const double scale = 1.0 / ((mass[0] + mass[1]) * b->width);
  return (Point){scale * (mass[0] * force[1].x - mass[1] * force[0].x),
                 scale * (mass[0] * force[1].y - mass[1] * force[0].y)};
}
