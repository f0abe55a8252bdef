#include "fluid/transport/phase_tension.h"
#include "fluid/phases/wetting.h"

struct PhaseTension_s {
  const Stars *stars; /* borrowed, like what follows */
  const PhaseProperties *properties;
  const PhaseBoundaries *boundaries;
  Wetting wetting; /* NULL: no surface tension, or no solid */
  char *moves;     /* [ne] */
};

PetscErrorCode PhaseTensionCreate(const Stars *stars, const PhaseProperties *properties,
                                  const PhaseBoundaries *boundaries, PhaseTension *tension)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(tension));
  (*tension)->stars = stars;
  (*tension)->properties = properties;
  (*tension)->boundaries = boundaries;
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTensionDestroy(PhaseTension *tension)
{
  PetscFunctionBeginUser;
  if (!*tension) PetscFunctionReturn(0);
  PetscCall(WettingDestroy(&(*tension)->wetting));
  PetscCall(PetscFree((*tension)->moves));
  PetscCall(PetscFree(*tension));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTensionSetSolid(PhaseTension t, const char moves[])
{
  PetscFunctionBeginUser;
  if (!PhaseHasTension(t->properties)) PetscFunctionReturn(0);
  if (!t->wetting) {
    PetscCall(WettingCreate(t->stars, t->properties->n, &t->wetting));
    PetscCall(PetscMalloc1(t->stars->ne, &t->moves));
  }
  if (moves)
    PetscCall(PetscArraycpy(t->moves, moves, t->stars->ne));
  else
    PetscCall(PetscArrayzero(t->moves, t->stars->ne));
  PetscFunctionReturn(0);
}

const char *PhaseTensionMoves(PhaseTension t)
{
  return t->moves;
}

PetscErrorCode PhaseTensionAdd(PhaseTension t, Phases phases, InverseDensity inverse[])
{
  const PhaseProperties *p = t->properties;
  double(*force)[2];
  PetscFunctionBeginUser;
  if (!PhaseHasTension(p)) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(t->stars->ne, &force));
  if (t->wetting) {
    const WettingSolid solid = {PhasesSolid(phases), t->moves, PhaseLightest(p)};
    const WettingSurface surface = {&p->surface_tension, t->boundaries->contact, &p->solid_cosine};
    PetscCall(WettingSurfaceForce(t->wetting, phases, &solid, &surface, (double *)force));
  } else {
    PetscCall(PhasesGetSurfaceForce(phases, &p->surface_tension, t->boundaries->contact, (double *)force));
  }
  for (int e = 0; e < t->stars->ne; e++) InverseDensityAddSurface(force[e], &inverse[e]);
  PetscCall(PetscFree(force));
  PetscFunctionReturn(0);
}
