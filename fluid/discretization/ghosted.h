/* Ghosted vectors (VecCreateGhost): this rank's entries, then copies of other ranks'. */
#ifndef FLUID_GHOSTED_H
#define FLUID_GHOSTED_H
#include <petscvec.h>

/* Collective: copies get their owners' values. */
static inline PetscErrorCode GhostedUpdate(Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(VecGhostUpdateBegin(v, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(v, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(0);
}

/* Collective: owners' entries become the sum of theirs and all copies'. */
static inline PetscErrorCode GhostedSum(Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(VecGhostUpdateBegin(v, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateEnd(v, ADD_VALUES, SCATTER_REVERSE));
  PetscFunctionReturn(0);
}

/* Not collective, as VecGetArray and its kin: entries and copies in one array. */
static inline PetscErrorCode GhostedGetArray(Vec v, PetscScalar **a)
{
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(v, &local));
  PetscCall(VecGetArray(local, a));
  PetscCall(VecGhostRestoreLocalForm(v, &local));
  PetscFunctionReturn(0);
}

/* The same; all is 0 then. */
static inline PetscErrorCode GhostedGetArrayZero(Vec v, PetscScalar **a)
{
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(v, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, a));
  PetscCall(VecGhostRestoreLocalForm(v, &local));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode GhostedRestoreArray(Vec v, PetscScalar **a)
{
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(v, &local));
  PetscCall(VecRestoreArray(local, a));
  PetscCall(VecGhostRestoreLocalForm(v, &local));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode GhostedGetArrayRead(Vec v, const PetscScalar **a)
{
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(v, &local));
  PetscCall(VecGetArrayRead(local, a));
  PetscCall(VecGhostRestoreLocalForm(v, &local));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode GhostedRestoreArrayRead(Vec v, const PetscScalar **a)
{
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(v, &local));
  PetscCall(VecRestoreArrayRead(local, a));
  PetscCall(VecGhostRestoreLocalForm(v, &local));
  PetscFunctionReturn(0);
}

#endif
