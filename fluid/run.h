/* What a run of the fluid has between its steps: mesh, fluid and all that is as large as they change when the
 * mesh is adapted. */
#ifndef FLUID_RUN_H
#define FLUID_RUN_H
#include "common/program/program.h"
#include "fluid/exchange.h"
#include "fluid/output/probes.h"
#include "fluid/output/writer.h"
#include "fluid/remeshing/adaptation.h"

typedef struct {
  const Program *program;
  Mesh *mesh;
  Fluid fluid;
  Exchange exchange;
  Writer writer;
  Probes probes;            /* NULL: the case has none */
  Adaptation adaptation;    /* NULL: the mesh stays */
  PetscBool first;          /* the run's first step is not accepted yet */
  PetscBool not_solenoidal; /* the velocity: as the run starts, or the mesh is new since the last step */
  Checkpoint from;          /* that the run resumes from, until the output is open; else NULL */
} FluidRun;

/* Mesh and fluid as the case says, or as the checkpoint that the run resumes from; the first exchange. */
PetscErrorCode FluidRunCreate(const Program *program, FluidRun *run);
/* After the first CoracleBegin, when all participants have accepted the case: creates the writer. */
PetscErrorCode FluidRunOpenOutput(FluidRun *run);
/* Saves the state at the start of the step, or at the end, if a checkpoint is due. */
PetscErrorCode FluidRunSave(const FluidRun *run);
/* The current step is final: output. */
PetscErrorCode FluidRunWrite(FluidRun *run);
/* If it is due: another mesh for the flow of the current step, and a fluid on it without state; else NULL. */
PetscErrorCode FluidRunRemesh(FluidRun *run, Mesh **mesh, Fluid *fluid);
/* The step is complete on the old mesh: the next one is on the new mesh. */
PetscErrorCode FluidRunAcceptMesh(FluidRun *run, Mesh *mesh, Fluid fluid);
/* The step will be redone on the old mesh; mesh and fluid may be NULL. */
PetscErrorCode FluidRunDiscardMesh(FluidRun *run, Mesh **mesh, Fluid *fluid);
/* Reports what the run has cost, and frees. */
PetscErrorCode FluidRunDestroy(FluidRun *run);
#endif
