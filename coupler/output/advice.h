/* One line at the end of a run on which participant wants more ranks.
 *
 * Fluid, coupler and solid work one after the other (README.md), so the coupler's clock divides into its waits for the fluid, those
 * for the solid, and its own work.  With more ranks of a participant that took the part s of the time the run is at most 1/(1 - s)
 * times as fast (Amdahl). */
#ifndef CORACLE_COUPLER_ADVICE_H
#define CORACLE_COUPLER_ADVICE_H
#include <stddef.h>

/* Of rank 0: ranks of, and seconds taken by, fluid, coupler and solid, in this order; shared: ranks share processors. */
typedef struct {
  int ranks[3];
  double seconds[3];
  int shared;
} AdviceInput;

void AdviceWrite(const AdviceInput *input, size_t size, char line[]);
#endif
