/* The fluid's part of the case file (sections fluid, gravity, time) and the mesh that it describes. */
#ifndef FLUID_CASE_H
#define FLUID_CASE_H
#include "common/link/case_file.h"
#include "fluid/flow/fluid.h"
#include "fluid/remeshing/adaptation.h"

/* Collective over comm.  Builds or reads the mesh and distributes it; with a checkpoint (else NULL) the mesh
 * is the one that was saved there, and *row as of MeshLoad. */
PetscErrorCode FluidCaseMesh(CoracleCase c, MPI_Comm comm, Checkpoint from, Mesh **mesh, PetscInt **row);
/* Reads everything else.  setup->boundary is allocated: PetscFree it after FluidCreate has copied it. */
PetscErrorCode FluidCaseSetup(CoracleCase c, const Mesh *mesh, FluidSetup *setup);
/* With fluid.phases: where they are at the start (FluidSetPhases); *region is allocated, its polygons too: FluidCaseFreeRegions. */
PetscErrorCode FluidCaseRegions(CoracleCase c, int *nregions, Region **region);
PetscErrorCode FluidCaseFreeRegions(int nregions, Region **region);
/* Whether the mesh adapts, and how (fluid.adapt), after the rest. */
PetscErrorCode FluidCaseAdaptation(CoracleCase c, const FluidSetup *fluid, PetscBool *adapts,
                                   AdaptationSetup *setup);
/* After the first step, when every solver has asked for its options: refuses those of fluid.petsc that none
 * has.  Collective. */
PetscErrorCode FluidCaseCheckOptions(CoracleCase c);
#endif
