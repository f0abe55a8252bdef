/* Solves x = H(x) for an H of which only values are known: interface quasi-Newton by least squares (IQN-ILS:
 * Degroote, Bathe, Vierendeels, Comput. Struct. 87, 2009).  With residuals r = H(x) - x and what is known of
 * their changes V = (dr_1 .. dr_m), W = (dH_1 .. dH_m), those of earlier solves among them,
 *
 *     x' = H(x) + W c,    c = argmin |r + V c|
 *
 * Columns that hardly differ from newer ones are dropped (QR with a filter). */
#ifndef CORACLE_ACCELERATE_H
#define CORACLE_ACCELERATE_H
#include <petscsys.h>

typedef struct QuasiNewton_s *QuasiNewton;

/* Collective, as all of these. */
PetscErrorCode QuasiNewtonCreate(MPI_Comm comm, QuasiNewton *a);
/* Another equation, of n numbers on this rank; what is known is kept if n is what it was on all ranks. */
PetscErrorCode QuasiNewtonBegin(QuasiNewton a, int n);
/* next[n] from x[n] and hx[n] = H(x). */
PetscErrorCode QuasiNewtonNext(QuasiNewton a, const double x[], const double hx[], double next[]);
PetscErrorCode QuasiNewtonDestroy(QuasiNewton *a);
#endif
