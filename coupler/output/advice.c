#include "coupler/output/advice.h"
#include <stdio.h>

static const char *const NAMES[] = {"fluid", "coupler", "solid"};
/* Less is no reason for other ranks; a participant with several ranks and less than the second could do with fewer. */
static const double MUCH = 0.5, LITTLE = 0.02;

void AdviceWrite(const AdviceInput *in, size_t size, char line[])
{
  const double total = in->seconds[0] + in->seconds[1] + in->seconds[2];
  double part[3];
  int longest = 0, n;
  for (int k = 0; k < 3; k++) {
    part[k] = total > 0.0 ? in->seconds[k] / total : 0.0;
    if (part[k] > part[longest]) longest = k;
  }
  n = snprintf(line, size, "ranks %d:%d:%d: fluid %.0f %%, coupler %.0f %%, solid %.0f %% of %.3g s",
               in->ranks[0], in->ranks[1], in->ranks[2], 100.0 * part[0], 100.0 * part[1], 100.0 * part[2],
               total);
  if (in->shared)
    n += snprintf(line + n, size - (size_t)n, "; ranks share processors here, fewer may be as fast");
  else if (part[longest] > MUCH)
    n += snprintf(line + n, size - (size_t)n, "; more ranks of the %s: at most %.2g times as fast",
                  NAMES[longest], 1.0 / (1.0 - part[longest]));
  for (int k = 0; k < 3; k++)
    if (in->ranks[k] > 1 && part[k] < LITTLE)
      n += snprintf(line + n, size - (size_t)n, "; the %s needs fewer", NAMES[k]);
}
