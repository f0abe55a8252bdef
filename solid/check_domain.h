/* What a case's check asks of the solid in the fluid's domain.  On one rank. */
#ifndef SOLID_CHECK_DOMAIN_H
#define SOLID_CHECK_DOMAIN_H
#include "common/link/case_file.h"
#include "solid/solid_impl.h"

/* Refuses a body that reaches out of the domain's bounds, and prints a note of the first that reaches out of the domain within them. */
PetscErrorCode CheckDomain(CoracleCase c, Solid s);
/* Refuses a pressure gauge of the fluid that is not on the surface. */
void CheckGauges(CoracleCase c, Solid s);
/* Prints a note of the first body that may leave it before the end, s: gravity acts, nothing holds the body until then and there are no walls, or none where it begins at
 * a side. */
PetscErrorCode NoteWalls(CoracleCase c, Solid s, double end);
/* Prints a note if bodies are so far from the origin, for their elements, that round-off of the positions makes them vibrate. */
void NoteFar(Solid s);
/* Prints a note of the first body that water passes through beside air: one thinner than two of the fluid's elements. */
PetscErrorCode NoteThin(CoracleCase c, Solid s);
#endif
