#include "fluid/check.h"
#include "common/program/program.h"
#include "common/program/run_case.h"
#include "fluid/check_phases.h"
#include "fluid/input/fluid_case.h"
#include "fluid/output/probes.h"
#include "fluid/output/writer.h"

/* What the calls that read them do not say of the fluid's keys. */
static const CoracleCaseKey KEYS[] = {
    {"fluid.density", "kg/m3", "density"},
    {"fluid.viscosity", "Pa s", "dynamic viscosity"},
    {"fluid.phases", "", "two or more phases that do not mix, instead of density and viscosity"},
    {"fluid.phases[].name", "", "what regions and boundaries call it"},
    {"fluid.phases[].density", "kg/m3", "its density"},
    {"fluid.phases[].viscosity", "Pa s", "its dynamic viscosity"},
    {"fluid.phases[].sound_speed", "m/s",
     "speed of sound of a compressible phase, whose density is that given where the pressure is 0"},
    {"fluid.phases[].gas.pressure", "Pa",
     "a compressible phase is an ideal gas of this absolute pressure where the fluid's pressure is 0 and its "
     "density that given"},
    {"fluid.phases[].gas.exponent", "",
     "of the density in pressure ~ density^exponent: 1 isothermal, 1.4 adiabatic air"},
    {"fluid.phases[].gas.initial_pressure", "Pa",
     "the fluid's pressure in the gas at the start, whose density follows from it; of a gas beneath water, "
     "what the water weighs"},
    {"fluid.phases_advection", "",
     "how phases move: geometric, a sharp line in each cut element; compressive, the limited shares of the "
     "paper"},
    {"fluid.surface_tension", "N/m",
     "of the interfaces between phases: a number for all, or a list; none if not given"},
    {"fluid.surface_tension[].between", "", "two phases"},
    {"fluid.surface_tension[].between[]", "", "a phase"},
    {"fluid.surface_tension[].value", "N/m", "surface tension between them; 0 for pairs that are not listed"},
    {"fluid.contact_angle", "degrees",
     "with surface_tension: between solids and interfaces, through the first phase of two, the heavier one "
     "if there are "
     "more; or a list; 90 if not given"},
    {"fluid.contact_angle[].between", "", "two phases"},
    {"fluid.contact_angle[].between[]", "", "a phase"},
    {"fluid.contact_angle[].value", "degrees",
     "contact angle of the interface between them, through the one that is named first"},
    {"fluid.capillary_cfl", "",
     "largest time step over sqrt((sum of the densities) h^3/surface tension), h^2 twice the least area of "
     "the "
     "interface's elements; 0.4 if not given; large: no limit"},
    {"fluid.gravity_cfl", "",
     "largest time step over sqrt(h (sum of the densities)/(pi g difference)), of the shortest waves of the "
     "interface's elements, h^2 twice their area; 0.5 if not given; large: no limit"},
    {"fluid.regions", "",
     "where the phases are at the start, the first one everywhere, later ones over earlier ones; solids hold "
     "the lightest"},
    {"fluid.regions[].phase", "", "which phase; without a shape: everywhere"},
    {"fluid.regions[].lower", "m", "lower left corner of a box"},
    {"fluid.regions[].upper", "m", "upper right corner of the box"},
    {"fluid.regions[].centre", "m", "centre of a disc"},
    {"fluid.regions[].radius", "m", "its radius"},
    {"fluid.regions[].point", "m", "a point on the edge of a half plane"},
    {"fluid.regions[].normal", "", "direction out of the half plane"},
    {"fluid.regions[].polygon", "", "corners of a polygon that does not cross itself"},
    {"fluid.regions[].polygon[]", "m", "a corner"},
    {"fluid.boundaries.*.phase", "",
     "phase of what flows in, above a level where there is one; the lightest if none is given"},
    {"fluid.boundaries.*.fractions", "", "of phases in what flows in, in place of phase; their sum is 1"},
    {"fluid.boundaries.*.fractions[].phase", "", "a phase"},
    {"fluid.boundaries.*.fractions[].value", "", "its fraction"},
    {"fluid.boundaries.*.wall", "", "a wall with further keys, in place of the word alone"},
    {"fluid.boundaries.*.contact_angle", "degrees",
     "between the boundary and interfaces, through the first phase of two, the heavier one if there are "
     "more; or a "
     "list; 90 if not given"},
    {"fluid.boundaries.*.contact_angle[].between", "", "two phases"},
    {"fluid.boundaries.*.contact_angle[].between[]", "", "a phase"},
    {"fluid.boundaries.*.contact_angle[].value", "degrees",
     "contact angle of the interface between them, through the one that is named first"},
    {"fluid.theta", "",
     "0.5 Crank-Nicolson ... 1 backward Euler; by default 0.5, with surface tension 1; the first four steps "
     "have 1 where the velocity does "
     "not begin as boundaries prescribe it"},
    {"fluid.petsc", "", "options for PETSc's solvers: -momentum_ksp_monitor"},
    {"fluid.initial.velocity", "m/s", "everywhere at the start; without it the fluid is at rest"},
    {"fluid.absorption", "", "zones in which waves are absorbed"},
    {"fluid.absorption[].from", "m", "a point where it begins, with rate 0"},
    {"fluid.absorption[].to", "m",
     "a point from which on it has its whole rate; in between the rate rises with the square of the way"},
    {"fluid.absorption[].rate", "1/s", "with which the fluid is drawn to the velocity"},
    {"fluid.absorption[].velocity", "m/s", "to which; at rest if not given"},
    {"fluid.absorption[].phase", "", "the phase that is drawn; all of the fluid if not given"},
    {"fluid.mesh.file", "", "a Gmsh mesh, instead of a box; a relative path starts at the case file"},
    {"fluid.mesh.lower", "m", "lower left corner of a box"},
    {"fluid.mesh.upper", "m", "upper right corner of the box"},
    {"fluid.mesh.corners", "m", "of a polygon, instead of a box, in either sense"},
    {"fluid.mesh.corners[]", "m", "x and y"},
    {"fluid.mesh.sides", "",
     "names of the polygon's sides, the first from the first corner to the second; absent: all are called "
     "boundary"},
    {"fluid.mesh.sides[]", "", "several may have one name"},
    {"fluid.mesh.size_max", "m",
     "largest edge of the box's cells; of a polygon about the edge of its triangles"},
    {"fluid.mesh.growth", "", "how fast cells grow with the distance from a refined box, m a metre"},
    {"fluid.mesh.refine", "",
     "boxes with smaller cells; fluid.adapt makes its meshes, the first one too, by its own sizes"},
    {"fluid.mesh.refine[].lower", "m", "lower left corner of a refined box"},
    {"fluid.mesh.refine[].upper", "m", "upper right corner of a refined box"},
    {"fluid.mesh.refine[].size", "m", "edge of the cells in it"},
    {"fluid.boundaries.*", "",
     "what holds on the mesh's boundary of this name; a box has left, right, bottom, top, a polygon the "
     "names of its sides"},
    {"fluid.boundaries.*.velocity", "m/s", "prescribed velocity; in the middle, of a parabolic profile"},
    {"fluid.boundaries.*.profile", "",
     "of the velocity along the boundary; or rows of place and factor, linear between them"},
    {"fluid.boundaries.*.profile[]", "m, 1",
     "x, or y if the boundary is higher than wide, and a factor; constant before the first and after the "
     "last"},
    {"fluid.boundaries.*.rise", "s",
     "time in which the velocity, or the pressure, rises from zero, as 1 - cos(pi t/rise)"},
    {"fluid.boundaries.*.period", "s",
     "of a velocity or pressure that swings, times sin(2 pi t/period), or in which the rows of factor or of "
     "the level repeat themselves"},
    {"fluid.boundaries.*.factor", "",
     "list of rows of time and factor of the velocity or pressure, linear between them"},
    {"fluid.boundaries.*.factor[]", "s, 1", "time, factor"},
    {"fluid.boundaries.*.pressure", "Pa", "an open boundary with this pressure"},
    {"fluid.boundaries.*.level", "m",
     "an open boundary outside of which the heaviest phase stands up to this height against gravity; or rows "
     "of time and height, linear between them; or a list of layers"},
    {"fluid.boundaries.*.level[]", "s, m", "time, height; constant before the first and after the last"},
    {"fluid.boundaries.*.level[].phase", "", "phase of a layer outside, from below"},
    {"fluid.boundaries.*.level[].height", "m",
     "height of its upper side, or rows of time and height; above the last: the lightest phase"},
    {"fluid.boundaries.*.level[].height[]", "s, m", "time, height"},
    {"fluid.adapt.size_min", "m", "le: shortest edge wanted; that around the solid"},
    {"fluid.adapt.size_max", "m", "Le: longest edge wanted"},
    {"fluid.adapt.velocity_error", "m/s", "wanted error of linear interpolation, each component"},
    {"fluid.adapt.corner_size", "m",
     "edge wanted at corners of solids, from size_min/1000 to size_min; size_min if not given"},
    {"fluid.adapt.interface_size", "m",
     "edge wanted at the interface between phases, from size_min to size_max; size_min if not given"},
    {"fluid.adapt.light_velocity_error", "m/s", "wanted error in the lighter phase; 0: as coarse as may be"},
    {"fluid.adapt.growth", "", "largest ratio of an edge to the next"},
    {"fluid.adapt.anisotropy", "", "largest ratio of edges wanted in a place"},
    {"fluid.adapt.elements_max", "", "most triangles of a mesh"},
    {"fluid.adapt.every", "steps",
     "from one mesh to the next, or sooner when the solid is about to leave its fine mesh"},
    {"fluid.probes", "", "list of points, lines and pressure gauges whose values are in fluid_probes.csv"},
    {"fluid.probes[].name", "", "leads the names of its columns"},
    {"fluid.probes[].point", "m", "a point of the fluid, also on its boundary"},
    {"fluid.probes[].line.from", "m", "first point of a line"},
    {"fluid.probes[].line.to", "m", "its last point"},
    {"fluid.probes[].line.points", "", "number of points on it, evenly spaced"},
    {"fluid.probes[].surface.from", "m", "where the segment of a free-surface gauge begins"},
    {"fluid.probes[].surface.to", "m", "where it ends"},
    {"fluid.probes[].surface.phase", "",
     "the phase whose places along the segment are recorded: where it first ends, its last point, and how "
     "much of the segment it has; of a wave, along a line that rises from the water, last is the top of the "
     "water, drops included (clouds of less than a hundredth of an element not), and first is lower where "
     "there is air beneath"},
    {"fluid.probes[].flow.from", "m", "where a segment begins through which the flow is recorded"},
    {"fluid.probes[].flow.to", "m",
     "where it ends; flow to the right as one goes there is positive: along x through a segment that goes "
     "upwards"},
    {"fluid.probes[].flow.phase", "", "the phase whose volume flows; if not given all that does"},
    {"fluid.probes[].phase", "", "a phase: its area, centre, velocity and the length of its interface"},
    {"fluid.probes[].distance", "m",
     "from the solid's face to where the gauge's pressure is taken; by default fluid.adapt.size_min, "
     "required without fluid.adapt"},
    {NULL, NULL, NULL}};

/* Measured on one rank (`peak_memory_mb`), from 41 000 to 190 000 triangles: of tests/coupled/disc.yaml and of phases,
 * cases/dam_break; on one mesh, and where meshes follow each other. */
#define MB_PROGRAM 50.0
static const double MB_TRIANGLE[2][2] = {{0.0044, 0.0075}, {0.0049, 0.0104}}; /* [phases][adapts] */

static void Expect(const Mesh *m, PetscBool phases, PetscBool adapts, const AdaptationSetup *s)
{
  double shortest = HUGE_VAL, longest = 0.0;
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      const double *a = m->x + 2 * m->vertex[3 * e + i], *b = m->x + 2 * m->vertex[3 * e + (i + 1) % 3];
      shortest = fmin(shortest, hypot(a[0] - b[0], a[1] - b[1]));
      longest = fmax(longest, hypot(a[0] - b[0], a[1] - b[1]));
    }
  printf("fluid: %smesh of %lld triangles in [%g, %g] x [%g, %g] m, edges from %.3g to %.3g m\n",
         adapts ? "starts from a " : "", (long long)m->nglobal, m->lower[0], m->upper[0], m->lower[1],
         m->upper[1], shortest, longest);
  if (adapts)
    printf("fluid: adapted every %d steps, edges from %g to %g m, at most %.0f triangles\n", s->every,
           s->corner_size, s->size_max, s->elements_max);
  const double most = adapts ? fmax(s->elements_max, (double)m->nglobal) : (double)m->nglobal;
  printf("fluid: memory about %.0f MB%s\n", MB_PROGRAM + MB_TRIANGLE[phases][adapts] * most,
         adapts ? ", if it reaches fluid.adapt.elements_max" : "");
}

/* The rate rises from `from` to `to`: where `to` is outside, it is nowhere what was asked for. */
static void NoteAbsorption(const Mesh *m, const Absorption *a)
{
  for (int k = 0; k < a->n; k++)
    for (int c = 0; c < 2; c++) {
      const double *to = a->zone[k].to, least = 1e-9 * (m->upper[c] - m->lower[c]);
      if (to[c] >= m->lower[c] - least && to[c] <= m->upper[c] + least) continue;
      printf(
          "note: fluid.absorption[%d].to, (%g, %g), lies outside of the domain: its rate is nowhere %g 1/s\n",
          k, to[0], to[1], a->zone[k].rate);
      break;
    }
}

static PetscErrorCode CheckBudget(CoracleCase c, const Mesh *m, const AdaptationSetup *s)
{
  double least;
  PetscFunctionBeginUser;
  PetscCall(AdaptationLeastCount(s, m, &least));
  if (least > s->elements_max)
    CoracleCaseRefuse(c, "fluid.adapt.elements_max",
                      "edges of fluid.adapt.size_max, %g m, alone take %.0f triangles", s->size_max, least);
  PetscFunctionReturn(0);
}

static PetscErrorCode Draw(CoracleCase c, Mesh *mesh, const FluidSetup *setup, int nregions,
                           const Region region[])
{
  Fluid fluid;
  Writer writer;
  PetscFunctionBeginUser;
  PetscCall(FluidCreate(mesh, setup, &fluid));
  if (setup->phases.n) PetscCall(FluidSetPhases(fluid, nregions, region));
  PetscCall(FluidSetInitial(fluid, 0.0, NULL, NULL, NULL));
  PetscCall(WriterCreate(c, fluid, NULL, &writer));
  PetscCall(WriterDestroy(&writer));
  PetscCall(FluidDestroy(&fluid));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReadCase(CoracleCase c, Command command)
{
  static const char *const SECTIONS[] = {"fluid", NULL};
  Mesh *mesh;
  RunCase run;
  FluidSetup setup;
  AdaptationSetup adaptation;
  Probes probes;
  PetscBool adapts;
  Region *region;
  int nregions;
  PetscFunctionBeginUser;
  RunCaseDescribe(c, KEYS);
  (void)CoracleCaseStringOr(c, "fluid.petsc", "");
  RunCaseRead(c, &run);
  PetscCall(FluidCaseMesh(c, PETSC_COMM_SELF, NULL, &mesh, NULL));
  PetscCall(FluidCaseSetup(c, mesh, &setup));
  PetscCall(FluidCaseRegions(c, &nregions, &region));
  PetscCall(FluidCaseAdaptation(c, &setup, &adapts, &adaptation));
  PetscCall(ProbesCreate(c, mesh, &probes));
  PetscCall(ProbesDestroy(&probes));
  PetscCall(CoracleCaseFinish(c, SECTIONS));
  if (command != COMMAND_KEYS && CoracleCaseFaultless(c)) {
    if (adapts) PetscCall(CheckBudget(c, mesh, &adaptation));
    Expect(mesh, (PetscBool)(setup.phases.n > 0), adapts, &adaptation);
    NoteBoundaries(mesh, &setup);
    NoteRegions(&setup, nregions, region);
    NoteOutside(mesh, &setup, nregions, region);
    NoteAbsent(mesh, &setup, nregions, region);
    NoteGases(mesh, &setup);
    NoteLightest(&setup);
    NoteAbsorption(mesh, &setup.absorption);
  }
  if (command == COMMAND_DRAW && CoracleCaseFaultless(c)) PetscCall(Draw(c, mesh, &setup, nregions, region));
  PetscCall(FluidCaseFreeRegions(nregions, &region));
  PetscCall(PetscFree(setup.boundary));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

static void Read(CoracleCase c, void *command)
{
  const PetscErrorCode failed = ReadCase(c, *(const Command *)command);
  if (failed) CoracleCaseRefuse(c, "fluid", "the mesh cannot be made (error %d of PETSc)", failed);
}

int FluidAnswer(Command command, int argc, char **argv)
{
  static const CommandAnswers ANSWERS = {"fluid", "", Read};
  return ProgramAnswer(command, &ANSWERS, argc, argv);
}
