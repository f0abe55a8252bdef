#include "coupler/force/surface_pressure.h"
#include "common/space/p2.h"

/* n: the barycentric coordinates of a pair's centre in its fluid element. */
static void CentreIn(const Overlap o, const SupermeshPair *pair, double n[3])
{
  const SupermeshBasis *b = &o->basis[pair->b];
  double d[2];
  SupermeshCentreInB(pair, &o->source_basis[pair->a], b, d);
  for (int i = 1; i < 3; i++) n[i] = b->gradient[i - 1][0] * d[0] + b->gradient[i - 1][1] * d[1];
  n[0] = 1.0 - n[1] - n[2];
}

/* p and its gradient at a pair's centre n; p: of the pair's element. */
static double PressureAt(const SupermeshBasis *b, const double p[6], const double n[3], double gradient[2])
{
  double g[3][2], corner[3][2];
  for (int c = 0; c < 2; c++) {
    g[1][c] = b->gradient[0][c];
    g[2][c] = b->gradient[1][c];
    g[0][c] = -g[1][c] - g[2][c];
  }
  P2Gradient((const double(*)[2])g, p, corner);
  for (int c = 0; c < 2; c++) gradient[c] = n[0] * corner[0][c] + n[1] * corner[1][c] + n[2] * corner[2][c];
  return P2Evaluate(p, n);
}

static int OutermostVertex(const double x[3][2], const double normal[2])
{
  int outermost = 0;
  for (int i = 1; i < 3; i++)
    if (normal[0] * (x[i][0] - x[outermost][0]) + normal[1] * (x[i][1] - x[outermost][1]) > 0.0)
      outermost = i;
  return outermost;
}

PetscErrorCode SurfacePressureSums(Overlap o, const double p[], double owned[][SURFACE_SUMS])
{
  double(*source)[SURFACE_SUMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nsources, &source));
  for (int k = 0; k < o->pairs.n; k++) {
    const SupermeshPair *pair = &o->pairs.pair[k];
    const SourceTriangle *t = &o->source[pair->a];
    const double *at = &p[6 * pair->b];
    double *s = source[pair->a], n[3];
    CentreIn(o, pair, n);
    s[SURFACE_AREA] += pair->area;
    s[SURFACE_INSIDE] += pair->area * P2Evaluate(at, n);
    if (t->is_shell)
      s[SURFACE_OUTSIDE] += pair->area * at[OutermostVertex((const double(*)[2])o->x[pair->b], t->normal)];
  }
  PetscCall(OverlapReverseAdd(o, SURFACE_SUMS, (const double *)source, (double *)owned));
  PetscCall(PetscFree(source));
  PetscFunctionReturn(0);
}

PetscErrorCode SurfacePressureNodes(Overlap o, const double owned[][SURFACE_SUMS], int nnodes,
                                    char is_given[], double value[][2])
{
  double(*node)[SURFACE_SUMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(nnodes, &node));
  for (int t = o->nvolume; t < o->nowned; t++)
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < SURFACE_SUMS; c++) node[o->node[t][i]][c] += owned[t][c];
  PetscCall(CopiesSum(o->nodes, SURFACE_SUMS, (double *)node));
  for (int i = 0; i < nnodes; i++) {
    const double area = node[i][SURFACE_AREA];
    is_given[i] = area > 0.0;
    value[i][0] = area > 0.0 ? node[i][SURFACE_INSIDE] / area : 0.0;
    value[i][1] = area > 0.0 ? node[i][SURFACE_OUTSIDE] / area : 0.0;
  }
  PetscCall(PetscFree(node));
  PetscFunctionReturn(0);
}

/* Whether the solid covers vertex v of the element of pair k. */
static PetscBool IsCovered(const Overlap o, int k, const double v[2])
{
  const int e = o->coupled_index[k];
  for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1]; i++) {
    const SourceTriangle *t = &o->source[o->pairs.pair[o->of_element[i]].a];
    double n[3];
    if (t->is_shell) continue;
    GeometryBarycentric((const double(*)[2])t->x, v, n);
    if (n[0] > 0.0 && n[1] > 0.0 && n[2] > 0.0) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

PetscErrorCode SurfacePressureHead(Overlap o, const double gravity[2], const double p[], int nnodes,
                                   double node[][SURFACE_HEAD_FIELDS])
{
  double(*source)[3][SURFACE_HEAD_FIELDS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nsources, &source));
  for (int k = 0; k < o->pairs.n; k++) {
    const SupermeshPair *pair = &o->pairs.pair[k];
    const SourceTriangle *t = &o->source[pair->a];
    if (!t->is_shell) continue;
    const int outermost = OutermostVertex((const double(*)[2])o->x[pair->b], t->normal);
    const double *x = o->x[pair->b][outermost];
    if (IsCovered(o, k, x)) continue;
    const double rho = fmax(o->rho_beside[pair->b], o->rho[pair->b]),
                 head = p[6 * pair->b + outermost] - rho * (gravity[0] * x[0] + gravity[1] * x[1]);
    for (int i = 0; i < 3; i++) {
      source[pair->a][i][SURFACE_HEAD] += pair->area * head;
      source[pair->a][i][SURFACE_DENSITY] += pair->area * rho;
      source[pair->a][i][SURFACE_SPECIFIC_VOLUME] += pair->area / rho;
      source[pair->a][i][SURFACE_VISCOSITY] += pair->area * o->mu[pair->b];
      source[pair->a][i][SURFACE_REACHED] += pair->area;
    }
  }
  PetscCall(OverlapSourcesToNodes(o, SURFACE_HEAD_FIELDS, (const double *)source, nnodes, (double *)node));
  PetscCall(CopiesSum(o->nodes, SURFACE_HEAD_FIELDS, (double *)node));
  for (int i = 0; i < nnodes; i++) {
    const double area = node[i][SURFACE_REACHED];
    for (int c = 0; c < SURFACE_HEAD_FIELDS; c++) node[i][c] = area > 0.0 ? node[i][c] / area : 0.0;
  }
  PetscCall(PetscFree(source));
  PetscFunctionReturn(0);
}

PetscErrorCode SurfacePressureInside(Overlap o, const double p[], int nnodes, double node[], double size[],
                                     double area[])
{
  enum { AREA, WEIGHT, PRESSURE, SIZE, NSUMS };
  double(*source)[3][NSUMS], (*sum)[NSUMS];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nsources, &source));
  PetscCall(PetscMalloc1(nnodes, &sum));
  for (int k = 0; k < o->pairs.n; k++) {
    const SupermeshPair *pair = &o->pairs.pair[k];
    const SourceTriangle *t = &o->source[pair->a];
    double gradient[2], n[3], shape[3], x[2];
    if (t->is_shell) continue;
    for (int c = 0; c < 2; c++) x[c] = t->x[0][c] + pair->centre[c];
    GeometryBarycentric((const double(*)[2])t->x, x, shape);
    CentreIn(o, pair, n);
    const double at = PressureAt(&o->basis[pair->b], &p[6 * pair->b], n, gradient);
    for (int i = 0; i < 3; i++) {
      const double weight = pair->area * pow(shape[i], SURFACE_NEARNESS);
      double value = at;
      for (int c = 0; c < 2; c++) value += gradient[c] * (t->x[i][c] - x[c]);
      source[pair->a][i][AREA] += pair->area;
      source[pair->a][i][WEIGHT] += weight;
      source[pair->a][i][PRESSURE] += weight * value;
      source[pair->a][i][SIZE] += pair->area * sqrt(2.0 * o->area[pair->b]);
    }
  }
  PetscCall(OverlapSourcesToNodes(o, NSUMS, (const double *)source, nnodes, (double *)sum));
  PetscCall(CopiesSum(o->nodes, NSUMS, (double *)sum));
  for (int i = 0; i < nnodes; i++) {
    area[i] = sum[i][AREA];
    node[i] = area[i] > 0.0 ? sum[i][PRESSURE] / sum[i][WEIGHT] : 0.0;
    size[i] = area[i] > 0.0 ? sum[i][SIZE] / area[i] : 0.0;
  }
  PetscCall(PetscFree(sum));
  PetscCall(PetscFree(source));
  PetscFunctionReturn(0);
}
