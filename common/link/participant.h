/* One rank of one participant of the job, on either end of the link: joining, failing and leaving.
 *
 *     job              0     1     2         3       handshake: every rank states role, version, case, program
 *     role             fluid fluid coupler   solid   split by the role's name, in order of rank in the job
 *     app              0     1     0         0       the participant's own communicator
 *     link             0     1     2         3       a duplicate of the job, for the messages */
#ifndef CORACLE_PARTICIPANT_H
#define CORACLE_PARTICIPANT_H
#include "common/link/case_file.h"
#include "common/link/coracle.h"
#include "common/link/failure_board.h"
#include "common/link/handshake.h"
#include "common/link/trace.h"
#include "common/link/wait.h"
#include <stdarg.h>

/* The link to the last checkpoint in a run's output folder (common/output/checkpoint_folder.h). */
#define CORACLE_CHECKPOINT "checkpoint"

/* Seconds: of processors, on all ranks; by the clock; waiting for messages, at most. */
enum { USED_CPU, USED_WALL, USED_WAITING, NUSED };

typedef struct {
  Role role;
  int rank, size; /* within the role */
  MPI_Comm job;   /* borrowed: the ranks of all participants */
  MPI_Comm app, link;
  int count[NROLES];  /* ranks of each role */
  int *world[NROLES]; /* [count] their ranks in the job */
  char (*host)[64];   /* [size of the job] */
  int step;           /* for messages */
  int dim;            /* dimension of the run's meshes */
  double start;       /* WaitClock when joining, s */
  char *resume;       /* folder of the checkpoint that the run resumes from; NULL: none */
  double used[NUSED]; /* rank 0: by the participant in the runs before that, s */
  bool started_mpi;
  bool shared; /* ranks share processors */
  Waiter waiter;
  double waited_for[NROLES]; /* s, of it for messages of each role */
  Trace trace;
  FailureBoard failures;
} Participant;

/* Joins as role; collective over the job, all ranks of its participants (MPI_COMM_NULL: the world).  `client`: role must not be coupler.  A process joins once. */
int ParticipantOpen(MPI_Comm job, const char *role, bool client, int argc, char **argv, Participant **p);
/* Called with the message of an error before the job is ended; NULL: nothing.  Local. */
void ParticipantSetErrorHandler(void (*f)(void *context, const char *message), void *context);
/* Local: what this rank has used so far; with what runs before have, on rank 0. */
void ParticipantUsed(const Participant *p, double used[NUSED]);
/* Collective over the participant: into a checkpoint. */
void ParticipantSaveUsed(Participant *p, const char *folder);
/* Rank 0: back from there. */
void ParticipantLoadUsed(Participant *p, const char *folder);
/* Local: the folder of the checkpoint that the case's `resume` means, which is there, or ""; true: `last`, but there is none. */
bool ParticipantFindResume(CoracleCase c, size_t size, char folder[]);
/* Leaves in good order; collective over the job. */
int ParticipantClose(Participant **p);
/* "coracle <role>[rank]: error: ..." once, then the end of the job. */
_Noreturn void ParticipantFail(Participant *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
_Noreturn void ParticipantFailList(Participant *p, const char *format, va_list list);
/* Ends the job, when what has been written has been read. */
_Noreturn void ParticipantAbort(void);
void ParticipantStep(Participant *p, int step);
/* Local: `what` has been waited for, of a role, since `start` (WaitClock). */
void ParticipantWaited(Participant *p, Role role, int rank, const char *what, double start);
#endif
