/* The fluid beside the solid in elements that the surface crosses, where several phases share one velocity (mode reaction).
 *
 * Such an element K has the mean density rho_K, of which the part inside the solid, alpha = |K and S|/|K|, has rho_f (the
 * phase that fills solids); so beside the solid it is
 *
 *     rho_o  =  (rho_K - alpha rho_f)/(1 - alpha).
 *
 * The fluid spreads its mass evenly over K, rho_K M.  Where it is, it is rho_o (M - B) + rho_f B, B = int over K and S of
 * N N; the difference is added to the implicit inertia, its weight to s,
 *
 *     (rho_o - rho_f)/dt (alpha M - B),       (rho_o - rho_f) (alpha M - B) g,
 *
 * and element, solid and water have their masses where they are, as with one fluid, for which this is 0.  Reaction on the
 * vertices of a pair's triangle: (rho_o - rho_f)/dt (int N_T of [u] - int N_T u), u the change over the step, [u] its mean
 * over K; the weight has none. */
#ifndef CORACLE_COUPLER_OUTSIDE_H
#define CORACLE_COUPLER_OUTSIDE_H
#include "coupler/wall_term.h"

/* Local: inertia and weight above of the pairs in the solid's volume that are not held; density[overlap->nsources]: of the solid, 0
 * where it is held (inertia.h). */
PetscErrorCode OutsideCoefficients(const Overlap overlap, const double density[], double dt,
                                   const double gravity[2], PairTerm term[]);
#endif
