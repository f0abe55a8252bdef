/* What lives from one step of the time loop to the next, and the parts of the loop that are not the
 * algorithm: the choice of the time step, the checks that end a run with a reason, and the checkpoint.  For
 * time_loop.c; everything is collective. */
#ifndef CORACLE_RUN_STATE_H
#define CORACLE_RUN_STATE_H
#include "common/program/early_stop.h"
#include "coupler/checkpoints.h"
#include "coupler/coupling_iteration.h"
#include "coupler/divergence_monitor.h"
#include "coupler/time_loop.h"

typedef struct {
  TimeLoop *loop;
  const CouplerModeTable *mode;
  SolidState solid; /* as received last; borrowed */
  SolidState start; /* as the current step began; a copy */
  FluidElements elements;
  CouplingIteration iteration;
  DivergenceMonitor monitor;
  Checkpoints checkpoints;
  EarlyStop early_stop;
  Gauges gauges;
  double t, dt;              /* start and length of the current step, s; dt 0 when the run has ended */
  double dt_before;          /* of the step before it, s; 0: there was none */
  int halvings;              /* of the current step so far */
  PetscBool solid_has_begun; /* the current step: the next attempt is a REDO to it */
  PetscBool shortened;       /* dt, so that it takes one coupling iteration */
  double
      iterations_taken; /* by the last step that took several and was not shortened; less with each step since */
  PetscBool ends;       /* with the accepted step: at time.end, or before */
  PetscBool has_left;     /* a node has been seen outside of the fluid's domain */
  PetscBool has_rejected; /* a participant has asked for a shorter step */
  int ncorrection;
  const CoracleCorrection *correction; /* [ncorrection] of the last accepted step, not sent yet; borrowed */
} RunState;

/* dt for the coming step: the proposal, at most time.dt_max and 1.3 of dt_before, and shorter where that spares coupling iterations, and where in
 * mode reaction the solid's elements would be inside out in its middle.  The last step ends exactly at time.end, and the one before it is shortened so
 * that the last is not much smaller.  The job ends when the flow diverges, or steps are halved again and again: a proposal, or steps, below 1e-6
 * of time.dt_max; and when an element would be inside out even in a 64th of the step. */
PetscErrorCode RunChooseStep(RunState *run, double proposed);
/* Not collective: of a step that has converged, coupling iterations, also those over more of it than dt. */
void RunRememberIterations(RunState *run, int iterations);
/* Ends the job when a node of the solid is outside of the fluid's domain. */
PetscErrorCode RunCheckInside(const RunState *run);
/* Ends the job when the solid asks for the load of the pressure where there is none: in modes other than reaction and among phases. */
PetscErrorCode RunCheckPressureLoad(const RunState *run);
/* Says, once a run, that a node of the solid has left the fluid's domain, by more than a hundredth of its smaller extent: through an open side, as a
 * body on a wall does not. */
PetscErrorCode RunNoteLeaving(RunState *run);
/* Finds the gauges on the solid, or those of the checkpoint; ends the job when one is not on its surface. */
PetscErrorCode RunCreateGauges(RunState *run);
/* Ends the job when the accepted step shows that the coupling diverges. */
PetscErrorCode RunCheckDivergence(RunState *run, const StepRecord *step);
/* The current step has not converged within coupler.max_iterations, or a participant cannot make it: dt is halved, or the job ends if it
 * has been halved often enough. */
PetscErrorCode RunHalveStep(RunState *run);
/* Ends the job with one message of rank 0 about what all ranks have found. */
PetscErrorCode RunFail(const RunState *run, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Claims the output folder and creates the writer and the checkpoints: the solid is known, the fluid has
 * answered, and the case suits both.  Until then the folder is untouched. */
PetscErrorCode RunOpenOutput(RunState *run);
/* t, dt and the divergence monitor; the writer and the coupler load their own parts (writer.h,
 * coupler.h). */
PetscErrorCode RunLoad(RunState *run, Checkpoint from);
/* Saves the coupler if a checkpoint is due: as the step that has been sent begins, or at the end. */
PetscErrorCode RunSave(const RunState *run);
#endif
