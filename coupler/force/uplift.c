#include "coupler/force/uplift.h"
#include "coupler/force/gap_head.h"
#include "coupler/force/squeeze_film.h"

/* Mean of the density times mean of its inverse of what is one fluid. */
#define ONE_FLUID 1.1

struct Uplift_s {
  MPI_Comm comm;
  double lower[2], upper[2];
  const double *gravity; /* [2] borrowed */
  Shell shell;           /* borrowed */
  SolidState solid;      /* a copy */
  ClosePoints points;
  PetscBool any;                                    /* points, on any rank */
  double (*film_load)[2], (*film_resistance)[2][2]; /* [nnodes] N, N s/m */
  PetscBool yields;                                 /* some film does, on any rank */
};

/* Along the surface: head, density, its inverse and viscosity, 1 where they are connected with a place where they are known. */
enum {
  HEAD = SURFACE_HEAD,
  DENSITY = SURFACE_DENSITY,
  SPECIFIC_VOLUME = SURFACE_SPECIFIC_VOLUME,
  VISCOSITY = SURFACE_VISCOSITY,
  REACHED = SURFACE_REACHED,
  NFIELDS = SURFACE_HEAD_FIELDS
};
typedef double Fields[NFIELDS];

/* Of the step, at the solid's nodes. */
typedef struct {
  char *is_free;   /* [nnodes] on the surface, between places where the fields are known */
  Fields *value;   /* [nnodes] */
  double *profile; /* [nnodes] of gap_head.h */
} Gap;

PetscErrorCode UpliftCreate(MPI_Comm comm, const double lower[2], const double upper[2],
                            const double gravity[2], Uplift *uplift)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(uplift));
  (*uplift)->comm = comm;
  PetscCall(PetscArraycpy((*uplift)->lower, lower, 2));
  PetscCall(PetscArraycpy((*uplift)->upper, upper, 2));
  (*uplift)->gravity = gravity;
  PetscFunctionReturn(0);
}

PetscErrorCode UpliftDestroy(Uplift *uplift)
{
  PetscFunctionBeginUser;
  if (!*uplift) PetscFunctionReturn(0);
  PetscCall(SolidStateDestroy(&(*uplift)->solid));
  PetscCall(ClosePointsDestroy(&(*uplift)->points));
  PetscCall(PetscFree2((*uplift)->film_load, (*uplift)->film_resistance));
  PetscCall(PetscFree(*uplift));
  PetscFunctionReturn(0);
}

static double Along(const double gravity[2], const double x[2])
{
  return gravity[0] * x[0] + gravity[1] * x[1];
}

/* --- which points are close ------------------------------------------------------------------------------- */

/* Points within reach of the largest element at the solid: most solids have none, and no more is done. */
PetscErrorCode UpliftBuild(Uplift u, const SolidState *solid, const Shell shell, const Overlap o)
{
  double largest = 0.0;
  int close;

  PetscFunctionBeginUser;
  PetscCall(SolidStateCopy(solid, &u->solid));
  u->shell = shell;
  for (int e = 0; e < o->ncoupled; e++) largest = fmax(largest, sqrt(2.0 * o->area[o->coupled_element[e]]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, u->comm));
  PetscCall(ClosePointsFind(&u->solid, u->shell, u->lower, u->upper, UPLIFT_REACH * largest, &u->points));
  close = u->points.n > 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &close, 1, MPI_INT, MPI_LOR, u->comm));
  u->any = close ? PETSC_TRUE : PETSC_FALSE;
  u->yields = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* field[nnodes] at p. */
static double At(const Uplift u, const ClosePoint *p, const double field[])
{
  const int *node = &u->solid.facet[2 * p->facet];
  return p->n[0] * field[node[0]] + p->n[1] * field[node[1]];
}

/* Of those the points within reach of the elements there; size[nnodes], m. */
static void KeepClose(Uplift u, const double size[])
{
  ClosePoints *points = &u->points;
  int n = 0;
  for (int k = 0; k < points->n; k++) {
    const ClosePoint *p = &points->point[k];
    if (p->gap <= UPLIFT_REACH * At(u, p, size)) points->point[n++] = *p;
  }
  points->n = n;
}

/* The fields are known in nodes of facets without close points, where the values of `outside` are. */
static PetscErrorCode FindKnown(Uplift u, Overlap o, const Fields outside[], Gap *gap)
{
  const int n = u->solid.nnodes;
  double(*facets)[2]; /* of the node, on any rank: all; with close points */
  char *is_close;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(n, &facets, u->solid.nfacets, &is_close));
  for (int k = 0; k < u->points.n; k++) is_close[u->points.point[k].facet] = 1;
  for (int k = 0; k < 2 * u->solid.nfacets; k++) {
    facets[u->solid.facet[k]][0] += 1.0;
    facets[u->solid.facet[k]][1] += is_close[k / 2];
  }
  PetscCall(CopiesSum(o->nodes, 2, (double *)facets));
  for (int i = 0; i < n; i++) {
    const PetscBool known = (PetscBool)(facets[i][1] < facets[i][0] && outside[i][REACHED] > 0.0);
    gap->is_free[i] = facets[i][0] > 0.0 && !known;
    for (int c = 0; c < NFIELDS; c++) gap->value[i][c] = known ? outside[i][c] : 0.0;
  }
  PetscCall(PetscFree2(facets, is_close));
  PetscFunctionReturn(0);
}

/* --- the force -------------------------------------------------------------------------------------------- */

/* How much of the excess at p is its facet's: all, half, or nothing where what is held meets what is free. */
static double Share(const ClosePoint *p)
{
  if (p->opposite == CLOSE_TO_WALL) return 1.0;
  return 0.5 * (1 + p->opposite_is_held - p->is_held);
}

/* force += int N_i e n over the close points, and the opposite to what is there; excess[nnodes], Pa, part[nnodes] of it where the gap is open,
 * size[nnodes], m; total: of this rank's walls. */
static PetscErrorCode AddForce(Uplift u, const double excess[], const double part[], const double size[],
                               double force[], double total[2])
{
  const ClosePoints *points = &u->points;
  double(*there)[2][2];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(ScatterArriving(points->scatter), &there));
  for (int k = 0; k < points->n; k++) {
    const ClosePoint *p = &points->point[k];
    const int *node = &u->solid.facet[2 * p->facet];
    const double least = p->gap < UPLIFT_CLOSED * At(u, p, size) ? UPLIFT_TAKEN : 0.0;
    double push = 0.0;
    for (int i = 0; i < 2; i++)
      push += Share(p) * p->weight * p->n[i] * fmax(part[node[i]], least) * excess[node[i]];
    for (int c = 0; c < 2; c++) {
      const double normal = u->shell->normal[p->facet][c];
      for (int i = 0; i < 2; i++) force[2 * node[i] + c] += push * p->n[i] * normal;
      if (p->opposite == CLOSE_TO_WALL) total[c] += push * normal;
      for (int i = 0; i < 2 && p->opposite != CLOSE_TO_WALL; i++)
        there[p->opposite][i][c] -= push * p->opposite_n[i] * normal;
    }
  }
  PetscCall(ClosePointsReverseAdd(points, &u->solid, 2, (const double *)there, force));
  PetscCall(PetscFree(there));
  PetscFunctionReturn(0);
}

/* What p, inside the solid at node i, has beyond the head; area: of the triangles around it, m2. */
static double Excess(const Uplift u, const Gap *gap, int i, double p, double area)
{
  const double *value = gap->value[i];
  if (value[REACHED] < 0.5 || area == 0.0) return 0.0;
  return p - value[HEAD] - value[DENSITY] * Along(u->gravity, &u->solid.x[2 * i]);
}

/* The part of the excess of node i that moves it by a step's fall. */
static double PartOfFall(const Uplift u, int i, double excess, double area, double dt)
{
  const double g = hypot(u->gravity[0], u->gravity[1]);
  if (excess == 0.0 || u->solid.mobility[i] == 0.0) return 1.0;
  const double rho = 3.0 / (u->solid.mobility[i] * area), largest = dt * g * sqrt(2.0 * rho * fabs(excess));
  return fmin(1.0, largest / fabs(excess));
}

/* The film at close point p; where the gap's ends are in different fluids none: the head between them is not known so well.
 * there[2][2]: the velocities of the nodes opposite, m/s; none at a wall. */
static SqueezeFilm FilmAt(const Uplift u, const ClosePoint *p, const Gap *gap, const double excess[],
                          const double there[2][2])
{
  const int *node = &u->solid.facet[2 * p->facet];
  const double *normal = u->shell->normal[p->facet];
  SqueezeFilm film = {.gap = p->gap, .excess = At(u, p, excess), .profile = At(u, p, gap->profile)};
  double volume = 0.0;
  for (int i = 0; i < 2; i++) {
    volume += p->n[i] * gap->value[node[i]][SPECIFIC_VOLUME];
    film.density += p->n[i] * gap->value[node[i]][DENSITY];
    film.viscosity += p->n[i] * gap->value[node[i]][VISCOSITY];
    for (int c = 0; c < 2; c++) film.closing += p->n[i] * normal[c] * u->solid.u[2 * node[i] + c];
    for (int c = 0; c < 2 && there; c++) film.closing -= p->opposite_n[i] * normal[c] * there[i][c];
  }
  if (film.density * volume > ONE_FLUID) film.excess = 0.0;
  return film;
}

/* Loads and resistances of the films at the close points; *any: there is a load on this rank. */
static PetscErrorCode SetFilm(Uplift u, const Gap *gap, const double excess[], double dt, int *any)
{
  const int n = u->solid.nnodes;
  double(*there)[2][2];

  PetscFunctionBeginUser;
  PetscCall(PetscFree2(u->film_load, u->film_resistance));
  /* one more: NULL says that no film yields, on all ranks, also where there are no nodes */
  PetscCall(PetscCalloc2(n + 1, &u->film_load, n + 1, &u->film_resistance));
  PetscCall(PetscMalloc1(ScatterArriving(u->points.scatter), &there));
  PetscCall(ClosePointsForward(&u->points, &u->solid, 2, u->solid.u, (double *)there));
  *any = 0;
  for (int k = 0; k < u->points.n; k++) {
    const ClosePoint *p = &u->points.point[k];
    const int *node = &u->solid.facet[2 * p->facet];
    const double *normal = u->shell->normal[p->facet];
    if (p->is_held) continue;
    const SqueezeFilm film = FilmAt(
        u, p, gap, excess, p->opposite == CLOSE_TO_WALL ? NULL : (const double(*)[2])there[p->opposite]);
    const SqueezeFilmYield yield = SqueezeFilmYieldOf(&film, dt);
    *any |= yield.load != 0.0;
    for (int i = 0; i < 2; i++)
      for (int c = 0; c < 2; c++) {
        const double part = p->weight * p->n[i], resistance = part * yield.resistance / Share(p);
        u->film_load[node[i]][c] += part * normal[c] * yield.load;
        u->film_resistance[node[i]][c][c] += SQUEEZE_FILM_ALONG * resistance;
        for (int d = 0; d < 2; d++)
          u->film_resistance[node[i]][c][d] +=
              (1.0 - SQUEEZE_FILM_ALONG) * resistance * normal[c] * normal[d];
      }
  }
  PetscCall(PetscFree(there));
  PetscFunctionReturn(0);
}

PetscErrorCode UpliftAdd(Uplift u, Overlap o, const double p[], double dt, double force[], double total[2])
{
  const size_t n = (size_t)u->solid.nnodes;
  double *excess, *part, *size, *area;
  Fields *outside;
  Gap gap;
  double sums[3] = {0.0, 0.0, 0.0}; /* the walls' force; ranks with a film that yields */
  int yields = 0;

  PetscFunctionBeginUser;
  total[0] = total[1] = 0.0;
  if (!u->any) PetscFunctionReturn(0);
  PetscCall(PetscMalloc5(n, &excess, n, &part, n, &size, n, &area, n, &outside));
  PetscCall(PetscMalloc3(n, &gap.is_free, n, &gap.value, n, &gap.profile));
  PetscCall(SurfacePressureInside(o, p, (int)n, excess, size, area));
  PetscCall(SurfacePressureHead(o, u->gravity, p, (int)n, outside));
  KeepClose(u, size);
  PetscCall(FindKnown(u, o, (const Fields *)outside, &gap));
  PetscCall(GapHeadSolve(&u->points, &u->solid, u->shell, o->nodes, gap.is_free, gap.value, gap.profile));
  for (int i = 0; i < (int)n; i++) excess[i] = Excess(u, &gap, i, excess[i], area[i]);
  PetscCall(SetFilm(u, &gap, excess, dt, &yields));
  for (int i = 0; i < (int)n; i++) part[i] = PartOfFall(u, i, excess[i], area[i], dt);
  PetscCall(AddForce(u, excess, part, size, force, sums));
  sums[2] = yields;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, u->comm));
  PetscCall(PetscArraycpy(total, sums, 2));
  u->yields = (PetscBool)(sums[2] > 0.0);
  PetscCall(PetscFree3(gap.is_free, gap.value, gap.profile));
  PetscCall(PetscFree5(excess, part, size, area, outside));
  PetscFunctionReturn(0);
}

void UpliftFilm(Uplift u, const double **load, const double **resistance)
{
  *load = u->yields ? (const double *)u->film_load : NULL;
  *resistance = u->yields ? (const double *)u->film_resistance : NULL;
}
