/* The fluid's elements in a box, and those of them that the kit couples: in a disc in the middle of the box. */
#ifndef CORACLE_CONFORMANCE_PATCH_H
#define CORACLE_CONFORMANCE_PATCH_H
#include "common/conformance/kit.h"

typedef struct {
  double box[4], centre[2], radius; /* m */
  int n;
  double *x, *rho, *area; /* [n][3][2] m; [n] kg/m3, m2 */
  int ncoupled;
  int *coupled; /* [ncoupled] elements whose centroid is in the disc */
} Patch;

/* Asks the fluid for its elements in the box, which is moved by a quarter of its width when `moved`, and checks them:
 * counter-clockwise, overlapping the box, none twice, some in the disc.  Collective; replaces *p. */
void PatchAsk(Kit *k, bool moved, Patch *p);
void PatchFree(Patch *p);

/* Mean of u[n][2][3] on element e. */
static inline double PatchMean(const double u[], int e, int c)
{
  return (u[6 * e + 3 * c] + u[6 * e + 3 * c + 1] + u[6 * e + 3 * c + 2]) / 3.0;
}
/* block = factor int N_i N_j of an element */
static inline void PatchMass(double area, double factor, double block[3][3])
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) block[i][j] = factor * area / 12.0 * (i == j ? 2.0 : 1.0);
}
/* Collective: sum of rho |K| u over all elements, kg m/s. */
void PatchMomentum(const Kit *k, const Patch *p, const double u[], double momentum[2]);
/* Collective: the same over the coupled elements; *mass: theirs, sum of rho |K|, kg. */
void PatchCoupled(const Kit *k, const Patch *p, const double u[], double momentum[2], double *mass);
/* Collective: the integral of |u - v| over the elements, m3/s, and the length of its mean over the coupled ones, m/s. */
void PatchDifference(const Kit *k, const Patch *p, const double u[], const double v[], double *all,
                     double *disc);
#endif
