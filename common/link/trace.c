#include "common/link/trace.h"
#include "common/link/json.h"
#include "common/link/wait.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double SHORT = 20e-6; /* s: less is not shown */

void TraceOpen(Trace *t, MPI_Comm job, Role role, int rank, bool first_host)
{
  double now = WaitClock(), first = now;
  MPI_Bcast(&first, 1, MPI_DOUBLE, 0, job);
  t->zero = t->step_start = first_host ? first : now;
  t->role = role;
  t->rank = rank;
}

/* As much of the name as there is room for, in whole characters of UTF-8. */
static void CopyName(char to[sizeof((TraceSpan *)0)->name], const char *name)
{
  size_t n = strnlen(name, sizeof((TraceSpan *)0)->name - 1);
  if (name[n])
    while (n > 0 && ((unsigned char)name[n] & 0xC0) == 0x80) n--;
  memcpy(to, name, n);
  to[n] = 0;
}

static void Add(Trace *t, TraceKind kind, const char *name, double start, double end)
{
  if (!t->on || (kind != TRACE_STEP && end - start < SHORT)) return;
  TraceSpan *s = BufferExtend(&t->spans, sizeof *s);
  *s = (TraceSpan){.start = start - t->zero,
                   .end = end - t->zero,
                   .role = (int16_t)t->role,
                   .kind = (int16_t)kind,
                   .rank = t->rank,
                   .step = t->step};
  CopyName(s->name, name);
}

static void EndPhase(Trace *t, double now)
{
  if (t->phase[0]) Add(t, TRACE_PHASE, t->phase, t->phase_start, now);
  t->phase[0] = 0;
}

void TraceStep(Trace *t, int step)
{
  const double now = WaitClock();
  if (step <= t->step) return;
  EndPhase(t, now);
  Add(t, TRACE_STEP, t->step ? "step" : "start", t->step_start, now);
  t->step = step;
  t->step_start = now;
}

void TracePhase(Trace *t, const char *name)
{
  const double now = WaitClock();
  EndPhase(t, now);
  CopyName(t->phase, name ? name : "");
  t->phase_start = now;
}

void TraceWait(Trace *t, const char *what, double start, double end)
{
  EndPhase(t, start);
  Add(t, TRACE_WAIT, what, start, end);
}

void TraceEnd(Trace *t)
{
  const double now = WaitClock();
  EndPhase(t, now);
  Add(t, TRACE_STEP, t->step ? "step" : "start", t->step_start, now);
}

/* --- writing -------------------------------------------------------------------------------------------- */

/* In whole nanoseconds, so that what ends where another span begins does so to the last digit. */
static void Event(FILE *f, const TraceSpan *s, const char *prefix, const char *name, double start, double end)
{
  const long long from = llround(1e9 * start), to = llround(1e9 * end);
  fprintf(f, ",\n{\"ph\": \"X\", \"pid\": %d, \"tid\": %d, \"ts\": %.3f, \"dur\": %.3f, \"name\": \"%s",
          s->role, s->rank, 1e-3 * (double)from, 1e-3 * (double)(to - from), prefix);
  JsonCharacters(f, name);
  if (s->kind == TRACE_STEP && s->step) fprintf(f, " %d", s->step);
  fprintf(f, "\", \"args\": {\"step\": %d}}", s->step);
}

/* The spans of one step, span[n], and what lies between them; the last is the step itself. */
static void WriteStep(FILE *f, size_t n, const TraceSpan span[])
{
  const TraceSpan *step = &span[n - 1];
  double at = step->start;
  Event(f, step, "", step->name, step->start, step->end);
  for (size_t i = 0; i < n; i++) {
    const TraceSpan gap = {.role = step->role, .rank = step->rank, .step = step->step, .kind = TRACE_PHASE};
    const double until = i + 1 < n ? span[i].start : step->end;
    if (until - at >= SHORT) Event(f, &gap, "", "compute", at, until);
    if (i + 1 < n)
      Event(f, &span[i], span[i].kind == TRACE_WAIT ? "wait for " : "", span[i].name, span[i].start,
            span[i].end);
    at = span[i].end;
  }
}

bool TraceWrite(const char *path, size_t n, const TraceSpan span[])
{
  FILE *f = fopen(path, "w");
  if (!f) return false;
  fprintf(f, "{\"displayTimeUnit\": \"ms\", \"traceEvents\": [");
  for (int role = 0; role < NROLES; role++)
    fprintf(f, "%s\n{\"ph\": \"M\", \"pid\": %d, \"name\": \"process_name\", \"args\": {\"name\": \"%s\"}}",
            role ? "," : "", role, ROLE_NAMES[role]);
  for (size_t first = 0, i = 0; i < n; i++) {
    if (span[i].kind != TRACE_STEP) continue;
    WriteStep(f, i + 1 - first, span + first);
    first = i + 1;
  }
  fprintf(f, "\n]}\n");
  return fclose(f) == 0;
}
