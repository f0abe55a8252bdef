/* Targets of other ranks that this rank's edges may touch: their positions come before the contact forces are
 * computed, the forces on them go back afterwards.  Every pair (edge, target) is computed once, by the edge's
 * rank. */
#ifndef SOLID_CONTACT_HALO_H
#define SOLID_CONTACT_HALO_H
#include "common/supermesh/geometry.h"
#include <petscsys.h>

/* An element with a node on the surface. */
typedef struct {
  int node[3];                /* local nodes; nnodes + 3 k + i for the i-th node of target k of the halo */
  int body, material, number; /* the last: in the model */
  long long gid[3];           /* of its nodes */
  double rest[6];             /* [3][2] rest coordinates, m */
  double twice_area;          /* at rest, m2 */
  int sector;                 /* of a rigid disc: its side on the circle; -1: there is none */
  double at_centre[3];        /* then, barycentric coordinates of the disc's centre */
} Target;

typedef struct Halo_s *Halo;

PetscErrorCode HaloCreate(MPI_Comm comm, Halo *h);
/* Collective: offers own targets, widened by their body's margin, to the ranks whose edges' box they touch.  Received ones:
 * HaloTargets. */
PetscErrorCode HaloBuild(Halo h, int nnodes, const double x[], const double margin[],
                         const GeometryBox *edges, int n, const Target target[]);
/* Collective: forgets those with keep[k] = 0; index[k] becomes the new place of target k or -1. */
PetscErrorCode HaloKeep(Halo h, const char keep[], int index[]);
int HaloTargets(Halo h, const Target **target);
/* Targets that travel in a substep, to this rank and from it. */
int HaloTraffic(Halo h);
/* Collective over neighbours: x[nnodes][2] and, unless v is NULL, v[nnodes][2] of the owners to the halo. */
PetscErrorCode HaloForward(Halo h, const double x[], const double v[]);
const double *HaloPositions(Halo h);  /* [targets][3][2] */
const double *HaloVelocities(Halo h); /* [targets][3][2] */
double *HaloForces(Halo h);           /* [targets][3][2], zeroed by HaloForward */
/* Collective over neighbours: adds the halo's forces to the owners' force[nnodes][2], in order of the ranks.
 */
PetscErrorCode HaloReverse(Halo h, double force[]);
PetscErrorCode HaloDestroy(Halo *h);
#endif
