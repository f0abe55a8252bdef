#include "coupler/uplift.h"
#include "coupler/surface_pressure.h"

/* Cosine of the angle between a close facet's normal and the wall's, at least. */
#define FACING 0.7
#define TOLERANCE 1e-10

struct Uplift_s {
  MPI_Comm comm;
  double lower[2], upper[2], gravity[2];
  Shell shell;      /* borrowed */
  SolidState solid; /* a copy */
};

/* Along the close facets: head and density beneath, 1 where they are connected with an end. */
enum {
  HEAD = SURFACE_HEAD,
  DENSITY = SURFACE_DENSITY,
  REACHED = SURFACE_REACHED,
  NFIELDS = SURFACE_HEAD_FIELDS
};
typedef double Fields[NFIELDS];

/* Of the step: close facets, and their nodes. */
typedef struct {
  char *is_close;         /* [nfacets] */
  char *is_end, *is_free; /* [nnodes] the fluid has access to the node; it is between ends */
  char *counts;           /* [nnodes] in sums on this rank */
  Fields *value;          /* [nnodes] */
} Beneath;

PetscErrorCode UpliftCreate(MPI_Comm comm, const double lower[2], const double upper[2],
                            const double gravity[2], Uplift *uplift)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(uplift));
  (*uplift)->comm = comm;
  PetscCall(PetscArraycpy((*uplift)->lower, lower, 2));
  PetscCall(PetscArraycpy((*uplift)->upper, upper, 2));
  PetscCall(PetscArraycpy((*uplift)->gravity, gravity, 2));
  PetscFunctionReturn(0);
}

PetscErrorCode UpliftDestroy(Uplift *uplift)
{
  PetscFunctionBeginUser;
  if (!*uplift) PetscFunctionReturn(0);
  PetscCall(SolidStateDestroy(&(*uplift)->solid));
  PetscCall(PetscFree(*uplift));
  PetscFunctionReturn(0);
}

PetscErrorCode UpliftBuild(Uplift u, const SolidState *solid, const Shell shell)
{
  PetscFunctionBeginUser;
  PetscCall(SolidStateCopy(solid, &u->solid));
  u->shell = shell;
  PetscFunctionReturn(0);
}

static double Along(const double gravity[2], const double x[2])
{
  return gravity[0] * x[0] + gravity[1] * x[1];
}

/* --- which facets are close to a wall --------------------------------------------------------------------- */

/* Whether facet f faces a wall nearer than UPLIFT_REACH of size[nnodes]; NULL: of `largest`. */
static PetscBool IsClose(const Uplift u, int f, const double size[], double largest)
{
  const int *node = &u->solid.facet[2 * f];
  const double *n = u->shell->normal[f];
  for (int c = 0; c < 2; c++) {
    if (fabs(n[c]) < FACING) continue;
    const double wall = n[c] > 0.0 ? u->upper[c] : u->lower[c];
    PetscBool within = PETSC_TRUE;
    for (int i = 0; i < 2; i++)
      if (fabs(wall - u->solid.x[2 * node[i] + c]) > UPLIFT_REACH * (size ? size[node[i]] : largest))
        within = PETSC_FALSE;
    if (within) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* *may: some facet may be close, as far as the largest element at the solid says: most solids are not, at no cost. */
static PetscErrorCode MayBeClose(const Uplift u, const Overlap o, PetscBool *may)
{
  double largest = 0.0;
  int close = 0;

  PetscFunctionBeginUser;
  for (int e = 0; e < o->ncoupled; e++) largest = fmax(largest, sqrt(2.0 * o->area[o->coupled_element[e]]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, u->comm));
  for (int f = 0; f < u->solid.nfacets && !close; f++) close = IsClose(u, f, NULL, largest);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &close, 1, MPI_INT, MPI_LOR, u->comm));
  *may = close ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* The ends are nodes of close facets and of others whose shell the fluid covers, where the values of `outside` are; *any: some facet of any
 * rank is close.  size[nnodes]: of the elements, m. */
static PetscErrorCode FindClose(Uplift u, Overlap o, const double size[], const Fields outside[], Beneath *b,
                                PetscBool *any)
{
  const int n = u->solid.nnodes;
  double(*facets)[2]; /* close ones of the node, and others, on any rank */
  PetscMPIInt rank;
  int close = 0;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(u->comm, &rank));
  PetscCall(PetscCalloc1(n, &facets));
  for (int f = 0; f < u->solid.nfacets; f++) {
    b->is_close[f] = (char)IsClose(u, f, size, 0.0);
    close |= b->is_close[f];
    for (int i = 0; i < 2; i++) facets[u->solid.facet[2 * f + i]][!b->is_close[f]] += 1.0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &close, 1, MPI_INT, MPI_LOR, u->comm));
  *any = close ? PETSC_TRUE : PETSC_FALSE;
  if (close) PetscCall(CopiesSum(o->nodes, 2, (double *)facets));
  for (int i = 0; i < n; i++) {
    b->counts[i] = CopiesOwner(o->nodes, i) == rank;
    b->is_end[i] = facets[i][0] > 0.0 && facets[i][1] > 0.0 && outside[i][REACHED] > 0.0;
    b->is_free[i] = facets[i][0] > 0.0 && !b->is_end[i];
    for (int c = 0; c < NFIELDS; c++) b->value[i][c] = b->is_end[i] ? outside[i][c] : 0.0;
  }
  PetscCall(PetscFree(facets));
  PetscFunctionReturn(0);
}

/* --- linear between the ends ------------------------------------------------------------------------------ */

/* image = sum over the close facets of (v_a - v_b)/length at free nodes, of all ranks. */
static PetscErrorCode Apply(Uplift u, Overlap o, const Beneath *b, const Fields v[], Fields image[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(image, u->solid.nnodes));
  for (int f = 0; f < u->solid.nfacets; f++) {
    const int p = u->solid.facet[2 * f], q = u->solid.facet[2 * f + 1];
    if (!b->is_close[f] || u->shell->length[f] == 0.0) continue;
    for (int c = 0; c < NFIELDS; c++) {
      const double flux = (v[p][c] - v[q][c]) / u->shell->length[f];
      image[p][c] += flux;
      image[q][c] -= flux;
    }
  }
  PetscCall(CopiesSum(o->nodes, NFIELDS, (double *)image));
  for (int i = 0; i < u->solid.nnodes; i++)
    for (int c = 0; c < NFIELDS && !b->is_free[i]; c++) image[i][c] = 0.0;
  PetscFunctionReturn(0);
}

static PetscErrorCode Dot(const Uplift u, const Beneath *b, const Fields v[], const Fields w[], double sum[])
{
  PetscFunctionBeginUser;
  for (int c = 0; c < NFIELDS; c++) sum[c] = 0.0;
  for (int i = 0; i < u->solid.nnodes; i++)
    for (int c = 0; c < NFIELDS && b->counts[i]; c++) sum[c] += v[i][c] * w[i][c];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, NFIELDS, MPI_DOUBLE, MPI_SUM, u->comm));
  PetscFunctionReturn(0);
}

/* Conjugate gradients: at most as many iterations as there are nodes between two ends. */
static PetscErrorCode Interpolate(Uplift u, Overlap o, Beneath *b)
{
  const int n = u->solid.nnodes;
  Fields *r, *d, *image;
  double rr[NFIELDS], next[NFIELDS], first[NFIELDS], dd[NFIELDS];
  int max_iterations = 1;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(n, &r, n, &d, n, &image));
  for (int i = 0; i < n; i++) max_iterations += b->is_free[i] && b->counts[i];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &max_iterations, 1, MPI_INT, MPI_SUM, u->comm));
  PetscCall(Apply(u, o, b, (const Fields *)b->value, r));
  for (int i = 0; i < n; i++)
    for (int c = 0; c < NFIELDS; c++) d[i][c] = r[i][c] = -r[i][c];
  PetscCall(Dot(u, b, (const Fields *)r, (const Fields *)r, first));
  PetscCall(PetscArraycpy(rr, first, NFIELDS));
  for (int k = 0; k < max_iterations; k++) {
    PetscBool more = PETSC_FALSE;
    for (int c = 0; c < NFIELDS; c++) more |= rr[c] > TOLERANCE * TOLERANCE * first[c];
    if (!more) break;
    PetscCall(Apply(u, o, b, (const Fields *)d, image));
    PetscCall(Dot(u, b, (const Fields *)d, (const Fields *)image, dd));
    for (int i = 0; i < n; i++)
      for (int c = 0; c < NFIELDS && b->is_free[i]; c++) {
        const double step = dd[c] > 0.0 ? rr[c] / dd[c] : 0.0;
        b->value[i][c] += step * d[i][c];
        r[i][c] -= step * image[i][c];
      }
    PetscCall(Dot(u, b, (const Fields *)r, (const Fields *)r, next));
    for (int i = 0; i < n; i++)
      for (int c = 0; c < NFIELDS; c++) d[i][c] = r[i][c] + (rr[c] > 0.0 ? next[c] / rr[c] : 0.0) * d[i][c];
    PetscCall(PetscArraycpy(rr, next, NFIELDS));
  }
  PetscCall(PetscFree3(r, d, image));
  PetscFunctionReturn(0);
}

/* --- the force -------------------------------------------------------------------------------------------- */

/* force += int N_i excess n over the close facets; excess[nnodes], Pa. */
static void AddForce(const Uplift u, const Beneath *b, const double excess[], double force[], double total[2])
{
  for (int f = 0; f < u->solid.nfacets; f++)
    for (int i = 0; i < 2 && b->is_close[f]; i++) {
      const int *node = &u->solid.facet[2 * f];
      const double weight = u->shell->length[f] / 6.0 * (2.0 * excess[node[i]] + excess[node[1 - i]]);
      for (int c = 0; c < 2; c++) {
        force[2 * node[i] + c] += weight * u->shell->normal[f][c];
        total[c] += weight * u->shell->normal[f][c];
      }
    }
}

/* e of node i, with p inside the solid there; area: of the triangles around it, m2. */
static double Excess(const Uplift u, const Beneath *b, int i, double p, double area, double dt)
{
  const double *value = b->value[i], g = hypot(u->gravity[0], u->gravity[1]);
  if (value[REACHED] < 0.5 || area == 0.0 || u->solid.mobility[i] == 0.0) return 0.0;
  const double e = p - value[HEAD] - value[DENSITY] * Along(u->gravity, &u->solid.x[2 * i]),
               rho = 3.0 / (u->solid.mobility[i] * area), largest = dt * g * sqrt(2.0 * rho * fabs(e));
  return fmax(-largest, fmin(largest, e));
}

PetscErrorCode UpliftAdd(Uplift u, Overlap o, const ElementTerm element[], const double p[], double dt,
                         double force[], double total[2])
{
  const size_t n = (size_t)u->solid.nnodes;
  double *excess, *size, *area;
  Fields *outside;
  Beneath b;
  PetscBool any = PETSC_FALSE;

  PetscFunctionBeginUser;
  total[0] = total[1] = 0.0;
  PetscCall(MayBeClose(u, o, &any));
  if (!any) PetscFunctionReturn(0);
  PetscCall(PetscMalloc4(n, &excess, n, &size, n, &area, n, &outside));
  PetscCall(PetscMalloc5((size_t)u->solid.nfacets, &b.is_close, n, &b.is_end, n, &b.is_free, n, &b.counts, n,
                         &b.value));
  PetscCall(SurfacePressureInside(o, p, (int)n, excess, size, area));
  PetscCall(SurfacePressureHead(o, element, u->gravity, p, (int)n, outside));
  PetscCall(FindClose(u, o, size, (const Fields *)outside, &b, &any));
  if (any) {
    PetscCall(Interpolate(u, o, &b));
    for (int i = 0; i < (int)n; i++) excess[i] = Excess(u, &b, i, excess[i], area[i], dt);
    AddForce(u, &b, excess, force, total);
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, total, 2, MPI_DOUBLE, MPI_SUM, u->comm));
  }
  PetscCall(PetscFree5(b.is_close, b.is_end, b.is_free, b.counts, b.value));
  PetscCall(PetscFree4(excess, size, area, outside));
  PetscFunctionReturn(0);
}
