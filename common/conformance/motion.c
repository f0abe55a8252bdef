#include "common/conformance/motion.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *Copy(void *old, const void *from, size_t bytes)
{
  void *to = realloc(old, bytes + 1);
  if (bytes) memcpy(to, from, bytes);
  return to;
}

static void FindArea(Motion *m, const ServerSolid *s)
{
  m->area = realloc(m->area, (size_t)m->n * sizeof *m->area + 1);
  for (int i = 0; i < m->n; i++) m->area[i] = 0.0;
  for (int e = 0; e < s->nelements; e++) {
    const int *v = s->element + 3 * e;
    const double *a = s->x + 2 * v[0], *b = s->x + 2 * v[1], *c = s->x + 2 * v[2];
    const double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    for (int i = 0; i < 3; i++) m->area[v[i]] += area / 3.0;
  }
  for (int e = 0; e < s->nfacets && s->nelements == 0; e++) {
    const double *a = s->x + 2 * s->facet[2 * e], *b = s->x + 2 * s->facet[2 * e + 1];
    for (int i = 0; i < 2; i++) m->area[s->facet[2 * e + i]] += 0.5 * hypot(b[0] - a[0], b[1] - a[1]);
  }
}

static void CopyNodes(Motion *to, const ServerSolid *from)
{
  const size_t n = (size_t)from->nnodes, one = n * sizeof(double), two = 2 * one;
  to->n = from->nnodes;
  to->gid = Copy(to->gid, from->gid, n * sizeof *from->gid);
  to->x = Copy(to->x, from->x, two);
  to->u = Copy(to->u, from->u, two);
  to->mean = Copy(to->mean, from->mean, two);
  to->mobility = Copy(to->mobility, from->mobility, one);
  to->acceleration = Copy(to->acceleration, from->acceleration, two);
}

void MotionTake(Motion *m, const ServerSolid *s)
{
  CopyNodes(m, s);
  FindArea(m, s);
}

void MotionCopy(Motion *to, const Motion *from)
{
  const ServerSolid nodes = {.nnodes = from->n,
                             .gid = from->gid,
                             .x = from->x,
                             .u = from->u,
                             .mean = from->mean,
                             .mobility = from->mobility,
                             .acceleration = from->acceleration};
  CopyNodes(to, &nodes);
  to->area = Copy(to->area, from->area, (size_t)from->n * sizeof *from->area);
}

void MotionFree(Motion *m)
{
  void *all[] = {m->area, m->gid, m->x, m->u, m->mean, m->mobility, m->acceleration};
  for (int k = 0; k < 7; k++) free(all[k]);
}

int MotionDiffers(const Motion *a, const Motion *b, char what[], size_t size)
{
  const struct {
    const char *name;
    const double *a, *b;
    int ncomp;
  } field[] = {{"position", a->x, b->x, 2},
               {"velocity at the step's end", a->u, b->u, 2},
               {"mean velocity", a->mean, b->mean, 2},
               {"mobility", a->mobility, b->mobility, 1},
               {"acceleration", a->acceleration, b->acceleration, 2}};
  snprintf(what, size, "number of nodes: %d, %d", a->n, b->n);
  if (a->n != b->n) return 1;
  for (size_t f = 0; f < sizeof field / sizeof *field; f++)
    for (int i = 0; i < field[f].ncomp * a->n; i++)
      if (memcmp(&field[f].a[i], &field[f].b[i], sizeof(double))) {
        snprintf(what, size, "%s at node %lld: %.17g, %.17g", field[f].name, a->gid[i / field[f].ncomp],
                 field[f].a[i], field[f].b[i]);
        return 1;
      }
  return 0;
}

void MotionSum(const Motion *m, double sum[MOTION_SUMS])
{
  memset(sum, 0, MOTION_SUMS * sizeof *sum);
  for (int i = 0; i < m->n; i++) {
    sum[0] += m->area[i];
    for (int d = 0; d < 2; d++) {
      const int k = 2 * i + d;
      sum[1 + d] += m->area[i] * m->x[k];
      sum[3 + d] += m->area[i] * m->x[k] * m->x[k];
      sum[5 + d] += m->area[i] * m->mean[k];
      sum[7 + d] += m->area[i] * m->u[k];
    }
  }
}
