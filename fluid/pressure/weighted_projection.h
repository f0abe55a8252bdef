/* The inertia-weighted projection: on elements with a solid's implicit inertia (coracle.h) the pressure moves
 * fluid and solid together,
 *
 *     u_projected = u* - dt W^-1 M grad phi,   W = rho M/dt + implicit inertia times its tensor   (6 x 6, element by element:
 *                                              3 x 3 along each of the tensor's principal axes)
 *
 * and the pressure's matrix is C^T M W^-1 M C/dt there instead of C^T M C/rho.  Not collective, but for Prepare. */
#ifndef FLUID_WEIGHTED_PROJECTION_H
#define FLUID_WEIGHTED_PROJECTION_H
#include "fluid/discretization/domain.h"
#include "fluid/discretization/solid_coupling.h"
#include <petscsys.h>

typedef struct WeightedProjection_s *WeightedProjection;

typedef struct {
  double dt;           /* s */
  const double *rho;   /* [ne], kg/m3 */
  SolidCoupling solid; /* borrowed until the next Prepare */
  PetscBool inertia;   /* it takes part: responses are wanted */
} WeightedProjectionStep;

PetscErrorCode WeightedProjectionCreate(const FluidDomain *domain, WeightedProjection *w);
PetscErrorCode WeightedProjectionDestroy(WeightedProjection *w);
/* Of the elements with implicit inertia, on any rank. */
typedef struct {
  PetscBool active; /* there are some */
  PetscBool moves;  /* not all of them are of solids that are held at rest */
  PetscBool
      same; /* their inertia times dt, and the density there, are those of the last Prepare, and so are the blocks */
} WeightedProjectionFound;

/* Responses of the current step.  Collective. */
PetscErrorCode WeightedProjectionPrepare(WeightedProjection w, const WeightedProjectionStep *step,
                                         WeightedProjectionFound *found);
/* block[q][r] = int of grad N_q . M W^-1 M grad N_r/dt over the P2 basis of element e; false, and nothing written,
 * where it has no implicit inertia. */
PetscBool WeightedProjectionBlock(WeightedProjection w, int e, double block[6][6]);
/* u[2][3] of element e -= its response to grad phi; false where it has no implicit inertia. */
PetscBool WeightedProjectionVelocity(WeightedProjection w, int e, const double grad[3][2], double u[6]);
/* v[2][3] = W^-1 v on the element of an entry: its area, m2, and rho/dt, kg/(m3 s). */
PetscErrorCode WeightedProjectionSolve(double area, double rho_dt, const CoracleCoupling *entry, double v[6]);
#endif
