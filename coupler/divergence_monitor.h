/* Divergence monitor: ends a run whose coupling diverges while its numbers can still be read.  Below a
 * certain density of the solid the added mass makes an explicit exchange over-correct, and the solid's
 * velocity changes with alternating sign and growing size from step to step. */
#ifndef CORACLE_DIVERGENCE_MONITOR_H
#define CORACLE_DIVERGENCE_MONITOR_H
#include "coupler/coupling_iteration.h"

/* Heuristic: the coupling diverges after this many alternations in a row, each DIVERGENCE_GROWTH times the
 * one before, which is large enough to be looked at; or after half as many that have grown by DIVERGENCE_TOTAL_GROWTH altogether (of a very light
 * solid the velocity overflows within a few steps, and the fluid's time step shrinks with it). */
#define DIVERGENCE_ALTERNATIONS 6
#define DIVERGENCE_GROWTH 1.1
#define DIVERGENCE_TOTAL_GROWTH 10.0
/* Part of the flow's kinetic energy per mass near the solid: changes of velocity with less are vibrations,
 * whether or not they grow. */
#define DIVERGENCE_ENERGY 0.01
/* Part of the shell's thickness: changes of velocity that move the solid by less within a step are not looked at.  A hundred times
 * what coupling iterations take as equal: below that a light solid's round-off grows until they are needed. */
#define DIVERGENCE_DISPLACEMENT (100.0 * NEGLIGIBLE_DISPLACEMENT)

typedef struct {
  int nsteps, alternations;
  double velocity[2], change[2]; /* of the last step, m/s */
  double first;                  /* size of the change that the alternations began with, m/s */
} DivergenceMonitor;             /* zero-initialise */

typedef struct {
  double t, dt;       /* the step just made ended at t, s */
  double velocity[2]; /* the solid's mean over the step, m/s */
  double force[2];    /* on the solid, N */
  double gravity[2];  /* m/s2 */
  double displaced;   /* fluid mass inside the solid, kg */
  double extent;      /* of the fluid's domain, m */
  double speed;       /* of the flow near the solid, root mean square, m/s */
  double thickness;   /* of the shell, m */
  int held;           /* nodes of the solid are fixed or move as prescribed */
  int max_iterations; /* coupling iterations that a step may take; 1: the first is accepted */
} DivergenceMonitorStep;

/* Local, the same on all ranks given the same numbers: 0, or 1 when the coupling diverges; then message
 * says how, the density ratio that the motion of a free solid implies, and what to do. */
int DivergenceMonitorCheck(DivergenceMonitor *monitor, const DivergenceMonitorStep *step, int nmessage,
                           char message[]);
#endif
