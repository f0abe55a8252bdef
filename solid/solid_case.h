/* The solid's part of the case file: sections solid and gravity.  All keys are listed in README.md. */
#ifndef SOLID_CASE_H
#define SOLID_CASE_H
#include "case_file.h"
#include "solid.h"

/* Not collective; every rank reads the same.  Refuses what cannot be (see case_file.h): unknown materials or
 * boundaries, degenerate elements, bodies that overlap or lie outside the walls.  setup->fail is left alone.
 */
PetscErrorCode SolidCaseRead(Case c, Assembly *a, SolidSetup *setup);
#endif
