/* What a case's check says of bodies, springs and materials: what they weigh and pull at the start, and keys that have no effect.  On one rank. */
#ifndef SOLID_CHECK_MATERIALS_H
#define SOLID_CHECK_MATERIALS_H
#include "solid/solid_impl.h"

/* Prints a line for each of the first bodies and of the first springs. */
PetscErrorCode ExpectBodies(Solid s);
/* Prints a note of the first pair whose one side alone has friction: the geometric mean of both is 0.  Not where solid.contact gives pairs their own. */
void NoteFriction(Solid s);
/* Prints a note if a material has strengths and no body has joints. */
void NoteStrengths(Solid s);
#endif
