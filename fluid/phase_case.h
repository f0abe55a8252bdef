/* The phases of a case file (fluid.phases) and where they are at the start (fluid.regions). */
#ifndef FLUID_PHASE_CASE_H
#define FLUID_PHASE_CASE_H
#include "common/link/case_file.h"
#include "fluid/phase_transport.h"

/* Names in the order of the phases, borrowed from the case, then NULL. */
typedef struct {
  const char *name[PHASES_MAX + 1];
} PhaseNames;

/* The phase that the string at key names.  Not collective. */
int PhaseCaseIndex(CoracleCase c, const char *key, const PhaseNames *names);
/* properties->n = 0 without the key.  Not collective. */
void PhaseCaseRead(CoracleCase c, PhaseNames *names, PhaseProperties *properties);
#endif
