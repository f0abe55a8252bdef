/* The head beside the solid (uplift.h) where no fluid element shows it: harmonic along the surface and through the gaps between solids,
 * from the nodes where it is given, that is, with the least
 *
 *     sum over facets (v_a - v_b)^2/length  +  sum over close points weight/length^2 (v(x) - v(y))^2
 *
 * so that a gap has as little resistance across as along a facet. */
#ifndef CORACLE_COUPLER_GAP_HEAD_H
#define CORACLE_COUPLER_GAP_HEAD_H
#include "common/exchange/copies.h"
#include "coupler/force/surface_pressure.h"
#include "coupler/geometry/close_points.h"

/* Collective: value[nnodes] where is_free[nnodes], from that of the other nodes, to 1e-10; 0 where nothing is given on surfaces that are
 * connected.  The same on all copies of a node, which nodes knows; solid and shell are those of the points. */
PetscErrorCode GapHeadSolve(const ClosePoints *points, const SolidState *solid, const Shell shell,
                            Copies nodes, const char is_free[], double value[][SURFACE_HEAD_FIELDS]);
#endif
