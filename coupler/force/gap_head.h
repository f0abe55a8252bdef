/* The head beside the solid (uplift.h) where no fluid element shows it: harmonic along the surface and through the gaps between solids,
 * from the nodes where it is given, that is, with the least
 *
 *     sum over facets (v_a - v_b)^2/length  +  sum over close points weight/length^2 (v(x) - v(y))^2
 *
 * so that a gap has as little resistance across as along a facet.  The same quadratic form has the pressure of a film of which each piece of the
 * gap yields alike (squeeze_film.h): -d2 profile/ds2 = 1, 0 where the head is given, half a square of the length of the gap. */
#ifndef CORACLE_COUPLER_GAP_HEAD_H
#define CORACLE_COUPLER_GAP_HEAD_H
#include "common/exchange/copies.h"
#include "coupler/force/surface_pressure.h"
#include "coupler/geometry/close_points.h"

/* Collective: value[nnodes] where is_free[nnodes], from that of the other nodes, to 1e-10; 0 where nothing is given on surfaces that are
 * connected.  profile[nnodes], m2, 0 there and where the value is given.  The same on all copies of a node, which nodes knows; solid and shell
 * are those of the points. */
PetscErrorCode GapHeadSolve(const ClosePoints *points, const SolidState *solid, const Shell shell,
                            Copies nodes, const char is_free[], double value[][SURFACE_HEAD_FIELDS],
                            double profile[]);
#endif
