/* Where a body of the case is and what it looks like, for case_body.c.  Not collective; all refuse what cannot be. */
#ifndef SOLID_CASE_SHAPE_H
#define SOLID_CASE_SHAPE_H
#include "solid/bodies/case_body.h"

/* How often the body is there along x and y, and how far apart. */
typedef struct {
  int n[2];
  double step[2]; /* m */
} BodyRepeat;
BodyRepeat CaseReadRepeat(CoracleCase c, int body);
/* The body's mesh, from its shape or its file; *circle: the radius of a disc, m, or 0. */
PetscErrorCode CaseReadShape(CoracleCase c, int body, MeshSerial *mesh, double *circle);
/* A ring keeps its wall (*position is allocated), other shapes are stretched as they are. */
PetscErrorCode CaseReadStretch(CoracleCase c, int body, const MeshSerial *mesh, BodySetup *setup,
                               double **position);
#endif
