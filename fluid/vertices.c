#include "fluid/vertices.h"
#include <petscvec.h>

PetscErrorCode VerticesNumber(const Mesh *m, PetscInt *owned, double number[])
{
  PetscInt start = 0;
  PetscScalar *v;
  Vec ghosted, local;
  PetscFunctionBeginUser;
  for (int k = 0; k < m->np2; k++) number[k] = -1.0;
  for (int k = 0; k < 3 * m->ne; k++) number[m->p2[6 * (k / 3) + k % 3]] = 0.0;
  *owned = 0;
  /* a rank may own a vertex none of whose elements it has */
  PetscCall(VecCreateGhost(m->comm, m->np2_owned, PETSC_DETERMINE, m->np2 - m->np2_owned,
                           m->p2gid + m->np2_owned, &ghosted));
  PetscCall(VecGhostGetLocalForm(ghosted, &local));
  PetscCall(VecGetArray(local, &v));
  PetscCall(PetscArraycpy(v, number, m->np2));
  PetscCall(VecRestoreArray(local, &v));
  PetscCall(VecGhostUpdateBegin(ghosted, MAX_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateEnd(ghosted, MAX_VALUES, SCATTER_REVERSE));
  PetscCall(VecGetArray(local, &v));
  for (int k = 0; k < m->np2_owned; k++) *owned += v[k] >= 0.0;
  PetscCallMPI(MPI_Exscan(owned, &start, 1, MPIU_INT, MPI_SUM, m->comm));
  for (int k = 0; k < m->np2_owned; k++)
    if (v[k] >= 0.0) v[k] = (double)start++;
  PetscCall(VecRestoreArray(local, &v));
  PetscCall(VecGhostUpdateBegin(ghosted, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(ghosted, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArray(local, &v));
  PetscCall(PetscArraycpy(number, v, m->np2));
  PetscCall(VecRestoreArray(local, &v));
  PetscCall(VecGhostRestoreLocalForm(ghosted, &local));
  PetscCall(VecDestroy(&ghosted));
  PetscFunctionReturn(0);
}
