/* Phases with the mesh and the stars that they stand on, made and destroyed together. */
#ifndef PHASES_SET_H
#define PHASES_SET_H
#include "fluid/phases/phases.h"

typedef struct {
  Mesh *mesh;
  Stars *stars;
  Phases phases;
} Set;

static PetscErrorCode SetMake(Mesh *mesh, int np, Set *s)
{
  PetscFunctionBeginUser;
  s->mesh = mesh;
  PetscCall(StarsCreate(mesh, &s->stars));
  PetscCall(PhasesCreate(s->stars, np, &s->phases));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetDestroy(Set *s)
{
  PetscFunctionBeginUser;
  PetscCall(PhasesDestroy(&s->phases));
  PetscCall(StarsDestroy(&s->stars));
  PetscCall(MeshDestroy(&s->mesh));
  PetscFunctionReturn(0);
}
#endif
