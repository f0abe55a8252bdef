/* Distances of the vertices from the interface between two phases, and the effective densities that follow. */
#include "fluid/phases/phases_impl.h"

/* What is known of a vertex: the weighted sum of its distances from the lines around, and what they cannot be. */
typedef struct {
  double sum, weight;
  char below, above; /* an element around it is of the first phase alone; of the second */
} VertexDistance;

/* The line of cut element e as seen from local vertex v: its length there is the weight. */
static void AddLine(Phases f, int e, int v, VertexDistance *d)
{
  const double *origin = f->stars->element[e].x[0];
  const HalfPlane h = PhasesLine(f, e, 0, origin);
  Polygon whole;
  if (h.n[0] == 0.0 && h.n[1] == 0.0) return;
  PolygonTriangle((const double(*)[2])f->stars->element[e].x, origin, &whole);
  const double length = PolygonCutBy(&whole, 0.5 * StarsTwiceArea(f->stars, e), &h).length;
  const double *x = f->stars->point[v];
  d->sum += length * (h.n[0] * (x[0] - origin[0]) + h.n[1] * (x[1] - origin[1]) - h.d);
  d->weight += length;
}

double PhasesDistance(Phases f, int v, double *inside)
{
  const Stars *s = f->stars;
  VertexDistance d = {0};
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3;
    if (f->single[e] < 0)
      AddLine(f, e, v, &d);
    else if (f->single[e] == 0)
      d.below = 1;
    else
      d.above = 1;
  }
  double distance = d.weight > 0.0 ? d.sum / d.weight : 0.0;
  if (d.below) distance = fmin(distance, 0.0);
  if (d.above) distance = fmax(distance, 0.0);
  *inside = distance != 0.0 ? distance < 0.0 : d.below == d.above ? 0.5 : d.below;
  return distance;
}

static void Element(Phases f, int e, const double distance[], const double rho[], const double gravity[2],
                    InverseDensity *inverse)
{
  const double(*x)[2] = (const double(*)[2])f->stars->element[e].x, *v = &f->volume[2 * (size_t)e];
  const double twice = StarsTwiceArea(f->stars, e);
  double grad[3][2], d[3];
  for (int i = 0; i < 3; i++) {
    const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3];
    grad[i][0] = (a[1] - b[1]) / twice;
    grad[i][1] = (b[0] - a[0]) / twice;
    d[i] = distance[f->stars->vertex[e][i]];
  }
  InverseDensityCut((const double(*)[2])grad, d, rho, 2.0 * (rho[0] * v[0] + rho[1] * v[1]) / twice, gravity,
                    inverse);
}

PetscErrorCode PhasesGetInverseDensity(Phases f, const double rho[], const double gravity[2],
                                       InverseDensity inverse[])
{
  const Stars *s = f->stars;
  double *distance, inside;
  PetscFunctionBeginUser;
  PetscCheck(f->has_lines, s->mesh->comm, PETSC_ERR_ORDER,
             "effective densities need the lines: call PhasesReconstruct");
  PetscCheck(f->np == 2, s->mesh->comm, PETSC_ERR_SUP, "%d phases in a flow: two are possible", f->np);
  PetscCall(PetscMalloc1(s->nowned, &distance));
  for (int v = 0; v < s->nowned; v++) distance[v] = PhasesDistance(f, v, &inside);
  for (int e = 0; e < s->ne; e++) {
    if (f->single[e] < 0)
      Element(f, e, distance, rho, gravity, &inverse[e]);
    else
      InverseDensityUniform(rho[f->single[e]], gravity, &inverse[e]);
  }
  PetscCall(PetscFree(distance));
  PetscFunctionReturn(0);
}
