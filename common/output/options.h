/* Options of PETSc that a case gives (keys fluid.petsc, coupler.petsc, solid.petsc). */
#ifndef CORACLE_OUTPUT_OPTIONS_H
#define CORACLE_OUTPUT_OPTIONS_H
#include <petscsys.h>

/* Not collective: the first of the options in `given` that nothing has asked PETSc for so far, as "-name", or "". */
PetscErrorCode OptionsUnused(const char *given, size_t size, char option[]);
#endif
