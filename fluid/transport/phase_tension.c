#include "fluid/transport/phase_tension.h"
#include "fluid/phases/wetting.h"

struct PhaseTension_s {
  const Stars *stars; /* borrowed, like what follows */
  const PhaseProperties *properties;
  const PhaseBoundaries *boundaries;
  Wetting wetting; /* NULL: no surface tension, or no solid so far */
  double *alpha;   /* [ne] */
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
  PetscCall(PetscFree2((*tension)->alpha, (*tension)->moves));
  PetscCall(PetscFree(*tension));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTensionSetSolid(PhaseTension t, const double alpha[], const char moves[])
{
  const int ne = t->stars->ne;
  int solid = 0;
  PetscFunctionBeginUser;
  if (!alpha || !PhaseHasTension(t->properties)) PetscFunctionReturn(0);
  for (int e = 0; e < ne; e++) solid |= alpha[e] > 0.0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &solid, 1, MPI_INT, MPI_LOR, t->stars->mesh->comm));
  if (!solid && !t->wetting) PetscFunctionReturn(0);
  if (!t->wetting) {
    PetscCall(WettingCreate(t->stars, t->properties->n, &t->wetting));
    PetscCall(PetscMalloc2(ne, &t->alpha, ne, &t->moves));
  }
  PetscCall(PetscArraycpy(t->alpha, alpha, ne));
  PetscCall(PetscArraycpy(t->moves, moves, ne));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTensionRemap(PhaseTension from, Transfer transfer, PhaseTension to)
{
  enum { FIELDS = 2 };
  const int nfrom = from->stars->ne, nto = to->stars->ne;
  double(*old)[FIELDS][3], (*new)[FIELDS][3], *alpha;
  char *moves;
  PetscFunctionBeginUser;
  if (!from->wetting) PetscFunctionReturn(0);
  PetscCall(PetscMalloc4(nfrom, &old, nto, &new, nto, &alpha, nto, &moves));
  for (int e = 0; e < nfrom; e++)
    for (int i = 0; i < 3; i++) {
      old[e][0][i] = from->alpha[e];
      old[e][1][i] = from->moves[e] ? from->alpha[e] : 0.0;
    }
  PetscCall(TransferP1DG(transfer, FIELDS, (const double *)old, (double *)new));
  for (int e = 0; e < nto; e++) {
    double mean[FIELDS];
    for (int k = 0; k < FIELDS; k++) mean[k] = (new[e][k][0] + new[e][k][1] + new[e][k][2]) / 3.0;
    alpha[e] = fmin(fmax(mean[0], 0.0), 1.0);
    moves[e] = mean[1] > 0.5 * mean[0];
  }
  PetscCall(PhaseTensionSetSolid(to, alpha, moves));
  PetscCall(PetscFree4(old, new, alpha, moves));
  PetscFunctionReturn(0);
}

PetscBool PhaseTensionHasSolid(PhaseTension t)
{
  return (PetscBool)(t->wetting != NULL);
}

PetscErrorCode PhaseTensionAdd(PhaseTension t, Phases phases, InverseDensity inverse[])
{
  const PhaseProperties *p = t->properties;
  double(*force)[2];
  PetscFunctionBeginUser;
  if (!PhaseHasTension(p)) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(t->stars->ne, &force));
  if (t->wetting) {
    const WettingSolid solid = {t->alpha, t->moves, PhaseLightest(p)};
    const WettingSurface surface = {&p->surface_tension, t->boundaries->contact, &p->solid_cosine};
    PetscCall(WettingSurfaceForce(t->wetting, phases, &solid, &surface, (double *)force));
  } else {
    PetscCall(PhasesGetSurfaceForce(phases, &p->surface_tension, t->boundaries->contact, (double *)force));
  }
  for (int e = 0; e < t->stars->ne; e++) InverseDensityAddSurface(force[e], &inverse[e]);
  PetscCall(PetscFree(force));
  PetscFunctionReturn(0);
}
