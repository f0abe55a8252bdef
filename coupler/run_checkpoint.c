#include "common/output/folder.h"
#include "common/program/case_copy.h"
#include "coupler/run_state.h"

enum { MONITOR_NUMBERS = 7 };

PetscErrorCode RunOpenOutput(RunState *run)
{
  TimeLoop *loop = run->loop;
  const char *resume = ServerResumePath(loop->server), *folder = loop->c->run.folder;
  const PetscBool resumes = resume ? FolderHolds(PETSC_COMM_WORLD, folder, resume) : PETSC_FALSE;
  const CouplerCase *c = loop->c;
  char ranks[80];
  CaseCopy copy;

  PetscFunctionBeginUser;
  PetscCall(CaseCopyTake(c->path, &copy));
  PetscCall(ClaimFolder(PETSC_COMM_WORLD, folder, resumes, &loop->claim));
  snprintf(ranks, sizeof ranks, "ranks of fluid, coupler, solid %d:%d:%d", ServerRanks(loop->server, "fluid"),
           ServerRanks(loop->server, "coupler"), ServerRanks(loop->server, "solid"));
  PetscCall(CaseCopyWrite(folder, ranks, c->argc, c->argv, &copy));
  PetscCall(EarlyStopBegin(folder, c->run.walltime, (PetscBool)(c->run.checkpoint > 0.0),
                           ServerWall(loop->server), &run->early_stop));
  PetscCall(CheckpointsCreate(PETSC_COMM_WORLD, loop->server, loop->c, &run->checkpoints));
  PetscCall(WriterCreate(PETSC_COMM_WORLD, loop->c, loop->from, &loop->writer));
  PetscFunctionReturn(0);
}

PetscErrorCode RunLoad(RunState *run, Checkpoint from)
{
  double row[MONITOR_NUMBERS], shortened;

  PetscFunctionBeginUser;
  PetscCall(CheckpointGetNumber(from, "t", &run->t));
  PetscCall(CheckpointGetNumber(from, "dt", &run->dt)); /* 0 from the end of a run: not chosen yet */
  PetscCall(CheckpointGetNumber(from, "dt before", &run->dt_before));
  PetscCall(CheckpointGetNumber(from, "shortened", &shortened));
  PetscCall(CheckpointGetNumber(from, "iterations taken", &run->iterations_taken));
  run->shortened = (PetscBool)(shortened != 0.0);
  PetscCall(CheckpointGetDoubles(from, "divergence monitor", 0, 1, MONITOR_NUMBERS, row));
  run->monitor = (DivergenceMonitor){(int)row[0], (int)row[1], {row[2], row[3]}, {row[4], row[5]}, row[6]};
  if (run->t >= run->loop->c->run.end)
    PetscCall(RunFail(run, "the checkpoint to resume from is at t = %g s already, time.end is %g s", run->t,
                      run->loop->c->run.end));
  PetscFunctionReturn(0);
}

PetscErrorCode RunSave(const RunState *run)
{
  const DivergenceMonitor *m = &run->monitor;
  const double row[MONITOR_NUMBERS] = {m->nsteps,    m->alternations, m->velocity[0], m->velocity[1],
                                       m->change[0], m->change[1],    m->first};
  PetscMPIInt rank;
  Checkpoint to;

  PetscFunctionBeginUser;
  if (!run->checkpoints.due[0]) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(CheckpointCreate(PETSC_COMM_WORLD, run->checkpoints.due, "coupler", &to));
  PetscCall(CheckpointPutNumber(to, "t", run->t));
  PetscCall(CheckpointPutNumber(to, "dt", run->dt));
  PetscCall(CheckpointPutNumber(to, "dt before", run->dt_before));
  PetscCall(CheckpointPutNumber(to, "shortened", run->shortened));
  PetscCall(CheckpointPutNumber(to, "iterations taken", run->iterations_taken));
  PetscCall(CheckpointPutDoubles(to, "divergence monitor", rank ? 0 : 1, MONITOR_NUMBERS, row));
  PetscCall(WriterSave(run->loop->writer, to));
  PetscCall(CouplerSave(run->loop->coupler, to));
  PetscCall(GaugesSave(run->gauges, to));
  PetscCall(CheckpointClose(&to));
  PetscFunctionReturn(0);
}
