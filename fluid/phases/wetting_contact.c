/* Where lines meet a solid's surface. */
#include "fluid/phases/phases_impl.h"

/* How far from the end of an element's line the solid's surface may be, in square roots of its area, and by what part of its length
 * a line of the surface may be missed. */
#define REACH 0.75
#define BEYOND 0.05

/* Distance of x from the segment of line in element e that `cut` is, relative to the same origin. */
static double DistanceFrom(const HalfPlane *line, const PolygonCut *cut, const double x[2])
{
  const double t = line->n[0] * x[1] - line->n[1] * x[0];
  return fmax(fabs(t - cut->middle) - 0.5 * cut->length, 0.0);
}

/* A part of the solid's surface, relative to an origin. */
typedef struct {
  double end[2][2], wall[2]; /* m; unit, into the solid */
} Surface;

/* That in element j: its line 0, and faces at which elements without a solid meet those in it; returns their number. */
static int Surfaces(Phases f, int j, const double origin[2], Surface surface[4])
{
  const StarElement *element = &f->stars->element[j];
  int n = 0;
  if (PhasesHasLine(f, j, 0)) {
    HalfPlane line;
    const PolygonCut cut = PhasesSegment(f, j, 0, origin, &line);
    for (int i = 0; i < 2; i++) {
      const double t = cut.middle + (i ? 0.5 : -0.5) * cut.length;
      surface[n].end[i][0] = line.n[0] * line.d - line.n[1] * t;
      surface[n].end[i][1] = line.n[1] * line.d + line.n[0] * t;
      surface[n].wall[i] = -line.n[i];
    }
    return cut.length > 0.0;
  }
  for (int i = 0; i < 3 && f->single[j] != 0; i++) {
    const int o = f->stars->neighbor[j][i];
    const double *a = element->x[(i + 1) % 3], *b = element->x[(i + 2) % 3];
    const double length = hypot(b[0] - a[0], b[1] - a[1]);
    if (o < 0 || f->single[o] != 0) continue;
    for (int c = 0; c < 2; c++) {
      surface[n].end[0][c] = a[c] - origin[c];
      surface[n].end[1][c] = b[c] - origin[c];
      surface[n].wall[c] = (c ? a[0] - b[0] : b[1] - a[1]) / length;
    }
    n++;
  }
  return n;
}

/* *x: where `line` meets the surface, longer by BEYOND; 0: it does not. */
static int Meet(const Surface *surface, const HalfPlane *line, double x[2])
{
  double end[2][2], d[2];
  for (int i = 0; i < 2; i++) {
    const double *a = surface->end[i], *b = surface->end[1 - i];
    for (int c = 0; c < 2; c++) end[i][c] = a[c] + BEYOND * (a[c] - b[c]);
    d[i] = line->n[0] * end[i][0] + line->n[1] * end[i][1] - line->d;
  }
  if ((d[0] > 0.0) == (d[1] > 0.0)) return 0;
  for (int c = 0; c < 2; c++) x[c] = end[0][c] + d[0] / (d[0] - d[1]) * (end[1][c] - end[0][c]);
  return 1;
}

/* The contact of `line`, whose segment in its element is cut, with a surface, if it is nearer than *nearest. */
static void TryContact(const Surface *surface, const double origin[2], const HalfPlane *line,
                       const PolygonCut *cut, double *nearest, WettingContact *found)
{
  double x[2];
  if (!Meet(surface, line, x)) return;
  const double distance = DistanceFrom(line, cut, x);
  if (distance >= *nearest) return;
  *nearest = distance;
  found->found = 1;
  for (int c = 0; c < 2; c++) {
    found->x[c] = origin[c] + x[c];
    found->wall[c] = surface->wall[c];
  }
}

WettingContact WettingFindContact(Phases f, int e, int k, const PhasesPairs *cosine)
{
  const Stars *s = f->stars;
  const double *origin = s->element[e].x[0];
  double nearest = REACH * sqrt(StarsArea(s, e));
  WettingContact found = {.found = 0};
  HalfPlane line;
  if (!PhasesHasLine(f, e, k)) return found;
  const PolygonCut cut = PhasesSegment(f, e, k, origin, &line);
  for (int i = 0; i < 3; i++)
    for (int m = s->start[s->vertex[e][i]]; m < s->start[s->vertex[e][i] + 1]; m++) {
      Surface surface[4];
      const int n = Surfaces(f, s->around[m] / 3, origin, surface);
      for (int j = 0; j < n; j++) TryContact(&surface[j], origin, &line, &cut, &nearest, &found);
    }
  found.cosine = cosine->value[k][PhasesBehind(f, e, k)];
  return found;
}
