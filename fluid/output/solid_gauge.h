/* The pressure at gauges on solids, and the force of it on a straight side of one. */
#ifndef FLUID_SOLID_GAUGE_H
#define FLUID_SOLID_GAUGE_H
#include "fluid/flow/fluid.h"
#include "fluid/input/probe_case.h"
#include "fluid/output/locate.h"

typedef struct {
  double x[2];     /* m, of the solid's face */
  double pressure; /* Pa, where it is taken */
  double at_face;  /* Pa, that and the weight of the fluid between it and the face */
} GaugeReading;

/* Collective: reading[ngauges] at the gauges; moving: the places, kept for their memory.  Where a floor or another solid is before a gauge the pressure is
 * that behind its face. */
PetscErrorCode SolidGaugeRead(const ProbeCase *list, Fluid fluid, const CoracleGauge gauge[], Places *moving,
                              GaugeReading reading[]);
/* Not collective: force x and y, N/m, and moment about the side's first end, N, of the pressure on a side with n gauges at the middles of its parts:
 *
 *   F = - sum p n |x_{i+1} - x_{i-1}|/2,   x_{-1} and x_n as far beyond the side's ends as x_0 and x_{n-1} are before them */
void SolidGaugeForce(int n, const CoracleGauge gauge[], const GaugeReading reading[], double force[3]);
#endif
