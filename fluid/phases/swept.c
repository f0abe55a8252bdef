#include "fluid/phases/swept.h"

PetscErrorCode SweptSearchCreate(Phases f, SweptSearch *t)
{
  PetscFunctionBeginUser;
  *t = (SweptSearch){.f = f};
  PetscCall(PetscCalloc1(f->stars->nl, &t->mark));
  PetscCall(PetscMalloc1(f->stars->nl, &t->list));
  PetscFunctionReturn(0);
}

PetscErrorCode SweptSearchDestroy(SweptSearch *t)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(t->mark));
  PetscCall(PetscFree(t->list));
  PetscFunctionReturn(0);
}

static void ListVertex(SweptSearch *t, int v)
{
  const Stars *s = t->f->stars;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3;
    if (t->mark[e] == t->stamp) continue;
    t->mark[e] = t->stamp;
    int at = t->n++;
    for (; at > 0 && s->element[t->list[at - 1]].egid > s->element[e].egid; at--)
      t->list[at] = t->list[at - 1];
    t->list[at] = e;
  }
}

/* Elements around the two vertices; with `wide` also those around the vertices of these. */
static void ListFace(SweptSearch *t, int a, int b, int wide)
{
  t->stamp++;
  t->n = 0;
  ListVertex(t, a);
  ListVertex(t, b);
  if (!wide) return;
  for (int v = 0; v < 2; v++) {
    const int center = v ? b : a;
    for (int k = t->f->stars->start[center]; k < t->f->stars->start[center + 1]; k++) {
      for (int i = 0; i < 3; i++) ListVertex(t, t->f->stars->vertex[t->f->stars->around[k] / 3][i]);
    }
  }
}

void SweptMake(const Stars *s, int a, int b, const double shift[][2], double swept, Swept *r)
{
  const double *xa = s->point[a], *xb = s->point[b];
  double twice = 0.0;
  for (int c = 0; c < 2; c++) {
    r->origin[c] = xa[c];
    r->corner[0][c] = 0.0;
    r->corner[1][c] = xb[c] - xa[c];
    r->corner[2][c] = r->corner[1][c] + shift[b][c];
    r->corner[4][c] = shift[a][c];
    r->corner[3][c] = 0.5 * (r->corner[2][c] + r->corner[4][c]);
  }
  const double(*x)[2] = (const double(*)[2])r->corner;
  twice = x[1][0] * x[2][1] - x[1][1] * x[2][0] + x[2][0] * x[4][1] - x[2][1] * x[4][0];
  const double edge[2] = {x[4][0] - x[2][0], x[4][1] - x[2][1]};
  const double push = (2.0 * swept - twice) / (edge[0] * edge[0] + edge[1] * edge[1]);
  r->corner[3][0] += push * edge[1];
  r->corner[3][1] -= push * edge[0];
  for (int c = 0; c < 2; c++) {
    r->low[c] = r->high[c] = 0.0;
    for (int k = 1; k < 5; k++) {
      r->low[c] = fmin(r->low[c], r->corner[k][c]);
      r->high[c] = fmax(r->high[c], r->corner[k][c]);
    }
  }
}

static int Apart(const Swept *r, const double x[3][2])
{
  for (int c = 0; c < 2; c++) {
    const double low = r->low[c] + r->origin[c], high = r->high[c] + r->origin[c];
    if (x[0][c] >= high && x[1][c] >= high && x[2][c] >= high) return 1;
    if (x[0][c] <= low && x[1][c] <= low && x[2][c] <= low) return 1;
  }
  return 0;
}

/* uncovered += sign times the area of p in each part of the outside. */
static void AddOutside(const Polygon *p, double sign, SweptOutside *outside)
{
  for (int i = 0; i < outside->n; i++) {
    SweptPart *part = &outside->part[i];
    Polygon in[2], below;
    const Polygon *all = p;
    if (outside->n == 1 && !part->nlevels) return;
    for (int k = 0; k < part->ncuts; k++) {
      PolygonClip(all, &part->cut[k], &in[k]);
      all = &in[k];
    }
    for (int k = 0; k < part->nlevels; k++) {
      PolygonClip(all, &part->level[k], &below);
      if (below.n) part->uncovered[k] += sign * PolygonArea(&below);
    }
    if (outside->n > 1 && all->n) part->uncovered[part->nlevels] += sign * PolygonArea(all);
  }
}

/* area[np] of the listed elements' phases in the region; returns what they do not cover of it, over the
 * square of the edge. */
static double Collect(const SweptSearch *t, const Swept *r, SweptOutside *outside, double area[],
                      double mass[])
{
  Polygon triangle[3], moved, part;
  double sign[3], all = 0.0, covered = 0.0;
  for (int i = 0; i < outside->n; i++)
    memset(outside->part[i].uncovered, 0, sizeof outside->part[i].uncovered);
  for (int k = 0; k < 3; k++) {
    Polygon *q = &triangle[k];
    q->n = 3;
    for (int c = 0; c < 2; c++) {
      q->x[0][c] = 0.0;
      q->x[1][c] = r->corner[k + 1][c];
      q->x[2][c] = r->corner[k + 2][c];
    }
    const double signed_area = PolygonArea(q);
    sign[k] = signed_area < 0.0 ? -1.0 : 1.0;
    all += fabs(signed_area);
    for (int c = 0; c < 2 && signed_area < 0.0; c++) {
      const double swap = q->x[1][c];
      q->x[1][c] = q->x[2][c];
      q->x[2][c] = swap;
    }
    AddOutside(q, sign[k], outside);
  }
  for (int j = 0; j < t->n; j++) {
    const int e = t->list[j];
    const double(*x)[2] = (const double(*)[2])t->f->stars->element[e].x;
    if (Apart(r, x)) continue;
    PolygonTriangle(x, r->origin, &moved);
    for (int k = 0; k < 3; k++) {
      PolygonClipTriangle(&triangle[k], (const double(*)[2])moved.x, &part);
      if (!part.n) continue;
      covered += PolygonArea(&part);
      AddOutside(&part, -sign[k], outside);
      if (!t->f->mass) {
        PhasesSplit(t->f, e, &part, r->origin, sign[k], area);
        continue;
      }
      double split[PHASES_MAX] = {0.0};
      PhasesSplit(t->f, e, &part, r->origin, sign[k], split);
      for (int p = 0; p < t->f->np; p++) {
        area[p] += split[p];
        mass[p] += split[p] * t->f->density[e * t->f->np + p];
      }
    }
  }
  const double *edge = r->corner[1];
  return (all - covered) / (edge[0] * edge[0] + edge[1] * edge[1]);
}

double SweptCollect(SweptSearch *t, int a, int b, int wide, const Swept *r, SweptOutside *outside,
                    double area[], double mass[])
{
  ListFace(t, a, b, wide);
  return Collect(t, r, outside, area, mass);
}
