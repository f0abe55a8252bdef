/* The solid's part of the case file: sections solid and gravity.  All keys are in cases/KEYS.md. */
#ifndef SOLID_CASE_H
#define SOLID_CASE_H
#include "common/link/case_file.h"
#include "solid/solid.h"

/* Not collective; every rank reads the same.  Refuses what cannot be (see case_file.h): unknown materials or
 * boundaries, degenerate elements, bodies that overlap or lie outside the walls. */
PetscErrorCode SolidCaseRead(CoracleCase c, Model *a, SolidSetup *setup);

/* Key solid.pressure_load: the fluid's pressure compresses the bodies (CoracleSetPressureLoad); at any time, not collective. */
PetscBool SolidCasePressureLoad(CoracleCase c);

/* Collective: options for PETSc, bodies and set-up of the case, whose section solid must then have been read
 * in full. */
PetscErrorCode SolidFromCase(CoracleCase c, MPI_Comm comm, Solid *solid);
#endif
