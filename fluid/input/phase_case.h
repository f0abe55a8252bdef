/* The phases of a case file (fluid.phases) and where they are at the start (fluid.regions). */
#ifndef FLUID_PHASE_CASE_H
#define FLUID_PHASE_CASE_H
#include "common/link/case_file.h"
#include "common/link/case_key.h"
#include "fluid/transport/phase_transport.h"

/* Names in the order of the phases, borrowed from the case, then NULL. */
typedef struct {
  const char *name[PHASES_MAX + 1];
} PhaseNames;

/* Cosines of the angles at key, degrees from 0 to 180, through the first phase of each pair.  Not collective. */
void PhaseCaseAngles(CoracleCase c, const char *key, const PhaseNames *names, PhasesPairs *cosine);
/* The phase that the string at key names.  Not collective. */
int PhaseCaseIndex(CoracleCase c, const char *key, const PhaseNames *names);
/* properties->n = 0 without the key.  More than two phases are sorted by density, the heaviest first (phases/README.md).  Not
 * collective. */
void PhaseCaseRead(CoracleCase c, PhaseNames *names, PhaseProperties *properties);
#endif
