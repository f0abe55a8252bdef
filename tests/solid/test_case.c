/* The solid's keys of a case file: what is read, and what a bad one is told. */
#include "../link/catch.h"
#undef CHECK
#include "build.h"
#include "solid_case.h"

#define HEAD                                                                                                 \
  "gravity: [0, -9.81]\nsolid:\n  materials:\n    m: {density: 1000, youngs_modulus: 1e6, poisson_ratio: "   \
  "0.3}\n"
#define DISC "    - {shape: disc, centre: [0, 0], radius: 0.1, size: 0.05, material: m}\n"

static const char *const SECTIONS[] = {"solid", NULL};
static Assembly assembly;
static SolidSetup setup;

static void Read(Case c)
{
  (void)AssemblyDestroy(&assembly);
  memset(&setup, 0, sizeof setup);
  (void)SolidCaseRead(c, &assembly, &setup);
  CaseFinish(c, SECTIONS);
}

static void Everything(void)
{
  CheckCase("gravity: [0, -9.81]\n"
            "solid:\n"
            "  courant: 0.4\n"
            "  walls: {lower: [-1, -1], upper: [2, 2]}\n"
            "  materials:\n"
            "    soft: {density: 1000, youngs_modulus: 1e5, poisson_ratio: 0.4, damping: 0.2, penalty: 3e5}\n"
            "    hard: {density: 2000, youngs_modulus: 1e8, poisson_ratio: 0.25}\n"
            "  bodies:\n"
            "    - {shape: disc, centre: [0, 0], radius: 0.1, size: 0.05, material: soft, velocity: [1, 2],\n"
            "       angular_velocity: 3, stretch: [1.5, 1.0]}\n"
            "    - {shape: rectangle, centre: [1, 0], width: 0.4, height: 0.2, angle: 0.1, size: 0.1,\n"
            "       material: hard, fixed: [left, top]}\n"
            "    - {shape: disc, centre: [1, 1], radius: 0.1, size: 0.05, material: hard, fixed: true}\n",
            NULL, Read, NULL);
  CHECK(setup.courant == 0.4 && setup.gravity[1] == -9.81 && setup.walls && setup.upper[0] == 2.0, "setup");
  CHECK(assembly.nbodies == 3, "%d bodies", assembly.nbodies);
  const Material *soft = &assembly.body[0].material, *hard = &assembly.body[1].material;
  CHECK(soft->damping == 0.2 && soft->penalty == 3e5 && soft->poisson_ratio == 0.4, "soft");
  CHECK(hard->damping == 0.0 && hard->penalty == 1e8 && hard->density == 2000.0, "hard");
  int fixed[3] = {0, 0, 0};
  for (int n = 0; n < assembly.nnodes; n++) {
    const double *x = assembly.x + 2 * n, *u = assembly.u + 2 * n;
    fixed[assembly.node_body[n]] += assembly.fixed[n];
    if (assembly.node_body[n] > 0) continue;
    CHECK(fabs(u[0] - (1.0 - 3.0 * x[1])) + fabs(u[1] - (2.0 + 3.0 * x[0])) < 1e-14, "velocity of node %d",
          n);
    CHECK(fabs(x[0] - 1.5 * assembly.rest[2 * n]) + fabs(x[1] - assembly.rest[2 * n + 1]) < 1e-14, "node %d",
          n);
  }
  CHECK(fixed[0] == 0 && fixed[1] == 7 && fixed[2] > 7, "fixed %d %d %d", fixed[0], fixed[1], fixed[2]);
}

static void MeshFile(void)
{
  CheckCase(HEAD "  bodies:\n    - {mesh: " SOURCE_FOLDER
                 "/square.msh, scale: 0.5, translate: [3, 1], material: m, fixed: [clamp]}\n",
            NULL, Read, NULL);
  int fixed = 0;
  CHECK(assembly.nelements == 4 && assembly.nfacets == 4, "%d elements, %d facets", assembly.nelements,
        assembly.nfacets);
  for (int n = 0; n < assembly.nnodes; n++) {
    const double *x = assembly.x + 2 * n;
    CHECK(x[0] >= 3.0 && x[0] <= 3.5 && x[1] >= 1.0 && x[1] <= 1.5, "node %d at (%g, %g)", n, x[0], x[1]);
    CHECK(assembly.fixed[n] == (x[0] == 3.0), "node %d", n);
    fixed += assembly.fixed[n];
  }
  CHECK(fixed == 2, "%d fixed", fixed);
}

static void Refusals(void)
{
  CheckCase(HEAD "  bodies:\n" DISC, NULL, Read, NULL);
  CheckCase(HEAD, NULL, Read, ":2: key 'solid.bodies': expected a list of at least one body");
  CheckCase(
      "gravity: [0, 0]\nsolid:\n  materials:\n    m: {density: -1, youngs_modulus: 1, poisson_ratio: 0}\n",
      NULL, Read, ":4: key 'solid.materials.m.density': expected a number > 0, found '-1'");
  CheckCase(
      "gravity: [0, 0]\nsolid:\n  materials:\n    m: {density: 1, youngs_modulus: 1, poisson_ratio: 0.5}\n",
      NULL, Read,
      ":4: key 'solid.materials.m.poisson_ratio': expected a number from 0 to 0.499, found '0.5'");
  CheckCase(HEAD "  bodies:\n    - {shape: disc, centre: [0, 0], radius: 0.1, size: 0.05, material: steel}\n",
            NULL, Read,
            ":6: key 'solid.bodies[0].material': there is no material 'steel' in solid.materials");
  CheckCase(HEAD "  bodies:\n" DISC
                 "    - {shape: disc, centre: [0.15, 0], radius: 0.1, size: 0.05, material: m}\n",
            NULL, Read, ":7: key 'solid.bodies[1]': the body overlaps solid.bodies[0]");
  CheckCase(HEAD "  bodies:\n    - {shape: rectangle, centre: [0, 0], width: 1, height: 1, size: 1, "
                 "material: m, fixed: [lid]}\n",
            NULL, Read,
            ":6: key 'solid.bodies[0]': the body has no boundary 'lid'; it has left, right, bottom, top");
  CheckCase(HEAD "  walls: {lower: [-1, -1], upper: [1, 0.05]}\n  bodies:\n" DISC, NULL, Read,
            ":7: key 'solid.bodies[0]': the body reaches through solid.walls at (0.0336749, 0.0583267)");
  CheckCase(
      HEAD
      "  bodies:\n    - {shape: disc, centre: [0, 0], radius: 0.1, size: 0.05, material: m, colour: red}\n",
      NULL, Read, ":6: unknown key 'solid.bodies[0].colour'");
  CheckCase(HEAD "  bodies:\n    - {mesh: none.msh, material: m}\n", NULL, Read,
            ":6: key 'solid.bodies[0].mesh': /tmp/none.msh: cannot be opened");
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  Everything();
  MeshFile();
  Refusals();
  PetscCall(AssemblyDestroy(&assembly));
  return PetscFinalize();
}
