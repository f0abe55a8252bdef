/* Notices when a staggered coupling blows up, before the numbers do: below a certain density of the solid the
 * added mass makes the exchange over-correct, and the solid's velocity changes with alternating sign and
 * growing size from step to step. */
#ifndef CORACLE_GUARD_H
#define CORACLE_GUARD_H

/* No physics: so many alternations in a row, each this much larger than the one before; or half as many that
 * have grown this much altogether (far below the limit a few steps are enough for any number, and the fluid's
 * time step shrinks along). */
#define GUARD_ALTERNATIONS 6
#define GUARD_GROWTH 1.1
#define GUARD_TOTAL_GROWTH 10.0

typedef struct {
  int nsteps, alternations;
  double velocity[2], change[2], first; /* first: size of the change that the alternations began with, m/s */
} DivergenceMonitor;                    /* zero-initialise */

typedef struct {
  double t, dt;       /* the step just made ended at t, s */
  double velocity[2]; /* the solid's mean over the step, m/s */
  double force[2];    /* on the solid, N */
  double gravity[2];  /* m/s2 */
  double displaced;   /* fluid mass inside the solid, kg */
  double extent;      /* of the fluid's domain, m */
  int tries;          /* that a step may take */
} DivergenceMonitorStep;

/* Local, the same on all ranks given the same numbers: 0 when all is well; else 1, and message says what and
 * what to do. */
int DivergenceMonitorCheck(DivergenceMonitor *guard, const DivergenceMonitorStep *step, int nmessage,
                           char message[]);
#endif
