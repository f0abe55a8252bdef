/* Nodes split where the bonds of their star are cut. */
#include "solid/cracks/joints_impl.h"

void JointsConnectCorners(const Joints j, int ncorners, int n, const Bond bond[], int root[])
{
  int merged = 1;
  for (int c = 0; c < ncorners; c++) root[c] = c;
  while (merged) {
    merged = 0;
    for (int k = 0; k < n; k++) {
      if (bond[k].joint >= 0 && j->memory[bond[k].joint].stage != JOINT_INTACT) continue;
      int *one = &root[bond[k].corner[0]], *two = &root[bond[k].corner[1]];
      merged |= *one != *two;
      *one = *two = PetscMin(*one, *two);
    }
  }
}

/* A node at the same place with the same velocity and history. */
static int CopyNode(Solid s, int from, long long gid)
{
  double *const field[] = {s->rest, s->x, s->v, s->start, s->load, s->interface_velocity};
  const int n = s->nnodes++;
  for (int k = 0; k < 6; k++)
    for (int c = 0; c < 2; c++) field[k][2 * n + c] = field[k][2 * from + c];
  s->gid[n] = gid;
  s->node_body[n] = s->node_body[from];
  s->base[n] = s->base[from];
  s->mass[n] = 0.0;
  s->inverse_mass[n] = s->inverse_mass[from];
  s->is_prescribed[n] = s->is_prescribed[from];
  return n;
}

static void SetCornerNode(Joints j, Solid s, Corner *corner, int node)
{
  const int ne = s->elements.n;
  corner->node = node;
  if (corner->place >= ne)
    j->ghost[corner->place - ne].node[corner->corner] = node;
  else if (corner->place >= 0)
    s->element[3 * corner->place + corner->corner] = s->elements.node[corner->corner][corner->place] = node;
}

/* What a corner's node was before its star split. */
typedef struct {
  double mass, load[2];
} Before;

/* Each node's mass from its corners; the load of a node is split between its parts by their masses, so that none is
 * accelerated otherwise than before. */
static void SplitMass(Solid s, int n, const Corner corner[], const Before before[])
{
  for (int c = 0; c < n; c++) s->mass[corner[c].node] = 0.0;
  for (int c = 0; c < n; c++) s->mass[corner[c].node] += corner[c].mass;
  for (int c = 0; c < n; c++) {
    const int k = corner[c].node;
    if (s->inverse_mass[k] > 0.0) s->inverse_mass[k] = 1.0 / s->mass[k];
    for (int i = 0; i < 2; i++) s->load[2 * k + i] = before[c].load[i] * (s->mass[k] / before[c].mass);
  }
}

void JointsSplitStar(Joints j, Solid s, int star)
{
  Corner *corner = j->corner + j->star_corner[star];
  const int n = j->star_corner[star + 1] - j->star_corner[star];
  int root[STAR_CORNERS], node[STAR_CORNERS];
  Before before[STAR_CORNERS];
  JointsConnectCorners(j, n, j->star_bond[star + 1] - j->star_bond[star], j->bond + j->star_bond[star], root);
  for (int c = 0; c < n; c++) {
    const int old = corner[c].node;
    before[c] = (Before){s->mass[old], {s->load[2 * old], s->load[2 * old + 1]}};
    node[c] = root[c] == c ? old : node[root[c]];
    for (int b = 0; b < c && root[c] == c; b++) /* the old node stays with the first of its parts */
      if (node[b] == old) {
        node[c] = CopyNode(s, old, j->first_gid + 3 * (long long)corner[c].element + corner[c].corner);
        break;
      }
  }
  for (int c = 0; c < n; c++) SetCornerNode(j, s, &corner[c], node[c]);
  SplitMass(s, n, corner, before);
}

void JointsRestoreStar(Joints j, Solid s, int star)
{
  const int first = j->star_corner[star], n = j->star_corner[star + 1] - first;
  Before before[STAR_CORNERS];
  for (int c = 0; c < n; c++) {
    before[c] = (Before){1.0, {0.0, 0.0}}; /* the coming step has loads of its own */
    SetCornerNode(j, s, &j->corner[first + c], j->saved_corner[first + c].node);
  }
  SplitMass(s, n, j->corner + first, before);
}

PetscErrorCode JointsPrescribeParts(Solid s)
{
  PetscFunctionBeginUser;
  s->nprescribed = s->nprescribed_first;
  for (int n = 0; n < s->nnodes; n++) {
    if (s->base[n] == n || !s->is_prescribed[n]) continue;
    PetscCall(PetscRealloc((size_t)(s->nprescribed + s->nprescribed_first) * sizeof *s->prescribed,
                           &s->prescribed));
    for (int k = 0; k < s->nprescribed_first; k++)
      if (s->prescribed[k].node == s->base[n])
        s->prescribed[s->nprescribed++] = (PrescribedNode){n, s->prescribed[k].motion};
  }
  PetscCall(PetscRealloc(2 * (size_t)s->nprescribed * sizeof *s->position_before, &s->position_before));
  PetscCall(PetscRealloc(2 * (size_t)s->nprescribed * sizeof *s->velocity_before, &s->velocity_before));
  PetscFunctionReturn(0);
}
