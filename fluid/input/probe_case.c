#include "fluid/input/probe_case.h"
#include "common/output/output.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const KINDS[] = {"point",   "line",  "solid_point", "solid_line",
                                    "surface", "phase", "flow",        NULL};

static const char *Key(int k, const char *what)
{
  static char key[CASE_KEY];
  return CaseKey(key, "fluid.probes[%d]%s%s", k, *what ? "." : "", what);
}

const char *ProbeCaseKey(const ProbeCase *list, int k)
{
  return Key(k, KINDS[list->probe[k].kind]);
}

static ProbeKind ReadKind(CoracleCase c, int k)
{
  int kind = -1, n = 0;
  for (int i = 0; KINDS[i]; i++) {
    if (!CoracleCaseHas(c, Key(k, KINDS[i]))) continue;
    kind = i;
    n++;
  }
  if (n != 1)
    CoracleCaseRefuse(
        c, Key(k, ""),
        "expected one of point, line, solid_point, solid_line, surface, phase, flow, found %d of them", n);
  return (ProbeKind)kind;
}

static const char *ReadName(CoracleCase c, const ProbeCase *list, int k)
{
  const char *name = CoracleCaseString(c, Key(k, "name"));
  if (!SeriesCanName(name))
    CoracleCaseRefuse(c, Key(k, "name"), "expected a name of up to %d characters without commas and quotes",
                      SERIES_NAME_MAX);
  for (int i = 0; i < k; i++)
    if (!strcmp(list->probe[i].name, name))
      CoracleCaseRefuse(c, Key(k, "name"), "fluid.probes[%d] has the name '%s', too", i, name);
  return name;
}

static void AddFixed(CoracleCase c, ProbeCase *list, int k)
{
  Probe *p = &list->probe[k];
  p->first = list->nfixed;
  if (p->first + p->n > PROBE_POINTS_MAX)
    CoracleCaseRefuse(c, "fluid.probes", "more than %d points", PROBE_POINTS_MAX);
  for (int i = 0; i < p->n; i++)
    for (int d = 0; d < 2; d++)
      list->fixed[p->first + i][d] =
          p->from[d] + (p->n > 1 ? (double)i / (p->n - 1) : 0.0) * (p->to[d] - p->from[d]);
  list->nfixed += p->n;
}

/* Of a gauge's distance, or of the finest mesh. */
#define BEHIND 0.05

/* The pressure of an element that the face crosses mixes both of its sides: by default one edge of the finest mesh
 * away from the face. */
static double ReadDistance(CoracleCase c, int k)
{
  if (!CoracleCaseHas(c, "fluid.adapt")) return CoracleCaseNumber(c, Key(k, "distance"), 0.0, HUGE_VAL);
  return CoracleCaseNumberOr(c, Key(k, "distance"), CoracleCasePositive(c, "fluid.adapt.size_min"), 0.0,
                             HUGE_VAL);
}

static void ReadEnds(CoracleCase c, int k, Probe *p)
{
  static const char *const
      FROM[] = {[PROBE_LINE] = "line.from", [PROBE_SURFACE] = "surface.from", [PROBE_FLOW] = "flow.from"},
      *const TO[] = {[PROBE_LINE] = "line.to", [PROBE_SURFACE] = "surface.to", [PROBE_FLOW] = "flow.to"};
  CoracleCaseVector(c, Key(k, FROM[p->kind]), 2, p->from);
  CoracleCaseVector(c, Key(k, TO[p->kind]), 2, p->to);
  if (p->to[0] == p->from[0] && p->to[1] == p->from[1])
    CoracleCaseRefuse(c, Key(k, TO[p->kind]), "expected another point than from, (%g, %g)", p->to[0],
                      p->to[1]);
}

/* Where probe k of this kind is. */
static void ReadPlace(CoracleCase c, const PhaseNames *names, ProbeCase *list, int k)
{
  Probe *p = &list->probe[k];
  double gauge[CASE_GAUGES_MAX][2];
  if (p->kind == PROBE_LINE || p->kind == PROBE_SURFACE || p->kind == PROBE_FLOW)
    ReadEnds(c, k, p);
  else if (p->kind == PROBE_POINT)
    CoracleCaseVector(c, Key(k, KINDS[p->kind]), 2, p->from);
  switch (p->kind) {
  case PROBE_LINE:
    p->n = CoracleCaseIntegerOr(c, Key(k, "line.points"), 51, 2, PROBE_POINTS_MAX);
    AddFixed(c, list, k);
    break;
  case PROBE_POINT:
    AddFixed(c, list, k);
    break;
  case PROBE_GAUGE:
  case PROBE_FACE:
    p->distance = ReadDistance(c, k);
    p->behind =
        BEHIND * (p->distance > 0.0 ? p->distance
                                    : CoracleCaseNumberOr(c, "fluid.adapt.size_min", 0.0, 0.0, HUGE_VAL));
    p->first = list->ngauges;
    p->n = CaseGauges(c, k, gauge);
    list->ngauges += p->n;
    if (list->ngauges > CASE_GAUGES_MAX)
      CoracleCaseRefuse(c, CaseGaugeKey(c, k), "more than %d gauges on solids", CASE_GAUGES_MAX);
    break;
  case PROBE_SURFACE:
  case PROBE_PHASE:
    if (!list->nphases)
      CoracleCaseRefuse(c, Key(k, KINDS[p->kind]), "there are no phases: expected fluid.phases");
    p->phase = p->kind == PROBE_PHASE ? PhaseCaseIndex(c, Key(k, "phase"), names)
                                      : PhaseCaseIndex(c, Key(k, "surface.phase"), names);
    break;
  case PROBE_FLOW:
    p->phase = -1;
    if (list->nphases && CoracleCaseHas(c, Key(k, "flow.phase")))
      p->phase = PhaseCaseIndex(c, Key(k, "flow.phase"), names);
    break;
  }
}

void ProbeCaseRead(CoracleCase c, ProbeCase *list)
{
  PhaseNames names;
  PhaseProperties properties;
  PhaseCaseRead(c, &names, &properties);
  *list = (ProbeCase){.n = CoracleCaseCount(c, "fluid.probes"), .nphases = properties.n};
  if (list->n > PROBES_MAX) CoracleCaseRefuse(c, "fluid.probes", "more than %d probes", PROBES_MAX);
  for (int k = 0; k < list->n; k++) {
    list->probe[k] = (Probe){.kind = ReadKind(c, k), .name = ReadName(c, list, k), .n = 1};
    ReadPlace(c, &names, list, k);
  }
}
