/* Surface tension: curvature of the lines at the vertices around them, and what follows in elements. */
#include "fluid/phases/curvature.h"
#include "fluid/phases/phases_impl.h"

enum { AROUND_MAX = 256 };

/* Radius of the neighbourhood whose volumes are fitted, in square roots of the mean area of a vertex's elements. */
#define REACH 3.0
/* Lines that are turned by more against the mean one belong to another part of the interface. */
#define ALIGNED 0.3
/* Lines of an element whose directions have a smaller cosine meet in it. */
#define PARALLEL 0.9

/* The part of the lines k around a vertex, and the frame for its fit. */
typedef struct {
  int k, n, element[AROUND_MAX]; /* that have such a line, in two rings */
  double origin[2], normal[2], length;
} Neighbourhood;

/* The segment of line k of element e relative to origin: ends, ordered along (-n[1], n[0]); 0 if it has none. */
static int Segment(Phases f, int e, int k, const double origin[2], HalfPlane *line, double end[2][2])
{
  if (!PhasesHasLine(f, e, k)) return 0;
  const PolygonCut cut = PhasesSegment(f, e, k, origin, line);
  if (!(cut.length > 0.0)) return 0;
  for (int i = 0; i < 2; i++) {
    const double t = cut.middle + (i ? 0.5 : -0.5) * cut.length;
    end[i][0] = line->n[0] * line->d - line->n[1] * t;
    end[i][1] = line->n[1] * line->d + line->n[0] * t;
  }
  return 1;
}

static void AddCut(Phases f, int v, Neighbourhood *h)
{
  const Stars *s = f->stars;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3;
    int known = !PhasesHasLine(f, e, h->k);
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
    area += StarsArea(s, e) / (s->start[v + 1] - s->start[v]);
    if (!Segment(f, e, h->k, s->point[v], &line, end)) continue;
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
static void AddContact(Phases f, int e, const Neighbourhood *h, const HalfPlane *line,
                       const PhasesPairs cosine[], CurvatureData *data)
{
  const StarElement *element = &f->stars->element[e];
  const int behind = PhasesBehind(f, e, h->k);
  const double tangent[2] = {h->normal[1], -h->normal[0]};
  for (int i = 0; i < 3; i++) {
    if (element->tag[i] < 0 || data->ncontacts == CURVATURE_CONTACTS) continue;
    const double *a = element->x[(i + 1) % 3], *b = element->x[(i + 2) % 3];
    const double wall[2] = {b[1] - a[1], a[0] - b[0]};
    double x[2], normal[2];
    if (!PhasesCrossing(f, e, h->k, i, x)) continue;
    const double size = hypot(wall[0], wall[1]),
                 cosa = cosine ? cosine[element->tag[i]].value[h->k][behind] : 0.0;
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

/* What lies below line k of element e, m2: phase k, and earlier phases where their lines have the same direction; 0 is returned
 * where these meet it. */
static int Below(Phases f, int e, int k, const HalfPlane *line, double *volume)
{
  const double *v = &f->volume[(size_t)e * (size_t)f->np];
  *volume = v[k];
  for (int j = 0; j < k; j++) {
    if (!PhasesHasLine(f, e, j)) continue;
    const HalfPlane *other = &f->line[(size_t)e * (size_t)(f->np - 1) + (size_t)j];
    const double same = line->n[0] * other->n[0] + line->n[1] * other->n[1];
    if (fabs(same) < PARALLEL) return 0;
    if (same > 0.0) *volume += v[j];
  }
  return 1;
}

static void AddCell(Phases f, int e, const Neighbourhood *h, const PhasesPairs cosine[], CurvatureData *data)
{
  const double(*x)[2] = (const double(*)[2])f->stars->element[e].x, *n = h->normal;
  CurvatureCell *cell = &data->cell[data->n];
  HalfPlane line;
  double end[2][2];
  if (data->n == CURVATURE_CELLS || !Segment(f, e, h->k, h->origin, &line, end)) return;
  if (line.n[0] * n[0] + line.n[1] * n[1] < ALIGNED) return;
  const double r = 0.5 * hypot(end[0][0] + end[1][0], end[0][1] + end[1][1]) / h->length;
  if (r >= 1.0 || !Below(f, e, h->k, &line, &cell->volume)) return;
  for (int i = 0; i < 3; i++) {
    const double d[2] = {x[i][0] - h->origin[0], x[i][1] - h->origin[1]};
    cell->x[i][0] = n[1] * d[0] - n[0] * d[1];
    cell->x[i][1] = n[0] * d[0] + n[1] * d[1];
  }
  cell->weight = (1.0 - r * r) * (1.0 - r * r);
  data->n++;
  AddContact(f, e, h, &line, cosine, data);
}

int PhasesCurvature(Phases f, int k, int v, const PhasesPairs cosine[], double *curvature)
{
  const Stars *s = f->stars;
  Neighbourhood h = {.k = k};
  CurvatureData data = {.n = 0};
  if (!Frame(f, v, &h)) return 0;
  data.length = h.length;
  for (int j = s->start[v]; j < s->start[v + 1]; j++)
    for (int i = 0; i < 3; i++) AddCut(f, s->vertex[s->around[j] / 3][i], &h);
  for (int j = 0; j < h.n; j++) AddCell(f, h.element[j], &h, cosine, &data);
  return CurvatureFit(&data, curvature);
}

/* At a vertex: of PhasesDistance and PhasesCurvature. */
typedef struct {
  double inside, curvature;
  int known;
} VertexSurface;

/* The mean over the vertices where it is known. */
static double ElementCurvature(Phases f, int e, const VertexSurface vertex[])
{
  double sum = 0.0;
  int n = 0;
  for (int i = 0; i < 3; i++) {
    const VertexSurface *v = &vertex[f->stars->vertex[e][i]];
    if (!v->known) continue;
    sum += v->curvature;
    n++;
  }
  return n ? sum / n : 0.0;
}

/* Of an element that no line k divides, but whose vertices may be on an interface along its faces: the first phase behind k that
 * elements around them have to themselves; k: there is none. */
static int Beside(Phases f, int e, int k)
{
  const Stars *s = f->stars;
  int found = k;
  for (int i = 0; i < 3; i++)
    for (int j = s->start[s->vertex[e][i]]; j < s->start[s->vertex[e][i] + 1]; j++) {
      const int p = f->single[s->around[j] / 3];
      if (p > k && (found == k || p < found)) found = p;
    }
  return found;
}

/* The phase that lies behind line k in element e or along its faces; k: there is no such line. */
static int OtherPhase(Phases f, int e, int k)
{
  if (PhasesHasLine(f, e, k)) return PhasesBehind(f, e, k);
  if (f->single[e] < k) return k;
  return f->single[e] > k ? f->single[e] : Beside(f, e, k);
}

/* force[ne][2] += that of lines k; vertex[nowned]: scratch */
static void AddForce(Phases f, int k, const PhasesPairs *tension, const PhasesPairs cosine[],
                     VertexSurface vertex[], double force[])
{
  const Stars *s = f->stars;
  for (int v = 0; v < s->nowned; v++) {
    vertex[v] = (VertexSurface){0.0, 0.0, 0};
    (void)PhasesDistance(f, k, v, &vertex[v].inside);
    vertex[v].known = PhasesCurvature(f, k, v, cosine, &vertex[v].curvature);
  }
  for (int e = 0; e < s->ne; e++) {
    const double(*x)[2] = (const double(*)[2])s->element[e].x, sigma = tension->value[k][OtherPhase(f, e, k)];
    if (sigma == 0.0) continue;
    const double jump = sigma * ElementCurvature(f, e, vertex) / StarsTwiceArea(s, e);
    for (int i = 0; i < 3; i++) {
      const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3], in = vertex[s->vertex[e][i]].inside;
      force[2 * e] += jump * in * (a[1] - b[1]);
      force[2 * e + 1] += jump * in * (b[0] - a[0]);
    }
  }
}

PetscErrorCode PhasesGetSurfaceForce(Phases f, const PhasesPairs *tension, const PhasesPairs cosine[],
                                     double force[])
{
  VertexSurface *vertex;
  PetscFunctionBeginUser;
  PetscCheck(f->has_lines, f->stars->mesh->comm, PETSC_ERR_ORDER,
             "surface tension needs the lines: call PhasesReconstruct");
  PetscCall(PetscArrayzero(force, 2 * f->stars->ne));
  PetscCall(PetscMalloc1(f->stars->nowned, &vertex));
  for (int k = 0; k + 1 < f->np; k++) AddForce(f, k, tension, cosine, vertex, force);
  PetscCall(PetscFree(vertex));
  PetscFunctionReturn(0);
}
