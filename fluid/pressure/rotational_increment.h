/* The part of the pressure's increment that viscosity makes: the rotational form of pressure correction (Timmermans, Minev and
 * van de Vosse, Int. J. Numer. Methods Fluids 22, 1996; Guermond and Shen, Math. Comp. 73, 2004).
 *
 * The projection changes u* by -dt/rho grad phi, and the momentum equation's viscous stress (kernels.h), of which u* was the solution, by
 *
 *     theta div tau(-dt/rho grad phi)  =  - 4/3 theta mu grad(div u*),      div u* = div(dt/rho grad phi),
 *
 * a gradient, which the next step's pressure balances from its start:
 *
 *     p  =  p^n + phi - theta mu div u*.
 *
 * (With 4/3 of it, the whole of that gradient, what an abrupt start leaves with theta 1/2 swings by seven times as much, tests/fluid/test_abrupt_start.c.)  Without it
 * the pressure learns of viscosity by phi alone: a disc that falls with a Reynolds number of 0.001 (tests/coupled/viscous.sh) was 10 % too fast after 40 steps, with it 4 % after 8.
 *
 * div u* is the projection of the bulk velocity's on linear functions with lumped mass, 0 where the pressure is prescribed.  One fluid; among phases the
 * pressure is not incremental (fluid/README.md). */
#ifndef FLUID_ROTATIONAL_INCREMENT_H
#define FLUID_ROTATIONAL_INCREMENT_H
#include "fluid/discretization/domain.h"
#include <petscvec.h>

typedef struct RotationalIncrement_s *RotationalIncrement;

/* domain is borrowed; like: a ghosted vector of the P2 nodes; is_fixed[n] of its P2 space, borrowed: nodes where the pressure is prescribed.  Collective,
 * like all of this. */
PetscErrorCode RotationalIncrementCreate(const FluidDomain *domain, Vec like, const char is_fixed[],
                                         RotationalIncrement *increment);
PetscErrorCode RotationalIncrementDestroy(RotationalIncrement *increment);
/* p -= factor mu div u, its copies, too; divergence: of u as in bulk_divergence.h, over the factor, on owners; mu[ne], Pa s,
 * another one where its revision (material.h) is another. */
PetscErrorCode RotationalIncrementAdd(RotationalIncrement increment, Vec divergence, const double mu[],
                                      int revision, double factor, Vec p);
#endif
