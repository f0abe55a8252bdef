/* Triangulations of the built-in bodies, undistributed.  Not collective; destroy with MeshSerialDestroy. */
#ifndef SOLID_SHAPE_H
#define SOLID_SHAPE_H
#include "mesh.h"

/* A disc of m rings, ring k having 6 k nodes; its boundary is a regular polygon of 6 m edges no longer than
 * size whose *area is pi r^2* (the corners lie slightly outside the circle, by r pi^2/(3 (6m)^2)), so that
 * mass and displaced fluid are the disc's.  Boundary name: boundary. */
PetscErrorCode ShapeDisc(const double centre[2], double radius, double size, MeshSerial *mesh);
/* A rectangle of width by height about centre, turned by angle (rad), with edges no longer than size along
 * its sides; diagonals alternate.  Boundary names: left, right, bottom, top, as before turning. */
PetscErrorCode ShapeRectangle(const double centre[2], double width, double height, double angle, double size,
                              MeshSerial *mesh);
/* A ring with `layers` elements through its wall and edges no longer than size along its outer side; polygons
 * of an even number of sides, with radii such that its area is pi (outer^2 - inner^2).  Boundary names:
 * inner, outer. */
PetscErrorCode ShapeRing(const double centre[2], double inner, double outer, int layers, double size,
                         MeshSerial *mesh);
#endif
