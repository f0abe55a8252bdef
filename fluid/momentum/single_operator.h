/* The operator of momentum_operator.h in single precision, for the products of the Krylov iteration: it looks for a
 * correction of u*, of which 1e-7 is below the tolerance; the residual that it starts from has the operator in
 * double precision.
 *
 *     bytes an element: 144 of S, 32 of the geometry, 32 of x, 16 of its stress; D stays in double precision */
#ifndef FLUID_SINGLE_OPERATOR_H
#define FLUID_SINGLE_OPERATOR_H
#include "fluid/momentum/momentum_operator.h"
#include "fluid/momentum/single.h"

typedef struct SingleOperator_s *SingleOperator;

/* op is borrowed.  Collective, like all of this. */
PetscErrorCode SingleOperatorCreate(MomentumOperator *op, SingleOperator *s);
PetscErrorCode SingleOperatorDestroy(SingleOperator *s);
/* For op as it has been assembled. */
PetscErrorCode SingleOperatorUpdate(SingleOperator s);
/* y = A x. */
PetscErrorCode SingleOperatorApply(SingleOperator s, Vec x, Vec y);
#endif
