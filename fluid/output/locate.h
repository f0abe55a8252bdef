/* Where points are in a mesh.  A point inside an element has one place, a point on a face or a vertex one in each
 * element there, on whatever rank; a field's value is the mean over the places. */
#ifndef FLUID_LOCATE_H
#define FLUID_LOCATE_H
#include "common/mesh/mesh.h"

/* A point outside of the mesh by less than this part of an element's height belongs to that element, whose functions
 * are continued: points of a round wall, which the mesh follows by chords.  Not so outside of the mesh's bounding box. */
#define LOCATE_REACH 0.1

typedef struct {
  int point, element;
  double n[3];  /* barycentric coordinates */
  double share; /* 1 over the number of places of the point on all ranks */
} Place;

typedef struct {
  int n, capacity;
  Place *place;    /* [n] of this rank */
  int npoints;     /* on all ranks the same */
  double *outside; /* [npoints] 0, or 1: not in the mesh */
} Places;

/* Not collective: whether x is in the bounding box of the whole mesh. */
PetscBool LocateInBounds(const Mesh *mesh, const double x[2]);
/* Collective: makes the places of x[n][2] anew; all of *places 0 before the first call. */
PetscErrorCode PlacesLocate(const Mesh *mesh, int n, const double x[][2], Places *places);
PetscErrorCode PlacesFree(Places *places);
#endif
