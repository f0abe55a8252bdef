#include "solid/check.h"
#include "common/program/program.h"
#include "common/program/run_case.h"
#include "solid/bodies/case_body.h"
#include "solid/check_domain.h"
#include "solid/check_materials.h"
#include "solid/check_motions.h"
#include "solid/probes.h"
#include "solid/solid_case.h"
#include "solid/solid_impl.h"
#include "solid/writer.h"
#include <stdio.h>
#include <stdlib.h>

/* What the calls that read them do not say of the solid's keys. */
static const CoracleCaseKey KEYS[] = {
    {"solid.materials.*.density", "kg/m3", "density"},
    {"solid.materials.*.youngs_modulus", "Pa",
     "Young's modulus; rigid materials need it, or penalty, for contact alone"},
    {"solid.materials.*.poisson_ratio", "", "Poisson's ratio"},
    {"solid.materials.*.damping", "", "part of the critical damping of the stiffest mode of an element"},
    {"solid.materials.*.damping_ratio", "",
     "of the critical damping at damping_frequency, in tension; grows with the frequency"},
    {"solid.materials.*.damping_frequency", "Hz", "required with damping_ratio"},
    {"solid.materials.*.penalty", "Pa", "of contact; absent: Young's modulus"},
    {"solid.materials.*.friction", "",
     "coefficient of friction in contact; of two materials the geometric mean, 0 if one has 0"},
    {"solid.materials.*.contact_damping", "",
     "part of the critical damping in contact, with which bodies come to rest; of two materials the "
     "geometric mean; not a "
     "coefficient of restitution: a rebound is set by damping_ratio"},
    {"solid.materials.*.plane", "", "plane strain or plane stress"},
    {"solid.materials.*.law", "",
     "stress from strain; rigid: none, its bodies keep their shape; joint: of named joints alone, with "
     "strengths, "
     "energies and frictions"},
    {"solid.materials.*.thickness", "m", "across the plane; absent: 1; the fluid sees one metre"},
    {"solid.materials.*.tensile_strength", "Pa", "with it the material can crack where there are joints"},
    {"solid.materials.*.shear_strength", "Pa", "without pressure; required with tensile_strength"},
    {"solid.materials.*.internal_friction", "",
     "what pressure adds to the shear strength, over the pressure"},
    {"solid.materials.*.weibull_modulus", "",
     "strengths of edges scatter about their means by Weibull's distribution of this modulus (5 to 20 of "
     "rock)"},
    {"solid.materials.*.weibull_seed", "", "another number, another sample"},
    {"solid.materials.*.fracture_energy", "J/m2", "of opening; required with tensile_strength"},
    {"solid.materials.*.shear_fracture_energy", "J/m2", "of sliding; absent: fracture_energy"},
    {"solid.bodies", "", "list of bodies; [] leaves the fluid alone"},
    {"solid.bodies[].material", "",
     "name of a material; not required where regions have one for each surface of the mesh"},
    {"solid.bodies[].regions.*", "", "material of the mesh's physical surface of this name"},
    {"solid.bodies[].mesh", "", "a Gmsh mesh, instead of a shape; a relative path starts at the case file"},
    {"solid.bodies[].translate", "m", "shift of the mesh, after scale"},
    {"solid.bodies[].scale", "", "factor on the mesh's coordinates; absent: 1"},
    {"solid.bodies[].shape", "", "required unless there is a mesh"},
    {"solid.bodies[].order", "",
     "of its triangles: 1, of constant strain, which can crack; 2, of linear strain, six nodes, which bend; "
     "absent: the mesh's, 1"},
    {"solid.bodies[].centre", "m", "centre of a shape"},
    {"solid.bodies[].size", "m", "edge of its elements"},
    {"solid.bodies[].radius", "m",
     "of a disc, a polygon of the same area (its corners lie outside the circle, by 2.3 % of the radius with "
     "12 edges); of the middle of a ring's wall"},
    {"solid.bodies[].thickness", "m", "of a ring's wall, with radius"},
    {"solid.bodies[].outer_radius", "m", "of a ring, instead of radius and thickness"},
    {"solid.bodies[].inner_radius", "m", "of a ring, instead of radius and thickness"},
    {"solid.bodies[].layers", "", "elements through a ring's wall; absent: as many as its size wants"},
    {"solid.bodies[].width", "m", "of a rectangle, or an ellipse"},
    {"solid.bodies[].height", "m", "of a rectangle, or an ellipse"},
    {"solid.bodies[].angle", "rad",
     "by which a rectangle, an ellipse or a polygon is turned about its centre (of area), counter-clockwise"},
    {"solid.bodies[].corners", "m",
     "of a polygon, in either sense; its elements have edges of about size, smaller ones beside its smaller "
     "features"},
    {"solid.bodies[].corners[]", "m", "x and y"},
    {"solid.bodies[].sides", "",
     "names of a polygon's sides, the first from the first corner to the second; absent: all are called "
     "boundary"},
    {"solid.bodies[].sides[]", "", "several may have one name"},
    {"solid.bodies[].stretch", "", "factors along x and y by which the body is stretched at the start"},
    {"solid.bodies[].fixed", "",
     "true, or a list of names of boundaries and physical surfaces that do not move"},
    {"solid.bodies[].fixed[]", "", "name of a boundary or a physical surface that does not move"},
    {"solid.bodies[].prescribed", "",
     "list of boundaries whose motion is prescribed, or of the motion of the whole body"},
    {"solid.bodies[].prescribed[].boundary", "", "name of the boundary; absent: the whole body"},
    {"solid.bodies[].prescribed[].name", "",
     "leads the columns of the force that holds or moves it, in solid_probes.csv (of all bodies of repeat "
     "together)"},
    {"solid.bodies[].prescribed[].component", "", "which component is prescribed; the other stays free"},
    {"solid.bodies[].prescribed[].table", "",
     "list of rows of time and velocity, linear between them; beside it no period and no rise"},
    {"solid.bodies[].prescribed[].table[]", "s, m/s", "time, velocity along x and y"},
    {"solid.bodies[].prescribed[].velocity", "m/s",
     "instead of a table: constant, or the amplitude of one that swings"},
    {"solid.bodies[].prescribed[].angular_velocity", "rad/s",
     "with the velocity, the table or without them: a rotation about the pivot, which moves with them, "
     "counter-clockwise; "
     "a number, or rows of time and angular velocity, linear between them"},
    {"solid.bodies[].prescribed[].angular_velocity[]", "s, rad/s",
     "time, angular velocity; constant before the first and after the last"},
    {"solid.bodies[].prescribed[].pivot", "m", "at the start; required with angular_velocity"},
    {"solid.bodies[].prescribed[].period", "s",
     "both swing: times sin(2 pi t/period), from one end of the way: 0 to velocity period/pi further on"},
    {"solid.bodies[].prescribed[].rise", "s", "time in which both rise from zero, linearly"},
    {"solid.bodies[].prescribed[].release", "s", "when the boundary becomes free; absent: never"},
    {"solid.bodies[].loads", "",
     "list of loads on boundaries, beside the fluid's; they add up, and new faces of cracks have none"},
    {"solid.bodies[].loads[].boundary", "", "name of the boundary"},
    {"solid.bodies[].loads[].pressure", "Pa",
     "normal to the boundary where it is then; a number, or rows of time and pressure, linear between them"},
    {"solid.bodies[].loads[].pressure[]", "s, Pa",
     "time, pressure; constant before the first and after the last"},
    {"solid.bodies[].loads[].traction", "Pa",
     "along x and y over the boundary at rest; two numbers, or rows of time and both"},
    {"solid.bodies[].loads[].traction[]", "s, Pa", "time, traction along x and y"},
    {"solid.bodies[].joints", "", "which edges between two elements can crack: none, all, or a list"},
    {"solid.bodies[].joints[]", "",
     "name of a physical surface in which edges can crack, or of a physical curve inside, along which they "
     "can"},
    {"solid.bodies[].joints[].name", "", "of a physical curve whose joints have a material of their own"},
    {"solid.bodies[].joints[].material", "",
     "of these joints: strengths, energies and internal_friction, and once parted friction and "
     "contact_damping between their faces; else those of the weaker material beside them"},
    {"solid.bodies[].joints[].lower", "m",
     "lower left corner of a box: edges between two elements with centres in it can crack"},
    {"solid.bodies[].joints[].upper", "m", "upper right corner of the box"},
    {"solid.bodies[].velocity", "m/s",
     "at the start; a submerged body loses a part of it in the first step to the fluid around it, which is "
     "at rest then (added mass)"},
    {"solid.bodies[].angular_velocity", "rad/s", "at the start, about the centre of mass, counter-clockwise"},
    {"solid.bodies[].repeat.n", "", "how often the body is there along x and y"},
    {"solid.bodies[].repeat.step", "m", "distance from one to the next along x and y"},
    {"solid.walls.lower", "m", "lower left corner of four rigid walls around all bodies"},
    {"solid.walls.upper", "m", "upper right corner of the walls"},
    {"solid.walls.friction", "",
     "of the walls' side: the coefficient of a contact is the geometric mean of both sides'; absent: that of "
     "what touches"},
    {"solid.walls.contact_damping", "", "part of the critical damping; absent: that of what touches"},
    {"solid.contact", "", "list of pairs of materials with a friction or damping of their own"},
    {"solid.contact[].between", "", "two names of materials, or walls"},
    {"solid.contact[].between[]", "", "name of a material, or walls"},
    {"solid.contact[].friction", "", "coefficient of friction of the pair"},
    {"solid.contact[].damping", "", "part of the critical damping of the pair"},
    {"solid.springs", "",
     "list of springs between a point of a body and a fixed point or a point of another body; their lengths "
     "and tensions are in solid_probes.csv"},
    {"solid.springs[].name", "", "leads the names of its columns"},
    {"solid.springs[].point", "m", "where it holds a body at the start"},
    {"solid.springs[].anchor", "m", "its other end, which does not move"},
    {"solid.springs[].other_point", "m",
     "in place of anchor: where its other end holds another body at the start"},
    {"solid.springs[].stiffness", "N/m", "per metre across the plane"},
    {"solid.springs[].damping", "N s/m", "resistance to its change of length; with length 0 to any motion"},
    {"solid.springs[].length", "m",
     "without tension; absent: at the start; 0: the same stiffness in all directions"},
    {"solid.springs[].acts", "", "pull: alone, as a mooring line; push: alone, as a fender"},
    {"solid.probes", "", "list of points whose displacement and velocity are in solid_probes.csv"},
    {"solid.probes[].name", "", "leads the names of its columns"},
    {"solid.probes[].point", "m",
     "where it is in the bodies at rest, or nearly: less than a tenth of a side away from one"},
    {"solid.contact_probes", "",
     "list of contacts between two bodies, or of a body and walls, whose forces, means over the step, and "
     "place are in solid_probes.csv"},
    {"solid.contact_probes[].name", "", "leads the names of its columns"},
    {"solid.contact_probes[].body", "",
     "number of the body on which the forces act, as in solid.csv: bodies are numbered from 0 as they come "
     "in the case, those of repeat "
     "along x first"},
    {"solid.contact_probes[].other", "",
     "number of the body that it touches, or a wall: left, right, bottom, top; absent: all that it touches"},
    {"solid.courant", "", "substep over the limit of stability"},
    {"solid.decay_rate", "1/s", "of velocities, by a resistance over the mass: leads to the static state"},
    {"solid.pressure_load", "",
     "the pressure of the fluid around compresses the bodies; leave it off for those whose stiffness stands "
     "for rigid"},
    {"solid.rebalance", "substeps",
     "lost to a bad share of the work after which elements change ranks; 0: never"},
    {"solid.petsc", "", "options for PETSc"},
    {NULL, NULL, NULL}};

/* JointsDirections of Gmsh's meshes: at most 0.15 by its Delaunay algorithm, 0.35 to 0.9 by its frontal one; 0.8 to 1 of rectangles. */
#define FEW_DIRECTIONS 0.3

/* Below a zone of one edge cracks take more than their energy; along edges of few directions they zigzag (tests/solid/README.md). */
static void ExpectCracks(Solid s)
{
  double zone;
  const int n = JointsResolution(s->joints, s, &zone);
  if (n == 0) return;
  printf("solid: %d edges can crack; E fracture_energy/tensile_strength^2 is %.2g edges long%s\n", n, zone,
         zone < 1.0 ? " (less than one: cracks take too much energy)" : "");
  if (JointsDirections(s->joints, s) > FEW_DIRECTIONS)
    printf("solid: these edges have few directions: strengths are up to a third too large (better: gmsh -2 "
           "-algo del2d)\n");
}

static void ExpectElements(Solid s, const SolidView *v, const double lower[2], const double upper[2])
{
  printf("solid: %d bodies of %d triangles", v->nbodies, v->nelements);
  if (s->elements.nsix > 0) printf(" (%d of six nodes, each counts as four)", s->elements.nsix);
  printf(", %d nodes and %d surface edges in [%.4g, %.4g] x [%.4g, %.4g] m\n", v->nnodes, v->nfacets,
         lower[0], upper[0], lower[1], upper[1]);
}

static PetscErrorCode Expect(CoracleCase c, Solid s, Command command)
{
  SolidView v;
  Writer writer;
  double limit, lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL};
  PetscFunctionBeginUser;
  SolidGetView(s, &v);
  for (int n = 0; n < 2 * v.nnodes; n++) {
    lower[n % 2] = fmin(lower[n % 2], v.x[n]);
    upper[n % 2] = fmax(upper[n % 2], v.x[n]);
  }
  if (v.nbodies == 0)
    printf("solid: no bodies\n");
  else
    ExpectElements(s, &v, lower, upper);
  PetscCall(SolidLimit(s, &limit));
  if (isfinite(limit))
    printf("solid: substeps of at most %.3g s\n", limit);
  else if (v.nbodies > 0)
    printf("solid: all bodies are %s\n",
           s->nfixed == v.nnodes ? "fixed" : "fixed or rigid: substeps are as contact asks for");
  PetscCall(ExpectBodies(s));
  ExpectCracks(s);
  if (command == COMMAND_DRAW) {
    PetscCall(WriterCreate(c, PETSC_COMM_SELF, s, NULL, &writer));
    PetscCall(WriterDestroy(&writer));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ReadCase(CoracleCase c, Command command)
{
  Solid solid;
  RunCase run;
  PetscFunctionBeginUser;
  RunCaseDescribe(c, KEYS);
  RunCaseRead(c, &run);
  const double longest = CoracleCasePositive(c, "time.dt_max"); /* of a solid alone */
  PetscCall(SolidFromCase(c, PETSC_COMM_SELF, &solid));
  if (command != COMMAND_KEYS && CoracleCaseFaultless(c)) {
    PetscCall(CheckDomain(c, solid));
    CheckGauges(c, solid);
    PetscCall(ProbesCheckPoints(c, PETSC_COMM_SELF, solid));
    PetscCall(Expect(c, solid, command));
    ExpectMotions(solid, run.end);
    NoteTurns(solid, run.end, longest);
    RunCaseNoteSteps(run.end, longest);
    RunCaseNoteUnsaved(run.walltime, run.checkpoint);
    PetscCall(NoteWalls(c, solid, run.end));
    NoteFar(solid);
    PetscCall(NoteThin(c, solid));
    NoteFriction(solid);
    NoteStrengths(solid);
  }
  PetscCall(SolidDestroy(&solid));
  PetscFunctionReturn(0);
}

static void Read(CoracleCase c, void *command)
{
  const PetscErrorCode failed = ReadCase(c, *(const Command *)command);
  if (failed) CoracleCaseRefuse(c, "solid", "the bodies cannot be made (error %d of PETSc)", failed);
}

int SolidAnswer(Command command, int argc, char **argv)
{
  static const CommandAnswers ANSWERS = {
      "solid", "  --alone          runs the solid without fluid and coupler\n", Read};
  return ProgramAnswer(command, &ANSWERS, argc, argv);
}
