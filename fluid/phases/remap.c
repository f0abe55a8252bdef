/* The polygons of each phase, intersected with the elements of another mesh. */
#include "common/transfer/transfer_parts.h"
#include "fluid/phases/phases_impl.h"

#define MASS_TINY 1e-9 /* of an element's area: a volume that says nothing of where its mass is */

/* An old element's phases on their way. */
typedef struct {
  int single;
  double area;
  double volume[PHASES_MAX];
  double defect
      [PHASES_MAX]; /* volume less that of the polygon, over the element's area; all of what is spread */
  double mass[PHASES_MAX];
  HalfPlane line[PHASES_MAX - 1];
} Load;

static void SetLoad(Phases f, int e, Load *load)
{
  const double(*x)[2] = (const double(*)[2])f->stars->element[e].x;
  Polygon whole;
  double area[PHASES_MAX] = {0.0};
  const HalfPlane *line = &f->line[(size_t)e * (size_t)(f->np - 1)];
  *load = (Load){.single = f->spread[e] ? 0 : f->single[e], .area = StarsArea(f->stars, e)};
  PolygonTriangle(x, x[0], &whole);
  PhasesSplitBy(f->np, load->single, line, x[0], &whole, x[0], 1.0, area);
  for (int p = 0; p < f->np; p++) {
    load->volume[p] = f->volume[(size_t)e * (size_t)f->np + (size_t)p];
    load->defect[p] = (load->volume[p] - area[p]) / load->area;
    if (f->mass) load->mass[p] = f->mass[(size_t)e * (size_t)f->np + (size_t)p];
  }
  for (int p = 0; p + 1 < f->np; p++) load->line[p] = line[p];
}

/* mass[np] += by the share of each phase's volume in `common`, or, of what has hardly any volume, by its share of the element. */
static void TakeMasses(const Polygon *common, const double origin[2], const double part[3][2],
                       const Load *load, int np, double mass[])
{
  const double area = PolygonArea(common);
  double taken[PHASES_MAX] = {0.0};
  PhasesSplitBy(np, load->single, load->line, part[0], common, origin, 1.0, taken);
  for (int p = 0; p < np; p++) {
    const double volume = load->volume[p];
    mass[p] += load->mass[p] * (volume > MASS_TINY * load->area ? (taken[p] + load->defect[p] * area) / volume
                                                                : area / load->area);
  }
}

/* volume[np], mass[np] += what the element takes of an old one; mass may be NULL */
static void Take(const double element[3][2], const double part[3][2], const Load *load, int np,
                 double volume[], double mass[])
{
  Polygon whole, old, common;
  PolygonTriangle(element, element[0], &whole);
  PolygonTriangle(part, element[0], &old);
  PolygonClipTriangle(&whole, (const double(*)[2])old.x, &common);
  if (!common.n) return;
  const double area = PolygonArea(&common);
  PhasesSplitBy(np, load->single, load->line, part[0], &common, element[0], 1.0, volume);
  for (int p = 0; p < np; p++) volume[p] += load->defect[p] * area;
  if (mass) TakeMasses(&common, element[0], part, load, np, mass);
}

static PetscErrorCode TakeAll(const TransferParts *parts, const Load load[], Phases to)
{
  PetscFunctionBeginUser;
  for (int k = 0; k < parts->nchanged; k++) {
    double *volume = &to->volume[(size_t)parts->changed[k] * (size_t)to->np];
    const GeometryBox box = GeometryBoxOf(parts->element[k]);
    const int *hit, nhit = SearchQuery(parts->search, &box, &hit);
    PetscCheck(nhit >= 0, PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory to search %d elements", parts->nparts);
    double *mass = to->mass ? &to->mass[(size_t)parts->changed[k] * (size_t)to->np] : NULL;
    for (int p = 0; p < to->np; p++) volume[p] = 0.0;
    for (int p = 0; p < to->np && mass; p++) mass[p] = 0.0;
    for (int h = 0; h < nhit; h++)
      Take(parts->element[k], parts->part[hit[h]], &load[hit[h]], to->np, volume, mass);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode PhasesRemap(Phases from, Transfer transfer, Phases to)
{
  TransferParts parts;
  Load *source, *copy, *load;
  PetscFunctionBeginUser;
  PetscCheck(from->has_lines, from->stars->mesh->comm, PETSC_ERR_ORDER,
             "PhasesRemap needs the lines of the old mesh: call PhasesReconstruct before it");
  PetscCheck(from->np == to->np, from->stars->mesh->comm, PETSC_ERR_ARG_INCOMP, "%d phases and %d", from->np,
             to->np);
  PetscCall(TransferGetParts(transfer, &parts));
  PetscCall(PetscMalloc3(from->stars->ne, &source, parts.ncopies, &copy, parts.nparts, &load));
  for (int e = 0; e < from->stars->ne; e++) SetLoad(from, e, &source[e]);
  PetscCall(TransferSendParts(transfer, sizeof *source, source, copy, load));
  for (int k = 0; k < parts.ncopies; k++) {
    double *volume = &to->volume[(size_t)TransferCopyTarget(transfer, k) * (size_t)to->np];
    double *mass = to->mass ? &to->mass[(size_t)TransferCopyTarget(transfer, k) * (size_t)to->np] : NULL;
    for (int p = 0; p < to->np; p++) volume[p] = copy[k].volume[p];
    for (int p = 0; p < to->np && mass; p++) mass[p] = copy[k].mass[p];
  }
  PetscCall(TakeAll(&parts, load, to));
  PetscCall(PetscFree3(source, copy, load));
  to->has_lines = PETSC_FALSE;
  PetscFunctionReturn(0);
}
