/* What the three participants' programs have in common: start, errors, and the end.
 *
 *     main                      ProgramStart    joins the job, starts PETSc on the participant's communicator,
 *                                               makes every error of PETSc or of the case file end the whole job
 *                               ...             the participant's own run
 *                               ProgramEnd      closes the case file, ends PETSc, leaves the job
 *
 * An error is reported once, as "coracle <role>[rank]: error: ...", by the link (CoracleFail, ServerFail). */
#ifndef CORACLE_PROGRAM_H
#define CORACLE_PROGRAM_H
#include "common/link/case_file.h"
#include "common/link/command_line.h"
#include "common/link/coracle.h"
#include "common/link/server.h"
#include <petscsys.h>

/* Whom an error of PETSc is told; fail must not return. */
typedef struct {
  void (*fail)(void *context, const char *message);
  void *context;
} ProgramErrors;

typedef struct {
  const char *role;     /* "fluid", "coupler" or "solid" */
  CoracleClient client; /* of a fluid or a solid, else NULL */
  Server server;        /* of the coupler, else NULL */
  MPI_Comm comm;        /* the participant's; PETSC_COMM_WORLD is the same */
  CoracleCase c;        /* the case file */
  ProgramErrors errors;
} Program;

/* Collective over the job. */
PetscErrorCode ProgramStart(const char *role, int argc, char **argv, Program *program);
/* Collective over the job: after CORACLE_STOP. */
PetscErrorCode ProgramEnd(Program *program);
/* Errors of PETSc go to errors->fail as one line, until PetscPopErrorHandler; errors: borrowed as long.  ProgramStart does so itself. */
PetscErrorCode ProgramTellErrors(ProgramErrors *errors);
/* Without a job: answers as CommandAnswer, with PETSc for what reads the case; returns the program's exit status. */
int ProgramAnswer(Command command, const CommandAnswers *answers, int argc, char **argv);
/* Ends the job with the message (context: a Program); what case files and others call back. */
void ProgramFail(void *context, const char *message);
/* Reports seconds[n] under the keys (CoracleReport): the maximum over the ranks.  Fluid and solid. */
PetscErrorCode ProgramReportSeconds(const Program *program, int n, const char *const keys[],
                                    const double seconds[]);
#endif
