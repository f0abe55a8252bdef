/* A spring between a point of a body and a fixed point, its anchor: a mooring line, or what holds an elastically mounted body.  Kernel: no MPI, no PETSc.
 *
 *     L = |anchor - x|,   n = (anchor - x)/L,   T = k (L - L0) + c dL/dt,   force on the point: T n
 *
 * A slack one pulls alone: T = 0 where L <= L0, and never below 0.  With L0 = 0 it is k (anchor - x) - c v, alike in all directions. */
#ifndef SOLID_SPRING_H
#define SOLID_SPRING_H
#include <math.h>

enum { MAX_SPRINGS = 64 };

typedef struct {
  int element;      /* of the model, which has the point */
  double weight[3]; /* of its nodes: the point's barycentric coordinates */
  double anchor[2]; /* m */
  double stiffness; /* k, N/m per metre of depth */
  double damping;   /* c, N s/m per metre of depth */
  double length;    /* L0, m */
  int slack;
} Spring;

typedef struct {
  double length, tension; /* L, m; T, N/m */
} SpringState;

/* force[2] on the point at x, which moves with v. */
static inline SpringState SpringForce(const Spring *s, const double x[2], const double v[2], double force[2])
{
  const double d[2] = {s->anchor[0] - x[0], s->anchor[1] - x[1]}, length = sqrt(d[0] * d[0] + d[1] * d[1]);
  if (s->length == 0.0) {
    for (int c = 0; c < 2; c++) force[c] = s->stiffness * d[c] - s->damping * v[c];
    return (SpringState){length, sqrt(force[0] * force[0] + force[1] * force[1])};
  }
  const double n[2] = {length > 0.0 ? d[0] / length : 0.0, length > 0.0 ? d[1] / length : 0.0};
  double tension = s->stiffness * (length - s->length) - s->damping * (n[0] * v[0] + n[1] * v[1]);
  if (s->slack && (length <= s->length || tension < 0.0)) tension = 0.0;
  for (int c = 0; c < 2; c++) force[c] = tension * n[c];
  return (SpringState){length, tension};
}

/* stiffness[2][2], N/m: -d(force)/dx, k n n^T + T/L (1 - n n^T), T without the dashpot's part.  Across itself a spring counts
 * where it pulls alone, so that there is no negative stiffness, and a slack one that does not pull has none. */
static inline void SpringStiffness(const Spring *s, const double x[2], const double v[2], double stiffness[4])
{
  double n[2], force[2];
  const SpringState now = SpringForce(s, x, v, force);
  const int acts = s->length == 0.0 || (now.length > 0.0 && (!s->slack || now.tension > 0.0));
  const double along = acts ? s->stiffness : 0.0;
  const double stretched = s->length == 0.0 ? 1.0 : fmax(0.0, 1.0 - s->length / fmax(s->length, now.length));
  const double lateral = along * stretched;
  for (int c = 0; c < 2; c++) n[c] = now.length > 0.0 ? (s->anchor[c] - x[c]) / now.length : 0.0;
  for (int k = 0; k < 4; k++)
    stiffness[k] = (along - lateral) * n[k / 2] * n[k % 2] + (k / 2 == k % 2 ? lateral : 0.0);
}
#endif
