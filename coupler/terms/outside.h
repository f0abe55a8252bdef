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
 * The solid does not feel it.  Without it each element that is crossed turns beside a solid at rest.  (Its inertia, moved likewise, needs a reaction with
 * the water's density on the solid's nodes: nodes lighter than that are thrown about.) */
#ifndef CORACLE_COUPLER_OUTSIDE_H
#define CORACLE_COUPLER_OUTSIDE_H
#include "coupler/terms/wall_term.h"

/* Of K: less than that is nothing beside the solid. */
#define OUTSIDE_LEAST 1e-3

/* Local: rho_o - rho_f of element[overlap->ncoupled], between 0 and that of the phases beside the solid; 0 with one fluid.  Its weight
 * is that of the pairs in the solid's volume that are not held. */
void OutsideDensity(const Overlap overlap, ElementTerm element[]);
#endif
