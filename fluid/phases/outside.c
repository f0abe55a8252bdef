#include "fluid/phases/outside.h"

/* Open boundary faces at a vertex, at which the domain begins and ends, seen counter-clockwise around it. */
typedef struct {
  int tag[2]; /* -1: none, or a wall */
  double along[2][2];
} OpenFaces;

static OpenFaces OpenAt(const Outside *o, int v)
{
  const Stars *s = o->stars;
  OpenFaces open = {.tag = {-1, -1}};
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3, c = s->around[k] % 3;
    for (int i = 0; i < 2; i++) {
      const int face = (c + 2 - i) % 3, far = (c + 1 + i) % 3, tag = s->element[e].tag[face];
      if (open.tag[i] >= 0 || tag < 0 || o->flux[e][face] == 0.0) continue;
      open.tag[i] = tag;
      for (int d = 0; d < 2; d++) open.along[i][d] = s->element[e].x[far][d] - s->element[e].x[c][d];
    }
  }
  return open;
}

/* Whether phase p alone comes in at x through boundary `tag`. */
static int IsOnly(const PhasesInflow *inflow, int tag, const double x[2], int p)
{
  const PhasesLevels *levels = inflow->levels ? &inflow->levels[tag] : NULL;
  for (int k = 0; levels && k < levels->n; k++)
    if (levels->normal[0] * x[0] + levels->normal[1] * x[1] < levels->d[k]) return p == levels->phase[k];
  return inflow->fraction[tag][p] == 1.0;
}

int OutsideIsOnly(const Outside *o, int v, int p)
{
  if (!o->inflow) return 1;
  const OpenFaces open = OpenAt(o, v);
  for (int i = 0; i < 2; i++)
    if (open.tag[i] >= 0 && !IsOnly(o->inflow, open.tag[i], o->stars->point[v], p)) return 0;
  return 1;
}

static double Cross(const double a[2], const double b[2])
{
  return a[0] * b[1] - a[1] * b[0];
}

/* The half plane through v in which what is outside belongs to the face at which the domain begins: that to the left of the
 * direction `shift`, or, where this points into the domain, of the outward one between both faces. */
static HalfPlane Side(const OpenFaces *open, const double shift[2], const double v[2])
{
  const double *begin = open->along[0], *end = open->along[1];
  const int wide = Cross(begin, end) <= 0.0, left = Cross(begin, shift) > 0.0,
            right = Cross(shift, end) > 0.0;
  const double lengths[2] = {hypot(begin[0], begin[1]), hypot(end[0], end[1])};
  double to[2] = {v[0] + shift[0], v[1] + shift[1]};
  if ((wide ? left || right : left && right) || (shift[0] == 0.0 && shift[1] == 0.0)) {
    to[0] = v[0] + begin[1] / lengths[0] - end[1] / lengths[1];
    to[1] = v[1] - begin[0] / lengths[0] + end[0] / lengths[1];
  }
  return HalfPlaneLeft(v, to);
}

static HalfPlane Nearer(const double v[2], const double other[2])
{
  HalfPlane h = {{other[0] - v[0], other[1] - v[1]}, 0.0};
  for (int c = 0; c < 2; c++) h.d += 0.5 * h.n[c] * (other[c] + v[c]);
  return h;
}

static SweptPart *AddPart(const Outside *o, int tag, const double origin[2], SweptOutside *parts)
{
  SweptPart *part = &parts->part[parts->n++];
  const PhasesLevels *levels = o->inflow->levels ? &o->inflow->levels[tag] : NULL;
  *part = (SweptPart){.tag = tag, .nlevels = levels ? levels->n : 0};
  for (int k = 0; k < part->nlevels; k++) {
    const double *n = levels->normal;
    part->level[k] = (HalfPlane){{n[0], n[1]}, levels->d[k] - n[0] * origin[0] - n[1] * origin[1]};
  }
  return part;
}

/* Outside of the boundaries at v, nearer to it than to `other` unless that is NULL. */
static void DivideAt(const Outside *o, const OpenFaces *open, int v, const double *other,
                     const double origin[2], SweptOutside *parts)
{
  const int two = open->tag[0] >= 0 && open->tag[1] >= 0 && open->tag[0] != open->tag[1];
  const double *x = o->stars->point[v], at[2] = {x[0] - origin[0], x[1] - origin[1]};
  for (int i = 0; i < 1 + two; i++) {
    SweptPart *part = AddPart(o, two || open->tag[0] >= 0 ? open->tag[i] : open->tag[1], origin, parts);
    if (other) {
      const double far[2] = {other[0] - origin[0], other[1] - origin[1]};
      part->cut[part->ncuts++] = Nearer(at, far);
    }
    if (!two) continue;
    const HalfPlane side = Side(open, o->shift[v], at);
    part->cut[part->ncuts++] = i ? HalfPlaneOther(&side) : side;
  }
}

static int SameOutside(const OpenFaces *a, const OpenFaces *b)
{
  int first = -1;
  for (int k = 0; k < 4; k++) {
    const int tag = k < 2 ? a->tag[k] : b->tag[k - 2];
    if (tag >= 0 && first >= 0 && tag != first) return 0;
    if (tag >= 0) first = tag;
  }
  return 1;
}

void OutsideDivide(const Outside *o, int a, int b, const double origin[2], SweptOutside *parts)
{
  parts->n = 0;
  if (!o->inflow) return;
  const OpenFaces open[2] = {OpenAt(o, a), OpenAt(o, b)};
  const int has[2] = {open[0].tag[0] >= 0 || open[0].tag[1] >= 0, open[1].tag[0] >= 0 || open[1].tag[1] >= 0};
  const int same = has[0] && has[1] && SameOutside(&open[0], &open[1]);
  const double *other[2] = {has[1] && !same ? o->stars->point[b] : NULL,
                            has[0] && !same ? o->stars->point[a] : NULL};
  if (has[0]) DivideAt(o, &open[0], a, other[0], origin, parts);
  if (has[1] && !same) DivideAt(o, &open[1], b, other[1], origin, parts);
}

void OutsideShare(const Outside *o, int np, double rest, const SweptOutside *parts, double area[])
{
  for (int i = 0; i < parts->n; i++) {
    const SweptPart *part = &parts->part[i];
    const double all = i + 1 < parts->n ? part->uncovered[part->nlevels] : rest;
    double below = 0.0;
    for (int k = 0; k < part->nlevels; k++) {
      area[o->inflow->levels[part->tag].phase[k]] += part->uncovered[k] - below;
      below = part->uncovered[k];
    }
    for (int p = 0; p < np; p++) area[p] += (all - below) * o->inflow->fraction[part->tag][p];
    rest -= all;
  }
}
