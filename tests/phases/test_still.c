// ranks: 1 2 3
/* A still tank of water below air, 1060 : 1.2 kg/m3, on a mesh that knows nothing of the surface: the first step's
 * velocity over g dt.  With the sub-cell mass matrix and ridges it is at rest; without either it is not.
 * still print: says how much. */
#include "flows.h"
#include "fluid/kernels.h"
#include <petscksp.h>

enum { MEAN, SUBCELL, RIDGE, FORMS };

typedef struct {
  Mesh *mesh;
  Stars *stars;
  Phases phases;
  Inertia *inertia; /* [ne] */
  double gravity[2];
  Mat a;
  Vec b, p;
} Tank;

static const double RHO[2] = {1060.0, 1.2};

static PetscErrorCode TankMake(unsigned seed, double slope, int form, Tank *t)
{
  const Shaken shaken = {.n = 16, .seed = seed, .radius = 1.0};
  Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}}};
  const double *volume, l = hypot(slope, 1.0);
  PetscFunctionBeginUser;
  t->gravity[0] = 9.81 * slope / l;
  t->gravity[1] = -9.81 / l;
  region[1] = (Region){.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.473}, .b = {-slope, 1.0}};
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &t->mesh));
  PetscCall(StarsCreate(t->mesh, &t->stars));
  PetscCall(PhasesCreate(t->stars, 2, &t->phases));
  PetscCall(PhasesFill(t->phases, 2, region));
  PetscCall(PhasesReconstruct(t->phases));
  PetscCall(PhasesGetVolumes(t->phases, &volume));
  PetscCall(PetscMalloc1(t->mesh->ne, &t->inertia));
  for (int e = 0; e < t->mesh->ne; e++) {
    Inertia *m = &t->inertia[e];
    PetscCall(PhasesGetInertia(t->phases, e, RHO, form == RIDGE, m));
    if (form > MEAN) continue;
    const double rho = (RHO[0] * volume[2 * e] + RHO[1] * volume[2 * e + 1]) / m->area;
    const Polygon whole = {3, {{m->x[0][0], m->x[0][1]}, {m->x[1][0], m->x[1][1]}, {m->x[2][0], m->x[2][1]}}};
    InertiaBegin((const double(*)[2])t->stars->element[e].x, m);
    InertiaAdd(&whole, rho, m);
    PetscCheck(!InertiaCondense(m), PETSC_COMM_SELF, PETSC_ERR_PLIB, "mass");
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode TankDestroy(Tank *t)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(t->inertia));
  PetscCall(PhasesDestroy(&t->phases));
  PetscCall(StarsDestroy(&t->stars));
  PetscCall(MeshDestroy(&t->mesh));
  PetscCall(MatDestroy(&t->a));
  PetscCall(VecDestroy(&t->b));
  PetscCall(VecDestroy(&t->p));
  PetscFunctionReturn(0);
}

/* force[q][6] = int N grad N_q over the P2 basis */
static void Gradients(const Tank *t, int e, double force[6][6])
{
  ElementGeometry g;
  ElementGeometryCompute(Corner(t->mesh, e, 0), Corner(t->mesh, e, 1), Corner(t->mesh, e, 2), &g);
  for (int q = 0; q < 6; q++) {
    double unit[6] = {0}, grad[3][2];
    unit[q] = 1.0;
    P2Gradient((const double(*)[2])g.g, unit, grad);
    for (int c = 0; c < 2; c++) {
      const double part[3] = {grad[0][c], grad[1][c], grad[2][c]};
      MassApply(g.area, part, &force[q][3 * c]);
    }
  }
}

/* C^T R C p = C^T Q g: the pressure that stops what a step of gravity does to a fluid at rest. */
static PetscErrorCode Assemble(Tank *t)
{
  const Mesh *m = t->mesh;
  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(m->comm, m->np2_owned, m->np2_owned, PETSC_DETERMINE, PETSC_DETERMINE, 40, NULL, 40,
                         NULL, &t->a));
  PetscCall(MatSetOption(t->a, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(MatCreateVecs(t->a, &t->p, &t->b));
  for (int e = 0; e < m->ne; e++) {
    double force[6][6], moved[6], a[6][6], b[6], g[6];
    PetscInt gid[6];
    Gradients(t, e, force);
    for (int k = 0; k < 6; k++) {
      g[k] = t->gravity[k / 3];
      gid[k] = m->p2gid[m->p2[6 * e + k]];
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

static PetscErrorCode Solve(Tank *t, int *iterations)
{
  KSP ksp;
  PC pc;
  MatNullSpace constant;
  KSPConvergedReason why;
  PetscFunctionBeginUser;
  PetscCall(MatNullSpaceCreate(t->mesh->comm, PETSC_TRUE, 0, NULL, &constant));
  PetscCall(MatSetNullSpace(t->a, constant));
  PetscCall(KSPCreate(t->mesh->comm, &ksp));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCJACOBI));
  PetscCall(KSPSetOperators(ksp, t->a, t->a));
  PetscCall(KSPSetTolerances(ksp, 1e-13, 1e-50, 1e5, 20000));
  PetscCall(KSPSolve(ksp, t->b, t->p));
  PetscCall(KSPGetConvergedReason(ksp, &why));
  PetscCall(KSPGetIterationNumber(ksp, iterations));
  CHECK(why > 0, "the pressure does not converge: %s", KSPConvergedReasons[why]);
  PetscCall(KSPDestroy(&ksp));
  PetscCall(MatNullSpaceDestroy(&constant));
  PetscFunctionReturn(0);
}

/* Largest |u+|/(g dt) */
static PetscErrorCode Speed(Tank *t, double *speed)
{
  const Mesh *m = t->mesh;
  Vec local;
  IS is;
  VecScatter scatter;
  const PetscScalar *p;
  PetscFunctionBeginUser;
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, m->np2, &local));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, m->np2, m->p2gid, PETSC_USE_POINTER, &is));
  PetscCall(VecScatterCreate(t->p, is, local, NULL, &scatter));
  PetscCall(VecScatterBegin(scatter, t->p, local, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, t->p, local, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(local, &p));
  *speed = 0.0;
  for (int e = 0; e < m->ne; e++) {
    double force[6][6], sum[6] = {0.0}, du[6], u[6];
    Gradients(t, e, force);
    for (int q = 0; q < 6; q++) {
      for (int k = 0; k < 6; k++) sum[k] += p[m->p2[6 * e + q]] * force[q][k];
    }
    for (int k = 0; k < 6; k++) u[k] = t->gravity[k / 3];
    InertiaProject(&t->inertia[e], u);
    InertiaResponse(&t->inertia[e], sum, du);
    for (int k = 0; k < 6; k++) *speed = fmax(*speed, fabs(u[k] - du[k]) / 9.81);
  }
  PetscCall(VecRestoreArrayRead(local, &p));
  PetscCall(VecDestroy(&local));
  PetscCall(ISDestroy(&is));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, speed, 1, MPI_DOUBLE, MPI_MAX, m->comm));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  static const char *const NAME[FORMS] = {"one density an element", "sub-cell mass",
                                          "sub-cell mass and ridges"};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (unsigned seed = 1; seed <= 3; seed++) {
    for (int form = MEAN; form < FORMS; form++) {
      Tank t;
      double speed;
      int iterations;
      PetscCall(TankMake(seed, seed == 3 ? 0.31 : 0.0, form, &t));
      PetscCall(Assemble(&t));
      PetscCall(Solve(&t, &iterations));
      PetscCall(Speed(&t, &speed));
      if (argc > 1)
        PetscCall(PetscPrintf(PETSC_COMM_WORLD, "seed %u, %-26s largest |u|/(g dt) %.1e, %d iterations\n",
                              seed, NAME[form], speed, iterations));
      CHECK(form == RIDGE ? speed < 1e-8 : speed > 0.1, "%s: largest |u|/(g dt) is %g", NAME[form], speed);
      PetscCall(TankDestroy(&t));
    }
  }
  return PetscFinalize();
}
