#include "solid/ranks/state.h"
#include <stdlib.h>

/* --- nodes -------------------------------------------------------------------------------------------- */

void StateOfNode(const Solid s, int n, void *record)
{
  NodeState *to = record;
  to->mobility = s->mobility[n];
  for (int c = 0; c < 2; c++) {
    const int k = 2 * n + c;
    to->x[c] = s->x[k];
    to->v[c] = s->v[k];
    to->start[c] = s->start[k];
    to->load[c] = s->load[k];
    to->interface_velocity[c] = s->interface_velocity[k];
    to->acceleration[c] = s->acceleration[k];
  }
}

static void SetNode(Solid s, int n, const NodeState *from)
{
  s->mobility[n] = from->mobility;
  for (int c = 0; c < 2; c++) {
    const int k = 2 * n + c;
    s->x[k] = from->x[c];
    s->v[k] = from->v[c];
    s->start[k] = from->start[c];
    s->load[k] = from->load[c];
    s->interface_velocity[k] = from->interface_velocity[c];
    s->acceleration[k] = from->acceleration[c];
  }
}

static PetscErrorCode TakeNodes(Solid s, const StateSource *from)
{
  NodeState *state;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)s->nnodes, &state));
  PetscCall(from->nodes(from->context, s, state));
  for (int n = 0; n < s->nnodes; n++) SetNode(s, n, &state[n]);
  PetscCall(PetscFree(state));
  PetscFunctionReturn(0);
}

/* --- springs of friction ------------------------------------------------------------------------------ */

PetscErrorCode StateOfSlips(Solid s, int *n, Slip **slip)
{
  const Slip *own;
  PetscFunctionBeginUser;
  PetscCall(ContactSlips(s->contact, n, &own));
  PetscCall(PetscMalloc1((size_t)*n, slip));
  for (int k = 0; k < *n; k++)
    (*slip)[k] = (Slip){3 * s->elements.number[own[k].edge / 3] + own[k].edge % 3, own[k].other,
                        own[k].material, own[k].slip};
  PetscFunctionReturn(0);
}

static int CompareNumbers(const void *a, const void *b)
{
  const long long p = *(const long long *)a, q = *(const int *)b;
  return (p > q) - (p < q);
}

int StateElement(const Solid s, long long number)
{
  const Elements *e = &s->elements;
  const int *found =
      e->n ? bsearch(&number, e->number, (size_t)e->n, sizeof *e->number, CompareNumbers) : NULL;
  return found ? (int)(found - e->number) : -1;
}

static PetscErrorCode TakeSlips(Solid s, const StateSource *from)
{
  Slip *slip;
  int n;
  PetscFunctionBeginUser;
  PetscCall(from->slips(from->context, s, &n, &slip));
  for (int k = 0; k < n; k++) {
    const int element = StateElement(s, slip[k].edge / 3);
    PetscCheck(element >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "element %d is not here", slip[k].edge / 3);
    slip[k].edge = 3 * element + slip[k].edge % 3;
  }
  PetscCall(ContactTakeSlips(s->contact, n, slip));
  PetscCall(PetscFree(slip));
  PetscFunctionReturn(0);
}

/* --- all ---------------------------------------------------------------------------------------------- */

/* First the joints: by the numbers of their corners the parts of nodes get the gid that they had. */
PetscErrorCode SolidTakeState(Solid s, const StateSource *from)
{
  PetscFunctionBeginUser;
  if (s->joints) {
    PetscCall(from->joints(from->context, s->joints));
    PetscCall(JointsReplay(s->joints, s));
  }
  PetscCall(TakeNodes(s, from));
  PetscCall(TakeSlips(s, from));
  s->force_valid = PETSC_FALSE;
  if (s->joints)
    PetscCall(JointsSynchronise(s->joints, s));
  else
    PetscCall(ContactSearch(s->contact, s, NULL));
  PetscFunctionReturn(0);
}
