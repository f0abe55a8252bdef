/* Options of PETSc that a case gives (keys fluid.petsc, coupler.petsc, solid.petsc). */
#ifndef CORACLE_OUTPUT_OPTIONS_H
#define CORACLE_OUTPUT_OPTIONS_H
#include <petscsys.h>

/* Not collective: the first of the options in `given` that nothing has asked PETSc for so far, as "-name", or "".  later: beginnings of options of
 * solvers that are made when they are first used, which are left out; NULL after the last, or none. */
PetscErrorCode OptionsUnused(const char *given, const char *const later[], size_t size, char option[]);
#endif
