/* The weight of what a solid that is held among phases displaces (mode reaction).
 *
 * The fluid that fills the solid stands still whatever its weight (inertia.h), but the pressure inside the solid depends on it: without weight
 * that is the harmonic function of the pressure around, and in elements that the surface crosses it does not meet the hydrostatic one beside it.
 * So what fills the solid weighs what lies beside it: in those elements rho_o of outside.h, elsewhere the function that is harmonic inside the
 * solid between its nodes beside elements that have fluid (harmonic.h).  Still water then has the same pressure with the solid and
 * without, and stays at rest.  The solid does not feel the weight (the body force q of inertia.h is its reaction's, too). */
#ifndef CORACLE_COUPLER_DISPLACED_H
#define CORACLE_COUPLER_DISPLACED_H
#include "coupler/geometry/harmonic.h"
#include "coupler/terms/wall_term.h"

/* Collective, after OutsideDensity and SlipTensors: displaced[nnodes], kg/m3, rho_o - rho_f inside what is held among phases; 0 where nothing
 * is, and in solids without fluid beside them.  *harmonic: of the solid's elements, NULL: not known yet; the caller destroys it. */
PetscErrorCode DisplacedDensity(const Overlap overlap, const SolidState *solid, const ElementTerm element[],
                                const SourceTerm source[], Harmonic *harmonic, double displaced[]);
#endif
