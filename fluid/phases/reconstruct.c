/* Lines in cut elements, one phase after the other: line p is fitted to what lines 0 .. p - 1 leave in the
 * element and around it, so that layers and T-junctions of straight interfaces are found as well.
 *
 * Of a phase of which the element K and those around it hold less than |K|, a fragment, the elements around may say nothing (PlicIsBlind).
 * Its line would be at the same corner of K in each step, wherever the fragment has got to.  It is spread: what a face sweeps of K holds
 * V_p/|K| of each phase p.  So is what round-off has left (PHASES_DUST: less of a phase in K and around it has no
 * surface, also where a line fits, which at a wall any does), and the inside of a cloud of fragments, where all elements around are cut,
 * which no line does.  Beside a solid lines stay: what its surface cuts has slivers of phases that are at rest. */
#include "fluid/phases/phases_impl.h"

static double *VolumeOf(Phases f, int e)
{
  return &f->volume[(size_t)e * (size_t)f->np];
}

static HalfPlane *LineOf(Phases f, int e, int p)
{
  return &f->line[(size_t)e * (size_t)(f->np - 1) + (size_t)p];
}

/* The phase that has an element to itself, -1 if several share it. */
static int SingleOf(Phases f, int e)
{
  const double *v = VolumeOf(f, e), tiny = PHASES_TINY * StarsArea(f->stars, e);
  int found = -1;
  for (int p = 0; p < f->np; p++) {
    if (v[p] < tiny) continue;
    if (found >= 0) return -1;
    found = p;
  }
  return found;
}

static void SetCell(Phases f, int e, int p, const double origin[2], PlicCell *cell)
{
  const double(*x)[2] = (const double(*)[2])f->stars->element[e].x;
  cell->area = StarsArea(f->stars, e);
  for (int c = 0; c < 2; c++) cell->center[c] = (x[0][c] + x[1][c] + x[2][c]) / 3.0 - origin[c];
  if (f->single[e] >= 0) { /* phases before p leave nothing, or all */
    const int gone = f->single[e] < p;
    cell->part.n = 0;
    if (!gone) PolygonTriangle(x, origin, &cell->part);
    cell->rest = gone ? 0.0 : cell->area;
    cell->volume = f->single[e] == p ? cell->area : 0.0;
    return;
  }
  PhasesRest(f, e, p, origin, &cell->part);
  cell->rest = PolygonArea(&cell->part);
  cell->volume = VolumeOf(f, e)[p];
}

/* The elements that share a vertex with e, and e. */
static int ListAround(const Stars *s, int e, int list[PLIC_CELLS])
{
  int n = 1;
  list[0] = e;
  for (int i = 0; i < 3; i++) n = StarsAddAround(s, s->vertex[e][i], n, PLIC_CELLS, list);
  return n;
}

/* Owned element e and those around it that earlier phases leave something of; around an element without a solid as if what solids cover were
 * like what they leave. */
static int Gather(Phases f, int e, int p, PlicCell cell[PLIC_CELLS])
{
  const Stars *s = f->stars;
  const double *origin = s->element[e].x[0];
  const int beside = PhasesOpen(f, e) == 1.0;
  int around[PLIC_CELLS], n = 1;
  const int m = ListAround(s, e, around);
  SetCell(f, e, p, origin, &cell[0]);
  for (int k = 1; k < m; k++) {
    const int j = around[k];
    if (beside && PhasesOpen(f, j) < PHASES_LEAST_OPEN) continue;
    SetCell(f, j, p, origin, &cell[n]);
    if (beside && PhasesOpen(f, j) < 1.0) cell[n].volume = fmin(cell[n].rest, PhasesVolumeBeside(f, j, p));
    if (cell[n].rest > PHASES_TINY * cell[n].area) n++;
  }
  return n;
}

/* What owned element e and those around it hold of its phase of which they hold second most, over |K|; HUGE_VAL beside a solid. */
static double SecondAround(Phases f, int e)
{
  const double area = StarsArea(f->stars, e);
  double sum[PHASES_MAX] = {0.0}, first = 0.0, second = 0.0;
  int list[PLIC_CELLS];
  const int n = ListAround(f->stars, e, list);
  for (int k = 0; k < n; k++) {
    if (PhasesOpen(f, list[k]) < 1.0) return HUGE_VAL;
    for (int p = 0; p < f->np; p++) sum[p] += VolumeOf(f, list[k])[p];
  }
  for (int p = 0; p < f->np; p++) {
    if (VolumeOf(f, e)[p] < PHASES_TINY * area) continue;
    second = fmax(second, fmin(sum[p], first));
    first = fmax(first, sum[p]);
  }
  return second / area;
}

int PhasesHasFragments(Phases f, int e)
{
  return SecondAround(f, e) < 1.0;
}

/* Whether none of the elements around e has a phase to itself. */
static int AllAreCut(Phases f, int e)
{
  int list[PLIC_CELLS];
  const int n = ListAround(f->stars, e, list);
  for (int k = 0; k < n; k++)
    if (f->single[list[k]] >= 0) return 0;
  return 1;
}

/* A line that keeps the volume, for the phases behind, where p has no place. */
static HalfPlane AnyLine(Phases f, int e, int p)
{
  HalfPlane line = {{1.0, 0.0}, 0.0};
  PlicCell cell;
  SetCell(f, e, p, f->stars->element[e].x[0], &cell);
  line.d = PolygonFindOffset(&cell.part, line.n, cell.volume);
  return line;
}

static HalfPlane FitLine(Phases f, int e, int p, PlicCell cell[])
{
  const double area = StarsArea(f->stars, e), *v = VolumeOf(f, e);
  double behind = 0.0; /* what is left for the phases behind */
  for (int k = p + 1; k < f->np; k++) behind += v[k];
  if (v[p] < PHASES_TINY * area) return (HalfPlane){{0.0, 0.0}, -1.0};
  if (behind < PHASES_TINY * area) return (HalfPlane){{0.0, 0.0}, 1.0};
  const double second = SecondAround(f, e);
  if (second < PHASES_DUST || (second < 1.0 && AllAreCut(f, e))) {
    f->spread[e] = 1;
    return AnyLine(f, e, p);
  }
  const int n = Gather(f, e, p, cell);
  if (cell[0].rest < PHASES_TINY * area)
    return (HalfPlane){{0.0, 0.0}, -1.0}; /* those before it have left no place */
  const HalfPlane line = PlicFit(n, cell);
  if (second < 1.0) f->spread[e] |= PlicIsBlind(n, cell, &line);
  return line;
}

PetscErrorCode PhasesReconstruct(Phases f)
{
  const Stars *s = f->stars;
  PlicCell *cell;
  PetscFunctionBeginUser;
  PetscCall(StarsExchange(s, (size_t)f->np * sizeof *f->volume, f->volume));
  for (int e = 0; e < s->nl; e++) f->single[e] = SingleOf(f, e);
  PetscCall(PetscArrayzero(f->spread, s->nl));
  PetscCall(PhasesUpdateDensities(f));
  PetscCall(PetscMalloc1(PLIC_CELLS, &cell));
  for (int p = 0; p + 1 < f->np; p++) {
    for (int e = 0; e < s->ne; e++) {
      if (f->single[e] < 0) *LineOf(f, e, p) = FitLine(f, e, p, cell);
    }
    PetscCall(StarsExchange(s, (size_t)(f->np - 1) * sizeof *f->line, f->line));
  }
  PetscCall(PetscFree(cell));
  PetscCall(StarsExchange(s, sizeof *f->spread, f->spread));
  f->has_lines = PETSC_TRUE;
  PetscFunctionReturn(0);
}
