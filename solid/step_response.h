/* S d = (M + c K)^-1 M d, c = dt^2/4: the response of one implicit step (interface_motion.c), by conjugate gradients.
 *
 * K is assembled once a step, in 2 x 2 blocks, with elements and joints where they are; springs are beside it.  The preconditioner is a
 * Cholesky factor of the rank's own part of M + c K at rest, turned with the material,
 *
 *     P^-1 = sum over ranks  W R (M/n + c0 K0)^-1 R^T W,
 *
 * R the mean rotation of the elements around each node (1 where a component is held), n the number of ranks that have it, W what of the
 * diagonal of the sum over ranks of M/n + c0 K0 is this rank's: a joint is its owner's alone and may be a hundred times as stiff as what other ranks have at
 * its nodes (with W = 1/n five times the iterations).  Turned that way K0 is the
 * tangent of a body that has turned and bent without much strain, so that the factor serves all steps whose c is within
 * 5 % of c0 = 1.1^k; only other lengths of step need a new one.  While joints are active, their stiffness changes by
 * orders of magnitude: then the factor is that of the present K, and R = 1.  P follows from the state alone: a step that
 * is redone or resumed has the same bits.  Springs, each of rank one or two, are not in
 * the factor and cost a few iterations.  PETSc's options of the factor have the prefix response_ (solid.petsc). */
#ifndef SOLID_STEP_RESPONSE_H
#define SOLID_STEP_RESPONSE_H
#include "solid/solid_impl.h"

/* Collective: K and P of the solid as it is now, for steps of s->dt. */
PetscErrorCode StepResponseUpdate(Solid s);
/* Collective: d[nnodes][2] -> S d, with K and P of the last update; what is held keeps its d.  tolerance: of the residual, over M d. */
PetscErrorCode StepResponseApply(Solid s, double tolerance, double d[]);
/* Not collective: component k = 2 node + c was held at the last update: its node is fixed, or a prescribed motion moves it. */
PetscBool StepResponseHolds(Solid s, int k);
PetscErrorCode StepResponseDestroy(StepResponse *response);
#endif
