#include "coupler/step/mode.h"

const char *const COUPLER_MODES[] = {"reaction", "stress_shell", "penalty_shell", NULL};

static const CouplerModeTable *const TABLES[] = {&COUPLER_MODE_REACTION, &COUPLER_MODE_STRESS_SHELL,
                                                 &COUPLER_MODE_PENALTY_SHELL};

const CouplerModeTable *CouplerModeGet(CouplerMode mode)
{
  return TABLES[mode];
}
