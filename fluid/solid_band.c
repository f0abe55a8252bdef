#include "fluid/solid_band.h"
#include "common/supermesh/search.h"
#include "fluid/fluid_impl.h"

/* Where a piece of the solid's surface is and where it will be at the next adaptation. */
typedef struct {
  double from[2], to[2];
} Sweep;

PetscErrorCode SolidBandSpeed(Fluid f, double *speed)
{
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(f->solid, &n);
  PetscFunctionBeginUser;
  *speed = 0.0;
  for (int k = 0; k < n; k++) {
    const double *u = entry[k].velocity;
    *speed = fmax(*speed, hypot(u[0], u[1]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, speed, 1, MPI_DOUBLE, MPI_MAX, f->domain.mesh->comm));
  PetscFunctionReturn(0);
}

/* This rank's part of the surface, and how far it goes until the next adaptation. */
static int LocalSweeps(Fluid f, double ahead, Sweep sweep[])
{
  int n = 0, nentries;
  const CoracleCoupling *entry = SolidCouplingEntries(f->solid, &nentries);
  for (int k = 0; k < nentries; k++) {
    const CoracleCoupling *coupling = entry + k;
    if (!(coupling->flags & CORACLE_HAS_SHELL)) continue;
    for (int c = 0; c < 2; c++) {
      double x = 0.0;
      for (int i = 0; i < 3; i++) x += ElementVertex(f->domain.mesh, coupling->element, i)[c] / 3.0;
      sweep[n].from[c] = x;
      sweep[n].to[c] = x + ahead * coupling->velocity[c];
    }
    n++;
  }
  return n;
}

/* The surface of all ranks; *all is allocated. */
static PetscErrorCode Sweeps(Fluid f, double ahead, int *n, Sweep **all)
{
  MPI_Comm comm = f->domain.mesh->comm;
  PetscMPIInt size, mine, *count, *first;
  Sweep *local;
  int nentries;
  PetscFunctionBeginUser;
  (void)SolidCouplingEntries(f->solid, &nentries);
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc3(nentries, &local, size, &count, size + 1, &first));
  mine = 4 * LocalSweeps(f, ahead, local);
  PetscCallMPI(MPI_Allgather(&mine, 1, MPI_INT, count, 1, MPI_INT, comm));
  first[0] = 0;
  for (int r = 0; r < size; r++) first[r + 1] = first[r] + count[r];
  *n = first[size] / 4;
  PetscCall(PetscMalloc1(*n, all));
  PetscCallMPI(MPI_Allgatherv(local, mine, MPI_DOUBLE, *all, count, first, MPI_DOUBLE, comm));
  PetscCall(PetscFree3(local, count, first));
  PetscFunctionReturn(0);
}

static double Distance(const Sweep *s, const double x[2])
{
  const double d[2] = {s->to[0] - s->from[0], s->to[1] - s->from[1]};
  const double r[2] = {x[0] - s->from[0], x[1] - s->from[1]};
  const double square = d[0] * d[0] + d[1] * d[1];
  const double k = square > 0.0 ? fmin(fmax((r[0] * d[0] + r[1] * d[1]) / square, 0.0), 1.0) : 0.0;
  return hypot(r[0] - k * d[0], r[1] - k * d[1]);
}

PetscErrorCode SolidBandSizes(Fluid f, const SolidBand *b, int nv, double size[])
{
  const double near = b->reach + 2.0 * SOLID_BAND * b->size_min;
  Sweep *sweep;
  GeometryBox *box;
  Search search;
  int n;
  PetscFunctionBeginUser;
  PetscCall(Sweeps(f, b->ahead, &n, &sweep));
  PetscCall(PetscMalloc1(n, &box));
  for (int k = 0; k < n; k++)
    for (int c = 0; c < 2; c++) {
      box[k].lower[c] = fmin(sweep[k].from[c], sweep[k].to[c]) - near;
      box[k].upper[c] = fmax(sweep[k].from[c], sweep[k].to[c]) + near;
    }
  PetscCheck(!SearchCreate(n, box, &search), PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for the surface");
  for (int v = 0; v < nv; v++) {
    const double *x = f->domain.mesh->x + 2 * v;
    const GeometryBox point = {{x[0], x[1]}, {x[0], x[1]}};
    const int *hit, nhit = SearchQuery(search, &point, &hit);
    size[v] = b->size_max;
    for (int h = 0; h < nhit; h++) {
      const double outside = fmax(Distance(sweep + hit[h], x) - SOLID_BAND * b->size_min, 0.0);
      size[v] = fmin(size[v], b->size_min + b->slope * outside);
    }
  }
  SearchDestroy(&search);
  PetscCall(PetscFree(box));
  PetscCall(PetscFree(sweep));
  PetscFunctionReturn(0);
}
