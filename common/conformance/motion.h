/* What a solid has sent in one step, on one rank of the coupler: kept to be compared. */
#ifndef CORACLE_CONFORMANCE_MOTION_H
#define CORACLE_CONFORMANCE_MOTION_H
#include "common/link/server.h"

/* area, and area-weighted: x, y, x^2, y^2, mean velocity, velocity at the step's end */
enum { MOTION_SUMS = 9 };

typedef struct {
  int n;
  /* [n] m2: a third of the triangles of this rank around a node; without triangles half its facets' lengths */
  double *area;
  long long *gid;
  double *x, *u, *mean, *mobility, *acceleration; /* as in ServerSolid */
} Motion;

/* Replaces *m by a copy. */
void MotionTake(Motion *m, const ServerSolid *solid);
void MotionCopy(Motion *to, const Motion *from);
void MotionFree(Motion *m);
/* Whether they differ in a bit; `what`: names the first that does. */
int MotionDiffers(const Motion *a, const Motion *b, char what[], size_t size);
void MotionSum(const Motion *m, double sum[MOTION_SUMS]);
#endif
