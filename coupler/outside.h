/* The weight of the fluid beside the solid in elements that the surface crosses, among phases (mode reaction); with one fluid it is
 * nothing.
 *
 * Such an element K has the mean density rho_K, of which the part inside the solid, alpha = |K and S|/|K|, has rho_f (the
 * phase that fills solids); so beside the solid it is
 *
 *     rho_o  =  (rho_K - alpha rho_f)/(1 - alpha).
 *
 * The fluid spreads its weight evenly over K.  Where it is, it is rho_o beside the solid and rho_f inside; the difference,
 * whose sum over K's functions is 0, is added to s:
 *
 *     (rho_o - rho_f) (alpha int_K N - int_{K and S} N) g.
 *
 * Without it each element that is crossed turns beside a solid at rest.  (Its inertia, moved likewise, needs a reaction with
 * the water's density on the solid's nodes: nodes lighter than that are thrown about.) */
#ifndef CORACLE_COUPLER_OUTSIDE_H
#define CORACLE_COUPLER_OUTSIDE_H
#include "coupler/wall_term.h"

/* Local: the weight above, beside the pairs in the solid's volume that are not held, of element[overlap->ncoupled]; gravity in m/s2. */
PetscErrorCode OutsideWeight(const Overlap overlap, const double gravity[2], ElementTerm element[]);
#endif
