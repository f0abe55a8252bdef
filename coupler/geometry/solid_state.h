/* The solid as the coupler's numerics see it: the nodes, surface facets and volume elements that this rank's
 * clients own, with their velocities.  Arrays are borrowed from whoever fills the struct (exchange.h in a
 * run).
 *
 *      solid on the left       facet f: facet[f] = (a, b)       element t: element[t] = (a, b, c),
 *      of a -> b               runs along the surface           counter-clockwise
 *
 * A node that several ranks hold has one gid and a copy on each; an element or a facet is on one rank. */
#ifndef CORACLE_SOLID_STATE_H
#define CORACLE_SOLID_STATE_H
#include <petscsys.h>

typedef struct {
  int changed; /* nodes, facets or elements are others than at the last exchange */
  int lost;    /* changed within the step, and the nodes of its start cannot be recovered */
  /* changed on this rank within the step and not lost: the elements in the nodes that this rank had at the
   * step's start, [nelements][3]; else NULL */
  const int *start_element;
  int pressure_load;                     /* the fluid's pressure is to compress it (pressure_load.h) */
  int nnodes, nfacets, nelements;        /* on this rank */
  const long long *gid;                  /* [nnodes] */
  const double *x;                       /* [nnodes][2] position, m */
  const double *u;                       /* [nnodes][2] the velocity that the mode couples to (mode.h), m/s */
  const double *mobility, *acceleration; /* [nnodes] 1/kg, [nnodes][2] m/s2 (inertia.h); 0: none is known */
  const int *facet, *element;            /* [nfacets][2], [nelements][3] nodes of this rank */
} SolidState;

/* Not collective.  A copy that owns its arrays, without start_element; it may have been a copy before,
 * zero-initialise the first time. */
PetscErrorCode SolidStateCopy(const SolidState *solid, SolidState *copy);
PetscErrorCode SolidStateDestroy(SolidState *copy);

/* Not collective.  An element of which less than a tenth is left where the velocity brings it within `ahead` s, -1: none. */
int SolidStateInverted(const SolidState *solid, double ahead);

/* Not collective.  Maps nodal values value[nnodes][2] to the n nodes that the step started with,
 * start[n][2]: where a crack has split a node, the mean over the corners of its elements.  Nodes without
 * elements keep their value in start. */
PetscErrorCode SolidStateOnStartNodes(const SolidState *solid, const double value[], int n, double start[]);
#endif
