#include "coupler/geometry/surface.h"

/* What is summed for a shell triangle: right-hand sides, covered mass, covered area. */
enum { MASS = 3 * SURFACE_FIELDS_MAX, AREA = MASS + 9, SUMS = AREA + 1 };

static void SumPairs(const Overlap o, int ncomp, SurfaceFields fields, void *context, double (*sum)[SUMS])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    const SupermeshBasis *basis = &o->source_basis[pair->a];
    double f[SURFACE_FIELDS_MAX][3], ab[3][3], aa[3][3], *s = sum[pair->a];
    if (!o->source[pair->a].is_shell) continue;
    SupermeshProduct(pair, basis, &o->basis[pair->b], ab);
    SupermeshProduct(pair, basis, basis, aa);
    fields(context, o, pair, f);
    for (int i = 0; i < 3; i++) {
      for (int c = 0; c < ncomp; c++) {
        for (int j = 0; j < 3; j++) s[3 * c + i] += ab[i][j] * f[c][j];
      }
      for (int j = 0; j < 3; j++) s[MASS + 3 * i + j] += aa[i][j];
    }
    s[AREA] += pair->area;
  }
}

/* q = m^-1 q for a symmetric positive definite 3 x 3 matrix (Cramer). */
static void Solve3(const double m[9], double q[3])
{
  const double c0 = m[4] * m[8] - m[5] * m[5], c1 = m[5] * m[2] - m[1] * m[8], c2 = m[1] * m[5] - m[4] * m[2];
  const double inverse = 1.0 / (m[0] * c0 + m[1] * c1 + m[2] * c2);
  const double d1 = m[0] * m[8] - m[2] * m[2], d2 = m[1] * m[2] - m[0] * m[5], e2 = m[0] * m[4] - m[1] * m[1];
  const double r[3] = {q[0], q[1], q[2]};
  q[0] = inverse * (c0 * r[0] + c1 * r[1] + c2 * r[2]);
  q[1] = inverse * (c1 * r[0] + d1 * r[1] + d2 * r[2]);
  q[2] = inverse * (c2 * r[0] + d2 * r[1] + e2 * r[2]);
}

/* [41]: the field's values at the triangle's vertices. */
static void ShellField(const double s[SUMS], double area, int comp, double q[3])
{
  for (int i = 0; i < 3; i++) q[i] = s[3 * comp + i];
  if (s[AREA] > 0.5 * area) {
    Solve3(&s[MASS], q);
  } else {
    const double mean = s[AREA] > 0.0 ? (q[0] + q[1] + q[2]) / s[AREA] : 0.0;
    for (int i = 0; i < 3; i++) q[i] = mean;
  }
}

/* [42] on one facet: s[2] the sums of its two triangles, area[2] theirs; value[ncomp][2]. */
static void FacetField(const double s[2][SUMS], const double area[2], int ncomp, double *value)
{
  static const int END[2][3] = {{0, 0, 1}, {0, 1, 1}}; /* which end of the edge a shell vertex belongs to */
  double m[2][2] = {{0.0}}, r[SURFACE_FIELDS_MAX][2] = {{0.0}};
  for (int t = 0; t < 2; t++) {
    if (s[t][AREA] <= 0.0) continue;
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) m[END[t][i]][END[t][j]] += area[t] / (i == j ? 6.0 : 12.0);
    }
    for (int c = 0; c < ncomp; c++) {
      double q[3];
      ShellField(s[t], area[t], c, q);
      for (int i = 0; i < 3; i++) r[c][END[t][i]] += area[t] / 12.0 * (q[i] + q[0] + q[1] + q[2]);
    }
  }
  const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  for (int c = 0; c < ncomp; c++) {
    value[2 * c] = determinant > 0.0 ? (m[1][1] * r[c][0] - m[0][1] * r[c][1]) / determinant : 0.0;
    value[2 * c + 1] = determinant > 0.0 ? (m[0][0] * r[c][1] - m[1][0] * r[c][0]) / determinant : 0.0;
  }
}

PetscErrorCode SurfaceFromFluid(Overlap o, int ncomp, const Shell shell, SurfaceFields fields, void *context,
                                double surface[])
{
  double(*sum)[SUMS], (*owned)[SUMS];

  PetscFunctionBeginUser;
  PetscAssert(ncomp <= SURFACE_FIELDS_MAX, PETSC_COMM_SELF, PETSC_ERR_PLIB, "too many fields: %d", ncomp);
  PetscCall(PetscCalloc2(o->nsources, &sum, o->nowned, &owned));
  SumPairs(o, ncomp, fields, context, sum);
  PetscCall(OverlapReverseAdd(o, SUMS, (const double *)sum, (double *)owned));
  for (int e = 0; e < shell->nfacets; e++) {
    double area[2];
    for (int t = 0; t < 2; t++) area[t] = GeometryArea((const double(*)[2])shell->x[2 * e + t]);
    FacetField((const double(*)[SUMS]) & owned[o->nvolume + 2 * e], area, ncomp, &surface[2 * ncomp * e]);
  }
  PetscCall(PetscFree2(sum, owned));
  PetscFunctionReturn(0);
}
