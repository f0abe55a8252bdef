/* What each rank does when (key output.trace): steps, and in them waits for other ranks and phases of computing.
 *
 *     step    |------------- 12 --------------|------------- 13 ------
 *     rank    | momentum | pressure |  wait   | momentum ...            a phase ends with the next phase, wait or step;
 *                                                                       what has no name is "compute"
 *
 * The ranks' spans travel to the coupler with CLOSE; its rank 0 writes them in the trace event format of Chrome, which
 * https://ui.perfetto.dev opens: a process for each participant, a thread for each rank.  56 bytes a span. */
#ifndef CORACLE_TRACE_H
#define CORACLE_TRACE_H
#include "common/link/buffer.h"
#include "common/link/handshake.h"
#include <mpi.h>
#include <stdbool.h>
#include <stdint.h>

typedef enum { TRACE_STEP, TRACE_WAIT, TRACE_PHASE } TraceKind;

typedef struct {
  double start, end; /* s after the job's start */
  int16_t role, kind;
  int32_t rank, step;
  char name[24];
} TraceSpan;

typedef struct {
  bool on;
  Role role;
  int rank, step;
  double zero;                              /* WaitClock at the job's start */
  double step_start, phase_start;           /* of what is open; WaitClock, s */
  char phase[sizeof((TraceSpan *)0)->name]; /* empty: none */
  Buffer spans;
} Trace;

/* The clock's zero is that of the job's first rank on its host; on other hosts that of the moment of this call, which all
 * ranks make at about the same time (collective over the job). */
void TraceOpen(Trace *t, MPI_Comm job, Role role, int rank, bool first_host);
/* Local, also when the trace is off.  A step that has begun already is ignored. */
void TraceStep(Trace *t, int step);
void TracePhase(Trace *t, const char *name); /* NULL: none */
void TraceWait(Trace *t, const char *what, double start, double end);
/* Ends what is open. */
void TraceEnd(Trace *t);
/* Writes n spans, those of each rank together and in their order, as JSON; false if the file cannot be written. */
bool TraceWrite(const char *path, size_t n, const TraceSpan span[]);
#endif
