#include "fluid/phases/phases_impl.h"

PetscErrorCode PhasesCreate(const Stars *stars, int np, Phases *phases)
{
  Phases f;
  PetscFunctionBeginUser;
  PetscCheck(np >= 2 && np <= PHASES_MAX, stars->mesh->comm, PETSC_ERR_ARG_OUTOFRANGE,
             "%d phases: from 2 to %d are possible", np, PHASES_MAX);
  PetscCall(PetscNew(&f));
  f->stars = stars;
  f->np = np;
  PetscCall(PetscCalloc1((size_t)stars->nl * (size_t)np, &f->volume));
  PetscCall(PetscCalloc1((size_t)stars->nl * (size_t)(np - 1), &f->line));
  PetscCall(PetscCalloc1(stars->nl, &f->single));
  PetscCall(PetscCalloc1(stars->nl, &f->spread));
  *phases = f;
  PetscFunctionReturn(0);
}

PetscErrorCode PhasesDestroy(Phases *phases)
{
  Phases f = *phases;
  PetscFunctionBeginUser;
  if (!f) PetscFunctionReturn(0);
  PetscCall(PetscFree(f->volume));
  PetscCall(PetscFree(f->line));
  PetscCall(PetscFree(f->single));
  PetscCall(PetscFree(f->spread));
  PetscCall(PetscFree(f->state));
  PetscCall(PetscFree(f->mass));
  PetscCall(PetscFree(f->density));
  PetscCall(PetscFree(f->solid));
  PetscCall(PetscFree(*phases));
  PetscFunctionReturn(0);
}

void PhasesSetAdvection(Phases f, PhasesAdvection advection)
{
  f->advection = advection;
}

PetscErrorCode PhasesSetVolumes(Phases f, const double volume[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(f->volume, volume, (size_t)f->stars->ne * (size_t)f->np));
  f->has_lines = PETSC_FALSE;
  PetscFunctionReturn(0);
}

PetscErrorCode PhasesSetSolid(Phases f, int filler, const double solid[])
{
  PetscFunctionBeginUser;
  if (!f->solid) PetscCall(PetscMalloc1(f->stars->nl + 1, &f->solid));
  f->filler = filler;
  for (int e = 0; e < f->stars->ne; e++)
    f->solid[e] = solid[e] < PHASES_LEAST_SOLID ? 0.0 : fmin(solid[e], 1.0);
  PetscCall(StarsExchange(f->stars, sizeof *f->solid, f->solid));
  PetscFunctionReturn(0);
}

const double *PhasesSolid(Phases f)
{
  return f->solid;
}

PetscErrorCode PhasesGetVolumes(Phases f, const double *volume[])
{
  PetscFunctionBeginUser;
  *volume = f->volume;
  PetscFunctionReturn(0);
}

int PhasesSingle(Phases f, int e)
{
  return f->single[e];
}

PetscBool PhasesEndAt(Phases f, int e)
{
  const int single = f->single[e];
  if (single < 0 || PhasesOpen(f, e) < 1.0) return PETSC_FALSE;
  for (int i = 0; i < 3; i++) {
    const int o = f->stars->neighbor[e][i];
    if (o >= 0 && f->single[o] > single && PhasesOpen(f, o) == 1.0) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

int PhasesSpread(Phases f, int e)
{
  return f->spread[e];
}

static int IsTrivial(const HalfPlane *h)
{
  return h->n[0] == 0.0 && h->n[1] == 0.0;
}

/* *out = in without what the line takes, or what the line takes of it. */
static void Keep(const Polygon *in, const HalfPlane *line, int taken, Polygon *out)
{
  if (IsTrivial(line)) {
    if ((line->d >= 0.0) == (taken != 0))
      *out = *in;
    else
      out->n = 0;
    return;
  }
  const HalfPlane h = taken ? *line : HalfPlaneOther(line);
  PolygonClip(in, &h, out);
}

void PhasesRest(Phases f, int e, int p, const double origin[2], Polygon *rest)
{
  Polygon before;
  PolygonTriangle((const double(*)[2])f->stars->element[e].x, origin, rest);
  for (int k = 0; k < p; k++) {
    const HalfPlane h = PhasesLine(f, e, k, origin);
    before = *rest;
    Keep(&before, &h, 0, rest);
  }
}

void PhasesPart(Phases f, int e, int p, const double origin[2], Polygon *part)
{
  Polygon rest;
  if (f->single[e] >= 0 && f->single[e] != p) {
    part->n = 0;
    return;
  }
  if (f->single[e] == p) {
    PolygonTriangle((const double(*)[2])f->stars->element[e].x, origin, part);
    return;
  }
  if (p == f->np - 1) {
    PhasesRest(f, e, p, origin, part);
    return;
  }
  PhasesRest(f, e, p, origin, &rest);
  const HalfPlane h = PhasesLine(f, e, p, origin);
  Keep(&rest, &h, 1, part);
}

PetscErrorCode PhasesGetPolygon(Phases f, int e, int p, Polygon *polygon)
{
  const double *x = f->stars->element[e].x[0];
  PetscFunctionBeginUser;
  PetscCheck(e >= 0 && e < f->stars->ne && p >= 0 && p < f->np, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
             "phase %d of element %d: there are %d and %d", p, e, f->np, f->stars->ne);
  PhasesPart(f, e, p, x, polygon);
  for (int k = 0; k < polygon->n; k++) {
    for (int c = 0; c < 2; c++) polygon->x[k][c] += x[c];
  }
  PetscFunctionReturn(0);
}

/* What phase p of local element e has of where it is: all, of the element its share if it is spread. */
static double Share(Phases f, int e, int p)
{
  return f->spread[e] ? f->volume[(size_t)e * (size_t)f->np + (size_t)p] / StarsArea(f->stars, e) : 1.0;
}

PetscErrorCode PhasesGetExtent(Phases f, int e, int p, Polygon *polygon, double *share)
{
  static const double ORIGIN[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  *share = Share(f, e, p);
  if (f->spread[e])
    PolygonTriangle((const double(*)[2])f->stars->element[e].x, ORIGIN, polygon);
  else
    PetscCall(PhasesGetPolygon(f, e, p, polygon));
  PetscFunctionReturn(0);
}

/* The phase that local element e has to itself, that has most of it where others are spread, or -1. */
static int Alone(Phases f, int e)
{
  const double *v = &f->volume[(size_t)e * (size_t)f->np];
  int most = 0;
  if (!f->spread[e]) return f->single[e];
  for (int p = 1; p < f->np; p++)
    if (v[p] > v[most]) most = p;
  return most;
}

int PhasesOnly(Phases f, int e)
{
  const double tiny = PHASES_TINY * StarsArea(f->stars, e), *v = &f->volume[(size_t)e * (size_t)f->np];
  int found = Alone(f, e);
  if (found >= 0 || !f->first) return found;
  for (int p = f->first; p < f->np; p++) {
    if (v[p] < tiny) continue;
    if (found >= 0) return -1;
    found = p;
  }
  return found;
}

int PhasesSide(Phases f, int e, int k)
{
  const int p = Alone(f, e);
  if (p >= 0) return p == k ? -1 : p > k;
  if (PhasesHasLine(f, e, k)) return 0;
  const double tiny = PHASES_TINY * StarsArea(f->stars, e), *v = &f->volume[(size_t)e * (size_t)f->np];
  int first = f->first, last = f->np - 1;
  while (v[first] < tiny) first++;
  while (v[last] < tiny) last--;
  return last == k ? -1 : first > k;
}

PolygonCut PhasesSegment(Phases f, int e, int k, const double origin[2], HalfPlane *line)
{
  Polygon rest;
  *line = PhasesLine(f, e, k, origin);
  PhasesRest(f, e, k, origin, &rest);
  return PolygonCutBy(&rest, 0.0, line);
}

/* The next phase behind p of which element e has at least `least`, m2, or -1. */
static int NextBehind(Phases f, int e, int p, double least)
{
  for (p++; p < f->np; p++)
    if (f->volume[(size_t)e * (size_t)f->np + (size_t)p] >= least) return p;
  return -1;
}

int PhasesBehind(Phases f, int e, int p)
{
  const double area = StarsArea(f->stars, e);
  int behind = NextBehind(f, e, p, PHASES_DUST * area);
  if (behind < 0) behind = NextBehind(f, e, p, PHASES_TINY * area);
  return behind < 0 ? f->np - 1 : behind;
}

void PhasesSplitBy(int np, int single, const HalfPlane line[], const double x0[2], const Polygon *polygon,
                   const double origin[2], double weight, double area[])
{
  if (single >= 0) {
    area[single] += weight * PolygonArea(polygon);
    return;
  }
  Polygon rest = *polygon, part;
  for (int p = 0; p + 1 < np && rest.n; p++) {
    const HalfPlane h = PhasesMoveLine(line[p], x0, origin);
    const Polygon before = rest;
    Keep(&before, &h, 1, &part);
    Keep(&before, &h, 0, &rest);
    if (part.n) area[p] += weight * PolygonArea(&part);
  }
  if (rest.n) area[np - 1] += weight * PolygonArea(&rest);
}

void PhasesSplit(Phases f, int e, const Polygon *polygon, const double origin[2], double weight,
                 double area[])
{
  if (f->spread[e]) {
    const double *volume = &f->volume[(size_t)e * (size_t)f->np];
    const double share = weight * PolygonArea(polygon) / StarsArea(f->stars, e);
    for (int p = 0; p < f->np; p++) area[p] += share * volume[p];
    return;
  }
  PhasesSplitBy(f->np, f->single[e], &f->line[(size_t)e * (size_t)(f->np - 1)], f->stars->element[e].x[0],
                polygon, origin, weight, area);
}

PetscErrorCode PhasesAdvect(Phases f, double dt, const double flux[], const double velocity[],
                            const PhasesInflow *inflow, double swept[], double swept_mass[])
{
  const size_t n = 3 * (size_t)f->stars->ne * (size_t)f->np;
  const PhasesInflow *open = inflow && inflow->fraction ? inflow : NULL;
  double *own = NULL, *mass = f->mass ? swept_mass : NULL;
  PetscFunctionBeginUser;
  PetscCheck(f->has_lines, f->stars->mesh->comm, PETSC_ERR_ORDER,
             "PhasesAdvect needs the lines of the present volumes: call PhasesReconstruct before it");
  if (!swept) PetscCall(PetscMalloc1(n, &own));
  f->has_lines = PETSC_FALSE;
  if (f->advection == PHASES_COMPRESSIVE)
    PetscCall(CompressiveAdvect(f, dt, flux, velocity, open, swept ? swept : own, mass));
  else
    PetscCall(GeometricAdvect(f, dt, flux, velocity, open, swept ? swept : own, mass));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(0);
}

PetscErrorCode PhasesGetStats(Phases f, PhasesStats *stats)
{
  const Stars *s = f->stars;
  double sum[PHASES_MAX + 1] = {0.0}, top[4] = {-HUGE_VAL, -HUGE_VAL, 0.0, f->courant};
  PetscFunctionBeginUser;
  for (int e = 0; e < s->ne; e++) {
    const double area = StarsArea(s, e), *v = &f->volume[(size_t)e * (size_t)f->np];
    double all = 0.0;
    for (int p = 0; p < f->np; p++) {
      sum[p] += v[p];
      all += v[p];
      top[0] = PetscMax(top[0], -v[p] / area);
      top[1] = PetscMax(top[1], v[p] / area);
    }
    top[2] = PetscMax(top[2], fabs(all - area) / area);
    sum[PHASES_MAX] += f->has_lines && f->single[e] < 0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, PHASES_MAX + 1, MPI_DOUBLE, MPI_SUM, s->mesh->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, top, 4, MPI_DOUBLE, MPI_MAX, s->mesh->comm));
  *stats = (PhasesStats){.lowest = -top[0],
                         .highest = top[1],
                         .gap = top[2],
                         .cut = (PetscInt)sum[PHASES_MAX],
                         .courant = top[3]};
  for (int p = 0; p < f->np; p++) stats->volume[p] = sum[p];
  PetscFunctionReturn(0);
}
