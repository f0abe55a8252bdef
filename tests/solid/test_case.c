/* The solid's keys of a case file: what is read, and the message of a bad one. */
#include "tests/link/catch.h"
#undef CHECK
#include "solid/cracks/interior_edges.h"
#include "solid/solid_case.h"
#include "tests/solid/build.h"

#define HEAD                                                                                                 \
  "gravity: [0, -9.81]\nsolid:\n  materials:\n    m: {density: 1000, youngs_modulus: 1e6, poisson_ratio: "   \
  "0.3}\n"
#define DISC "    - {shape: disc, centre: [0, 0], radius: 0.1, size: 0.05, material: m}\n"

static const char *const SECTIONS[] = {"solid", NULL};
static Model model;
static SolidSetup setup;

static void Read(CoracleCase c)
{
  (void)ModelDestroy(&model);
  memset(&setup, 0, sizeof setup);
  (void)SolidCaseRead(c, &model, &setup);
  CoracleCaseFinish(c, SECTIONS);
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
  CHECK(model.nbodies == 3, "%d bodies", model.nbodies);
  const Material *soft = &model.body[0].material, *hard = &model.body[1].material;
  CHECK(soft->damping == 0.2 && soft->penalty == 3e5 && soft->poisson_ratio == 0.4, "soft");
  CHECK(hard->damping == 0.0 && hard->penalty == 1e8 && hard->density == 2000.0, "hard");
  int fixed[3] = {0, 0, 0};
  for (int n = 0; n < model.nnodes; n++) {
    const double *x = model.x + 2 * n, *u = model.u + 2 * n;
    fixed[model.node_body[n]] += model.fixed[n];
    if (model.node_body[n] > 0) continue;
    CHECK(fabs(u[0] - (1.0 - 3.0 * x[1])) + fabs(u[1] - (2.0 + 3.0 * x[0])) < 1e-14, "velocity of node %d",
          n);
    CHECK(fabs(x[0] - 1.5 * model.rest[2 * n]) + fabs(x[1] - model.rest[2 * n + 1]) < 1e-14, "node %d", n);
  }
  CHECK(fixed[0] == 0 && fixed[1] == 7 && fixed[2] > 7, "fixed %d %d %d", fixed[0], fixed[1], fixed[2]);
}

/* One entry, six bodies: two rows of three, joints' boxes move along; messages name the entry. */
static void Repeated(void)
{
  CheckCase("gravity: [0, -9.81]\nsolid:\n  rebalance: 7\n  materials:\n    m: {density: 1000, "
            "youngs_modulus: 1e6, "
            "poisson_ratio: 0.3, tensile_strength: 1, shear_strength: 1, fracture_energy: 1, "
            "internal_friction: 0.7}\n  bodies:\n"
            "    - {shape: disc, centre: [9, 9], radius: 0.1, size: 0.05, material: m}\n"
            "    - {shape: rectangle, centre: [0, 0], width: 1, height: 1, size: 0.5, material: m,\n"
            "       joints: [{lower: [-0.5, -0.5], upper: [0, 0.5]}], repeat: {n: [3, 2], step: [1.5, 2]}}\n",
            NULL, Read, NULL);
  CHECK(setup.rebalance == 7.0 && model.nbodies == 7, "%d bodies", model.nbodies);
  CHECK(model.body[0].material.internal_friction == 0.7, "internal friction");
  int jointed[7] = {0};
  for (int e = 0; e < model.nelements; e++) jointed[model.element_body[e]] += model.jointed[e];
  for (int b = 1; b < 7; b++) {
    const double *centre = model.body[b].centre;
    CHECK(fabs(centre[0] - 1.5 * ((b - 1) % 3)) + fabs(centre[1] - 2.0 * ((b - 1) / 3)) < 1e-13,
          "body %d at (%g, %g)", b, centre[0], centre[1]);
    CHECK(jointed[b] == jointed[1] && jointed[b] > 0, "body %d has %d jointed elements", b, jointed[b]);
  }
  CheckCase(HEAD "  bodies:\n" DISC
                 "    - {shape: disc, centre: [1, 0], radius: 0.1, size: 0.05, material: m, "
                 "repeat: {n: [3, 1], step: [0.1, 0]}}\n",
            NULL, Read,
            ":7: key 'solid.bodies[1]': its copies 0 and 1 of repeat, counted from 0, overlap at (1.01223, "
            "0.0115175)");
  CheckCase(HEAD "  bodies:\n    - {shape: disc, centre: [1, 0], radius: 0.1, size: 0.05, material: m, "
                 "repeat: {n: [3, 0.5], step: [1, 1]}}\n",
            NULL, Read, ":6: key 'solid.bodies[0].repeat.n': expected two integers >= 1");
}

/* Copies of a stretched ring are as it is, each at its place. */
static void RepeatedStretch(void)
{
  CheckCase(HEAD "  bodies:\n    - {shape: ring, centre: [0, 0], radius: 0.4, thickness: 0.1, size: 0.1, "
                 "layers: 2, material: m,\n"
                 "       stretch: [1.2, 1.0], repeat: {n: [2, 2], step: [1.5, 2]}}\n",
            NULL, Read, NULL);
  const int n = model.nnodes / 4;
  CHECK(model.nbodies == 4, "%d bodies", model.nbodies);
  for (int k = 0; k < 8 * n; k++) {
    const int b = k / (2 * n), c = k % 2;
    const double by = c ? 2.0 * (b / 2) : 1.5 * (b % 2), moved = model.x[k] - model.x[k % (2 * n)];
    CHECK(fabs(moved - by) < 1e-13 && fabs(model.rest[k] - model.rest[k % (2 * n)] - by) < 1e-13,
          "body %d: a node is moved by %g, not by %g", b, moved, by);
  }
}

/* A body of two densities that turns about its mass centre has no momentum. */
static void TurnsAboutMass(void)
{
  double momentum[2] = {0.0, 0.0}, size = 0.0;
  CheckCase("gravity: [0, 0]\nsolid:\n  materials:\n    soft: {density: 1000, youngs_modulus: 1e5, "
            "poisson_ratio: 0.4}\n"
            "    hard: {density: 8000, youngs_modulus: 1e8, poisson_ratio: 0.2}\n  bodies:\n    - "
            "{mesh: " SOURCE_FOLDER "/regions.msh, regions: {soft: soft, hard: hard}, angular_velocity: 3}\n",
            NULL, Read, NULL);
  for (int k = 0; k < 3 * model.nelements; k++)
    for (int c = 0; c < 2; c++) {
      const double p = ModelCornerMass(&model, k) * model.u[2 * model.element[k] + c];
      momentum[c] += p;
      size += fabs(p);
    }
  CHECK(size > 0.0 && hypot(momentum[0], momentum[1]) < 1e-13 * size, "momentum (%g, %g) of %g", momentum[0],
        momentum[1], size);
}

static void MeshFile(void)
{
  CheckCase(HEAD "  bodies:\n    - {mesh: " SOURCE_FOLDER
                 "/square.msh, scale: 0.5, translate: [3, 1], material: m, fixed: [clamp]}\n",
            NULL, Read, NULL);
  int fixed = 0;
  CHECK(model.nelements == 4 && model.nfacets == 4, "%d elements, %d facets", model.nelements, model.nfacets);
  for (int n = 0; n < model.nnodes; n++) {
    const double *x = model.x + 2 * n;
    CHECK(x[0] >= 3.0 && x[0] <= 3.5 && x[1] >= 1.0 && x[1] <= 1.5, "node %d at (%g, %g)", n, x[0], x[1]);
    CHECK(model.fixed[n] == (x[0] == 3.0), "node %d", n);
    fixed += model.fixed[n];
  }
  CHECK(fixed == 2, "%d fixed", fixed);
}

/* Elements of the body that may part. */
static int Jointed(int body)
{
  int n = 0;
  for (int e = 0; e < model.nelements; e++) n += model.element_body[e] == body && model.jointed[e];
  return n;
}

#define STRONG                                                                                               \
  "gravity: [0, 0]\nsolid:\n  materials:\n    m: {density: 1000, youngs_modulus: 1e6, poisson_ratio: 0.3}\n" \
  "    r: {density: 1000, youngs_modulus: 1e6, poisson_ratio: 0.3, tensile_strength: 1e4, shear_strength: "  \
  "2e4,\n"                                                                                                   \
  "        fracture_energy: 5%s}\n  bodies:\n"
#define BLOCK                                                                                                \
  "    - {shape: rectangle, centre: [%g, 0], width: 1, height: 1, size: 0.5, material: %s, joints: %s}\n"

#define CURVED "    - {mesh: " SOURCE_FOLDER "/regions.msh, material: r, joints: [%s]%s}\n"

static void Joints(void)
{
  char text[1600];
  int n = snprintf(text, sizeof text, STRONG, ", shear_fracture_energy: 7");
  n += snprintf(text + n, sizeof text - (size_t)n, BLOCK, 0.0, "r", "all");
  n += snprintf(text + n, sizeof text - (size_t)n, BLOCK, 2.0, "r", "none");
  n += snprintf(text + n, sizeof text - (size_t)n, BLOCK, 4.0, "r",
                "[{lower: [3.5, -0.5], upper: [4, 0]}, {lower: [4, 0], upper: [4.5, 0.5]}]");
  (void)snprintf(text + n, sizeof text - (size_t)n,
                 "    - {mesh: " SOURCE_FOLDER
                 "/square.msh, translate: [5, 0], material: r, joints: [plate]}\n"
                 "    - {mesh: " SOURCE_FOLDER "/square.msh, translate: [7, 0], material: m}\n");
  CheckCase(text, NULL, Read, NULL);
  CHECK(Jointed(0) == 8 && Jointed(1) == 0 && Jointed(2) == 4 && Jointed(3) == 4 && Jointed(4) == 0,
        "jointed %d %d %d %d %d", Jointed(0), Jointed(1), Jointed(2), Jointed(3), Jointed(4));
  const Material *m = &model.body[0].material;
  CHECK(m->strength[0] == 1e4 && m->strength[1] == 2e4 && m->fracture_energy[0] == 5.0 &&
            m->fracture_energy[1] == 7.0,
        "strengths");
  n = snprintf(text, sizeof text, STRONG, "");
  (void)snprintf(text + n, sizeof text - (size_t)n, BLOCK, 0.0, "m", "all");
  CheckCase(
      text, NULL, Read,
      ":8: key 'solid.bodies[0]': joints need tensile_strength, shear_strength and fracture_energy, which "
      "material 'm' has not");
  (void)snprintf(text + n, sizeof text - (size_t)n, BLOCK, 0.0, "r", "some");
  CheckCase(text, NULL, Read, ":8: key 'solid.bodies[0].joints': expected one of none, all, found 'some'");
  (void)snprintf(text + n, sizeof text - (size_t)n,
                 "    - {mesh: " SOURCE_FOLDER "/square.msh, material: r, joints: [crust]}\n");
  CheckCase(text, NULL, Read,
            ":8: key 'solid.bodies[0]': the body has no region or curve inside 'crust'; "
            "it has plate");
}

/* A physical curve between triangles is where a body may part, and nowhere else. */
static void JointsOnCurve(void)
{
  static const int SIDES[] = {1 << 1, 0, 0, 1 << 2}; /* of soft and hard, the edge from (1, 0) to (1, 1) */
  char text[1600];
  const int n = snprintf(text, sizeof text, STRONG, "");
  InteriorEdges edges;
  (void)snprintf(text + n, sizeof text - (size_t)n, CURVED, "seam", "");
  CheckCase(text, NULL, Read, NULL);
  for (int e = 0; e < 4; e++) CHECK(model.jointed[e] == SIDES[e], "element %d: %d", e, model.jointed[e]);
  CHECK(!InteriorEdgesFind(&model, &edges) && edges.n == 3 && edges.njoints == 1, "%d joints in %d edges",
        edges.njoints, edges.n);
  CHECK(!InteriorEdgesDestroy(&edges), "destroyed");
  (void)snprintf(text + n, sizeof text - (size_t)n, CURVED, "{name: seam, material: m}", "");
  CheckCase(text, NULL, Read,
            ":8: key 'solid.bodies[0].joints[0].material': material 'm' of joints needs tensile_strength, "
            "shear_strength and fracture_energy");
  (void)snprintf(text + n, sizeof text - (size_t)n, CURVED, "{name: soft, material: r}", "");
  CheckCase(text, NULL, Read, ":8: key 'solid.bodies[0]': the body has no curve inside 'soft'; it has seam");
  (void)snprintf(text + n, sizeof text - (size_t)n, CURVED,
                 "{name: seam, material: r}, {name: seam, material: r}", "");
  CheckCase(text, NULL, Read, ":8: key 'solid.bodies[0]': the joints of curve 'seam' have two materials");
  (void)snprintf(text + n, sizeof text - (size_t)n, CURVED, "seam", ", order: 2");
  CheckCase(text, NULL, Read,
            ":8: key 'solid.bodies[0]': six-node triangles (order 2) have no joints: they do not crack");
  (void)snprintf(text + n, sizeof text - (size_t)n, CURVED, "clamp", "");
  CheckCase(
      text, NULL, Read,
      ":8: key 'solid.bodies[0]': the body has no region or curve inside 'clamp'; it has soft, hard, seam");
}

#define RIGID                                                                                                \
  "gravity: [0, -9.81]\nsolid:\n  materials:\n    m: {density: 1000, law: rigid, penalty: 1e6}\n  "          \
  "bodies:\n    - "
#define SLAB "shape: rectangle, centre: [0.1, 0.2], width: 0.4, height: 0.2, size: 0.05, material: m"

/* What a rigid body is made of, and what it cannot have. */
static void RigidBodies(void)
{
  CheckCase(RIGID "{" SLAB "}\n", NULL, Read, NULL);
  const RigidBody *rigid = &model.body[0].rigid;
  const double mass = 1000.0 * 0.08, inertia = mass * (0.16 + 0.04) / 12.0;
  CHECK(fabs(rigid->mass - mass) < 1e-10 && fabs(rigid->inertia / inertia - 1.0) < 0.06, "%g kg/m, %g kg m",
        rigid->mass, rigid->inertia);
  const double turned = 2.0 * (0.4 * 0.4 * 0.4 + 0.2 * 0.2 * 0.2) / 12.0; /* int (r x n)^2 */
  CHECK(fabs(rigid->surface_compliance - 1.2 / mass - turned / rigid->inertia) < 1e-12, "compliance %g",
        rigid->surface_compliance);
  CheckCase(RIGID "{" SLAB ", fixed: true}\n", NULL, Read, NULL);
  CHECK(model.body[0].rigid.mass == 0.0, "held as a whole it is not a rigid body");
  CheckCase(RIGID "{" SLAB ", fixed: [left]}\n", NULL, Read,
            ":6: key 'solid.bodies[0]': a rigid body is held as a whole (fixed: true) or not at all");
  CheckCase(RIGID "{" SLAB ", joints: all}\n", NULL, Read,
            ":6: key 'solid.bodies[0]': joints need tensile_strength, shear_strength and fracture_energy, "
            "which material 'm' has not");
  CheckCase(RIGID "{" SLAB ", prescribed: [{boundary: left, velocity: [0, 1]}]}\n", NULL, Read,
            ":6: key 'solid.bodies[0]': a rigid body moves as prescribed as a whole: without a boundary");
  CheckCase(
      "gravity: [0, -9.81]\nsolid:\n  materials:\n    m: {density: 1000, law: rigid}\n  bodies:\n    - {" SLAB
      "}\n",
      NULL, Read, ":4: key 'solid.materials.m.penalty' is missing");
}

/* The mean velocity over intervals within, before, after and over several rows of a table. */
static void CheckTable(void)
{
  const double row[] = {0.0, 0.0, 1.0, 1.0, 4.0, 1.0, 1.5, -2.0, 0.0, 3.0, 1.0, 0.0};
  const PrescribedMotion motion = {{1, 1}, 4, row, 0.0, 0.0, 0.0, 0.0, {0.0, 0.0}, {0}, ""};
  static const double CASE[][4] = {
      {-2.0, 1.0, 0.0, 1.0}, {-1.0, 5.0, 0.55, 0.45}, /* from, length, mean of u, v */
      {0.25, 0.5, 2.0, 1.0}, {1.0, 0.25, 2.5, 0.75},  {0.5, 2.5, 0.5, 0.3},
      {3.0, 2.0, 1.0, 0.0},  {1.5, 1.5, -0.5, 0.0}};
  for (size_t k = 0; k < sizeof CASE / sizeof *CASE; k++)
    for (int c = 0; c < 2; c++) {
      const double mean = PrescribedVelocity(&motion, c, CASE[k][0], CASE[k][1]);
      CHECK(fabs(mean - CASE[k][2 + c]) < 1e-14, "mean velocity %d from %g for %g s: %g", c, CASE[k][0],
            CASE[k][1], mean);
    }
}

/* Of one row that rises and swings, against its sum over many short intervals. */
static void CheckSwing(void)
{
  enum { MANY = 200000 };
  const double row[] = {0.0, 2.0, -3.0};
  static const double PERIOD_RISE[][2] = {{0.0, 0.0}, {0.0, 1.5}, {0.7, 0.0}, {0.7, 1.5}};
  for (size_t k = 0; k < sizeof PERIOD_RISE / sizeof *PERIOD_RISE; k++)
    for (double from = 0.0; from < 2.0; from += 0.9) {
      const double period = PERIOD_RISE[k][0], rise = PERIOD_RISE[k][1], h = 0.8;
      const PrescribedMotion motion = {{1, 1}, 1, row, 0.0, period, rise, 0.0, {0.0, 0.0}, {0}, ""};
      double sum = 0.0;
      for (int i = 0; i < MANY; i++) {
        const double t = from + h * (i + 0.5) / MANY;
        sum += (period > 0.0 ? sin(2.0 * M_PI * t / period) : 1.0) * (t < rise ? t / rise : 1.0) / MANY;
      }
      for (int c = 0; c < 2; c++) {
        const double mean = PrescribedVelocity(&motion, c, from, h);
        CHECK(fabs(mean - sum * row[1 + c]) < 1e-9, "period %g, rise %g: mean velocity %d from %g: %g",
              period, rise, c, from, mean);
      }
    }
}

/* Regions of a mesh, contact's table, walls, planes, drives and rings. */
static void Full(void)
{
  CheckCase(
      "gravity: [0, 0]\n"
      "solid:\n"
      "  walls: {lower: [-9, -9], upper: [9, 9], friction: 0.7}\n"
      "  contact:\n"
      "    - {between: [hard, soft], friction: 0.1}\n"
      "    - {between: [soft, walls], friction: 0.2, damping: 0.3}\n"
      "  materials:\n"
      "    soft: {density: 1000, youngs_modulus: 1e5, poisson_ratio: 0.4, friction: 0.5, contact_damping: "
      "0.6, law: neo_hookean}\n"
      "    hard: {density: 2000, youngs_modulus: 1e8, poisson_ratio: 0.2, plane: stress, thickness: 0.01,\n"
      "      law: corotated}\n"
      "  bodies:\n"
      "    - {mesh: " SOURCE_FOLDER "/regions.msh, regions: {soft: soft, hard: hard},\n"
      "       prescribed: [{boundary: clamp, component: x, table: [[0, 1, 0], [2, 3, 0]]}]}\n"
      "    - {shape: ring, centre: [5, 0], radius: 1, thickness: 0.1, size: 0.2, layers: 2, material: soft,\n"
      "       stretch: [1.5, 1.0]}\n"
      "    - {shape: ring, centre: [-5, 0], inner_radius: 0.5, outer_radius: 1, size: 0.2, material: soft,\n"
      "       prescribed: [{boundary: inner, velocity: [4, 5], release: 6}]}\n",
      NULL, Read, NULL);
  CHECK(model.nmaterials == 2, "%d materials", model.nmaterials);
  const Material *soft = &model.material[0], *hard = &model.material[1];
  CHECK(soft->friction == 0.5 && soft->contact_damping == 0.6 && !soft->plane_stress &&
            soft->thickness == 1.0,
        "soft");
  CHECK(hard->plane_stress && hard->thickness == 0.01 && hard->law == LAW_COROTATED &&
            soft->law == LAW_NEO_HOOKEAN,
        "hard");
  for (int e = 0; e < model.nelements; e++)
    CHECK(model.element_material[e] == (e == 2 || e == 3), "element %d", e);
  CHECK(setup.nrules == 2 && setup.rule[0].friction == 0.1 && setup.rule[0].damping < 0.0 &&
            setup.rule[1].damping == 0.3 && setup.rough_walls && setup.wall_friction == 0.7 &&
            setup.wall_damping < 0.0,
        "contact");
  CHECK(model.nmotions == 2 && model.motion[0].nrows == 2 && !model.motion[0].prescribed[1] &&
            model.motion[0].release == 0.0 && model.motion[1].release == 6.0,
        "drives");
  const double mean = PrescribedVelocity(&model.motion[0], 0, 1.0, 2.0); /* 2 to 3, then 3 */
  CHECK(fabs(mean - 2.75) < 1e-14, "mean velocity %g", mean);
  CheckTable();
  CheckSwing();
  double area[3] = {0.0, 0.0, 0.0}, span[2] = {0.0, 0.0};
  for (int n = 0; n < model.nnodes; n++) /* the stretched ring's wall is 0.1 at its right, thinner above */
    for (int c = 0; c < 2 && model.node_body[n] == 1; c++)
      span[c] = fmax(span[c], model.x[2 * n + c] - (c ? 0.0 : 5.0));
  CHECK(fabs(span[0] / 1.55 - 1.0) < 0.01 && fabs(span[1] / 1.0355 - 1.0) < 0.01, "stretched ring %g %g",
        span[0], span[1]);
  for (int e = 0; e < model.nelements; e++) {
    const int *n = model.element + 3 * e;
    const double *x = model.rest;
    area[model.element_body[e]] += 0.5 * ((x[2 * n[1]] - x[2 * n[0]]) * (x[2 * n[2] + 1] - x[2 * n[0] + 1]) -
                                          (x[2 * n[1] + 1] - x[2 * n[0] + 1]) * (x[2 * n[2]] - x[2 * n[0]]));
  }
  CHECK(fabs(area[1] / (M_PI * 0.2) - 1.0) < 1e-12 && fabs(area[2] / (M_PI * 0.75) - 1.0) < 1e-12,
        "rings of %g and %g m2", area[1], area[2]);
}

static void Refusals(void)
{
  CheckCase(HEAD "  bodies:\n    - {mesh: " SOURCE_FOLDER "/regions.msh, material: m, regions: {wood: m}}\n",
            NULL, Read, ":6: key 'solid.bodies[0]': the body has no region 'wood'; it has soft, hard");
  CheckCase(HEAD "  bodies:\n    - {mesh: " SOURCE_FOLDER "/regions.msh, regions: {hard: m}}\n", NULL, Read,
            ":6: key 'solid.bodies[0].material': expected a material: regions have none for the mesh's "
            "surface 'soft'");
  CheckCase(HEAD "  contact: [{between: [m, stone], friction: 1}]\n  bodies:\n" DISC, NULL, Read,
            ":5: key 'solid.contact[0].between[1]': there is no material 'stone' in solid.materials: "
            "expected one of m, walls");
  CheckCase(HEAD
            "  bodies:\n    - {shape: ring, centre: [0, 0], radius: 1, thickness: 3, size: 1, material: m}\n",
            NULL, Read, ":6: key 'solid.bodies[0].thickness': the ring has no hole or no wall");
  CheckCase(HEAD
            "  bodies:\n    - {shape: ring, centre: [0, 0], radius: 1, thickness: 1, size: 0.5, material: m, "
            "stretch: [1.0, 0.2]}\n",
            NULL, Read, ":6: key 'solid.bodies[0]': its stretch turns element 1 at (0.351152, 0) inside out");
  CheckCase(
      HEAD "  bodies:\n    - {shape: disc, centre: [0, 0], radius: 0.1, size: 0.05, material: m, prescribed: "
           "[{boundary: boundary, table: [[1, 0, 0], [1, 0, 0]]}]}\n",
      NULL, Read,
      ":6: key 'solid.bodies[0].prescribed[0].table[1]': the first numbers of the rows must rise");
  CheckCase(HEAD
            "  bodies:\n    - {shape: disc, centre: [0, 0], radius: 0.1, size: 0.05, material: m, driven: "
            "[{boundary: boundary, velocity: [1, 0]}]}\n",
            NULL, Read, ":6: key 'solid.bodies[0].driven' is now called 'solid.bodies[0].prescribed'");
  CheckCase("gravity: [0, 0]\nsolid:\n  materials:\n    m: {density: 1, youngs_modulus: 1, poisson_ratio: 0, "
            "law: hooke}\n",
            NULL, Read,
            ":4: key 'solid.materials.m.law': expected one of neo_hookean, corotated, st_venant_kirchhoff, "
            "rigid, joint, "
            "found 'hooke'");
  CheckCase(HEAD "  bodies:\n" DISC, NULL, Read, NULL);
  CheckCase(HEAD, NULL, Read,
            ":2: key 'solid.bodies': expected a list of bodies; of a fluid alone an empty one, []");
  CheckCase(
      "gravity: [0, 0]\nsolid:\n  materials:\n    m: {density: -1, youngs_modulus: 1, poisson_ratio: 0}\n",
      NULL, Read, ":4: key 'solid.materials.m.density': expected a number > 0, found '-1'");
  CheckCase(
      "gravity: [0, 0]\nsolid:\n  materials:\n    m: {density: 1, youngs_modulus: 1, poisson_ratio: 0.5}\n",
      NULL, Read,
      ":4: key 'solid.materials.m.poisson_ratio': expected a number from 0 to 0.499, found '0.5'");
  CheckCase(HEAD "  bodies:\n    - {shape: disc, centre: [0, 0], radius: 0.1, size: 0.05, material: steel}\n",
            NULL, Read,
            ":6: key 'solid.bodies[0].material': there is no material 'steel' in solid.materials: expected "
            "one of m");
  CheckCase(HEAD "  bodies:\n" DISC
                 "    - {shape: disc, centre: [0.15, 0], radius: 0.1, size: 0.05, material: m}\n",
            NULL, Read,
            ":7: key 'solid.bodies[1]': the body overlaps solid.bodies[0] at (0.0622311, 0.0115175)");
  CheckCase(
      HEAD "  bodies:\n    - {shape: rectangle, centre: [0, 0], width: 4, height: 4, size: 1, material: m}\n"
           "    - {shape: rectangle, centre: [3, 0], width: 4, height: 4, size: 1, material: m}\n",
      NULL, Read, ":7: key 'solid.bodies[1]': the body overlaps solid.bodies[0] at (1.66667, -1.66667)");
  CheckCase(
      HEAD "  bodies:\n    - {shape: rectangle, centre: [0, 0], width: 1, height: 1, size: 1, "
           "material: m, fixed: [lid]}\n",
      NULL, Read,
      ":6: key 'solid.bodies[0]': the body has no boundary or region 'lid'; it has left, right, bottom, "
      "top");
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
  Repeated();
  RepeatedStretch();
  TurnsAboutMass();
  MeshFile();
  Joints();
  JointsOnCurve();
  RigidBodies();
  Full();
  Refusals();
  PetscCall(ModelDestroy(&model));
  return PetscFinalize();
}
