/* What the fluid's solvers (PETSc's KSP, chosen by options) have in common. */
#ifndef FLUID_SOLVER_OPTIONS_H
#define FLUID_SOLVER_OPTIONS_H
#include <petscksp.h>

/* Sets an option of PETSc that nobody has set: for solvers that are made inside of others.  Not collective. */
PetscErrorCode SolverDefaultOption(const char *prefix, const char *option, const char *value);
typedef struct {
  int iterations;
  char failure[160]; /* "": has converged; else equation, t, s, and PETSc's reason */
} SolverReport;
/* Collective. */
PetscErrorCode SolverSolve(KSP ksp, const char *equation, double t, Vec rhs, Vec x, SolverReport *report);
/* A solver with a direct factor as preconditioner; operators, tolerances and options are still to be set.
 * One rank has the factor (PETSc's own Cholesky, whose two triangular solves are twice as fast here as those of
 * the supernodal packages): its solve costs less than a distributed one until the mesh is large;
 * -<prefix>pc_type and the like choose otherwise.  Collective. */
PetscErrorCode SolverCreateDirect(MPI_Comm comm, const char *prefix, KSPType type, KSP *ksp);
#endif
