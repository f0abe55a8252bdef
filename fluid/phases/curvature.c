/* Surface tension between two phases: curvature at the vertices around their interface, and what follows in elements. */
#include "fluid/phases/curvature.h"
#include "fluid/phases/phases_impl.h"

enum { AROUND_MAX = 256 };

/* Radius of the neighbourhood whose volumes are fitted, in square roots of the mean area of a vertex's elements. */
#define REACH 3.0
/* Lines that are turned by more against the mean one belong to another part of the interface. */
#define ALIGNED 0.3

/* The part of the interface around a vertex, and the frame for its fit. */
typedef struct {
  int n, element[AROUND_MAX]; /* cut elements in two rings */
  double origin[2], normal[2], length;
} Neighbourhood;

/* The segment of cut element e relative to origin: ends, ordered along (-n[1], n[0]); 0 if it has none. */
static int Segment(Phases f, int e, const double origin[2], HalfPlane *line, double end[2][2])
{
  Polygon whole;
  *line = PhasesLine(f, e, 0, origin);
  if (line->n[0] == 0.0 && line->n[1] == 0.0) return 0;
  PolygonTriangle((const double(*)[2])f->stars->element[e].x, origin, &whole);
  const PolygonCut cut = PolygonCutBy(&whole, 0.5 * StarsTwiceArea(f->stars, e), line);
  if (!(cut.length > 0.0)) return 0;
  for (int k = 0; k < 2; k++) {
    const double t = cut.middle + (k ? 0.5 : -0.5) * cut.length;
    end[k][0] = line->n[0] * line->d - line->n[1] * t;
    end[k][1] = line->n[1] * line->d + line->n[0] * t;
  }
  return 1;
}

static void AddCut(Phases f, int v, Neighbourhood *h)
{
  const Stars *s = f->stars;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3;
    int known = f->single[e] >= 0;
    for (int j = 0; j < h->n && !known; j++) known = h->element[j] == e;
    if (!known && h->n < AROUND_MAX) h->element[h->n++] = e;
  }
}

/* The mean line through the elements around v gives the frame; 0 if there is none. */
static int Frame(Phases f, int v, Neighbourhood *h)
{
  const Stars *s = f->stars;
  double sum = 0.0, distance = 0.0, area = 0.0;
  h->normal[0] = h->normal[1] = 0.0;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3;
    HalfPlane line;
    double end[2][2];
    area += 0.5 * StarsTwiceArea(s, e) / (s->start[v + 1] - s->start[v]);
    if (f->single[e] >= 0 || !Segment(f, e, s->point[v], &line, end)) continue;
    const double length = hypot(end[1][0] - end[0][0], end[1][1] - end[0][1]);
    sum += length;
    distance += length * line.d;
    for (int c = 0; c < 2; c++) h->normal[c] += length * line.n[c];
  }
  const double size = hypot(h->normal[0], h->normal[1]);
  if (!(size > 0.0)) return 0;
  for (int c = 0; c < 2; c++) {
    h->normal[c] /= size;
    h->origin[c] = s->point[v][c] + h->normal[c] * distance / sum;
  }
  h->length = REACH * sqrt(area);
  return 1;
}

/* The contact angle where the segment of element e ends on a wall. */
static void AddContact(Phases f, int e, const Neighbourhood *h, const HalfPlane *line, const double cosine[],
                       CurvatureData *data)
{
  const StarElement *element = &f->stars->element[e];
  const double tangent[2] = {h->normal[1], -h->normal[0]};
  for (int i = 0; i < 3; i++) {
    if (element->tag[i] < 0 || data->ncontacts == CURVATURE_CONTACTS) continue;
    const double *a = element->x[(i + 1) % 3], *b = element->x[(i + 2) % 3];
    const double wall[2] = {b[1] - a[1], a[0] - b[0]};
    double x[2], normal[2];
    if (!PhasesCrossing(f, e, i, x)) continue;
    const double size = hypot(wall[0], wall[1]), cosa = cosine ? cosine[element->tag[i]] : 0.0;
    const double along = (-wall[1] * line->n[0] + wall[0] * line->n[1]) / size;
    const double sine = copysign(sqrt(1.0 - cosa * cosa), along);
    for (int c = 0; c < 2; c++) {
      x[c] -= h->origin[c];
      normal[c] = (-cosa * wall[c] + sine * (c ? wall[0] : -wall[1])) / size;
    }
    const double across = normal[0] * h->normal[0] + normal[1] * h->normal[1];
    data->contact[data->ncontacts++] =
        (CurvatureContact){x[0] * tangent[0] + x[1] * tangent[1],
                           -(normal[0] * tangent[0] + normal[1] * tangent[1]) / fmax(across, 0.2)};
  }
}

static void AddCell(Phases f, int e, const Neighbourhood *h, const double cosine[], CurvatureData *data)
{
  const double(*x)[2] = (const double(*)[2])f->stars->element[e].x, *n = h->normal;
  CurvatureCell *cell = &data->cell[data->n];
  HalfPlane line;
  double end[2][2];
  if (data->n == CURVATURE_CELLS || !Segment(f, e, h->origin, &line, end)) return;
  if (line.n[0] * n[0] + line.n[1] * n[1] < ALIGNED) return;
  const double r = 0.5 * hypot(end[0][0] + end[1][0], end[0][1] + end[1][1]) / h->length;
  if (r >= 1.0) return;
  for (int i = 0; i < 3; i++) {
    const double d[2] = {x[i][0] - h->origin[0], x[i][1] - h->origin[1]};
    cell->x[i][0] = n[1] * d[0] - n[0] * d[1];
    cell->x[i][1] = n[0] * d[0] + n[1] * d[1];
  }
  cell->volume = f->volume[2 * (size_t)e];
  cell->weight = (1.0 - r * r) * (1.0 - r * r);
  data->n++;
  AddContact(f, e, h, &line, cosine, data);
}

int PhasesCurvature(Phases f, int v, const double cosine[], double *curvature)
{
  const Stars *s = f->stars;
  Neighbourhood h = {.n = 0};
  CurvatureData data = {.n = 0};
  if (!Frame(f, v, &h)) return 0;
  data.length = h.length;
  for (int k = s->start[v]; k < s->start[v + 1]; k++)
    for (int i = 0; i < 3; i++) AddCut(f, s->vertex[s->around[k] / 3][i], &h);
  for (int j = 0; j < h.n; j++) AddCell(f, h.element[j], &h, cosine, &data);
  return CurvatureFit(&data, curvature);
}

/* The mean over the vertices where it is known. */
static double ElementCurvature(Phases f, int e, const double curvature[], const char known[])
{
  double sum = 0.0;
  int n = 0;
  for (int i = 0; i < 3; i++) {
    const int v = f->stars->vertex[e][i];
    if (!known[v]) continue;
    sum += curvature[v];
    n++;
  }
  return n ? sum / n : 0.0;
}

PetscErrorCode PhasesGetSurfaceForce(Phases f, double tension, const double cosine[], double force[])
{
  const Stars *s = f->stars;
  double *inside, *curvature;
  char *known;
  PetscFunctionBeginUser;
  PetscCheck(f->has_lines, s->mesh->comm, PETSC_ERR_ORDER,
             "surface tension needs the lines: call PhasesReconstruct");
  PetscCheck(f->np == 2, s->mesh->comm, PETSC_ERR_SUP, "surface tension of %d phases: two are possible",
             f->np);
  PetscCall(PetscMalloc3(s->nowned, &inside, s->nowned, &curvature, s->nowned, &known));
  for (int v = 0; v < s->nowned; v++) {
    (void)PhasesDistance(f, v, &inside[v]);
    curvature[v] = 0.0;
    known[v] = (char)PhasesCurvature(f, v, cosine, &curvature[v]);
  }
  for (int e = 0; e < s->ne; e++) {
    const double(*x)[2] = (const double(*)[2])s->element[e].x;
    const double jump = tension * ElementCurvature(f, e, curvature, known) / StarsTwiceArea(s, e);
    force[2 * e] = force[2 * e + 1] = 0.0;
    for (int i = 0; i < 3; i++) {
      const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3], in = inside[s->vertex[e][i]];
      force[2 * e] += jump * in * (a[1] - b[1]);
      force[2 * e + 1] += jump * in * (b[0] - a[0]);
    }
  }
  PetscCall(PetscFree3(inside, curvature, known));
  PetscFunctionReturn(0);
}
