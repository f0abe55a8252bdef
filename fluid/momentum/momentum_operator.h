/* The operator A of the momentum equation, applied without its 6 x 6 blocks.  Both components of the velocity share one
 * scalar operator S (mass, advection, the Laplacian's part of the viscous stress), stored; the rest of the stress couples the components
 * and follows from the geometry; what boundaries and the solid do to one element alone is a dense block:
 *
 *     A u  =  (I2 x S) u   +   C u   +   D u
 *
 *     S   3 x 3 blocks, column-major      block[e][0]      element e with itself
 *                                         block[e][1 + i]  with its neighbour across face i
 *     C   stress theta mu (grad u^T - 2/3 div u I), interior penalty on interior faces
 *     D   6 x 6 blocks of few elements: dense[k] of element dense_element[k]; what is the same for both components S has
 *
 * The Krylov iteration multiplies with its copy in single precision (single_operator.h). */
#ifndef FLUID_MOMENTUM_OPERATOR_H
#define FLUID_MOMENTUM_OPERATOR_H
#include "fluid/discretization/domain.h"
#include <petscmat.h>

typedef double ScalarBlocks[4][9];

typedef struct {
  const FluidDomain *domain; /* borrowed */
  ScalarBlocks *block;       /* [ne + 1], the last one is only read over */
  double (*volume)[9]; /* [ne] of block[e][0] all but interior faces: its part in continuous functions */
  int ndense, dense_capacity;
  int *dense_element, *dense_at; /* [ndense]; [ne] the index of an element's dense block, or -1 */
  double (*dense)[36];
  double diffusion;    /* largest theta mu dt/(rho |K|) of this rank's elements */
  double *theta_mu;    /* [ne + ng] theta times viscosity, Pa s */
  double (*stress)[4]; /* [ne + ng] scratch: C's stress, column-major */
  PetscBool alone;     /* one rank: there are no ghosts */
  Vec ghosted;         /* scratch: an argument with its ghosts */
} MomentumOperator;

/* like: a velocity, ghosted blocks [2][3].  Collective. */
PetscErrorCode MomentumOperatorCreate(const FluidDomain *domain, Vec like, MomentumOperator *op);
PetscErrorCode MomentumOperatorDestroy(MomentumOperator *op);
/* Adds the dense block (6 x 6, column-major) of element e: to S where it is the same for both components, else to D; to volume the mean of
 * its xx and yy parts.  Not collective. */
PetscErrorCode MomentumOperatorAddDense(MomentumOperator *op, int e, const double block[36]);
/* There are none, for the next step.  Not collective. */
void MomentumOperatorClearDense(MomentumOperator *op);
/* y = A x.  Collective. */
PetscErrorCode MomentumOperatorApply(MomentumOperator *op, Vec x, Vec y);
/* y += D x, [ne][2][3].  Not collective. */
void MomentumOperatorApplyDense(const MomentumOperator *op, const double x[], double y[]);
/* *u: x and behind it the ghosts, until it is restored.  Collective. */
PetscErrorCode MomentumOperatorGetGhosted(MomentumOperator *op, Vec x, const PetscScalar **u);
PetscErrorCode MomentumOperatorRestoreGhosted(MomentumOperator *op, Vec x, const PetscScalar **u);
#endif
