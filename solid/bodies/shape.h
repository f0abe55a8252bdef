/* Triangulations of the built-in bodies, undistributed.  Not collective; destroy with MeshSerialDestroy. */
#ifndef SOLID_SHAPE_H
#define SOLID_SHAPE_H
#include "common/mesh/mesh.h"
#include "solid/element_law.h"

/* A disc of m rings, ring k having 6 k nodes; its boundary is a regular polygon of 6 m edges no longer than
 * size whose *area is pi r^2* (the corners lie slightly outside the circle, by r pi^2/(3 (6m)^2)), so that
 * mass and displaced fluid are the disc's.  Boundary name: boundary. */
PetscErrorCode ShapeDisc(const double centre[2], double radius, double size, MeshSerial *mesh);
/* The affine image of a disc's mesh, of area pi times the product of the radii along its axes, turned (rad): edges of the boundary no longer
 * than size, the others shorter along the shorter axis. */
PetscErrorCode ShapeEllipse(const double centre[2], const double radii[2], double turned, double size,
                            MeshSerial *mesh);
/* A rectangle of width by height about centre, turned by angle (rad), with edges no longer than size along
 * its sides; diagonals alternate.  Boundary names: left, right, bottom, top, as before turning. */
PetscErrorCode ShapeRectangle(const double centre[2], double width, double height, double angle, double size,
                              MeshSerial *mesh);
/* A ring with `layers` elements through its wall and edges no longer than size along its outer side; polygons
 * of an even number of sides, with radii such that its area is pi (outer^2 - inner^2).  Boundary names:
 * inner, outer. */
PetscErrorCode ShapeRing(const double centre[2], double inner, double outer, int layers, double size,
                         MeshSerial *mesh);
/* Where the nodes of a ring at rest, of ShapeRing about this centre, are when its wall's middle line, the
 * circle of the mean radius R, has become an ellipse, x[nv][2], m.  The wall stays normal to it, with the
 * thickness at which nothing acts on its faces (ElementFreeStretch of the line's own stretch):
 *
 *     (R + d) e_r  ->  m + l_n d n,    m = centre + R (s_x cos, s_y sin),   n its outer normal
 *
 * An affine map would stretch the wall across too, which then vibrates through its thickness.  What is left
 * across is of order thickness/R of what acts along, as bending is. */
void ShapeRingStretched(const double centre[2], const double stretch[2], ElementLaw law,
                        const MeshSerial *mesh, double x[]);
#endif
