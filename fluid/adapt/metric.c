#include "fluid/adapt/metric.h"
#include "fluid/adapt/metric_tensor.h"

PetscErrorCode MetricFromSizes(int nv, const double h[], double metric[])
{
  PetscFunctionBeginUser;
  for (int v = 0; v < nv; v++) {
    PetscCheck(h[v] > 0.0, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "size %g at vertex %d, not positive",
               h[v], v);
    metric[3 * v] = metric[3 * v + 2] = 1.0 / (h[v] * h[v]);
    metric[3 * v + 1] = 0.0;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MetricFromHessian(int nv, const double hessian[], double error, double h_max, double metric[])
{
  PetscFunctionBeginUser;
  PetscCheck(error > 0.0 && h_max > 0.0, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
             "error %g and h_max %g must be positive", error, h_max);
  const double least = 1.0 / (h_max * h_max);
  for (int v = 0; v < nv; v++) {
    double lambda[2], axis[2];
    MetricEigen(&hessian[3 * v], lambda, axis);
    for (int i = 0; i < 2; i++) lambda[i] = fmax(2.0 / 9.0 * fabs(lambda[i]) / error, least);
    MetricCompose(lambda, axis, &metric[3 * v]);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MetricBound(int nv, double h_min, double h_max, double anisotropy, double metric[])
{
  PetscFunctionBeginUser;
  PetscCheck(
      h_min > 0.0 && h_max >= h_min && anisotropy >= 1.0, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
      "sizes in [%g, %g] with an anisotropy of at most %g: expected 0 < h_min <= h_max, 1 <= anisotropy",
      h_min, h_max, anisotropy);
  const double least = 1.0 / (h_max * h_max), most = 1.0 / (h_min * h_min);
  for (int v = 0; v < nv; v++) {
    double lambda[2], axis[2];
    MetricEigen(&metric[3 * v], lambda, axis);
    lambda[0] = fmin(fmax(lambda[0], least), most);
    lambda[1] = fmax(fmin(fmax(lambda[1], least), most), lambda[0] / (anisotropy * anisotropy));
    MetricCompose(lambda, axis, &metric[3 * v]);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MetricIntersect(int nv, const double other[], double metric[])
{
  PetscFunctionBeginUser;
  for (int v = 0; v < nv; v++) {
    PetscCheck(MetricIsValid(&metric[3 * v]) && MetricIsValid(&other[3 * v]), PETSC_COMM_SELF,
               PETSC_ERR_ARG_OUTOFRANGE, "the metric at vertex %d is not positive definite", v);
    MetricIntersectTensor(&other[3 * v], 0.0, &metric[3 * v]);
  }
  PetscFunctionReturn(0);
}

/* M_q meets what M_p has grown to on the way from p; 1 if that changed it. */
static int Grow(const double x[], int p, int q, double log_growth, double metric[])
{
  const double ex = x[2 * q] - x[2 * p], ey = x[2 * q + 1] - x[2 * p + 1];
  const double *mp = &metric[3 * p];
  const double f = 1.0 + log_growth * sqrt(MetricSquare(mp, ex, ey)), s = 1.0 / (f * f);
  const double grown[3] = {s * mp[0], s * mp[1], s * mp[2]};
  return MetricIntersectTensor(grown, 1e-3, &metric[3 * q]);
}

PetscErrorCode MetricGrade(const MeshSerial *mesh, double growth, double metric[])
{
  int *changed, active = 1; /* the sweep in which a vertex changed last */
  PetscFunctionBeginUser;
  PetscCheck(growth > 1.0, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "growth %g, not above 1", growth);
  const double log_growth = log(growth);
  PetscCall(PetscCalloc1(mesh->nv + 1, &changed));
  for (int sweep = 1; active; sweep++) {
    active = 0;
    for (int k = 0; k < 3 * mesh->ne; k++) {
      /* every other sweep runs backwards, so that fine sizes spread both ways */
      const int c = sweep % 2 ? k : 3 * mesh->ne - 1 - k;
      const int p = mesh->vertex[c], q = mesh->vertex[c % 3 == 2 ? c - 2 : c + 1];
      if (changed[p] >= sweep - 1 && Grow(mesh->x, p, q, log_growth, metric)) changed[q] = sweep, active = 1;
      if (changed[q] >= sweep - 1 && Grow(mesh->x, q, p, log_growth, metric)) changed[p] = sweep, active = 1;
    }
  }
  PetscCall(PetscFree(changed));
  PetscFunctionReturn(0);
}

/* Divided differences of exp: (e^a - e^b)/(a - b), and of three points. */
static double Slope(double a, double b)
{
  return fabs(a - b) < 1e-8 ? exp(b) : exp(b) * expm1(a - b) / (a - b);
}

static double Curvature(double a, double b, double c)
{
  if (fabs(a - c) < fabs(b - c)) return Curvature(b, a, c);
  if (fabs(a - c) < fabs(a - b)) return Curvature(a, c, b);
  /* a and c are the furthest apart */
  return fabs(a - c) < 1e-3 ? 0.5 * exp((a + b + c) / 3.0) : (Slope(a, b) - Slope(b, c)) / (a - c);
}

/* ln det M is linear on a triangle, as MeshAdapt takes it; the mean of exp of a linear function is twice the
 * divided difference of its corners' values (Hermite and Genocchi). */
PetscErrorCode MetricCount(const MeshSerial *mesh, const double metric[], double *triangles)
{
  double sum = 0.0;
  PetscFunctionBeginUser;
  for (int e = 0; e < mesh->ne; e++) {
    const int *v = &mesh->vertex[3 * e];
    const double *a = &mesh->x[2 * v[0]], *b = &mesh->x[2 * v[1]], *c = &mesh->x[2 * v[2]];
    const double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    double half_log[3];
    for (int i = 0; i < 3; i++) {
      PetscCheck(MetricIsValid(&metric[3 * v[i]]), PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
                 "the metric at vertex %d is not positive definite", v[i]);
      half_log[i] = 0.5 * log(MetricDet(&metric[3 * v[i]]));
    }
    sum += area * 2.0 * Curvature(half_log[0], half_log[1], half_log[2]);
  }
  *triangles = 4.0 / sqrt(3.0) * sum;
  PetscFunctionReturn(0);
}
