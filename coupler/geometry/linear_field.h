/* Linear vector fields in the plane and their integrals over pairs (supermesh.h), pointwise.
 *
 *     q(x)  =  value + gradient (x - origin)
 *
 * has its values at a triangle's vertices, the origin being vertex 0 (SupermeshBasis), or is that field seen from a pair's
 * centre.  Sums of fields times coefficients are linear too, so that a pair's terms are first added and then integrated, once;
 * and what is integrated is summed over a triangle's pairs before its functions come in, once a triangle:
 *
 *     pair       m0 += int q,  m1 += int (x - origin) q^T          VectorMomentsAdd
 *     triangle   int N_i q  =  grad N_i . m1,  i = 1, 2              VectorMomentsVertices; N_0 = 1 - N_1 - N_2
 *
 * and likewise int N_i N_j with the moments up to the second of a coefficient (MassMoments). */
#ifndef CORACLE_LINEAR_FIELD_H
#define CORACLE_LINEAR_FIELD_H
#include "common/supermesh/supermesh.h"

typedef struct {
  double value[2], gradient[2][2]; /* gradient[d]: of both components along axis d */
} LinearField;

typedef struct {
  double zero[2], first[2][2]; /* first[d]: of both components times x_d */
} VectorMoments;

/* second: xx, xy, yy */
typedef struct {
  double zero, first[2], second[3];
} MassMoments;

/* Of values a, b, c at the vertices 0, 1, 2. */
static inline LinearField LinearFieldOf(const SupermeshBasis *basis, const double a[2], const double b[2],
                                        const double c[2])
{
  LinearField q;
  for (int k = 0; k < 2; k++) q.value[k] = a[k];
  for (int d = 0; d < 2; d++)
    for (int k = 0; k < 2; k++)
      q.gradient[d][k] = (b[k] - a[k]) * basis->gradient[0][d] + (c[k] - a[k]) * basis->gradient[1][d];
  return q;
}

/* u[3][2], as fields on source triangles are stored */
static inline LinearField LinearFieldOnSource(const SupermeshBasis *basis, const double u[3][2])
{
  return LinearFieldOf(basis, u[0], u[1], u[2]);
}

/* u[2][3], as fields on fluid elements are */
static inline LinearField LinearFieldOnElement(const SupermeshBasis *basis, const double u[6])
{
  return LinearFieldOf(basis, (const double[2]){u[0], u[3]}, (const double[2]){u[1], u[4]},
                       (const double[2]){u[2], u[5]});
}

/* value = q at d from its origin */
static inline void LinearFieldValue(const LinearField *q, const double d[2], double value[2])
{
  for (int c = 0; c < 2; c++) value[c] = q->value[c] + q->gradient[0][c] * d[0] + q->gradient[1][c] * d[1];
}

/* The same field with its origin moved by d. */
static inline LinearField LinearFieldAt(const LinearField *q, const double d[2])
{
  LinearField at = *q;
  LinearFieldValue(q, d, at.value);
  return at;
}

/* to += factor q */
static inline void LinearFieldAdd(double factor, const LinearField *q, LinearField *to)
{
  for (int c = 0; c < 2; c++) to->value[c] += factor * q->value[c];
  for (int d = 0; d < 2; d++)
    for (int c = 0; c < 2; c++) to->gradient[d][c] += factor * q->gradient[d][c];
}

/* q, seen from the pair's centre; d: the centre from the origin of m. */
static inline void VectorMomentsAdd(const SupermeshPair *pair, const LinearField *q, const double d[2],
                                    VectorMoments *m)
{
  const double *s = pair->second, *gx = q->gradient[0], *gy = q->gradient[1];
  for (int c = 0; c < 2; c++) {
    const double all = pair->area * q->value[c];
    m->zero[c] += all;
    m->first[0][c] += all * d[0] + s[0] * gx[c] + s[1] * gy[c];
    m->first[1][c] += all * d[1] + s[1] * gx[c] + s[2] * gy[c];
  }
}

/* vertex[i][c] = int N_i q_c */
static inline void VectorMomentsVertices(const SupermeshBasis *basis, const VectorMoments *m,
                                         double vertex[3][2])
{
  for (int i = 1; i < 3; i++)
    for (int c = 0; c < 2; c++)
      vertex[i][c] = m->first[0][c] * basis->gradient[i - 1][0] + m->first[1][c] * basis->gradient[i - 1][1];
  for (int c = 0; c < 2; c++) vertex[0][c] = m->zero[c] - vertex[1][c] - vertex[2][c];
}

/* Of 1 over the pair. */
static inline MassMoments PairMass(const SupermeshPair *pair, const double d[2])
{
  const double *s = pair->second, area = pair->area;
  return (MassMoments){area,
                       {area * d[0], area * d[1]},
                       {area * d[0] * d[0] + s[0], area * d[0] * d[1] + s[1], area * d[1] * d[1] + s[2]}};
}

/* to += factor m */
static inline void MassMomentsAdd(double factor, const MassMoments *m, MassMoments *to)
{
  to->zero += factor * m->zero;
  for (int d = 0; d < 2; d++) to->first[d] += factor * m->first[d];
  for (int d = 0; d < 3; d++) to->second[d] += factor * m->second[d];
}

/* matrix[i][j] = int N_i N_j times the coefficient */
static inline void MassMomentsMatrix(const SupermeshBasis *basis, const MassMoments *m, double matrix[3][3])
{
  const double *g = basis->gradient[0], *h = basis->gradient[1], *s = m->second;
  const double sh[2] = {s[0] * h[0] + s[1] * h[1], s[1] * h[0] + s[2] * h[1]};
  const double n1 = m->first[0] * g[0] + m->first[1] * g[1], n2 = m->first[0] * h[0] + m->first[1] * h[1];
  matrix[1][1] = s[0] * g[0] * g[0] + 2.0 * s[1] * g[0] * g[1] + s[2] * g[1] * g[1];
  matrix[2][2] = sh[0] * h[0] + sh[1] * h[1];
  matrix[1][2] = matrix[2][1] = sh[0] * g[0] + sh[1] * g[1];
  matrix[0][1] = matrix[1][0] = n1 - matrix[1][1] - matrix[1][2];
  matrix[0][2] = matrix[2][0] = n2 - matrix[1][2] - matrix[2][2];
  matrix[0][0] = m->zero - n1 - n2 - matrix[0][1] - matrix[0][2];
}
#endif
