/* Loads on boundaries of bodies, in the plane and times the thickness at rest: a pressure, normal to the edge where it is now, and a
 * traction of fixed direction over the edge at rest.  Kernel: no MPI, no PETSc, no memory.
 *
 *     f_i = int N_i (-p n) ds + int N_i t dS        n ds: outward, of the deformed edge; dS: of that at rest
 *
 * A negative pressure pulls.  Of a six-node triangle the edge has three nodes, and N_i are quadratic: f belongs to half of it. */
#ifndef SOLID_BOUNDARY_LOAD_H
#define SOLID_BOUNDARY_LOAD_H
#include "common/program/time_table.h"
#include <math.h>

typedef struct {
  TimeTable pressure; /* of t, s, and Pa; nrows 0: none */
  TimeTable traction; /* of t, s, and its components, Pa */
} BoundaryLoad;

/* Side i of an element, from its corner i to the next, has the load. */
typedef struct {
  int element, side, load;
} LoadedSide;

/* N_i and their derivatives at s of an edge of 2 or 3 nodes, in order along it; s from 0 to 1. */
static inline void EdgeShape(int nnodes, double s, double value[3], double slope[3])
{
  value[0] = nnodes == 2 ? 1.0 - s : (1.0 - s) * (1.0 - 2.0 * s);
  value[1] = nnodes == 2 ? s : 4.0 * s * (1.0 - s);
  value[2] = nnodes == 2 ? 0.0 : s * (2.0 * s - 1.0);
  slope[0] = nnodes == 2 ? -1.0 : 4.0 * s - 3.0;
  slope[1] = nnodes == 2 ? 1.0 : 4.0 - 8.0 * s;
  slope[2] = nnodes == 2 ? 0.0 : 4.0 * s - 1.0;
}

/* force[nnodes][2] of the part from .. to of the edge at x, m, with the solid on its left, `rest` at rest; N a metre of thickness.
 * By Gauss's rule of two points: exact for the pressure, and the traction on straight edges. */
static inline void EdgeLoad(int nnodes, const double x[3][2], const double rest[3][2], double from, double to,
                            double pressure, const double traction[2], double force[3][2])
{
  for (int i = 0; i < 3; i++) force[i][0] = force[i][1] = 0.0;
  for (int k = -1; k <= 1; k += 2) {
    const double w = 0.5 * (to - from), s = 0.5 * (from + to) + k * w / sqrt(3.0);
    double value[3], slope[3], along[2] = {0.0, 0.0}, before[2] = {0.0, 0.0};
    EdgeShape(nnodes, s, value, slope);
    for (int i = 0; i < nnodes; i++)
      for (int c = 0; c < 2; c++) {
        along[c] += slope[i] * x[i][c];
        before[c] += slope[i] * rest[i][c];
      }
    const double length = sqrt(before[0] * before[0] + before[1] * before[1]);
    for (int i = 0; i < nnodes; i++) {
      force[i][0] += w * value[i] * (traction[0] * length - pressure * along[1]);
      force[i][1] += w * value[i] * (traction[1] * length + pressure * along[0]);
    }
  }
}
#endif
