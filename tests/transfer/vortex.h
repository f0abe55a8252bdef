/* A Taylor vortex, u = (sin pi x cos pi y, -cos pi x sin pi y) in the unit square, transferred again and
 * again between random meshes of n x n cells.  With P_k the L2 projection on mesh k, u_0 = P_0 u and
 * u_k = P_k u_(k-1), Pythagoras says
 *
 *     E_(k-1) - E_k = 1/2 |u_(k-1) - u_k|^2 = 1/2 |(1 - P_k) u_(k-1)|^2 >= 0
 *     |u - u_k|^2 = |u - P_k u|^2 + |P_k (u - u_(k-1))|^2 <= e_0^2 + ... + e_k^2,     e_k = |u - P_k u|
 *
 * and so  E_(k-1) - E_k <= 1/2 (e_k + sqrt(e_0^2 + ... + e_(k-1)^2))^2.  e_k is O(h^2): the relative loss of
 * a transfer is O(h^4). */
#ifndef TESTS_TRANSFER_VORTEX_H
#define TESTS_TRANSFER_VORTEX_H
#include "common/transfer/transfer.h"
#include "tests/quadrature.h"
#include "tests/transfer/shaken.h"

typedef double VortexValues[2][3];

typedef struct {
  double energy, loss, bound;  /* of all transfers so far; of the last one; and its bound */
  double momentum[2], modulus; /* int u, int |u| */
  double error;                /* |u - u_k|, m/s m */
  double best;                 /* e_k */
} VortexState;

/* energy, momentum, modulus, error: of w against the exact field */
static inline VortexState VortexMeasure(const Mesh *m, const VortexValues w[])
{
  const Quadrature *rule = QuadratureOf(4);
  double sum[5] = {0.0};
  for (int e = 0; e < m->ne; e++) {
    for (int q = 0; q < rule->n; q++) {
      const double weight = rule->weight[q] * ElementArea(m, e), *N = rule->point[q];
      double x[2] = {0.0}, u[2] = {0.0};
      for (int c = 0; c < 2; c++) {
        for (int i = 0; i < 3; i++) {
          x[c] += N[i] * Corner(m, e, i)[c];
          u[c] += N[i] * w[e][c][i];
        }
      }
      const double exact[2] = {sin(M_PI * x[0]) * cos(M_PI * x[1]), -cos(M_PI * x[0]) * sin(M_PI * x[1])};
      for (int c = 0; c < 2; c++) {
        sum[0] += weight * 0.5 * u[c] * u[c];
        sum[1 + c] += weight * u[c];
        sum[4] += weight * (u[c] - exact[c]) * (u[c] - exact[c]);
      }
      sum[3] += weight * hypot(u[0], u[1]);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sum, 5, MPI_DOUBLE, MPI_SUM, m->comm);
  return (VortexState){
      .energy = sum[0], .momentum = {sum[1], sum[2]}, .modulus = sum[3], .error = sqrt(sum[4])};
}

/* w = P u */
static inline void VortexProject(const Mesh *m, VortexValues w[])
{
  const Quadrature *rule = QuadratureOf(4);
  memset(w, 0, (size_t)m->ne * sizeof *w);
  for (int e = 0; e < m->ne; e++) {
    for (int q = 0; q < rule->n; q++) {
      const double *N = rule->point[q];
      double x[2] = {0.0};
      for (int i = 0; i < 6; i++) x[i % 2] += N[i / 2] * Corner(m, e, i / 2)[i % 2];
      const double exact[2] = {sin(M_PI * x[0]) * cos(M_PI * x[1]), -cos(M_PI * x[0]) * sin(M_PI * x[1])};
      /* inverse of the mass matrix area/12 (1 + delta): rows 12/area (delta - 1/4) */
      for (int i = 0; i < 6; i++)
        w[e][i / 3][i % 3] += rule->weight[q] * exact[i / 3] * (12.0 * N[i % 3] - 3.0);
    }
  }
}

typedef struct {
  int n, transfers; /* cells a side; transfers so far */
  Mesh *mesh;
  VortexValues *u;
  double spent; /* sum of e_k^2 */
  VortexState state;
} Vortex;

static inline PetscErrorCode VortexMesh(int n, int k, Mesh **mesh, VortexValues **u, double *best)
{
  const Shaken what = {n, (unsigned)k + 1, 1.0, {0}};
  PetscFunctionBeginUser;
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &what, mesh));
  PetscCall(PetscMalloc1((*mesh)->ne, u));
  VortexProject(*mesh, *u);
  *best = VortexMeasure(*mesh, (const VortexValues *)*u).error;
  PetscFunctionReturn(0);
}

static inline PetscErrorCode VortexCreate(int n, Vortex *v)
{
  double best;
  PetscFunctionBeginUser;
  *v = (Vortex){.n = n};
  PetscCall(VortexMesh(n, 0, &v->mesh, &v->u, &best));
  v->state = VortexMeasure(v->mesh, (const VortexValues *)v->u);
  v->state.best = best;
  v->spent = best * best;
  PetscFunctionReturn(0);
}

static inline PetscErrorCode VortexDestroy(Vortex *v)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(v->u));
  PetscCall(MeshDestroy(&v->mesh));
  PetscFunctionReturn(0);
}

/* One transfer to a new mesh. */
static inline PetscErrorCode VortexTransfer(Vortex *v)
{
  const double before = v->state.energy;
  double best;
  Mesh *mesh;
  VortexValues *u;
  Transfer transfer;
  PetscFunctionBeginUser;
  v->transfers++;
  PetscCall(VortexMesh(v->n, v->transfers, &mesh, &u, &best));
  PetscCall(TransferCreate(v->mesh, mesh, &transfer));
  PetscCall(TransferP1DG(transfer, 2, &v->u[0][0][0], &u[0][0][0]));
  PetscCall(TransferDestroy(&transfer));
  PetscCall(VortexDestroy(v));
  v->mesh = mesh;
  v->u = u;
  v->state = VortexMeasure(mesh, (const VortexValues *)u);
  v->state.best = best;
  v->state.loss = before - v->state.energy;
  v->state.bound = 0.5 * (best + sqrt(v->spent)) * (best + sqrt(v->spent));
  v->spent += best * best;
  PetscFunctionReturn(0);
}

/* What must hold after every transfer; start: the state before the first. */
static inline void VortexCheck(const Vortex *v, const VortexState *start)
{
  const VortexState *s = &v->state;
  CHECK(s->loss >= 0.0 && s->loss <= s->bound, "transfer %d: energy falls by %g, the bound is %g",
        v->transfers, s->loss, s->bound);
  CHECK(s->error <= sqrt(v->spent) * (1.0 + 1e-6), "transfer %d: error %g, the bound is %g", v->transfers,
        s->error, sqrt(v->spent));
  for (int c = 0; c < 2; c++) {
    CHECK(fabs(s->momentum[c] - start->momentum[c]) < 1e-12 * start->modulus,
          "transfer %d: momentum %d drifts by %g of %g", v->transfers, c, s->momentum[c] - start->momentum[c],
          start->modulus);
  }
}
#endif
