// ranks: 1 2 3
/* Fluxes of the fluid's own projected velocity, noisy on purpose: they close on every element, are opposite
 * on both sides of a face, stay near {u}.n; beta is continuous in its normal part and free of divergence.  A
 * linear solenoidal velocity gives its own fluxes to round-off, also through open boundaries.  flux print:
 * says how well. */
#include "fluid/flow/fluid.h"
#include "fluid/phases/flux.h"
#include "tests/phases/flows.h"

static int print;

/* A vortex with noise that differs from vertex to vertex; 0 on the walls. */
static void Noisy(void *context, double t, const double x[2], double v[])
{
  const double s = VortexPsi(x) * M_PI;
  uint64_t bits[2];
  memcpy(bits, x, sizeof bits);
  VortexVelocity(x, v);
  for (int c = 0; c < 2; c++) v[c] += s * (Chance((unsigned)(bits[0] >> 20), (int)(bits[1] >> 30), c) - 0.5);
}

static PetscErrorCode Solenoidal(const Mesh *mesh, Fluid *fluid)
{
  Boundary wall[4] = {{.kind = BOUNDARY_VELOCITY},
                      {.kind = BOUNDARY_VELOCITY},
                      {.kind = BOUNDARY_VELOCITY},
                      {.kind = BOUNDARY_VELOCITY}};
  const FluidSetup setup = {.theta = 0.5, .rho = 1.0, .mu = 1.0, .cfl = 1.0, .dt_max = 1.0, .boundary = wall};
  PetscFunctionBeginUser;
  PetscCall(FluidCreate(mesh, &setup, fluid));
  PetscCall(FluidSetInitial(*fluid, 0.0, Noisy, NULL, NULL));
  PetscCall(FluidMakeSolenoidal(*fluid));
  PetscFunctionReturn(0);
}

/* The two sides of each inner face: fluxes cancel, normal parts of beta agree; beta has no divergence. */
static void CheckField(const Stars *s, const double flux[], const double beta[], const FluxReport *report)
{
  double(*all)[9] = malloc((size_t)(s->nl + 1) * sizeof *all), jump = 0.0, divergence = 0.0;
  for (int e = 0; e < s->ne; e++) {
    memcpy(all[e], &beta[6 * e], 6 * sizeof(double));
    memcpy(&all[e][6], &flux[3 * e], 3 * sizeof(double));
  }
  StarsExchange(s, sizeof *all, all);
  for (int k = 0; k < 3 * s->ne; k++) {
    const int e = k / 3, i = k % 3, o = s->neighbor[e][i];
    double grad[3][2];
    if (i == 0) {
      double div = 0.0;
      P1Gradients((const double(*)[2])s->element[e].x, grad);
      for (int j = 0; j < 3; j++) div += grad[j][0] * all[e][j] + grad[j][1] * all[e][3 + j];
      divergence = fmax(divergence, fabs(div) * StarsArea(s, e));
    }
    if (o < 0) continue;
    int j = 0;
    while (s->neighbor[o][j] != e) j++;
    CHECK(all[e][6 + i] == -all[o][6 + j], "face %d of element %d: %.17g and %.17g", i, e, all[e][6 + i],
          all[o][6 + j]);
    for (int end = 1; end < 3; end++) {
      const int p = (i + end) % 3, q = (j + 3 - end) % 3;
      const double *a = s->element[e].x[(i + 1) % 3], *b = s->element[e].x[(i + 2) % 3];
      const double n[2] = {b[1] - a[1], a[0] - b[0]};
      jump = fmax(jump, fabs((all[e][p] - all[o][q]) * n[0] + (all[e][3 + p] - all[o][3 + q]) * n[1]));
    }
  }
  free(all);
  CHECK(jump < 1e-13 * 0.1, "beta.n jumps by %g m2/s", jump);
  CHECK(divergence < 1e-14 + 2.0 * report->imbalance, "int div beta is %g m2/s", divergence);
}

static PetscErrorCode Projected(void)
{
  Mesh *mesh;
  Stars *stars;
  Fluid fluid;
  FluxReport report;
  double *flux, *beta;
  PetscFunctionBeginUser;
  PetscCall(UnstructuredMesh(PETSC_COMM_WORLD, 0.05, &mesh));
  PetscCall(StarsCreate(mesh, &stars));
  PetscCall(Solenoidal(mesh, &fluid));
  PetscCall(PetscMalloc2(3 * mesh->ne, &flux, 6 * mesh->ne, &beta));
  PetscCall(FluxEquilibrate(stars, FluidVelocity(fluid), NULL, flux, beta, &report));
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                          "defect %.1e, imbalance %.1e, largest flux %.1e m2/s; change %.2f %%\n",
                          report.defect, report.imbalance, report.largest, 100.0 * report.change));
  CHECK(report.defect < 1e-13, "around a vertex the velocity leaves %g m2/s", report.defect);
  CHECK(report.imbalance < 1e-14, "an element's fluxes sum to %g m2/s", report.imbalance);
  CHECK(report.largest > 0.01 && report.change > 0.001 && report.change < 0.1, "largest %g, changed by %g",
        report.largest, report.change);
  CheckField(stars, flux, beta, &report);
  PetscCall(PetscFree2(flux, beta));
  PetscCall(FluidDestroy(&fluid));
  PetscCall(StarsDestroy(&stars));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

static void Stagnation(const double x[2], double u[2])
{
  u[0] = 0.3 + x[0] + 0.5 * x[1];
  u[1] = 0.2 - x[1] + 0.25 * x[0];
}

/* A linear field with inflow and outflow: left and bottom prescribed, right and top open. */
static PetscErrorCode Through(double defect)
{
  const Shaken shaken = {.n = 9, .seed = 4u, .radius = 1.0};
  Mesh *mesh;
  Stars *stars;
  FluxReport report;
  double *u, *moment, *flux, *beta, worst = 0.0;
  char open[4];
  PetscFunctionBeginUser;
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(StarsCreate(mesh, &stars));
  for (int k = 0; k < 4; k++) open[k] = k == MeshTagIndex(mesh, "right") || k == MeshTagIndex(mesh, "top");
  PetscCall(PetscMalloc4(6 * mesh->ne, &u, 6 * mesh->ne, &moment, 3 * mesh->ne, &flux, 6 * mesh->ne, &beta));
  for (int k = 0; k < 3 * mesh->ne; k++) {
    const double *a = Corner(mesh, k / 3, (k + 1) % 3), *b = Corner(mesh, k / 3, (k + 2) % 3);
    double v[3][2];
    Stagnation(Corner(mesh, k / 3, k % 3), v[0]);
    Stagnation(a, v[1]);
    Stagnation(b, v[2]);
    for (int c = 0; c < 2; c++) u[6 * (k / 3) + 3 * c + k % 3] = v[0][c];
    for (int end = 1; end < 3; end++) {
      const double mean[2] = {(2.0 * v[end][0] + v[3 - end][0]) / 6.0,
                              (2.0 * v[end][1] + v[3 - end][1]) / 6.0};
      moment[2 * k + end - 1] = mean[0] * (b[1] - a[1]) - mean[1] * (b[0] - a[0]);
    }
  }
  for (int k = 0; k < 3 * mesh->ne; k++) u[6 * (k / 3) + k % 3] += defect * Corner(mesh, k / 3, k % 3)[0];
  const FluxBoundary boundary = {open, moment, NULL};
  PetscCall(FluxEquilibrate(stars, u, &boundary, flux, beta, &report));
  for (int k = 0; k < 6 * mesh->ne; k++) worst = fmax(worst, fabs(beta[k] - u[k]));
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  if (defect > 0.0) {
    CHECK(report.defect > 1e-3 * defect && report.imbalance < report.defect,
          "a defect of the velocity is reported as %g, and an element's fluxes sum to %g", report.defect,
          report.imbalance);
  } else {
    CHECK(worst < 1e-12 && report.defect < 1e-14 && report.imbalance < 1e-14,
          "a linear velocity changes by %g, defect %g", worst, report.defect);
  }
  PetscCall(PetscFree4(u, moment, flux, beta));
  PetscCall(StarsDestroy(&stars));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  print = argc > 1;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Projected());
  PetscCall(Through(0.0));
  PetscCall(Through(1e-3));
  return PetscFinalize();
}
