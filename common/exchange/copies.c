#include "common/exchange/copies_impl.h"
#include <string.h>

PetscErrorCode CopiesDestroy(Copies *copies)
{
  Copies c = *copies;
  PetscFunctionBeginUser;
  if (!c) PetscFunctionReturn(0);
  PetscCall(ScatterDestroy(&c->scatter));
  PetscCall(PetscFree(c->item));
  PetscCall(PetscFree(c->item_group));
  PetscCall(PetscFree(c->group));
  PetscCall(PetscFree2(c->owner, c->is_first));
  PetscCall(PetscFree(c->arrived));
  PetscCall(PetscFree(c->result));
  PetscCall(PetscFree(c->begun));
  PetscCall(PetscFree(*copies));
  PetscFunctionReturn(0);
}

int CopiesOwner(Copies c, int item)
{
  return c->owner[item];
}

PetscBool CopiesIsFirst(Copies c, int item)
{
  return c->is_first[item] ? PETSC_TRUE : PETSC_FALSE;
}

static PetscErrorCode Reserve(size_t bytes, size_t *capacity, char **buffer)
{
  PetscFunctionBeginUser;
  if (bytes <= *capacity) PetscFunctionReturn(0);
  PetscCall(PetscFree(*buffer));
  PetscCall(PetscMalloc1(bytes, buffer));
  *capacity = bytes;
  PetscFunctionReturn(0);
}

/* All copies of the shared items, in c->arrived; room for the groups in c->result. */
static PetscErrorCode Gather(Copies c, size_t bytes, const void *value)
{
  PetscFunctionBeginUser;
  PetscCall(Reserve(bytes * (size_t)ScatterArriving(c->scatter), &c->arrived_capacity, &c->arrived));
  PetscCall(Reserve(bytes * (size_t)c->ngroups, &c->result_capacity, &c->result));
  PetscCall(ScatterForward(c->scatter, bytes, value, c->arrived));
  PetscFunctionReturn(0);
}

/* value[item] = result of its group */
static void Distribute(Copies c, size_t bytes, void *value)
{
  for (int k = 0; k < c->nshared; k++)
    memcpy((char *)value + bytes * (size_t)c->item[k], c->result + bytes * (size_t)c->item_group[k], bytes);
}

PetscErrorCode CopiesSum(Copies c, int ncomp, double value[])
{
  const size_t bytes = (size_t)ncomp * sizeof *value;
  PetscFunctionBeginUser;
  PetscCall(Gather(c, bytes, value));
  const double *in = (const double *)(const void *)c->arrived;
  double *sum = (double *)(void *)c->result;
  PetscCall(PetscArrayzero(sum, (size_t)ncomp * (size_t)c->ngroups));
  for (int k = 0; k < ScatterArriving(c->scatter); k++)
    for (int d = 0; d < ncomp; d++) sum[ncomp * c->group[k] + d] += in[ncomp * k + d];
  Distribute(c, bytes, value);
  PetscFunctionReturn(0);
}

PetscErrorCode CopiesMin(Copies c, int ncomp, double value[])
{
  const size_t bytes = (size_t)ncomp * sizeof *value;
  PetscFunctionBeginUser;
  PetscCall(Gather(c, bytes, value));
  const double *in = (const double *)(const void *)c->arrived;
  double *least = (double *)(void *)c->result;
  for (int k = 0; k < ncomp * c->ngroups; k++) least[k] = PETSC_INFINITY;
  for (int k = 0; k < ScatterArriving(c->scatter); k++)
    for (int d = 0; d < ncomp; d++)
      least[ncomp * c->group[k] + d] = PetscMin(least[ncomp * c->group[k] + d], in[ncomp * k + d]);
  Distribute(c, bytes, value);
  PetscFunctionReturn(0);
}

PetscErrorCode CopiesReduce(Copies c, size_t bytes, CopiesFold fold, void *value)
{
  PetscFunctionBeginUser;
  PetscCall(Gather(c, bytes, value));
  PetscCall(PetscArrayzero(c->begun, c->ngroups));
  for (int k = 0; k < ScatterArriving(c->scatter); k++) {
    const char *next = c->arrived + bytes * (size_t)k;
    char *into = c->result + bytes * (size_t)c->group[k];
    if (c->begun[c->group[k]])
      fold(into, next);
    else
      memcpy(into, next, bytes);
    c->begun[c->group[k]] = 1;
  }
  Distribute(c, bytes, value);
  PetscFunctionReturn(0);
}
