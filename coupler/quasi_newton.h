/* Interface quasi-Newton by least squares, IQN-ILS (Degroote, Bathe, Vierendeels, Comput.  Struct. 87, 2009):
 * solves x = H(x) from values of H alone.  With the residual r = H(x) - x and the differences of earlier
 * iterations (and earlier solves) V = (dr_1 .. dr_m), W = (dH_1 .. dH_m), newest first,
 *
 *     x_next = H(x) + W c,      c = argmin |r + V c|      by V = Q R.
 *
 * Columns that are nearly dependent on newer ones are dropped (QR with a filter). */
#ifndef CORACLE_QUASI_NEWTON_H
#define CORACLE_QUASI_NEWTON_H
#include <petscsys.h>

typedef struct QuasiNewton_s *QuasiNewton;

/* Collective, as all of these. */
PetscErrorCode QuasiNewtonCreate(MPI_Comm comm, QuasiNewton *a);
/* Starts another solve with n unknowns on this rank (-1: none);  V and W are kept if n is unchanged on all
 * ranks. */
PetscErrorCode QuasiNewtonBegin(QuasiNewton a, int n);
/* next[n], which may be x, from x[n] and hx[n] = H(x). */
PetscErrorCode QuasiNewtonNext(QuasiNewton a, const double x[], const double hx[], double next[]);
PetscErrorCode QuasiNewtonDestroy(QuasiNewton *a);
#endif
