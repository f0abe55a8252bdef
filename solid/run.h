/* What a run of the solid has between its steps. */
#ifndef SOLID_RUN_H
#define SOLID_RUN_H
#include "common/program/program.h"
#include "solid/exchange.h"
#include "solid/writer.h"

typedef struct {
  const Program *program;
  Solid solid;
  Exchange exchange;
  Writer writer;
  Checkpoint from; /* that the run resumes from, until the output is open; else NULL */
} SolidRun;

/* The solid as the case says, or as the checkpoint that the run resumes from; the first exchange. */
PetscErrorCode SolidRunCreate(const Program *program, SolidRun *run);
/* After the first ExchangeBegin, when all participants have accepted the case: creates the writer. */
PetscErrorCode SolidRunOpenOutput(SolidRun *run);
/* Saves the state at the start of the step, or at the end, if a checkpoint is due. */
PetscErrorCode SolidRunSave(const SolidRun *run);
/* Reports what the run has cost, and frees. */
PetscErrorCode SolidRunDestroy(SolidRun *run);
/* Hears of a number that summary.json has; sum: of the ranks' values, else the largest of them.  Nonzero: an error. */
typedef int (*SolidTell)(void *context, const char *key, double value, int sum);
PetscErrorCode SolidReport(Solid solid, SolidTell tell, void *context);
#endif
