#include "common/program/program.h"
#include "common/link/affinity.h"
#include "common/link/resources.h"
#include <string.h>

void ProgramFail(void *context, const char *message)
{
  const Program *p = context;
  if (p->server) ServerFail(p->server, "%s", message);
  CoracleFail(p->client, "%s", message);
}

/* PETSc's error handler; errors: a ProgramErrors. */
static PetscErrorCode Abort(MPI_Comm comm, int line, const char *function, const char *file,
                            PetscErrorCode code, PetscErrorType type, const char *message, void *errors)
{
  const ProgramErrors *to = errors;
  char text[2048];
  if (code == PETSC_ERR_MEM ||
      !strcmp(function, "PetscMallocAlign")) { /* whose code is a line number in PETSc 3.18 */
    (void)snprintf(text, sizeof text,
                   "out of memory: this rank has had up to %.0f MB; a coarser mesh needs less, and so do "
                   "more ranks on more computers (in %s, %s:%d)",
                   PeakMemory(), function, file, line);
    to->fail(to->context, text);
  }
  (void)snprintf(text, sizeof text, "%s (in %s, %s:%d)", message ? message : "an error of PETSc", function,
                 file, line);
  to->fail(to->context, text);
  return code;
}

PetscErrorCode ProgramTellErrors(ProgramErrors *errors)
{
  return PetscPushErrorHandler(Abort, errors);
}

PetscErrorCode ProgramStart(const char *role, int argc, char **argv, Program *p)
{
  *p = (Program){.role = role};
  if (!strcmp(role, "coupler"))
    ServerOpen(argc, argv, &p->comm, &p->server);
  else
    CoracleOpen(role, argc, argv, &p->comm, &p->client);
  PETSC_COMM_WORLD = p->comm;
  /* the link reports signals in one line (failure_board.h), instead of PETSc's seven */
  PetscCall(PetscOptionsSetValue(NULL, "-no_signal_handler", NULL));
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  PetscFunctionBeginUser;
  p->errors = (ProgramErrors){ProgramFail, p};
  PetscCall(ProgramTellErrors(&p->errors));
  CoracleCaseOpen(argc, argv, ProgramFail, p, &p->c);
  PetscFunctionReturn(0);
}

PetscErrorCode ProgramEnd(Program *p)
{
  CoracleCaseClose(&p->c);
  PetscCall(PetscPopErrorHandler());
  PetscCall(PetscFinalize());
  return p->server ? ServerClose(&p->server) : CoracleClose(&p->client);
}

int ProgramAnswer(Command command, const CommandAnswers *answers, int argc, char **argv)
{
  const PetscBool reads = (PetscBool)(command != COMMAND_HELP && command != COMMAND_VERSION);
  if (reads) {
    AffinityAlone();
    if (PetscInitialize(NULL, NULL, NULL, NULL)) return 1;
  }
  const int status = CommandAnswer(command, answers, argc, argv);
  if (reads) (void)PetscFinalize();
  return status;
}

PetscErrorCode ProgramReportSeconds(const Program *p, int n, const char *const keys[], const double seconds[])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) PetscCall(CoracleReport(p->client, keys[k], seconds[k], 0));
  PetscFunctionReturn(0);
}
