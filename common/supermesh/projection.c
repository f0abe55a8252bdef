#include "common/supermesh/projection.h"
#include "common/supermesh/supermesh.h"
#include <stdlib.h>

/* What a source gives to a target. */
typedef struct {
  int source;
  double mixed[3][3]; /* int N_T,i N_S,j, m2 */
} Share;

struct Projection_s {
  int nt;
  int *first;   /* [nt + 1] shares of target t: first[t] .. first[t + 1] - 1 */
  double *area; /* [nt] m2 */
  Share *share;
};

/* The shares of each pair, which ascend in their targets. */
static void SetShares(Projection p, const double target[][3][2], const double source[][3][2],
                      const SupermeshPairs *pairs)
{
  int n = 0;
  for (int t = 0; t < p->nt; t++) {
    const SupermeshBasis of_target = SupermeshBasisOf(target[t]);
    p->first[t] = n;
    p->area[t] = GeometryArea(target[t]);
    for (; n < pairs->n && pairs->pair[n].a == t; n++) {
      const SupermeshBasis of_source = SupermeshBasisOf(source[pairs->pair[n].b]);
      p->share[n].source = pairs->pair[n].b;
      SupermeshProduct(&pairs->pair[n], &of_target, &of_source, p->share[n].mixed);
    }
  }
  p->first[p->nt] = n;
}

int ProjectionCreate(int nt, const double target[][3][2], Search search, const double source[][3][2],
                     Projection *projection)
{
  Projection p = calloc(1, sizeof *p);
  SupermeshPairs pairs = {0};
  int failed = 1;
  *projection = p;
  if (!p) return 1;
  p->nt = nt;
  if (!SupermeshIntersect(nt, target, search, source, &pairs)) {
    p->first = malloc(((size_t)nt + 1) * sizeof *p->first);
    p->area = malloc(((size_t)nt + 1) * sizeof *p->area);
    p->share = malloc(((size_t)pairs.n + 1) * sizeof *p->share);
    failed = !p->first || !p->area || !p->share;
  }
  if (!failed) SetShares(p, target, source, &pairs);
  SupermeshPairsDestroy(&pairs);
  if (failed) ProjectionDestroy(projection);
  return failed;
}

/* The inverse of the P1 mass matrix area/12 (I + 1 1^T) is 12/area (I - 1 1^T / 4). */
static void InvertMass(double area, double q[3])
{
  const double quarter = 0.25 * (q[0] + q[1] + q[2]);
  for (int i = 0; i < 3; i++) q[i] = 12.0 / area * (q[i] - quarter);
}

void ProjectionApply(Projection p, int ncomp, const double source[], const int place[], double target[])
{
  const size_t stride = 3 * (size_t)ncomp;
  for (int t = 0; t < p->nt; t++) {
    double *to = target + stride * (size_t)(place ? place[t] : t);
    memset(to, 0, stride * sizeof *to);
    for (const Share *s = p->share + p->first[t]; s < p->share + p->first[t + 1]; s++) {
      const double *from = source + stride * (size_t)s->source;
      for (int c = 0; c < ncomp; c++) {
        for (int i = 0; i < 3; i++) {
          for (int j = 0; j < 3; j++) to[3 * c + i] += s->mixed[i][j] * from[3 * c + j];
        }
      }
    }
    for (int c = 0; c < ncomp; c++) InvertMass(p->area[t], to + 3 * c);
  }
}

int ProjectionPairs(Projection p)
{
  return p->first[p->nt];
}

void ProjectionDestroy(Projection *projection)
{
  Projection p = *projection;
  if (!p) return;
  free(p->first);
  free(p->area);
  free(p->share);
  free(p);
  *projection = NULL;
}
