// ranks: 1 2 3
/* A free-surface gauge finds a straight surface exactly on a mesh that knows nothing of it, a drop above it, and nothing where the phase is
 * not; a flow is divided between phases, also in a cloud. */
#include "common/supermesh/geometry.h"
#include "fluid/flow/fluid.h"
#include "fluid/output/flow_gauge.h"
#include "fluid/output/surface_gauge.h"
#include "tests/check.h"
#include "tests/fluid/box_mesh.h"

static PetscErrorCode Measure(Fluid fluid, int phase, double x0, double y0, double x1, double y1,
                              SurfacePlace *place)
{
  const double from[2] = {x0, y0}, to[2] = {x1, y1};
  return SurfaceMeasure(PhaseTransportPhases(FluidPhases(fluid)), FluidMesh(fluid), phase, from, to, place);
}

static void Expect(const SurfacePlace *p, double first, double last, double length, double error,
                   const char *what)
{
  CHECK(fabs(p->first - first) < error && fabs(p->last - last) < error && fabs(p->length - length) < error,
        "%s: first %.12g of %.12g, last %.12g of %.12g, length %.12g of %.12g", what, p->first, first,
        p->last, last, p->length, length);
}

static void Velocity(void *context, double t, const double x[2], double u[])
{
  u[0] = 1.0 + x[1];
  u[1] = -1.0;
}

/* Of each phase below and above the surface at 0.403, and of both. */
static PetscErrorCode CheckFlows(Fluid fluid)
{
  const double from[2] = {0.9, 0.0}, to[2] = {0.9, 1.0}, water = 0.403 + 0.5 * 0.403 * 0.403;
  double flow[3];
  PetscFunctionBeginUser;
  PetscCall(FluidSetInitial(fluid, 0.0, Velocity, NULL, NULL));
  for (int k = 0; k < 3; k++) PetscCall(FlowMeasure(fluid, k - 1, from, to, &flow[k]));
  CHECK(fabs(flow[0] - 1.5) < 1e-9 && fabs(flow[1] - 1.5 + water) < 1e-5 && fabs(flow[2] - water) < 1e-5,
        "flows %.12g, %.12g, %.12g", flow[0], flow[1], flow[2]);
  PetscFunctionReturn(0);
}

/* Specks of a thousandth of each element are a cloud: it flows, by its share, but has no surface; with half of an element at (0.5, 0.8) there
 * is one. */
static PetscErrorCode CheckCloud(Fluid fluid, double size)
{
  const Mesh *m = FluidMesh(fluid);
  const Phases phases = PhaseTransportPhases(FluidPhases(fluid));
  const double from[2] = {0.5, 0.0}, to[2] = {0.5, 1.0};
  SurfacePlace p;
  double *volume, flow;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * m->ne, &volume));
  for (int drop = 0; drop < 2; drop++) {
    for (int e = 0; e < m->ne; e++) {
      double x[3][2];
      MeshCorners(m, e, x);
      const double dx = (x[0][0] + x[1][0] + x[2][0]) / 3.0 - 0.5,
                   dy = (x[0][1] + x[1][1] + x[2][1]) / 3.0 - 0.8;
      const double area = GeometryArea((const double(*)[2])x),
                   share = drop && hypot(dx, dy) < 0.5 * size ? 0.5 : 1e-3 + 1e-4 * (m->egid[e] % 10);
      volume[2 * e] = (1.0 - share) * area;
      volume[2 * e + 1] = share * area;
    }
    PetscCall(PhasesSetVolumes(phases, volume));
    PetscCall(PhasesReconstruct(phases));
    PetscCall(Measure(fluid, 1, 0.5, 0.0, 0.5, 1.0, &p));
    if (!drop) Expect(&p, 0.0, 0.0, 0.0, 1e-15, "a cloud");
    PetscCall(FlowMeasure(fluid, 1, from, to, &flow));
    CHECK(drop || (flow > 1.5 * 1e-3 && flow < 1.5 * 1.9e-3), "a cloud: a flow of %g m2/s", flow);
    CHECK(!drop || fabs(p.last - 0.8) < 1.5 * size, "a drop above a cloud: last %.12g", p.last);
  }
  PetscCall(PetscFree(volume));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const double size = 0.06;
  /* 0: air everywhere, 1: water below y = 0.313 + x/10 and in a drop */
  const Region region[] = {{.shape = REGION_BOX, .phase = 0, .a = {-10.0, -10.0}, .b = {10.0, 10.0}},
                           {.shape = REGION_HALF_PLANE, .phase = 1, .a = {0.0, 0.313}, .b = {-0.1, 1.0}},
                           {.shape = REGION_DISC, .phase = 1, .a = {0.47, 0.75}, .radius = 0.15}};
  Boundary boundary[8] = {{.kind = BOUNDARY_FREE_SLIP},
                          {.kind = BOUNDARY_FREE_SLIP},
                          {.kind = BOUNDARY_FREE_SLIP},
                          {.kind = BOUNDARY_FREE_SLIP}};
  FluidSetup setup = {.theta = 0.5,
                      .rho = 1.0,
                      .mu = 1.0,
                      .cfl = 0.5,
                      .dt_max = 0.01,
                      .boundary = boundary,
                      .phases = {.n = 2, .rho = {1.0, 1000.0}, .mu = {1e-5, 1e-3}}};
  SurfacePlace p;
  Mesh *mesh;
  Fluid fluid;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(SquareMesh(size, &mesh));
  PetscCall(FluidCreate(mesh, &setup, &fluid));
  PetscCall(FluidSetPhases(fluid, 3, region));
  PetscCall(Measure(fluid, 1, 0.9, 0.0, 0.9, 1.0, &p));
  Expect(&p, 0.403, 0.403, 0.403, 1e-6, "a surface");
  PetscCall(Measure(fluid, 1, 0.0, 0.1, 0.0, 0.9, &p));
  Expect(&p, 0.213, 0.213, 0.213, 1e-6, "a surface along a wall");
  PetscCall(Measure(fluid, 0, 0.9, 0.0, 0.9, 1.0, &p));
  Expect(&p, 0.0, 1.0, 0.597, 1e-6, "what is above");
  PetscCall(Measure(fluid, 1, 0.47, 0.0, 0.47, 1.0, &p));
  Expect(&p, 0.36, 0.9, 0.66, 0.05 * size, "a drop above it");
  PetscCall(Measure(fluid, 1, 0.9, 0.55, 0.9, 1.0, &p));
  Expect(&p, 0.0, 0.0, 0.0, 1e-15, "none");
  PetscCall(Measure(fluid, 1, 0.0, -1e-16, 1.0, -1e-16, &p));
  Expect(&p, 1.0, 1.0, 1.0, 1e-12, "the floor");
  PetscCall(CheckFlows(fluid));
  PetscCall(CheckCloud(fluid, size));
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  return PetscFinalize();
}
