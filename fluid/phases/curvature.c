/* Surface tension: curvature of the lines at the vertices around them, and what follows in elements. */
#include "fluid/phases/curvature.h"
#include "fluid/phases/phases_impl.h"

enum { AROUND_MAX = 256 };

/* Radius of the neighbourhood whose volumes are fitted, in square roots of the mean area of a vertex's elements. */
#define REACH 3.0
/* Lines that are turned by more against the mean one belong to another part of the interface. */
#define ALIGNED 0.3
/* A line whose direction and that of the contact angle have a smaller cosine does not end at that angle. */
#define TURNED 0.7
/* Lines of an element whose directions have a smaller cosine meet in it. */
#define PARALLEL 0.9

/* The part of the lines k around a vertex, and the frame for its fit. */
typedef struct {
  int k, n, element[AROUND_MAX]; /* that have such a line, in two rings */
  double origin[2], normal[2], length;
  double nearest, turn; /* m, of a contact at a solid at whose angle the line is not; 1/m */
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

void PhasesContactNormal(const double wall[2], double cosine, const double line[2], double normal[2])
{
  const double sine = copysign(sqrt(1.0 - cosine * cosine), wall[0] * line[1] - wall[1] * line[0]);
  normal[0] = -cosine * wall[0] - sine * wall[1];
  normal[1] = -cosine * wall[1] + sine * wall[0];
}

/* The slope at x where the interface has this normal. */
static void AddSlope(const Neighbourhood *h, const double x[2], const double normal[2], CurvatureData *data)
{
  const double tangent[2] = {h->normal[1], -h->normal[0]}, d[2] = {x[0] - h->origin[0], x[1] - h->origin[1]};
  const double across = normal[0] * h->normal[0] + normal[1] * h->normal[1];
  if (data->ncontacts == CURVATURE_CONTACTS) return;
  data->contact[data->ncontacts++] =
      (CurvatureContact){d[0] * tangent[0] + d[1] * tangent[1],
                         -(normal[0] * tangent[0] + normal[1] * tangent[1]) / fmax(across, 0.2)};
}

/* The contact angle where the segment of element e meets a solid. */
static void AddSolid(Phases f, int e, Neighbourhood *h, const HalfPlane *line, const double middle[2],
                     CurvatureData *data)
{
  const WettingContact *c = f->contact ? &f->contact[(size_t)e * (size_t)(f->np - 1) + (size_t)h->k] : NULL;
  double normal[2];
  if (!c || !c->found) return;
  PhasesContactNormal(c->wall, c->cosine, line->n, normal);
  const double dot = normal[0] * line->n[0] + normal[1] * line->n[1];
  if (dot > TURNED) {
    AddSlope(h, c->x, normal, data);
    return;
  }
  const double *m = middle, d[2] = {c->x[0] - h->origin[0], c->x[1] - h->origin[1]};
  const double distance = hypot(d[0], d[1]), arm = hypot(d[0] - m[0], d[1] - m[1]);
  if (distance > fmin(h->nearest, 0.5 * h->length)) return;
  const double angle = acos(fmin(fmax(-(line->n[0] * c->wall[0] + line->n[1] * c->wall[1]), -1.0), 1.0));
  h->nearest = distance;
  h->turn = (acos(c->cosine) - angle) / fmax(arm, h->length / 6.0);
}

/* The contact angle where the segment of element e ends on a wall. */
static void AddContact(Phases f, int e, const Neighbourhood *h, const HalfPlane *line,
                       const PhasesPairs cosine[], CurvatureData *data)
{
  const StarElement *element = &f->stars->element[e];
  const int behind = PhasesBehind(f, e, h->k);
  for (int i = 0; i < 3; i++) {
    if (element->tag[i] < 0) continue;
    const double *a = element->x[(i + 1) % 3], *b = element->x[(i + 2) % 3];
    const double length = hypot(b[0] - a[0], b[1] - a[1]),
                 wall[2] = {(b[1] - a[1]) / length, (a[0] - b[0]) / length};
    double x[2], normal[2];
    if (!PhasesCrossing(f, e, h->k, i, x)) continue;
    PhasesContactNormal(wall, cosine ? cosine[element->tag[i]].value[h->k][behind] : 0.0, line->n, normal);
    AddSlope(h, x, normal, data);
  }
}

/* What lies below line k of element e, m2: phase k, and earlier phases where their lines have the same direction; 0 is returned
 * where these meet it. */
static int Below(Phases f, int e, int k, const HalfPlane *line, double *volume)
{
  const double *v = &f->volume[(size_t)e * (size_t)f->np];
  *volume = v[k];
  for (int j = f->first; j < k; j++) {
    if (!PhasesHasLine(f, e, j)) continue;
    const HalfPlane *other = &f->line[(size_t)e * (size_t)(f->np - 1) + (size_t)j];
    const double same = line->n[0] * other->n[0] + line->n[1] * other->n[1];
    if (fabs(same) < PARALLEL) return 0;
    if (same > 0.0) *volume += v[j];
  }
  return 1;
}

static void AddCell(Phases f, int e, Neighbourhood *h, const PhasesPairs cosine[], CurvatureData *data)
{
  const double *n = h->normal;
  CurvatureCell *cell = &data->cell[data->n];
  HalfPlane line;
  Polygon part;
  double end[2][2];
  if (data->n == CURVATURE_CELLS || !Segment(f, e, h->k, h->origin, &line, end)) return;
  if (line.n[0] * n[0] + line.n[1] * n[1] < ALIGNED) return;
  const double middle[2] = {0.5 * (end[0][0] + end[1][0]), 0.5 * (end[0][1] + end[1][1])};
  const double r = 0.5 * hypot(end[0][0] + end[1][0], end[0][1] + end[1][1]) / h->length;
  if (r >= 1.0 || !Below(f, e, h->k, &line, &cell->volume)) return;
  PhasesRest(f, e, f->first, h->origin, &part);
  cell->n = part.n < CURVATURE_CORNERS ? part.n : CURVATURE_CORNERS;
  for (int i = 0; i < cell->n; i++) {
    cell->x[i][0] = n[1] * part.x[i][0] - n[0] * part.x[i][1];
    cell->x[i][1] = n[0] * part.x[i][0] + n[1] * part.x[i][1];
  }
  cell->weight = (1.0 - r * r) * (1.0 - r * r);
  data->n++;
  AddContact(f, e, h, &line, cosine, data);
  AddSolid(f, e, h, &line, middle, data);
}

int PhasesCurvature(Phases f, int k, int v, const PhasesPairs cosine[], double *curvature)
{
  const Stars *s = f->stars;
  Neighbourhood h = {.k = k, .nearest = HUGE_VAL};
  if (!Frame(f, v, &h)) return 0;
  CurvatureData data = {.n = 0, .length = h.length};
  for (int j = s->start[v]; j < s->start[v + 1]; j++)
    for (int i = 0; i < 3; i++) AddCut(f, s->vertex[s->around[j] / 3][i], &h);
  for (int j = 0; j < h.n; j++) AddCell(f, h.element[j], &h, cosine, &data);
  const int known = CurvatureFit(&data, curvature);
  if (h.nearest < HUGE_VAL) *curvature = h.turn;
  return known || h.nearest < HUGE_VAL;
}

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
      const int p = PhasesOnly(f, s->around[j] / 3);
      if (p > k && (found == k || p < found)) found = p;
    }
  return found;
}

/* The phase that lies behind line k in element e or along its faces; k: there is no such line. */
static int OtherPhase(Phases f, int e, int k)
{
  if (PhasesHasLine(f, e, k)) return PhasesBehind(f, e, k);
  const int p = PhasesOnly(f, e);
  if (p < k) return k;
  return p > k ? p : Beside(f, e, k);
}

/* excess[2] += tension curvature n times the length of line k in element e */
static void AddSegment(Phases f, int e, int k, double pull, double excess[2])
{
  HalfPlane line;
  if (!PhasesHasLine(f, e, k)) return;
  const double length = PhasesSegment(f, e, k, f->stars->element[e].x[0], &line).length;
  for (int c = 0; c < 2; c++) excess[c] += pull * length * line.n[c];
}

void PhasesAddSurfaceForce(Phases f, int k, const PhasesPairs *tension, const PhasesPairs cosine[],
                           VertexSurface vertex[], double force[], double excess[])
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
    const double pull = sigma * ElementCurvature(f, e, vertex), jump = pull / StarsTwiceArea(s, e);
    if (excess) AddSegment(f, e, k, pull, &excess[2 * e]);
    for (int i = 0; i < 3; i++) {
      const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3], in = vertex[s->vertex[e][i]].inside;
      force[2 * e] += jump * in * (a[1] - b[1]);
      force[2 * e + 1] += jump * in * (b[0] - a[0]);
      if (!excess) continue;
      excess[2 * e] += 0.5 * pull * in * (a[1] - b[1]);
      excess[2 * e + 1] += 0.5 * pull * in * (b[0] - a[0]);
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
  for (int k = 0; k + 1 < f->np; k++) PhasesAddSurfaceForce(f, k, tension, cosine, vertex, force, NULL);
  PetscCall(PetscFree(vertex));
  PetscFunctionReturn(0);
}
