#include "fluid/pressure/weighted_projection.h"
#include "fluid/adapt/metric_tensor.h"

/* Inertia times dt is the same where its entries differ by no more than this of the largest. */
#define SAME 1e-12

enum { N = 3 }; /* velocity unknowns of an element and component */

/* The inertia tensor's principal values, of the unit vector `axis` and of what is across, axis turned by a right angle. */
typedef struct {
  double axis[2], value[2];
} Principal;

typedef struct {
  Principal tensor;
  double along[2][N][N]; /* W^-1 M/dt of the components along the axis and across */
} Response;

/* What a response is made of. */
typedef struct {
  int element;
  double density;                    /* the fluid's, kg/m3 */
  double times_dt[N * N], tensor[4]; /* the implicit inertia and its tensor */
} EntryInertia;

struct WeightedProjection_s {
  const FluidDomain *domain; /* borrowed */
  SolidCoupling solid;       /* borrowed: of the current step */
  double dt;
  int n;                 /* entries of solid, -1: there are no responses yet */
  EntryInertia *inertia; /* [n], element -1 where there is none */
  Response *response;    /* [n] */
};

PetscErrorCode WeightedProjectionCreate(const FluidDomain *domain, WeightedProjection *w)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(w));
  (*w)->domain = domain;
  (*w)->n = -1;
  PetscFunctionReturn(0);
}

PetscErrorCode WeightedProjectionDestroy(WeightedProjection *w)
{
  PetscFunctionBeginUser;
  if (!*w) PetscFunctionReturn(0);
  PetscCall(PetscFree2((*w)->response, (*w)->inertia));
  PetscCall(PetscFree(*w));
  PetscFunctionReturn(0);
}

static void MassMatrix(double area, double m[N][N])
{
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) m[i][j] = area / 12.0 * (i == j ? 2.0 : 1.0);
}

/* w = L L^T in its lower triangle; false if it is not positive definite */
static PetscBool Factor(double w[N][N])
{
  for (int j = 0; j < N; j++) {
    for (int k = 0; k < j; k++) w[j][j] -= w[j][k] * w[j][k];
    if (!(w[j][j] > 0.0)) return PETSC_FALSE;
    w[j][j] = sqrt(w[j][j]);
    for (int i = j + 1; i < N; i++) {
      for (int k = 0; k < j; k++) w[i][j] -= w[i][k] * w[j][k];
      w[i][j] /= w[j][j];
    }
  }
  return PETSC_TRUE;
}

/* x -> (L L^T)^-1 x for the columns of x */
static void SolveColumns(const double l[N][N], double x[N][N])
{
  for (int i = 0; i < N; i++) {
    for (int k = 0; k < i; k++)
      for (int c = 0; c < N; c++) x[i][c] -= l[i][k] * x[k][c];
    for (int c = 0; c < N; c++) x[i][c] *= 1.0 / l[i][i];
  }
  for (int i = N - 1; i >= 0; i--) {
    for (int k = i + 1; k < N; k++)
      for (int c = 0; c < N; c++) x[i][c] -= l[k][i] * x[k][c];
    for (int c = 0; c < N; c++) x[i][c] *= 1.0 / l[i][i];
  }
}

static Principal PrincipalOf(const double tensor[2][2])
{
  const double packed[3] = {tensor[0][0], tensor[0][1], tensor[1][1]};
  Principal p;
  MetricEigen(packed, p.value, p.axis);
  return p;
}

/* v[2][N]: components along the axis and across become those along x and y, and back */
static void FromAxes(const Principal *p, double v[2 * N])
{
  for (int i = 0; i < N; i++) {
    const double along = v[i], across = v[N + i];
    v[i] = p->axis[0] * along - p->axis[1] * across;
    v[N + i] = p->axis[1] * along + p->axis[0] * across;
  }
}

static void ToAxes(const Principal *p, double v[2 * N])
{
  for (int i = 0; i < N; i++) {
    const double x = v[i], y = v[N + i];
    v[i] = p->axis[0] * x + p->axis[1] * y;
    v[N + i] = p->axis[0] * y - p->axis[1] * x;
  }
}

/* x -> W^-1 x for the columns of x, of components that move with `value` of the inertia */
static PetscErrorCode DivideColumns(double area, double rho_dt, double value, const double inertia[N][N],
                                    double x[N][N])
{
  double w[N][N];
  PetscFunctionBeginUser;
  MassMatrix(area, w);
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) w[i][j] = rho_dt * w[i][j] + value * inertia[i][j];
  PetscCheck(Factor(w), PETSC_COMM_SELF, PETSC_ERR_NOT_CONVERGED,
             "the implicit inertia of the solid is not positive on a fluid element");
  SolveColumns((const double(*)[N])w, x);
  PetscFunctionReturn(0);
}

PetscErrorCode WeightedProjectionSolve(double area, double rho_dt, const CoracleCoupling *k, double v[6])
{
  const Principal tensor = PrincipalOf(k->inertia_tensor);
  PetscFunctionBeginUser;
  ToAxes(&tensor, v);
  for (int c = 0; c < 2; c++) {
    double column[N][N] = {{0.0}};
    for (int i = 0; i < N; i++) column[i][0] = v[N * c + i];
    PetscCall(DivideColumns(area, rho_dt, tensor.value[c], k->implicit_inertia, column));
    for (int i = 0; i < N; i++) v[N * c + i] = column[i][0];
  }
  FromAxes(&tensor, v);
  PetscFunctionReturn(0);
}

static PetscErrorCode FindResponse(double area, double rho, double dt, const CoracleCoupling *k, Response *r)
{
  PetscFunctionBeginUser;
  r->tensor = PrincipalOf(k->inertia_tensor);
  for (int c = 0; c < 2; c++) {
    if (c > 0 && r->tensor.value[c] == r->tensor.value[0]) {
      PetscCall(PetscArraycpy(r->along[c], r->along[0], N));
      continue;
    }
    MassMatrix(area, r->along[c]);
    PetscCall(DivideColumns(area, rho, dt * r->tensor.value[c], k->implicit_inertia, r->along[c]));
  }
  PetscFunctionReturn(0);
}

/* u[2][N], over dt, of grad[N][2], values at the element's vertices */
static void Respond(const Response *r, const double grad[N][2], double u[2 * N])
{
  double v[2 * N];
  for (int i = 0; i < 2 * N; i++) v[i] = grad[i % N][i / N];
  ToAxes(&r->tensor, v);
  for (int i = 0; i < 2 * N; i++) {
    const double *row = r->along[i / N][i % N];
    u[i] = 0.0;
    for (int j = 0; j < N; j++) u[i] += row[j] * v[i / N * N + j];
  }
  FromAxes(&r->tensor, u);
}

static PetscBool IsWeighted(const CoracleCoupling *k)
{
  return k && k->flags & CORACLE_HAS_INERTIA ? PETSC_TRUE : PETSC_FALSE;
}

static EntryInertia InertiaOf(const CoracleCoupling *k, const WeightedProjectionStep *s)
{
  EntryInertia inertia = {.element = -1};
  if (!IsWeighted(k)) return inertia;
  inertia.element = k->element;
  inertia.density = s->rho[k->element];
  for (int i = 0; i < N * N; i++) inertia.times_dt[i] = s->dt * k->implicit_inertia[i / N][i % N];
  for (int i = 0; i < 4; i++) inertia.tensor[i] = k->inertia_tensor[i / 2][i % 2];
  return inertia;
}

static PetscBool AreClose(int n, const double a[], const double b[])
{
  double largest = 0.0, difference = 0.0;
  for (int i = 0; i < n; i++) {
    largest = PetscMax(largest, fabs(a[i]));
    difference = PetscMax(difference, fabs(a[i] - b[i]));
  }
  return (PetscBool)(difference <= SAME * largest);
}

static PetscBool IsSame(const EntryInertia *a, const EntryInertia *b)
{
  return (PetscBool)(a->element == b->element && a->density == b->density &&
                     AreClose(N * N, a->times_dt, b->times_dt) && AreClose(4, a->tensor, b->tensor));
}

/* Whether the entries' inertia times dt, and the density there, are those of the last responses, on this rank. */
static PetscBool HasSame(WeightedProjection w, int n, const CoracleCoupling entry[],
                         const WeightedProjectionStep *s)
{
  PetscBool same = (PetscBool)(n == w->n);
  for (int k = 0; k < n && same; k++) {
    const EntryInertia inertia = InertiaOf(&entry[k], s);
    same = IsSame(&inertia, &w->inertia[k]);
  }
  return same;
}

static PetscErrorCode SetResponses(WeightedProjection w, int n, const CoracleCoupling entry[],
                                   const WeightedProjectionStep *s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(w->response, w->inertia));
  PetscCall(PetscMalloc2(n, &w->response, n, &w->inertia));
  w->n = n;
  for (int k = 0; k < n; k++) {
    const int e = entry[k].element;
    w->inertia[k] = InertiaOf(&entry[k], s);
    if (IsWeighted(&entry[k]))
      PetscCall(FindResponse(w->domain->geometry[e].area, s->rho[e], s->dt, &entry[k], &w->response[k]));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode WeightedProjectionPrepare(WeightedProjection w, const WeightedProjectionStep *s,
                                         WeightedProjectionFound *found)
{
  enum { ACTIVE, MOVES, OTHER, NFLAGS };
  int n, flag[NFLAGS] = {0};
  const CoracleCoupling *entry = SolidCouplingEntries(s->solid, &n);
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) {
    flag[ACTIVE] |= IsWeighted(entry + k);
    flag[MOVES] |= IsWeighted(entry + k) && !SolidCouplingIsAtRest(entry + k);
  }
  flag[OTHER] = s->inertia && !HasSame(w, n, entry, s);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, flag, NFLAGS, MPI_INT, MPI_LOR, w->domain->mesh->comm));
  *found =
      (WeightedProjectionFound){(PetscBool)flag[ACTIVE], (PetscBool)flag[MOVES], (PetscBool)!flag[OTHER]};
  w->solid = s->solid;
  w->dt = s->dt;
  if (flag[OTHER]) PetscCall(SetResponses(w, n, entry, s));
  PetscFunctionReturn(0);
}

/* The response where element e has implicit inertia, else NULL. */
static const Response *ResponseAt(WeightedProjection w, int e)
{
  return IsWeighted(SolidCouplingAt(w->solid, e)) ? w->response + SolidCouplingIndex(w->solid, e) : NULL;
}

PetscBool WeightedProjectionBlock(WeightedProjection w, int e, double block[6][6])
{
  const ElementGeometry *g = w->domain->geometry + e;
  const Response *response = ResponseAt(w, e);
  if (!response) return PETSC_FALSE;
  for (int r = 0; r < 6; r++) {
    double basis[6] = {0}, grad[3][2], u[6], moved[2][3];
    basis[r] = 1.0;
    P2Gradient(g->g, basis, grad);
    Respond(response, (const double(*)[2])grad, u);
    for (int c = 0; c < 2; c++) P1MassApply(g->area, u + 3 * c, moved[c]);
    for (int q = 0; q < 6; q++) block[r][q] = 0.0;
    P2GradientTranspose(g->g, (const double(*)[3])moved, block[r]);
  }
  return PETSC_TRUE;
}

PetscBool WeightedProjectionVelocity(WeightedProjection w, int e, const double grad[3][2], double u[6])
{
  const Response *response = ResponseAt(w, e);
  double change[2 * N];
  if (!response) return PETSC_FALSE;
  Respond(response, grad, change);
  for (int i = 0; i < 2 * N; i++) u[i] -= w->dt * change[i];
  return PETSC_TRUE;
}
