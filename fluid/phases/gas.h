/* The equation of state of a phase.  Kernel: no mesh, no MPI.
 *
 *     rho = rho_0 (1 + p/p_0)^(1/n),    1/(rho c^2) = 1/(n (p_0 + p))
 *
 * p is the fluid's pressure, rho_0 the density where that is 0 and p_0 the absolute pressure there: an ideal gas, isothermal for
 * n = 1, adiabatic for n = 1.4 of air.  A sound speed c that does not depend on the pressure is p_0 = rho_0 c^2, n = 1. */
#ifndef CORACLE_PHASES_GAS_H
#define CORACLE_PHASES_GAS_H
#include <math.h>

/* pressure = 0: incompressible. */
typedef struct {
  double density, pressure, exponent; /* rho_0, kg/m3; p_0, Pa; n */
} EquationOfState;

/* Pa */
static inline double GasPressure(const EquationOfState *s, double rho)
{
  return s->pressure * (pow(rho / s->density, s->exponent) - 1.0);
}

/* kg/m3 */
static inline double GasDensity(const EquationOfState *s, double p)
{
  return s->density * pow(fmax(1.0 + p / s->pressure, 1e-6), 1.0 / s->exponent);
}

/* 1/(rho c^2), 1/Pa */
static inline double GasCompressibility(const EquationOfState *s, double rho)
{
  return 1.0 / (s->exponent * s->pressure * pow(rho / s->density, s->exponent));
}
#endif
