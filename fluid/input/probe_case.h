/* The list fluid.probes of the case: where the flow is recorded in every step.
 *
 *   {name, point: [x, y]}                   a point, also on a wall
 *   {name, line: {from, to, points}}        as many points, evenly spaced, numbered from 0
 *   {name, solid_point: [x, y], distance}   a pressure gauge on a solid, which follows it; where it is as the run starts
 *   {name, solid_line: {from, to, points}, distance}   gauges along a straight side of a solid, and the force of the pressure on it
 *   {name, surface: {from, to, phase}}      where along a segment the phase is
 *   {name, flow: {from, to, phase}}         what of the phase flows through a segment; without a phase: of all
 *   {name, phase}                           a phase as a whole: area, centre, velocity, length of its interface */
#ifndef FLUID_PROBE_CASE_H
#define FLUID_PROBE_CASE_H
#include "common/program/gauge_case.h"
#include "fluid/input/phase_case.h"

enum { PROBES_MAX = 64, PROBE_POINTS_MAX = 1000 };

typedef enum {
  PROBE_POINT,
  PROBE_LINE,
  PROBE_GAUGE,
  PROBE_FACE,
  PROBE_SURFACE,
  PROBE_PHASE,
  PROBE_FLOW
} ProbeKind;

typedef struct {
  ProbeKind kind;
  const char *name;      /* of the case */
  int first, n;          /* its points: of the fixed ones, or of the gauges */
  double from[2], to[2]; /* m */
  int phase;             /* of a surface or a flow (-1: all), or the phase itself */
  double distance;       /* m, from the solid's face to where a gauge's pressure is taken */
  double behind;         /* m, as far as contact may press a body that stands on the floor into it */
} Probe;

typedef struct {
  int n, nfixed, ngauges;
  int nphases; /* 0: one fluid */
  Probe probe[PROBES_MAX];
  double fixed[PROBE_POINTS_MAX][2]; /* m */
} ProbeCase;

/* Not collective. */
void ProbeCaseRead(CoracleCase c, ProbeCase *list);
/* The key of probe k that says where it is, in a static buffer. */
const char *ProbeCaseKey(const ProbeCase *list, int k);
#endif
