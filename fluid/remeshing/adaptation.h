/* When the fluid's mesh is adapted, and to which metric: the interpolation error of the velocity, and the
 * size le in the band that the solid's surface, or the interface between phases, will sweep until the next time. */
#ifndef FLUID_ADAPTATION_H
#define FLUID_ADAPTATION_H
#include "fluid/flow/fluid.h"

typedef struct {
  double size_min, size_max;   /* le, Le: lengths of edges, m */
  double velocity_error;       /* of linear interpolation, for each component, m/s */
  double interface_size;       /* of edges at an interface between phases, m */
  double corner_size;          /* of edges at corners of solids, m: at most size_min */
  double light_velocity_error; /* that wanted in the lighter phase; 0: any */
  double growth;               /* of sizes from one edge to the next, > 1 */
  double anisotropy;           /* longest by shortest size of an element, >= 1 */
  double elements_max;         /* the budget: where the metric asks for more, the error is raised */
  int every;                   /* steps, at most, between two adaptations */
} AdaptationSetup;

typedef struct Adaptation_s *Adaptation;

PetscErrorCode AdaptationCreate(const AdaptationSetup *setup, Adaptation *adaptation);
/* Collective, once a step when its flow is known (its projected velocity): is it time for another mesh?  True `every` steps after
 * the last one, or when the solid may leave its band in the next step. */
PetscErrorCode AdaptationDue(Adaptation adaptation, Fluid fluid, PetscBool *due);
/* Not collective: the step that AdaptationDue was asked about last will be redone. */
void AdaptationDiscard(Adaptation adaptation);
/* Collective: the mesh adapted to the flow of the current step and to the solid. */
PetscErrorCode AdaptationMesh(Adaptation adaptation, Fluid fluid, Mesh **mesh);
/* What is known before the first step: boxes around the solid, box[nbox][2][2] lower and upper corners, m, and where the
 * phases are (nphases = 0: one fluid). */
typedef struct {
  int nbox;
  const double *box;
  int nphases, nregions;
  const Region *region;
} AdaptationStart;
/* Collective, first_mesh.c: the mesh with le in the boxes and the interface's size at the interface; elsewhere the largest. */
PetscErrorCode AdaptationFirstMesh(Adaptation adaptation, const Mesh *initial, const AdaptationStart *start,
                                   Mesh **mesh);
/* Collective: the triangles that edges of size_max everywhere take. */
PetscErrorCode AdaptationLeastCount(const AdaptationSetup *setup, const Mesh *mesh, double *triangles);
/* Collective: refuses `count` elements beyond the budget. */
PetscErrorCode AdaptationCheckBudget(const AdaptationSetup *setup, MPI_Comm comm, double count);
/* Borrowed.  Not collective. */
const AdaptationSetup *AdaptationGetSetup(Adaptation adaptation);
/* Collective, between two steps: what says when the next one is due; NULL: nothing.  A checkpoint of a run
 * that did not adapt leaves it as at the start. */
PetscErrorCode AdaptationSave(Adaptation adaptation, Checkpoint to);
PetscErrorCode AdaptationLoad(Adaptation adaptation, Checkpoint from);
PetscErrorCode AdaptationDestroy(Adaptation *adaptation);
#endif
