/* Conservative fluxes from a velocity whose divergence vanishes against the P2 functions only.
 *
 * r_{K,a} = int_K u . grad(lambda_a), lambda_a the hat function of vertex a of element K.  A hat function is
 * in P2, so around an inner vertex the r_{K,a} of its star sum to zero, and one number per edge of the star,
 *
 *        \  |  /           phi_{k+1} = phi_k + r_{K_k,a}        counter-clockwise around a,
 *       K1\ | /K0
 *      ----a-----  phi_0   is fixed up to one constant, which brings the phi closest to int_f lambda_a {u}.n
 *       K2/ | \            (least squares, weight 1 / length).  At the boundary the chain begins and ends at
 *        /  |  \           boundary faces: prescribed there, or free where the boundary is open.
 *
 * The flux through a face is the sum over its two vertices, and over an element sum_f F_f = int_K u . grad(1)
 * = 0. With the linear part of {u}.n the fluxes make a field beta in BDM1 (Brezzi, Douglas and Marini 1985):
 * its normal part is continuous and its divergence is zero in every point.
 *
 * What a solver's tolerance leaves of sum r - (prescribed flux) around a vertex is spread evenly over its
 * elements and reported: an element's fluxes then sum to the shares of its vertices. */
#ifndef CORACLE_PHASES_FLUX_H
#define CORACLE_PHASES_FLUX_H
#include "fluid/phases/stars.h"

typedef struct {
  const char *open; /* [ntags] nonzero: free; else prescribed.  NULL: no boundary is open */
  /* [ne][3][2] int_f lambda g.n, m2/s, of a face's first and second vertex (i + 1) % 3 and (i + 2) % 3, read
   * on prescribed boundary faces only.  NULL: 0 everywhere */
  const double *moment;
  /* [nl] of elements that may have a divergence: what does not close around a vertex goes by these.  NULL, or where all are 0:
   * evenly */
  const double *weight;
} FluxBoundary;

typedef struct {
  double defect;    /* largest |sum r - prescribed| around a vertex, m2/s */
  double imbalance; /* largest |sum of the fluxes| of an element, m2/s */
  double largest;   /* |flux| through a face, m2/s */
  double change;    /* root mean square of F - int_f {u}.n over that of int_f {u}.n, inner faces */
} FluxReport;

/* Collective.  u[ne][6]: P1DG velocity, component c at vertex i is 3 c + i, m/s.  flux[ne][3]: outward, m2/s;
 * the two sides of a face have opposite numbers to the last bit, on any ranks.  beta[ne][6], or NULL, like u.
 * */
PetscErrorCode FluxEquilibrate(const Stars *stars, const double u[], const FluxBoundary *boundary,
                               double flux[], double beta[], FluxReport *report);

/* The linear field[6], like u, on an element with given normal parts (outward) at the ends of its faces:
 * normal[face][first or second vertex].  Not collective. */
void FluxLinearField(const StarElement *element, const double normal[3][2], double field[6]);
/* u.n, outward, at both ends of face i of a field like u; *length of the face, m.  Not collective. */
void FluxNormalParts(const StarElement *element, const double u[6], int i, double normal[2], double *length);

/* Collective.  One continuous velocity[ne][3][2] at the vertices: the mean of beta over each star, weighted
 * with the elements' areas; the same bits wherever a vertex appears. */
PetscErrorCode FluxVertexVelocity(const Stars *stars, const double beta[], double velocity[]);
#endif
