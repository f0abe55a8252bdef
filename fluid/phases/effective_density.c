/* Distances of the vertices from the lines around them, and the effective densities that follow. */
#include "common/space/p1.h"
#include "common/supermesh/geometry.h"
#include "fluid/phases/phases_impl.h"

/* What is known of a vertex: the weighted sum of its distances from the lines around, and what they cannot be. */
typedef struct {
  double sum, weight;
  char below, above; /* an element around it lies below the line; above it */
} VertexDistance;

/* A line shorter than this, over the root of the element's area, cuts off no more than a corner, where it has to be if advection has
 * left a trace of a phase there: it says little of where the interface is. */
#define CORNER 0.01
/* The least barycentric coordinate of a line's middle that counts. */
#define LEAST 1e-6
/* Beside a solid, of what it leaves of an element: less of a phase may be a film along the surface. */
#define FILM 0.01

/* Line k of cut element e as point v sees it.  The weight is the integral along the line of the barycentric coordinate of the element's vertex `corner`: with it,
 * vertices' distances have the volumes of the lines, sum of weight times distance. */
static void AddLine(Phases f, int e, int k, int corner, const double v[2], VertexDistance *sum)
{
  const double(*x)[2] = (const double(*)[2])f->stars->element[e].x;
  HalfPlane h;
  const PolygonCut cut = PhasesSegment(f, e, k, x[0], &h);
  const double middle[2] = {x[0][0] + h.d * h.n[0] - cut.middle * h.n[1],
                            x[0][1] + h.d * h.n[1] + cut.middle * h.n[0]};
  double lambda[3];
  GeometryBarycentric(x, middle, lambda);
  const double trace = cut.length * cut.length / (CORNER * CORNER * StarsArea(f->stars, e));
  const double weight = cut.length * fmax(lambda[corner], LEAST) * fmin(1.0, trace);
  sum->sum += weight * (h.n[0] * (v[0] - x[0][0]) + h.n[1] * (v[1] - x[0][1]) - h.d);
  sum->weight += weight;
}

/* The lines k of the elements around `vertex` that have no solid, as point v sees them. */
static void AddLinesAround(Phases f, int k, int vertex, const double v[2], VertexDistance *sum)
{
  const Stars *s = f->stars;
  for (int j = s->start[vertex]; j < s->start[vertex + 1]; j++) {
    const int e = s->around[j] / 3;
    if (PhasesHasLine(f, e, k) && PhasesOpen(f, e) == 1.0) AddLine(f, e, k, s->around[j] % 3, v, sum);
  }
}

/* Of a vertex in or at a solid, without such elements around it, the lines around its neighbours. */
static void AddLinesNear(Phases f, int k, int vertex, VertexDistance *sum)
{
  const Stars *s = f->stars;
  for (int j = s->start[vertex]; j < s->start[vertex + 1]; j++) {
    const int *corner = s->vertex[s->around[j] / 3];
    for (int i = 0; i < 3; i++)
      if (corner[i] != vertex) AddLinesAround(f, k, corner[i], s->point[vertex], sum);
  }
}

/* Line k of cut element e is a trace's: a corner's, and the lines around leave its vertices, at distances d, on one side. */
static int IsTrace(Phases f, int e, int k, const double d[3])
{
  HalfPlane h;
  if (fmin(d[0], fmin(d[1], d[2])) < 0.0 && fmax(d[0], fmax(d[1], d[2])) > 0.0) return 0;
  return PhasesSegment(f, e, k, f->stars->element[e].x[0], &h).length < CORNER * sqrt(StarsArea(f->stars, e));
}

/* PhasesSide of what a solid leaves of element e; 0, too, where that is little. */
static int SideBeside(Phases f, int e, int line)
{
  const double area = StarsArea(f->stars, e);
  double below = 0.0;
  if (PhasesOpen(f, e) < PHASES_LEAST_OPEN) return 0;
  for (int p = 0; p <= line; p++) below += PhasesVolumeBeside(f, e, p);
  return below > (1.0 - FILM) * area ? -1 : below < FILM * area ? 1 : 0;
}

double PhasesDistance(Phases f, int line, int v, double *inside)
{
  const Stars *s = f->stars;
  VertexDistance d = {0};
  int at_solid = 0;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3, has_solid = PhasesOpen(f, e) < 1.0,
              side = has_solid ? SideBeside(f, e, line) : PhasesSide(f, e, line);
    d.below |= side < 0;
    d.above |= side > 0;
    at_solid |= has_solid;
  }
  AddLinesAround(f, line, v, s->point[v], &d);
  if (at_solid && !(d.weight > 0.0)) AddLinesNear(f, line, v, &d);
  double distance = d.weight > 0.0 ? d.sum / d.weight : 0.0;
  if (d.below) distance = fmin(distance, 0.0);
  if (d.above) distance = fmax(distance, 0.0);
  *inside = distance != 0.0 ? distance < 0.0 : d.below == d.above ? 0.5 : d.below;
  return distance;
}

/* The density of element e: of what is beside a solid in it, where that is enough. */
static double DensityOf(Phases f, int e, const double rho[])
{
  const double area = StarsArea(f->stars, e), *v = &f->volume[(size_t)e * (size_t)f->np];
  const int beside = PhasesOpen(f, e) < 1.0 && PhasesOpen(f, e) >= PHASES_LEAST_OPEN;
  double density = 0.0;
  for (int p = 0; p < f->np; p++) density += rho[p] * (beside ? PhasesVolumeBeside(f, e, p) : v[p]) / area;
  return density;
}

/* distance[np - 1][nowned] */
static void Element(Phases f, int e, const double distance[], const double rho[], const double gravity[2],
                    InverseDensity *inverse)
{
  const double mean = DensityOf(f, e, rho);
  DensityLine line[PHASES_MAX - 1];
  double grad[3][2];
  int n = 0;
  (void)P1Gradients((const double(*)[2])f->stars->element[e].x, grad);
  for (int k = 0; k + 1 < f->np; k++) {
    if (!PhasesHasLine(f, e, k)) continue;
    const double *d = distance + (size_t)k * (size_t)f->stars->nowned;
    line[n] = (DensityLine){.rho = {rho[k], rho[PhasesBehind(f, e, k)]}};
    for (int i = 0; i < 3; i++) line[n].d[i] = d[f->stars->vertex[e][i]];
    n += !IsTrace(f, e, k, line[n].d);
  }
  if (n)
    InverseDensityCut((const double(*)[2])grad, n, line, mean, gravity, inverse);
  else
    InverseDensityUniform(mean, gravity, inverse);
  if (n == 1 && PhasesOpen(f, e) == 1.0) InverseDensityAddSurplus(&line[0], mean, gravity, inverse);
}

PetscErrorCode PhasesGetInverseDensity(Phases f, const double rho[], const double gravity[2],
                                       InverseDensity inverse[])
{
  const Stars *s = f->stars;
  double *distance, inside;
  PetscFunctionBeginUser;
  PetscCheck(f->has_lines, s->mesh->comm, PETSC_ERR_ORDER,
             "effective densities need the lines: call PhasesReconstruct");
  PetscCall(PetscMalloc1((size_t)(f->np - 1) * (size_t)s->nowned, &distance));
  for (int k = 0; k + 1 < f->np; k++)
    for (int v = 0; v < s->nowned; v++) distance[k * s->nowned + v] = PhasesDistance(f, k, v, &inside);
  for (int e = 0; e < s->ne; e++) {
    const double *density = f->mass ? &f->density[(size_t)e * (size_t)f->np] : rho;
    if (f->single[e] < 0)
      Element(f, e, distance, density, gravity, &inverse[e]);
    else
      InverseDensityUniform(density[f->single[e]], gravity, &inverse[e]);
  }
  PetscCall(PetscFree(distance));
  PetscFunctionReturn(0);
}
