/* What compressible phases add to the pressure's equation.  With beta = sum of a_k/(rho_k c_k^2), a_k the shares of an element:
 *
 *   div u = -beta (p - p~)/dt:    int k grad phi.grad q + int beta phi q/dt^2 = int u.grad q/dt - ... - int beta (p - p~) q/dt^2
 *
 * p is the pressure before phi is added, p~ the one that the phases would have without the step. */
#ifndef FLUID_COMPRESSIBILITY_H
#define FLUID_COMPRESSIBILITY_H
#include "fluid/discretization/domain.h"
#include <petscvec.h>

/* Of an element: beta, 1/Pa; p~ at the P2 nodes, Pa; the pressure by the equation of state at the start of the step, and its share
 * in p~. */
typedef struct {
  double beta, target[6], state, share;
} CompressibleElement;

/* int N_i N_j over the P2 functions of an element of unit area: vertices, then the edges opposite. */
static inline double P2Mass(int i, int j)
{
  if (i < 3 && j < 3) return (i == j ? 6.0 : -1.0) / 180.0;
  if (i >= 3 && j >= 3) return (i == j ? 32.0 : 16.0) / 180.0;
  return (i + 3 == j || j + 3 == i ? -4.0 : 0.0) / 180.0;
}

/* block += int beta N_i N_j/dt^2 */
static inline void CompressibilityBlock(const CompressibleElement *c, double area, double dt,
                                        double block[6][6])
{
  if (c->beta == 0.0) return;
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++) block[i][j] += c->beta / (dt * dt) * area * P2Mass(i, j);
}

/* load[i] -= int beta (p - p~) N_i/dt */
static inline void CompressibilityLoad(const CompressibleElement *c, double area, double dt,
                                       const double p[6], double load[6])
{
  if (c->beta == 0.0) return;
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++) load[i] -= c->beta / dt * area * P2Mass(i, j) * (p[j] - c->target[j]);
}

/* d[n of the P2 space] += the loads of all elements[ne]; p: ghosted.  Not collective. */
PetscErrorCode CompressibilityAddLoads(const FluidDomain *domain, const CompressibleElement elements[],
                                       double dt, Vec p, PetscScalar d[]);
#endif
