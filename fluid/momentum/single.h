/* Single precision for the momentum equation's Krylov iteration: half of the memory, twice the numbers in a
 * register.  Pointwise, as kernels.h.
 *
 *   a vector of an element, [2][4]     u_x at vertices 0, 1, 2, unused | u_y at vertices 0, 1, 2, unused
 *   a block, [9]                       3 x 3 in column-major order; one number behind it is read, too
 *
 * Unused numbers must be finite: zero, or what follows a block. */
#ifndef FLUID_SINGLE_H
#define FLUID_SINGLE_H
#include <string.h>

typedef float SingleBlocks[4][9]; /* of an element: with itself, with its neighbour across each face */
typedef float SingleVector[8];
typedef float SingleLanes __attribute__((vector_size(16)));
typedef struct {
  SingleLanes c[2];
} SinglePair; /* a vector in registers */

static inline void SingleLoad(const float u[8], SinglePair *v)
{
  memcpy(v, u, sizeof *v);
}

static inline void SingleStore(const SinglePair *v, float u[8])
{
  memcpy(u, v, sizeof *v);
}

static inline void SingleFromDouble(const double u[6], float v[8])
{
  for (int c = 0; c < 2; c++) {
    for (int i = 0; i < 3; i++) v[4 * c + i] = (float)u[3 * c + i];
    v[4 * c + 3] = 0.0f;
  }
}

static inline void SingleToDouble(const float v[8], double u[6])
{
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < 3; i++) u[3 * c + i] = v[4 * c + i];
}

/* r += block u for both components */
static inline void SingleBlockAdd(const float block[9], const float u[8], SinglePair *r)
{
  for (int j = 0; j < 3; j++) {
    SingleLanes column;
    memcpy(&column, block + 3 * j, sizeof column);
    r->c[0] += column * u[j];
    r->c[1] += column * u[4 + j];
  }
}

/* product = a b of 3 x 3 blocks, all column-major */
static inline void SingleBlockProduct(const double a[9], const double b[9], float product[9])
{
  for (int j = 0; j < 3; j++)
    for (int i = 0; i < 3; i++)
      product[3 * j + i] = (float)(a[i] * b[3 * j] + a[3 + i] * b[3 * j + 1] + a[6 + i] * b[3 * j + 2]);
}

/* What the coupled stress of an element (kernels.h) follows from: theta mu; the faces' outward normals times a quarter of their
 * lengths, which are -area/2 times the gradients of the basis; their factor to gradients. */
typedef struct {
  float theta_mu, gradient; /* Pa s; -2/area, 1/m2 */
  float q[3][2];            /* m */
} SingleGeometry;

/* CoupledStress: sigma(u) = theta mu (grad u^T - 2/3 div u I), stress[2 d + c] */
static inline void SingleStress(const SingleGeometry *g, const float u[8], float stress[4])
{
  float grad[2][2];
  for (int c = 0; c < 2; c++)
    for (int d = 0; d < 2; d++)
      grad[c][d] =
          g->gradient * (u[4 * c] * g->q[0][d] + u[4 * c + 1] * g->q[1][d] + u[4 * c + 2] * g->q[2][d]);
  const float third = 2.0f / 3.0f * (grad[0][0] + grad[1][1]);
  stress[0] = g->theta_mu * (grad[0][0] - third);
  stress[1] = g->theta_mu * grad[0][1];
  stress[2] = g->theta_mu * grad[1][0];
  stress[3] = g->theta_mu * (grad[1][1] - third);
}

/* CoupledForceFace, of face i of K and face j of N; f[4] collects what grad w is multiplied with, r[2][4] the rest. */
static inline void SingleForceFace(const SingleGeometry *g, int i, int j, const float sk[4],
                                   const float sn[4], const float uk[8], const float un[8], float f[4],
                                   float r[8])
{
  const int a = (i + 1) % 3, b = (i + 2) % 3, oa = (j + 2) % 3, ob = (j + 1) % 3;
  const float *n = g->q[i];
  const float jump[2] = {uk[a] + uk[b] - un[oa] - un[ob], uk[4 + a] + uk[4 + b] - un[4 + oa] - un[4 + ob]};
  const float third = 2.0f / 3.0f * (n[0] * jump[0] + n[1] * jump[1]);
  for (int c = 0; c < 2; c++) {
    const float t = (sk[c] + sn[c]) * n[0] + (sk[2 + c] + sn[2 + c]) * n[1];
    r[4 * c + a] -= t;
    r[4 * c + b] -= t;
    for (int d = 0; d < 2; d++) f[2 * d + c] -= g->theta_mu * (n[c] * jump[d] - (c == d ? third : 0.0f));
  }
}

/* CoupledForceEnd: r[2][4] += the volume's stress and f, times grad w */
static inline void SingleForceEnd(const SingleGeometry *g, const float stress[4], const float f[4],
                                  float r[8])
{
  float s[4];
  for (int k = 0; k < 4; k++) s[k] = g->gradient * f[k] - 2.0f * stress[k];
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < 3; i++) r[4 * c + i] += s[c] * g->q[i][0] + s[2 + c] * g->q[i][1];
}
#endif
