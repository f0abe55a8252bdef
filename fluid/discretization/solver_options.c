#include "fluid/discretization/solver_options.h"

/* Least fill, where PETSc has been built with it. */
#if defined(PETSC_HAVE_SUITESPARSE)
#define ORDERING MATORDERINGAMD
#else
#define ORDERING MATORDERINGND
#endif

PetscErrorCode SolverDefaultOption(const char *prefix, const char *option, const char *value)
{
  char name[96];
  PetscBool chosen;
  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(name, sizeof name, "-%s%s", prefix, option));
  PetscCall(PetscOptionsHasName(NULL, NULL, name, &chosen));
  if (!chosen) PetscCall(PetscOptionsSetValue(NULL, name, value));
  PetscFunctionReturn(0);
}

PetscErrorCode SolverSolve(KSP ksp, const char *equation, double t, Vec rhs, Vec x, SolverReport *report)
{
  PetscInt count;
  KSPConvergedReason reason;
  PetscFunctionBeginUser;
  PetscCall(KSPSolve(ksp, rhs, x));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(KSPGetIterationNumber(ksp, &count));
  *report = (SolverReport){.iterations = (int)count};
  if (reason <= 0)
    (void)snprintf(report->failure, sizeof report->failure,
                   "the %s equation did not converge at t = %g s: %s after %d iterations", equation, t,
                   KSPConvergedReasons[reason], report->iterations);
  PetscFunctionReturn(0);
}

PetscErrorCode SolverCreateDirect(MPI_Comm comm, const char *prefix, KSPType type, KSP *ksp)
{
  PetscMPIInt size;
  PC pc;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(KSPCreate(comm, ksp));
  PetscCall(KSPSetOptionsPrefix(*ksp, prefix));
  PetscCall(KSPSetType(*ksp, type));
  PetscCall(KSPGetPC(*ksp, &pc));
  if (size == 1) {
    PetscCall(PCSetType(pc, PCCHOLESKY));
    PetscCall(PCFactorSetMatOrderingType(pc, ORDERING));
  } else {
    PetscCall(PCSetType(pc, PCTELESCOPE));
    PetscCall(PCTelescopeSetReductionFactor(pc, size));
    PetscCall(SolverDefaultOption(prefix, "telescope_ksp_type", "preonly"));
    PetscCall(SolverDefaultOption(prefix, "telescope_pc_type", "cholesky"));
    PetscCall(SolverDefaultOption(prefix, "telescope_pc_factor_mat_ordering_type", ORDERING));
  }
  PetscFunctionReturn(0);
}
