#include "coupler/region.h"
#include "common/supermesh/geometry.h"
#include "coupler/geometry/shell.h"
#include <limits.h>

PetscErrorCode RegionCreate(MPI_Comm comm, double thickness, Region *region)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(region));
  (*region)->comm = comm;
  (*region)->thickness = thickness;
  PetscFunctionReturn(0);
}

/* Boxes as {-lower, upper}, so that one MPI_MAX joins them over the ranks. */
static PetscErrorCode JoinBoxes(MPI_Comm comm, int n, GeometryBox box[])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) {
    for (int c = 0; c < 2; c++) box[k].lower[c] *= -1.0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, box, 4 * n, MPI_DOUBLE, MPI_MAX, comm));
  for (int k = 0; k < n; k++) {
    for (int c = 0; c < 2; c++) box[k].lower[c] *= -1.0;
  }
  PetscFunctionReturn(0);
}

/* Grows the box of the cluster whose grid cell contains the simplex's centre. */
static void AddSimplex(const GeometryBox *whole, int side, int n, const int node[], const double x[],
                       GeometryBox cluster[])
{
  int cell[2];
  for (int c = 0; c < 2; c++) {
    const double extent = whole->upper[c] - whole->lower[c];
    double centre = 0.0;
    for (int i = 0; i < n; i++) centre += x[2 * node[i] + c] / n;
    cell[c] = extent > 0.0 ? (int)(side * (centre - whole->lower[c]) / extent) : 0;
    cell[c] = PetscMin(PetscMax(cell[c], 0), side - 1);
  }
  for (int i = 0; i < n; i++) GeometryBoxGrow(&cluster[cell[0] + side * cell[1]], &x[2 * node[i]]);
}

/* Cells of the grid along each side. */
static PetscErrorCode Side(Region r, const SolidState *solid, int *side)
{
  long long facets = solid->nfacets;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &facets, 1, MPI_LONG_LONG, MPI_SUM, r->comm));
  *side = (int)PetscMin(PetscMax(sqrt((double)facets / REGION_FACETS), REGION_SIDE_MIN), REGION_SIDE_MAX);
  PetscFunctionReturn(0);
}

/* cluster[n]; those of empty cells are empty. */
static PetscErrorCode Clusters(Region r, const SolidState *solid, int *n, GeometryBox cluster[REGION_BOXES])
{
  GeometryBox whole = GeometryBoxEmpty();
  int side = 0;

  PetscFunctionBeginUser;
  PetscCall(Side(r, solid, &side));
  *n = side * side;
  for (int i = 0; i < solid->nnodes; i++) GeometryBoxGrow(&whole, &solid->x[2 * i]);
  PetscCall(JoinBoxes(r->comm, 1, &whole));
  for (int k = 0; k < *n; k++) cluster[k] = GeometryBoxEmpty();
  for (int t = 0; t < solid->nelements; t++)
    AddSimplex(&whole, side, 3, &solid->element[3 * t], solid->x, cluster);
  for (int e = 0; e < solid->nfacets; e++)
    AddSimplex(&whole, side, 2, &solid->facet[2 * e], solid->x, cluster);
  PetscCall(JoinBoxes(r->comm, *n, cluster));
  PetscFunctionReturn(0);
}

/* The way of the fastest node in REGION_STEPS steps. */
static PetscErrorCode Reach(Region r, const SolidState *solid, double dt, double *reach)
{
  double speed = 0.0;

  PetscFunctionBeginUser;
  for (int i = 0; i < solid->nnodes; i++) speed = fmax(speed, hypot(solid->u[2 * i], solid->u[2 * i + 1]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &speed, 1, MPI_DOUBLE, MPI_MAX, r->comm));
  *reach = REGION_STEPS * dt * speed;
  PetscFunctionReturn(0);
}

PetscErrorCode RegionUpdate(Region r, const SolidState *solid, double dt)
{
  GeometryBox cluster[REGION_BOXES];
  double area = 0.0, reach = 0.0;
  int n;

  PetscFunctionBeginUser;
  PetscCall(Clusters(r, solid, &n, cluster));
  PetscCall(Reach(r, solid, dt, &reach));
  r->nbox = 0;
  for (int k = 0; k < n; k++) {
    if (cluster[k].lower[0] > cluster[k].upper[0]) continue;
    area += (cluster[k].upper[0] - cluster[k].lower[0]) * (cluster[k].upper[1] - cluster[k].lower[1]);
    PetscCall(PetscArraycpy(r->box[r->nbox][0], cluster[k].lower, 2));
    PetscCall(PetscArraycpy(r->box[r->nbox++][1], cluster[k].upper, 2));
  }
  r->margin = PetscMax(PetscMin(reach, 0.2 * sqrt(area)), PetscMax(reach / REGION_STEPS, 8.0 * r->thickness));
  for (int k = 0; k < r->nbox; k++) {
    for (int c = 0; c < 2; c++) {
      r->box[k][0][c] -= r->margin + SHELL_OFFSET_LIMIT * r->thickness;
      r->box[k][1][c] += r->margin + SHELL_OFFSET_LIMIT * r->thickness;
    }
  }
  PetscCall(PetscFree(r->x));
  PetscCall(PetscMalloc1(2 * (size_t)solid->nnodes, &r->x));
  PetscCall(PetscArraycpy(r->x, solid->x, 2 * (size_t)solid->nnodes));
  r->n = solid->nnodes;
  PetscFunctionReturn(0);
}

PetscErrorCode RegionStale(Region r, const SolidState *solid, double dt, PetscBool *stale)
{
  int local = solid->changed || solid->nnodes != r->n, any;

  PetscFunctionBeginUser;
  for (int i = 0; i < solid->nnodes && !local; i++) {
    double way[2];
    for (int c = 0; c < 2; c++)
      way[c] = solid->x[2 * i + c] + 0.5 * dt * solid->u[2 * i + c] - r->x[2 * i + c];
    local = !(hypot(way[0], way[1]) <= r->margin); /* NaN is stale, too */
  }
  PetscCallMPI(MPI_Allreduce(&local, &any, 1, MPI_INT, MPI_MAX, r->comm));
  *stale = any ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(0);
}

PetscErrorCode RegionOutside(Region r, const SolidState *solid, const FluidElements *elements, double margin,
                             long long *gid, int *local)
{
  struct {
    long value;
    int rank;
  } mine = {LONG_MAX, 0}, first;
  int found = -1;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(r->comm, &mine.rank));
  for (int i = 0; i < solid->nnodes; i++) {
    const double *x = &solid->x[2 * i];
    const int inside = x[0] >= elements->lower[0] - margin && x[0] <= elements->upper[0] + margin &&
                       x[1] >= elements->lower[1] - margin && x[1] <= elements->upper[1] + margin;
    if (inside || solid->gid[i] >= mine.value) continue;
    mine.value = (long)solid->gid[i];
    found = i;
  }
  PetscCallMPI(MPI_Allreduce(&mine, &first, 1, MPI_LONG_INT, MPI_MINLOC, r->comm));
  *gid = first.value == LONG_MAX ? -1 : first.value;
  *local = *gid >= 0 && first.rank == mine.rank ? found : -1;
  PetscFunctionReturn(0);
}

PetscErrorCode RegionDestroy(Region *region)
{
  PetscFunctionBeginUser;
  if (!*region) PetscFunctionReturn(0);
  PetscCall(PetscFree((*region)->x));
  PetscCall(PetscFree(*region));
  PetscFunctionReturn(0);
}
