/* Where the flow is: the mesh, the pressure's nodes, the geometry of its elements and the conditions on its boundaries.
 * Momentum, projection and measurements share one domain and only read it; it lasts as long as the mesh. */
#ifndef FLUID_DOMAIN_H
#define FLUID_DOMAIN_H
#include "common/space/p2_space.h"
#include "fluid/discretization/boundary.h"
#include "fluid/discretization/kernels.h"

typedef struct {
  const Mesh *mesh;          /* borrowed */
  P2Space *p2;               /* of the pressure */
  ElementGeometry *geometry; /* [ne + ng] */
  Boundary *boundary;        /* [mesh->ntags], a copy */
  int nfaces, *face;         /* [nfaces] 3 e + i: faces of this rank's elements on boundaries */
} FluidDomain;

/* Collective over mesh->comm (bounding boxes of the boundaries). */
PetscErrorCode DomainCreate(const Mesh *mesh, const Boundary boundary[], FluidDomain *d);
PetscErrorCode DomainDestroy(FluidDomain *d);

/* Position of vertex i of element e, m. */
static inline const double *ElementVertex(const Mesh *m, int e, int i)
{
  return m->x + 2 * m->vertex[3 * e + i];
}

/* The boundary on which face i of element e lies; NULL inside. */
static inline const Boundary *BoundaryOfFace(const FluidDomain *d, int e, int i)
{
  return d->mesh->neighbor[3 * e + i] >= 0 ? NULL : d->boundary + d->mesh->tag[3 * e + i];
}

/* grad[i]: the gradient at vertex i of element e of the P2 field p on this rank's nodes. */
static inline void DomainGradient(const FluidDomain *d, int e, const double p[], double grad[3][2])
{
  double pe[6];
  for (int k = 0; k < 6; k++) pe[k] = p[d->p2->node[6 * e + k]];
  P2Gradient(d->geometry[e].g, pe, grad);
}

/* Each side's share of the interior penalty: eta = PENALTY_FACTOR (mu_K trace_K + mu_N trace_N)/2, twice its own on a boundary. */
#define PENALTY_INTERIOR 0.5
#define PENALTY_BOUNDARY 2.0

/* Element e as the kernels of its face i see it, viscosity mu[e] and penalty times theta; its two vertices are
 * (i + 1) % 3 and (i + 2) % 3. */
static inline FaceSide FaceSideOf(const FluidDomain *d, const double mu[], int e, int i, double theta,
                                  double share)
{
  const ElementGeometry *g = d->geometry + e;
  return (FaceSide){g, theta * mu[e], theta * share * PENALTY_FACTOR * mu[e] * g->trace, (i + 1) % 3,
                    (i + 2) % 3};
}
#endif
