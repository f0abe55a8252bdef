/* Water below air in the closed unit square, inviscid: gravity, the inertia of cut elements, the pressure,
 * and momentum that moves with the mass (one velocity an element moves; slopes stay).  One step is
 *
 *     C^T R C p = C^T Q (u/dt + g + W^-1 k),    u <- Q (u + dt (g + W^-1 k)) - dt R C p
 *
 * with the kinks' force k, or with condensed ridges (Q, R of inertia.h), or with neither. */
#ifndef TESTS_PHASES_TANK_H
#define TESTS_PHASES_TANK_H
#include "common/space/p2_space.h"
#include "fluid/discretization/kernels.h"
#include "fluid/phases/flux.h"
#include "tests/phases/flows.h"
#include <petscksp.h>

enum { MEAN, SUBCELL, RIDGE, KINK, FORMS };

typedef struct {
  Mesh *mesh;
  P2Space *p2;
  Stars *stars;
  Phases phases;
  Inertia *inertia; /* [ne] */
  double *u;        /* [ne][6] m/s */
  double *kick;     /* [ne][6] g + W^-1 k, m/s2 */
  double gravity[2];
  Mat a;
  Vec b, p, local;
  VecScatter scatter;
  KSP ksp;
} Tank;

static const double RHO[2] = {1060.0, 1.2};

static inline PetscErrorCode TankSolver(Tank *t)
{
  PC pc;
  IS is;
  MatNullSpace constant;
  PetscFunctionBeginUser;
  PetscCall(MatNullSpaceCreate(t->mesh->comm, PETSC_TRUE, 0, NULL, &constant));
  PetscCall(MatSetNullSpace(t->a, constant));
  PetscCall(MatNullSpaceDestroy(&constant));
  PetscCall(KSPCreate(t->mesh->comm, &t->ksp));
  PetscCall(KSPSetType(t->ksp, KSPCG));
  PetscCall(KSPGetPC(t->ksp, &pc));
  PetscCall(PCSetType(pc, PCJACOBI));
  PetscCall(KSPSetInitialGuessNonzero(t->ksp, PETSC_TRUE));
  PetscCall(KSPSetTolerances(t->ksp, 1e-13, 1e-50, 1e5, 20000));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, t->p2->n, &t->local));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, t->p2->n, t->p2->gid, PETSC_USE_POINTER, &is));
  PetscCall(VecScatterCreate(t->p, is, t->local, NULL, &t->scatter));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* The inertia of all elements with the interface as it is. */
static inline PetscErrorCode TankInertia(int form, Tank *t)
{
  const double *volume;
  PetscFunctionBeginUser;
  PetscCall(PhasesReconstruct(t->phases));
  PetscCall(PhasesGetVolumes(t->phases, &volume));
  for (int e = 0; e < t->mesh->ne; e++) {
    Inertia *m = &t->inertia[e];
    PetscCall(PhasesGetInertia(t->phases, e, RHO, (PetscBool)(form == RIDGE), m));
    if (form > MEAN) continue;
    const double rho = (RHO[0] * volume[2 * e] + RHO[1] * volume[2 * e + 1]) / m->area;
    const Polygon whole = {3, {{m->x[0][0], m->x[0][1]}, {m->x[1][0], m->x[1][1]}, {m->x[2][0], m->x[2][1]}}};
    InertiaBegin((const double(*)[2])t->stars->element[e].x, m);
    InertiaAdd(&whole, rho, m);
    PetscCheck(!InertiaCondense(m), PETSC_COMM_SELF, PETSC_ERR_PLIB, "mass");
  }
  PetscFunctionReturn(0);
}

/* At rest, on a random mesh of n x n cells; gravity is normal to the line from below to above of slope
 * `slope`. */
static inline PetscErrorCode TankMake(int n, unsigned seed, double slope, int nregions, const Region region[],
                                      Tank *t)
{
  const Shaken shaken = {.n = n, .seed = seed, .radius = 1.0};
  const double l = hypot(slope, 1.0);
  PetscFunctionBeginUser;
  *t = (Tank){.gravity = {9.81 * slope / l, -9.81 / l}};
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &t->mesh));
  PetscCall(P2SpaceCreate(t->mesh, &t->p2));
  PetscCall(StarsCreate(t->mesh, &t->stars));
  PetscCall(PhasesCreate(t->stars, 2, &t->phases));
  PetscCall(PhasesFill(t->phases, nregions, region));
  PetscCall(PetscMalloc1(t->mesh->ne, &t->inertia));
  PetscCall(PetscCalloc1(6 * t->mesh->ne, &t->u));
  PetscCall(PetscCalloc1(6 * t->mesh->ne, &t->kick));
  PetscCall(MatCreateAIJ(t->mesh->comm, t->p2->nowned, t->p2->nowned, PETSC_DETERMINE, PETSC_DETERMINE, 40,
                         NULL, 40, NULL, &t->a));
  PetscCall(MatSetOption(t->a, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(MatCreateVecs(t->a, &t->p, &t->b));
  PetscCall(TankSolver(t));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode TankDestroy(Tank *t)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(t->inertia));
  PetscCall(PetscFree(t->u));
  PetscCall(PetscFree(t->kick));
  PetscCall(PhasesDestroy(&t->phases));
  PetscCall(StarsDestroy(&t->stars));
  PetscCall(MatDestroy(&t->a));
  PetscCall(VecDestroy(&t->b));
  PetscCall(VecDestroy(&t->p));
  PetscCall(VecDestroy(&t->local));
  PetscCall(VecScatterDestroy(&t->scatter));
  PetscCall(KSPDestroy(&t->ksp));
  PetscCall(P2SpaceDestroy(&t->p2));
  PetscCall(MeshDestroy(&t->mesh));
  PetscFunctionReturn(0);
}

/* force[q][6] = int N grad N_q over the P2 basis */
static inline void Gradients(const Tank *t, int e, double force[6][6])
{
  ElementGeometry g;
  ElementGeometryCompute(Corner(t->mesh, e, 0), Corner(t->mesh, e, 1), Corner(t->mesh, e, 2), &g);
  for (int q = 0; q < 6; q++) {
    double unit[6] = {0}, grad[3][2];
    unit[q] = 1.0;
    P2Gradient((const double(*)[2])g.g, unit, grad);
    for (int c = 0; c < 2; c++) {
      const double part[3] = {grad[0][c], grad[1][c], grad[2][c]};
      P1MassApply(g.area, part, &force[q][3 * c]);
    }
  }
}

static inline PetscErrorCode TankKick(int form, Tank *t)
{
  PetscFunctionBeginUser;
  for (int e = 0; e < t->mesh->ne; e++) {
    double force[6] = {0.0}, *kick = &t->kick[6 * e];
    if (form == KINK) PetscCall(PhasesGetKink(t->phases, e, RHO, t->gravity, force));
    InertiaSolve(&t->inertia[e], force, kick);
    for (int k = 0; k < 6; k++) kick[k] += t->gravity[k / 3];
  }
  PetscFunctionReturn(0);
}

static inline PetscErrorCode TankAssemble(Tank *t, double dt)
{
  const Mesh *m = t->mesh;
  PetscFunctionBeginUser;
  PetscCall(MatZeroEntries(t->a));
  PetscCall(VecZeroEntries(t->b));
  for (int e = 0; e < m->ne; e++) {
    double force[6][6], moved[6], a[6][6], b[6], g[6];
    PetscInt gid[6];
    Gradients(t, e, force);
    for (int k = 0; k < 6; k++) {
      g[k] = t->kick[6 * e + k] + t->u[6 * e + k] / dt;
      gid[k] = t->p2->gid[t->p2->node[6 * e + k]];
    }
    InertiaProject(&t->inertia[e], g);
    for (int q = 0; q < 6; q++) {
      InertiaResponse(&t->inertia[e], force[q], moved);
      b[q] = InertiaDot(force[q], g);
      for (int r = 0; r < 6; r++) a[q][r] = InertiaDot(force[r], moved);
    }
    PetscCall(MatSetValues(t->a, 6, gid, 6, gid, &a[0][0], ADD_VALUES));
    PetscCall(VecSetValues(t->b, 6, gid, b, ADD_VALUES));
  }
  PetscCall(MatAssemblyBegin(t->a, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(t->a, MAT_FINAL_ASSEMBLY));
  PetscCall(VecAssemblyBegin(t->b));
  PetscCall(VecAssemblyEnd(t->b));
  PetscFunctionReturn(0);
}

/* u <- Q (u + dt g) - dt R C p */
static inline PetscErrorCode TankUpdate(Tank *t, double dt)
{
  const Mesh *m = t->mesh;
  const PetscScalar *p;
  PetscFunctionBeginUser;
  PetscCall(VecScatterBegin(t->scatter, t->p, t->local, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(t->scatter, t->p, t->local, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(t->local, &p));
  for (int e = 0; e < m->ne; e++) {
    double force[6][6], sum[6] = {0.0}, du[6], *u = &t->u[6 * e];
    Gradients(t, e, force);
    for (int q = 0; q < 6; q++) {
      for (int k = 0; k < 6; k++) sum[k] += p[t->p2->node[6 * e + q]] * force[q][k];
    }
    for (int k = 0; k < 6; k++) u[k] += dt * t->kick[6 * e + k];
    InertiaProject(&t->inertia[e], u);
    InertiaResponse(&t->inertia[e], sum, du);
    for (int k = 0; k < 6; k++) u[k] -= dt * du[k];
  }
  PetscCall(VecRestoreArrayRead(t->local, &p));
  PetscFunctionReturn(0);
}

/* One step with the interface as it is, after TankInertia. */
static inline PetscErrorCode TankStep(Tank *t, int form, double dt, int *iterations)
{
  KSPConvergedReason why;
  PetscFunctionBeginUser;
  PetscCall(TankKick(form, t));
  PetscCall(TankAssemble(t, dt));
  PetscCall(KSPSetOperators(t->ksp, t->a, t->a));
  PetscCall(KSPSolve(t->ksp, t->b, t->p));
  PetscCall(KSPGetConvergedReason(t->ksp, &why));
  PetscCall(KSPGetIterationNumber(t->ksp, iterations));
  CHECK(why > 0, "the pressure does not converge: %s", KSPConvergedReasons[why]);
  PetscCall(TankUpdate(t, dt));
  PetscFunctionReturn(0);
}

/* q = int rho u, kg/s a metre, and the mass */
static inline double TankMomentum(const Inertia *m, const double u[6], double q[2])
{
  double mass = 0.0;
  q[0] = q[1] = 0.0;
  for (int k = 0; k < 9; k++) {
    mass += m->mass[k / 3][k % 3];
    for (int c = 0; c < 2; c++) q[c] += m->mass[k / 3][k % 3] * u[3 * c + k % 3];
  }
  return mass;
}

/* Moves the interface and, with the mass that passes the faces, the mean momentum of the elements that it
 * leaves. */
static inline PetscErrorCode TankMove(int form, Tank *t, double dt, double *defect)
{
  const Stars *s = t->stars;
  double *flux, *beta, *velocity, *swept, (*mean)[2], (*q)[2], now[2];
  FluxReport report;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc6(3 * s->ne, &flux, 6 * s->ne, &beta, 6 * s->ne, &velocity, 6 * s->ne, &swept, s->nl,
                         &mean, s->ne, &q));
  PetscCall(FluxEquilibrate(s, t->u, NULL, flux, beta, &report));
  PetscCall(FluxVertexVelocity(s, beta, velocity));
  PetscCall(PhasesAdvect(t->phases, dt, flux, velocity, NULL, swept, NULL));
  for (int e = 0; e < s->ne; e++) {
    const double mass = TankMomentum(&t->inertia[e], &t->u[6 * e], q[e]);
    for (int c = 0; c < 2; c++) mean[e][c] = q[e][c] / mass;
  }
  PetscCall(StarsExchange(s, sizeof *mean, mean));
  for (int k = 0; k < 6 * s->ne; k++) { /* face k / 2 of all, phase k % 2 */
    const int e = k / 6, o = s->neighbor[e][k / 2 % 3];
    const double mass = RHO[k % 2] * swept[k], *from = mass > 0.0 || o < 0 ? mean[e] : mean[o];
    for (int c = 0; c < 2; c++) q[e][c] -= mass * from[c];
  }
  PetscCall(TankInertia(form, t));
  for (int e = 0; e < s->ne; e++) {
    const double mass = TankMomentum(&t->inertia[e], &t->u[6 * e], now);
    for (int k = 0; k < 6; k++) t->u[6 * e + k] += (q[e][k / 3] - now[k / 3]) / mass;
  }
  *defect = report.defect;
  PetscCall(PetscFree6(flux, beta, velocity, swept, mean, q));
  PetscFunctionReturn(0);
}

/* Largest velocity component, m/s. */
static inline double TankSpeed(const Tank *t)
{
  double speed = 0.0;
  for (int k = 0; k < 6 * t->mesh->ne; k++) speed = fmax(speed, fabs(t->u[k]));
  MPI_Allreduce(MPI_IN_PLACE, &speed, 1, MPI_DOUBLE, MPI_MAX, t->mesh->comm);
  return speed;
}
#endif
