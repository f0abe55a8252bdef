/* The fluid's part of the case file (sections fluid, gravity, time) and the mesh that it describes. */
#ifndef FLUID_CASE_H
#define FLUID_CASE_H
#include "adaptation.h"
#include "case_file.h"
#include "fluid.h"

/* Collective over comm.  Builds or reads the mesh and distributes it. */
PetscErrorCode FluidCaseMesh(Case c, MPI_Comm comm, Mesh **mesh);
/* Reads everything else.  setup->boundary is allocated: PetscFree it after FluidCreate has copied it. */
PetscErrorCode FluidCaseSetup(Case c, const Mesh *mesh, FluidSetup *setup);
/* Whether the mesh adapts, and how (fluid.adapt). */
PetscErrorCode FluidCaseAdaptation(Case c, PetscBool *adapts, AdaptationSetup *setup);
/* After the first step, when every solver has asked for its options: refuses those of fluid.petsc that none
 * has.  Collective. */
PetscErrorCode FluidCaseCheckOptions(Case c);
#endif
