/* What is known of this rank's elements as long as none changes: those that are held, and where the forces of each node lie. */
#include "solid/solid_impl.h"

PetscBool SolidElementHeld(const Elements *e, int k, const double inverse_mass[])
{
  double mobility = 0.0;
  for (int i = 0; i < 3; i++) mobility += inverse_mass[e->node[i][k]] + inverse_mass[e->far[i][k]];
  return mobility == 0.0 ? PETSC_TRUE : PETSC_FALSE;
}

/* Its forces are zero, or act on nodes that cannot move. */
static PetscBool Idle(const Solid s, int k)
{
  const Elements *e = &s->elements;
  return (PetscBool)(s->body[e->body[k]].rigid.mass > 0.0 || SolidElementHeld(e, k, s->inverse_mass));
}

/* Strips of elements whose forces stay, and nodes that cannot move. */
static void FindHeld(Solid s)
{
  Elements *e = &s->elements;
  for (int k = 0; k < e->n; k++) e->held[k / STRIP] = Idle(s, k) && (k % STRIP == 0 || e->held[k / STRIP]);
  e->held_known = PETSC_FALSE;
  s->nfixed = 0;
  for (int n = 0; n < s->nnodes; n++)
    if (s->inverse_mass[n] == 0.0) s->fixed[s->nfixed++] = n;
}

/* The node of which the k-th of all force entries is a part, or -1: corners of elements, then nodes of six-node triangles. */
static int NodeOfForce(const Solid s, int k)
{
  const Elements *e = &s->elements;
  if (k < 3 * e->n) return e->six_node[k / 3] ? -1 : s->element[k];
  const int first = e->six_first[(k - 3 * e->n) / 6], i = (k - 3 * e->n) % 6;
  return s->element[3 * (first + i % 3) + i / 3];
}

void SolidListCorners(Solid s)
{
  const int ne = s->elements.n, n = 3 * ne + 6 * s->elements.nsix;
  int *end = s->corner_start + 1;
  for (int i = 0; i <= s->nnodes; i++) s->corner_start[i] = 0;
  for (int k = 0; k < n; k++)
    if (NodeOfForce(s, k) >= 0) end[NodeOfForce(s, k)]++;
  for (int i = 1; i < s->nnodes; i++) end[i] += end[i - 1];
  const int all = s->nnodes > 0 ? end[s->nnodes - 1] : 0;
  for (int k = n - 1; k >= 0; k--) /* fills from behind, then shifts back */
    if (NodeOfForce(s, k) >= 0) s->corner[--end[NodeOfForce(s, k)]] = k < 3 * ne ? (k % 3) * ne + k / 3 : k;
  for (int i = 0; i < s->nnodes; i++) s->corner_start[i] = end[i];
  s->corner_start[s->nnodes] = all;
  FindHeld(s);
}
