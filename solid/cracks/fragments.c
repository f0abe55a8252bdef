/* What cracks have done: sums over the joints, damage of the elements, and the pieces that are left. */
#include "common/exchange/scatter.h"
#include "solid/cracks/joints_impl.h"

PetscErrorCode SolidFracture(Solid s, FractureState *state)
{
  double sum[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
  const double *force;
  const int *piece;
  const Joints j = s->joints;
  PetscFunctionBeginUser;
  *state = (FractureState){0};
  PetscCall(SolidPieces(s, &state->pieces, &piece));
  if (!j) PetscFunctionReturn(0);
  PetscCall(SolidForces(s, &force));
  for (int k = 0; k < j->n; k++) {
    const JointMemory *m = &j->memory[k];
    if (!j->joint[k].mine || m->stage == JOINT_INTACT) continue;
    sum[m->stage == JOINT_ACTIVE ? 0 : 1] += 1.0;
    for (int end = 0; end < 2; end++) {
      const double half = 0.5 * j->joint[k].length, energy = half * m->end[end].absorbed;
      sum[3] += energy;
      if (m->end[end].damage < 1.0) continue;
      sum[2] += half;
      sum[4] += energy;
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 5, MPI_DOUBLE, MPI_SUM, s->comm));
  state->active = (int)sum[0];
  state->broken = (int)sum[1];
  state->length = sum[2];
  state->energy = sum[3];
  state->debonded = sum[4];
  PetscFunctionReturn(0);
}

void SolidDamage(Solid s, double damage[])
{
  const Joints j = s->joints;
  for (int e = 0; e < s->elements.n; e++) damage[e] = 0.0;
  for (int k = 0; j && k < j->n; k++) {
    if (!j->joint[k].followed) continue;
    const double most = fmax(j->memory[k].end[0].damage, j->memory[k].end[1].damage);
    for (int i = 0; i < 2; i++) {
      const int e = j->joint[k].place[i];
      if (e < s->elements.n) damage[e] = fmax(damage[e], most);
    }
  }
}

/* --- pieces ------------------------------------------------------------------------------------------- */

static void Lower(double label[], int n, const int node[], PetscBool *changed)
{
  double least = HUGE_VAL;
  for (int i = 0; i < n; i++) least = fmin(least, label[node[i]]);
  for (int i = 0; i < n; i++) {
    if (label[node[i]] > least) *changed = PETSC_TRUE;
    label[node[i]] = least;
  }
}

/* One sweep over what holds nodes together: elements, and joints that are not broken. */
static PetscBool Sweep(const Solid s, double label[])
{
  const Joints j = s->joints;
  PetscBool changed = PETSC_FALSE;
  for (int e = 0; e < s->elements.n; e++) Lower(label, 3, s->element + 3 * e, &changed);
  for (int e = s->elements.n - 1; e >= 0; e--) Lower(label, 3, s->element + 3 * e, &changed);
  for (int k = 0; j && k < j->nactive; k++)
    for (int end = 0; end < 2; end++) {
      const int *corner = j->joint[j->active[k]].corner[end];
      const int node[2] = {j->corner[corner[0]].node, j->corner[corner[1]].node};
      Lower(label, 2, node, &changed);
    }
  return changed;
}

/* label[nnodes]: the lowest global number of the piece's nodes. */
static PetscErrorCode LabelNodes(Solid s, double label[])
{
  int any = 1;
  PetscFunctionBeginUser;
  for (int n = 0; n < s->nnodes; n++) label[n] = (double)s->gid[n];
  while (any) {
    PetscBool changed = PETSC_FALSE;
    while (Sweep(s, label)) changed = PETSC_TRUE;
    PetscCall(CopiesMin(s->copies, 1, label));
    any = changed;
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, s->comm));
  }
  PetscFunctionReturn(0);
}

/* number[nnodes] = place of the node's label among all labels of all ranks */
static PetscErrorCode NumberLabels(Solid s, const double label[], int number[], int *n)
{
  PetscInt mine = s->nnodes, total, *own, *all;
  void *gathered;
  int labels;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)mine, &own));
  for (int i = 0; i < s->nnodes; i++) own[i] = (PetscInt)label[i];
  PetscCall(PetscSortRemoveDupsInt(&mine, own));
  PetscCall(GatherRecords(s->comm, (int)mine, sizeof *own, own, &labels, &gathered));
  all = gathered;
  total = labels;
  PetscCall(PetscSortRemoveDupsInt(&total, all));
  for (int i = 0; i < s->nnodes; i++) {
    PetscInt place;
    PetscCall(PetscFindInt((PetscInt)label[i], total, all, &place));
    number[i] = (int)place;
  }
  *n = (int)total;
  PetscCall(PetscFree(own));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidPieces(Solid s, int *n, const int **piece)
{
  double *label;
  PetscFunctionBeginUser;
  if (s->npieces == 0) {
    PetscCall(PetscMalloc1((size_t)s->nnodes, &label));
    PetscCall(LabelNodes(s, label));
    PetscCall(NumberLabels(s, label, s->piece, &s->npieces));
    PetscCall(PetscFree(label));
  }
  *n = s->npieces;
  *piece = s->piece;
  PetscFunctionReturn(0);
}

PetscErrorCode SolidFragments(Solid s, int fragment[], int *n)
{
  const int *piece;
  PetscFunctionBeginUser;
  PetscCall(SolidPieces(s, n, &piece));
  for (int e = 0; e < s->elements.n; e++) fragment[e] = piece[s->element[3 * e]];
  PetscFunctionReturn(0);
}
