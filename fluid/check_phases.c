#include "fluid/check_phases.h"
#include "common/program/gravity.h"
#include "common/supermesh/geometry.h"
#include <stdio.h>

/* The lowest and the highest vertex, against gravity, m. */
static void Heights(const Mesh *m, const double gravity[2], double range[2])
{
  const double g = hypot(gravity[0], gravity[1]);
  range[0] = HUGE_VAL, range[1] = -HUGE_VAL;
  for (int v = 0; v < m->nv; v++) {
    const double height = 0.0 - (gravity[0] * m->x[2 * v] + gravity[1] * m->x[2 * v + 1]) / g;
    range[0] = fmin(range[0], height);
    range[1] = fmax(range[1], height);
  }
}

/* The lowest and the highest that layer k is, m. */
static void Levels(const BoundaryPhases *b, int k, double range[2])
{
  range[0] = range[1] = b->level_table[k].nrows ? TimeTableAt(&b->level_table[k], 0, 1) : b->level[k];
  for (int row = 1; row < b->level_table[k].nrows; row++) {
    range[0] = fmin(range[0], TimeTableAt(&b->level_table[k], row, 1));
    range[1] = fmax(range[1], TimeTableAt(&b->level_table[k], row, 1));
  }
}

/* Of layers the lowest is not to be above all, the highest not below. */
static void NoteLevel(const char *name, const BoundaryPhases *b, const double mesh[2])
{
  double low[2], high[2];
  if (!b->nlevels) return;
  Levels(b, 0, low);
  Levels(b, b->nlevels - 1, high);
  if (low[1] > mesh[1])
    printf("note: fluid.boundaries.%s: the level, %g m, is above the top of the fluid's domain, %g m\n", name,
           low[1], mesh[1]);
  if (high[0] < mesh[0])
    printf("note: fluid.boundaries.%s: the level, %g m, is below the bottom of the fluid's domain, %g m\n",
           name, high[0], mesh[0]);
}

/* Whether the velocity leads into the domain somewhere on the boundary, or does when it turns. */
static PetscBool FlowsIn(const Mesh *m, int tag, const Boundary *b)
{
  const PetscBool turns = (PetscBool)(b->period > 0.0 || b->factor.nrows > 0 || b->profile.nrows > 0);
  for (int k = 0; k < 3 * m->ne && b->kind == BOUNDARY_VELOCITY; k++) {
    if (m->tag[k] != tag) continue;
    const double *p = m->x + 2 * m->vertex[k / 3 * 3 + (k + 1) % 3],
                 *q = m->x + 2 * m->vertex[k / 3 * 3 + (k + 2) % 3];
    const double flux = b->velocity[0] * (q[1] - p[1]) - b->velocity[1] * (q[0] - p[0]);
    const double least = 1e-9 * hypot(b->velocity[0], b->velocity[1]) * hypot(q[0] - p[0], q[1] - p[1]);
    if ((turns ? -fabs(flux) : flux) < -least) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

void NoteBoundaries(const Mesh *m, const FluidSetup *setup)
{
  const PhaseProperties *phases = &setup->phases;
  double heights[2];
  if (!phases->n) return;
  Heights(m, setup->gravity, heights);
  for (int b = 0; b < m->ntags; b++) {
    const Boundary *boundary = &setup->boundary[b];
    double inflow = 0.0;
    for (int p = 0; p < phases->n; p++) inflow += boundary->phases.inflow[p];
    NoteLevel(m->tag_name[b], &boundary->phases, heights);
    if (inflow == 0.0 && FlowsIn(m, b, boundary))
      printf("note: fluid.boundaries.%s: what flows in is %s, the lightest phase: neither phase nor "
             "fractions are given\n",
             m->tag_name[b], phases->name[PhaseLightest(phases)]);
  }
}

void NoteRegions(const FluidSetup *setup, int nregions, const Region region[])
{
  const double *g = setup->gravity;
  for (int k = 0; k < nregions; k++) {
    const Region *r = &region[k];
    if (r->shape != REGION_HALF_PLANE || r->phase == PhaseLightest(&setup->phases) ||
        r->b[0] * g[0] + r->b[1] * g[1] <= 0.0)
      continue;
    printf("note: fluid.regions[%d]: the half plane of %s lies above its edge: its normal, (%g, %g), which "
           "leads out "
           "of it, points down\n",
           k, setup->phases.name[r->phase], r->b[0], r->b[1]);
  }
}

/* The smallest box around a region; of a half plane the mesh's, empty if none of its corners is in it. */
static GeometryBox BoxOf(const Mesh *m, const Region *r)
{
  GeometryBox box = GeometryBoxEmpty();
  if (r->shape == REGION_BOX) {
    GeometryBoxGrow(&box, r->a);
    GeometryBoxGrow(&box, r->b);
  }
  for (int k = 0; r->shape == REGION_POLYGON && k < r->n; k++) GeometryBoxGrow(&box, r->x[k]);
  for (int k = 0; k < 4; k++) {
    const double disc[2] = {r->a[0] + (k % 2 ? r->radius : -r->radius),
                            r->a[1] + (k / 2 ? r->radius : -r->radius)},
                 corner[2] = {k % 2 ? m->upper[0] : m->lower[0], k / 2 ? m->upper[1] : m->lower[1]};
    if (r->shape == REGION_DISC) GeometryBoxGrow(&box, disc);
    if (r->shape != REGION_HALF_PLANE ||
        (corner[0] - r->a[0]) * r->b[0] + (corner[1] - r->a[1]) * r->b[1] >= 0.0)
      continue;
    GeometryBoxGrow(&box, m->lower);
    GeometryBoxGrow(&box, m->upper);
  }
  return box;
}

void NoteOutside(const Mesh *m, const FluidSetup *setup, int nregions, const Region region[])
{
  for (int k = 0; k < nregions; k++) {
    const GeometryBox box = BoxOf(m, &region[k]);
    if (box.lower[0] < m->upper[0] && box.upper[0] > m->lower[0] && box.lower[1] < m->upper[1] &&
        box.upper[1] > m->lower[1])
      continue;
    printf("note: fluid.regions[%d], of %s, lies outside of the domain, [%g, %g] x [%g, %g] m\n", k,
           setup->phases.name[region[k].phase], m->lower[0], m->upper[0], m->lower[1], m->upper[1]);
  }
}

static PetscBool ComesIn(const Mesh *m, const FluidSetup *setup, int phase)
{
  for (int b = 0; b < m->ntags; b++) {
    const BoundaryPhases *at = &setup->boundary[b].phases;
    if (at->inflow[phase] > 0.0) return PETSC_TRUE;
    for (int k = 0; k < at->nlevels; k++)
      if (at->level_phase[k] == phase) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

void NoteAbsent(const Mesh *m, const FluidSetup *setup, int nregions, const Region region[])
{
  const PhaseProperties *phases = &setup->phases;
  for (int p = 0; p < phases->n; p++) {
    PetscBool there = (PetscBool)(p == PhaseLightest(phases) || ComesIn(m, setup, p));
    for (int k = 0; k < nregions; k++) there = (PetscBool)(there || region[k].phase == p);
    if (!there)
      printf(
          "note: fluid.phases: there is no %s: it is in none of fluid.regions and comes in at no boundary\n",
          phases->name[p]);
  }
}

void NoteGases(const Mesh *m, const FluidSetup *setup)
{
  const PhaseProperties *phases = &setup->phases;
  const double g = GravityLargest(setup->gravity, &setup->gravity_table);
  double heights[2], heaviest = 0.0;
  if (g == 0.0) return;
  if (hypot(setup->gravity[0], setup->gravity[1]) > 0.0)
    Heights(m, setup->gravity, heights);
  else
    heights[0] = 0.0, heights[1] = hypot(m->upper[0] - m->lower[0], m->upper[1] - m->lower[1]);
  for (int p = 0; p < phases->n; p++) heaviest = fmax(heaviest, phases->rho[p]);
  const double weight = heaviest * g * (heights[1] - heights[0]);
  for (int p = 0; p < phases->n; p++) {
    const double pressure = phases->state[p].pressure + phases->initial_pressure[p];
    if (phases->state[p].pressure == 0.0 || pressure >= weight) continue;
    printf("note: fluid.phases: %s has an absolute pressure of %.3g Pa at the start, and what the domain may "
           "hold above it weighs up to %.3g Pa: caught beneath it is compressed to less than half\n",
           phases->name[p], pressure, weight);
  }
}

void NoteLightest(const FluidSetup *setup)
{
  const PhaseProperties *phases = &setup->phases;
  const int lightest = phases->n ? PhaseLightest(phases) : 0;
  for (int p = lightest + 1; p < phases->n; p++)
    if (phases->rho[p] == phases->rho[lightest])
      printf("note: fluid.phases: %s and %s have the same density, the least: %s counts as the lightest "
             "phase, which fills solids and "
             "comes in through open boundaries where no phase is given; give the other a little more\n",
             phases->name[lightest], phases->name[p], phases->name[lightest]);
}
