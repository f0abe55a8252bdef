/* What a case's check says of prescribed motions.  On one rank. */
#ifndef SOLID_CHECK_MOTIONS_H
#define SOLID_CHECK_MOTIONS_H
#include "solid/solid_impl.h"

/* Prints a line for each of the first prescribed motions that is not at rest: from where to where it gets until the end, s, or its release. */
void ExpectMotions(Solid s, double end);
/* Prints a note of the first body that a prescribed motion turns by more than a radian within a step of dt_max, s. */
void NoteTurns(Solid s, double end, double dt_max);
#endif
