/* The joints of this rank, from the model. */
#include "solid/cracks/joints_impl.h"
#include <stdint.h>
#include <stdlib.h>

typedef struct {
  Solid s;
  const Model *a;
  const InteriorEdges *edges;
  int nghosts;
  const GhostElement *ghost;
  const int *part, *local;
  int *place; /* [a->nelements] as in Corner */
  int *star;  /* [a->nnodes] or -1 */
} Making;

/* --- elements ----------------------------------------------------------------------------------------- */

static void AddGhost(Joints j, const Making *m, int e)
{
  Ghost *g = &j->ghost[j->nghosts];
  *g = (Ghost){.inverse = TensorInverse(ModelRestEdges(m->a, e)), .law = ModelElementLaw(m->a, e)};
  for (int i = 0; i < 3; i++) g->node[i] = m->local[m->a->element[3 * e + i]];
  m->place[e] = m->s->elements.n + j->nghosts++;
}

/* Own elements, and the ghosts. */
static PetscErrorCode PlaceElements(Joints j, const Making *m)
{
  PetscFunctionBeginUser;
  for (int e = 0; e < m->a->nelements; e++) m->place[e] = -1;
  for (int k = 0; k < m->s->elements.n; k++) m->place[m->s->elements.number[k]] = k;
  PetscCall(PetscMalloc1((size_t)m->nghosts, &j->ghost));
  for (int k = 0; k < m->nghosts; k++)
    if (m->ghost[k].rank == m->s->rank) AddGhost(j, m, m->ghost[k].element);
  const size_t n = (size_t)(m->s->elements.n + j->nghosts);
  double **stress = m->s->elements.stress;
  PetscCall(PetscCalloc3(n, &stress[0], n, &stress[1], n, &stress[2]));
  PetscFunctionReturn(0);
}

/* --- stars -------------------------------------------------------------------------------------------- */

static void NumberStars(Joints j, const Making *m)
{
  for (int n = 0; n < m->a->nnodes; n++) m->star[n] = -1;
  for (int k = 0; k < m->edges->n; k++)
    for (int i = 0; i < 2 && m->edges->edge[k].joint >= 0; i++) {
      const int n = m->edges->edge[k].node[i];
      if (m->local[n] >= 0 && m->star[n] < 0) m->star[n] = j->nstars++;
    }
}

/* Elements in ascending order. */
static PetscErrorCode GatherCorners(Joints j, const Making *m)
{
  const Model *a = m->a;
  int *start;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)j->nstars + 2, &j->star_corner));
  start = j->star_corner + 1; /* shifted: filling moves it to where it belongs */
  for (int k = 0; k < 3 * a->nelements; k++)
    if (m->star[a->element[k]] >= 0) start[m->star[a->element[k]] + 1]++;
  for (int s = 0; s < j->nstars; s++) start[s + 1] += start[s];
  j->ncorners = start[j->nstars];
  for (int s = 0; s < j->nstars; s++)
    PetscCheck(start[s + 1] - start[s] <= STAR_CORNERS, PETSC_COMM_SELF, PETSC_ERR_SUP,
               "a node with joints has %d elements, at most %d can be", start[s + 1] - start[s],
               STAR_CORNERS);
  PetscCall(PetscMalloc2((size_t)j->ncorners, &j->corner, (size_t)j->ncorners, &j->saved_corner));
  for (int k = 0; k < 3 * a->nelements; k++) {
    const int e = k / 3, star = m->star[a->element[k]];
    if (star < 0) continue;
    const double mass = ModelCornerMass(a, k);
    j->corner[start[star]++] = (Corner){e, k % 3, m->place[e], m->local[a->element[k]], mass};
  }
  PetscFunctionReturn(0);
}

static int FindCorner(const Joints j, int star, int element)
{
  for (int k = j->star_corner[star]; k < j->star_corner[star + 1]; k++)
    if (j->corner[k].element == element) return k - j->star_corner[star];
  return -1;
}

/* Parts of a star that no edge connects from the start (two bodies' corners that meet in a node) stay bonded. */
static int BondLoose(const Joints j, int star, int n, Bond bond[])
{
  const int corners = j->star_corner[star + 1] - j->star_corner[star];
  int root[STAR_CORNERS];
  JointsConnectCorners(j, corners, n, bond, root);
  for (int c = 1; c < corners; c++)
    if (root[c] == c) bond[n++] = (Bond){{0, c}, -1};
  return n;
}

/* index[njoints]: this rank's joints by number, or -1 */
static PetscErrorCode GatherBonds(Joints j, const Making *m, const int index[])
{
  int *start, *count;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)j->nstars + 1, &j->star_bond));
  start = j->star_bond;
  for (int s = 0; s < j->nstars; s++) /* an edge has two corners, and loose parts are fewer than corners */
    start[s + 1] = start[s] + 2 * (j->star_corner[s + 1] - j->star_corner[s]);
  PetscCall(PetscMalloc1((size_t)start[j->nstars], &j->bond));
  PetscCall(PetscCalloc1((size_t)j->nstars, &count));
  for (int k = 0; k < m->edges->n; k++)
    for (int i = 0; i < 2; i++) {
      const InteriorEdge *edge = &m->edges->edge[k];
      const int s = m->star[edge->node[i]];
      if (s < 0) continue;
      j->bond[start[s] + count[s]++] =
          (Bond){{FindCorner(j, s, edge->element[0]), FindCorner(j, s, edge->element[1])},
                 edge->joint < 0 ? -1 : index[edge->joint]};
    }
  for (int s = 0, kept = 0; s < j->nstars; s++) {
    const int from = start[s], n = BondLoose(j, s, count[s], j->bond + from);
    for (int k = 0; k < n; k++) j->bond[kept + k] = j->bond[from + k];
    start[s] = kept;
    kept += n;
    j->nbonds = kept;
  }
  start[j->nstars] = j->nbonds;
  PetscCall(PetscFree(count));
  PetscFunctionReturn(0);
}

/* --- joints ------------------------------------------------------------------------------------------- */

/* 0 < U < 1 of a joint, by its number alone (SplitMix64), whatever the ranks. */
static double Uniform(int seed, int joint)
{
  uint64_t z = ((uint64_t)(uint32_t)seed << 32 | (uint32_t)joint) + 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return ((double)(z >> 11) + 0.5) / 9007199254740992.0; /* 2^53 */
}

/* Weibull's distribution with mean 1: P(factor < f) = 1 - exp(-(f Gamma(1 + 1/m))^m). */
static double StrengthFactor(const Material *material, int joint)
{
  const double m = material->weibull_modulus;
  return m == 0.0 ? 1.0 : pow(-log(Uniform(material->weibull_seed, joint)), 1.0 / m) / tgamma(1.0 + 1.0 / m);
}

/* Between two materials the weaker one counts, unless the joint has one of its own.  All is times the thickness, as the elements' stresses are. It
 * is pressed as contact presses: an edge on both sides of which phi = 3 depth/height acts with the penalty.
 */
static JointLaw LawOf(const Model *a, const InteriorEdge *edge, double length)
{
  const Material *beside[2], *one, *two;
  const int own = a->joint_material[3 * edge->element[0] + edge->side[0]];
  for (int i = 0; i < 2; i++) beside[i] = &a->material[a->element_material[edge->element[i]]];
  const double thickness = fmin(beside[0]->thickness, beside[1]->thickness);
  one = own < 0 ? beside[0] : &a->material[own];
  two = own < 0 ? beside[1] : one;
  const double of_one = StrengthFactor(one, edge->joint), of_two = StrengthFactor(two, edge->joint);
  JointLaw law = {.friction = fmin(one->internal_friction, two->internal_friction)};
  for (int i = 0; i < 2; i++) {
    law.strength[i] = thickness * fmin(of_one * one->strength[i], of_two * two->strength[i]);
    law.energy[i] = thickness * fmin(one->fracture_energy[i], two->fracture_energy[i]);
    law.stiffness += 3.0 * thickness * fmin(beside[0]->penalty, beside[1]->penalty) * length /
                     TensorDeterminant(ModelRestEdges(a, edge->element[i]));
  }
  return law;
}

static Joint JointOf(const Joints j, const Making *m, const InteriorEdge *edge)
{
  const Model *a = m->a;
  const Point d = PointMinus(PointAt(a->rest, edge->node[1]), PointAt(a->rest, edge->node[0]));
  Joint joint = {.number = edge->joint,
                 .first = edge->element[0],
                 .second = edge->element[1],
                 .body = a->element_body[edge->element[0]],
                 .material = a->joint_material[3 * edge->element[0] + edge->side[0]],
                 .length = hypot(d.x, d.y)};
  joint.law = LawOf(a, edge, joint.length);
  for (int i = 0; i < 2; i++) {
    joint.place[i] = m->place[edge->element[i]];
    joint.side[i] = edge->side[i];
    joint.star[i] = m->star[edge->node[i]];
  }
  joint.followed =
      (PetscBool)(m->part[edge->element[0]] == m->s->rank || m->part[edge->element[1]] == m->s->rank);
  joint.mine = (PetscBool)(m->part[edge->element[0]] == m->s->rank);
  for (int end = 0; end < 2; end++)
    for (int i = 0; i < 2; i++)
      joint.corner[end][i] =
          joint.followed ? j->star_corner[joint.star[end]] + FindCorner(j, joint.star[end], edge->element[i])
                         : -1;
  return joint;
}

static PetscErrorCode GatherJoints(Joints j, const Making *m, int index[])
{
  PetscFunctionBeginUser;
  for (int pass = 0; pass < 2; pass++) {
    j->n = 0;
    for (int k = 0; k < m->edges->n; k++) {
      const InteriorEdge *edge = &m->edges->edge[k];
      if (edge->joint < 0) continue;
      index[edge->joint] = -1;
      if (m->star[edge->node[0]] < 0 && m->star[edge->node[1]] < 0) continue;
      index[edge->joint] = j->n;
      if (pass) j->joint[j->n] = JointOf(j, m, edge);
      j->n++;
    }
    if (!pass) PetscCall(PetscMalloc1((size_t)j->n, &j->joint));
  }
  const size_t n = (size_t)j->n;
  InitiationList *w = &j->initiation;
  PetscCall(PetscCalloc5(n, &j->memory, n, &j->saved, n, &j->active, n, &j->at_tip, 2 * n, &j->tip));
  PetscCall(PetscMalloc7(n, &w->joint, n, &w->place[0], n, &w->place[1], n, &w->node[0], n, &w->node[1], n,
                         &w->inverse_square[0], n, &w->inverse_square[1]));
  PetscCall(PetscMalloc1(n, &w->friction));
  PetscFunctionReturn(0);
}

PetscErrorCode JointsCreate(Solid s, const Model *a, const InteriorEdges *edges, int nghosts,
                            const GhostElement ghost[], const int part[], const int local[], Joints *joints)
{
  Making m = {s, a, edges, nghosts, ghost, part, local, NULL, NULL};
  Joints j;
  int *index;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&j));
  PetscCall(PetscMalloc3((size_t)a->nelements, &m.place, (size_t)a->nnodes, &m.star, (size_t)edges->njoints,
                         &index));
  PetscCall(PlaceElements(j, &m));
  NumberStars(j, &m);
  PetscCall(GatherCorners(j, &m));
  PetscCall(GatherJoints(j, &m, index));
  PetscCall(GatherBonds(j, &m, index));
  PetscCall(PetscCalloc2((size_t)j->nstars, &j->marked, (size_t)j->nstars, &j->cut));
  j->first_gid = a->nnodes;
  JointsFindCrackTips(j, s, PETSC_TRUE);
  JointsList(j);
  PetscCall(PetscFree3(m.place, m.star, index));
  *joints = j;
  PetscFunctionReturn(0);
}

PetscErrorCode JointsDestroy(Joints *j)
{
  PetscFunctionBeginUser;
  if (!*j) PetscFunctionReturn(0);
  PetscCall(PetscFree((*j)->star_corner));
  PetscCall(PetscFree((*j)->star_bond));
  PetscCall(PetscFree2((*j)->corner, (*j)->saved_corner));
  PetscCall(PetscFree((*j)->bond));
  PetscCall(PetscFree((*j)->joint));
  PetscCall(PetscFree((*j)->ghost));
  InitiationList *w = &(*j)->initiation;
  PetscCall(PetscFree5((*j)->memory, (*j)->saved, (*j)->active, (*j)->at_tip, (*j)->tip));
  PetscCall(PetscFree7(w->joint, w->place[0], w->place[1], w->node[0], w->node[1], w->inverse_square[0],
                       w->inverse_square[1]));
  PetscCall(PetscFree(w->friction));
  PetscCall(PetscFree2((*j)->marked, (*j)->cut));
  PetscCall(PetscFree(*j));
  PetscFunctionReturn(0);
}

int JointsResolution(Joints j, Solid s, double *zone)
{
  int n = 0;
  *zone = HUGE_VAL;
  for (int k = 0; j && k < j->n; k++) {
    const Joint *joint = &j->joint[k];
    const JointLaw *law = &joint->law;
    if (!joint->mine) continue;
    const Material *m = &s->material[s->elements.material[joint->place[0]]];
    const double of_edge = law->energy[0] / (law->strength[0] * joint->length);
    *zone = fmin(*zone, m->youngs_modulus * m->thickness / law->strength[0] * of_edge);
    n++;
  }
  return n;
}

double JointsDirections(Joints j, Solid s)
{
  static const double FOLDS[] = {2.0, 6.0, 8.0}; /* a line; 60 degrees; 45 degrees */
  double sum[3][2] = {{0.0}}, length = 0.0, order[3];
  for (int k = 0; j && k < j->n; k++) {
    const Joint *joint = &j->joint[k];
    if (!joint->mine) continue;
    const int one = j->corner[joint->corner[0][0]].node, two = j->corner[joint->corner[1][0]].node;
    const Point d = PointMinus(PointAt(s->rest, two), PointAt(s->rest, one));
    const double angle = atan2(d.y, d.x);
    for (int f = 0; f < 3; f++) {
      sum[f][0] += joint->length * cos(FOLDS[f] * angle);
      sum[f][1] += joint->length * sin(FOLDS[f] * angle);
    }
    length += joint->length;
  }
  for (int f = 0; f < 3; f++) order[f] = hypot(sum[f][0], sum[f][1]) / fmax(length, 1e-300);
  return order[0] > 0.5 ? 0.0 : fmax(order[1], order[2]);
}
