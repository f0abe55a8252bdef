/* A spring between a point of a body and its other end: a fixed point, its anchor, or a point of another body.  A mooring line, a fender, a hinge, what
 * holds an elastically mounted body.  Kernel: no MPI, no PETSc.
 *
 *     d = y - x,   L = |d|,   n = d/L,   T = k (L - L0) + c dL/dt,   force on the point at x: T n,   on the other end, at y: - T n
 *
 * One that pulls alone has T = 0 where L <= L0, and never T < 0; one that pushes alone T = 0 where L >= L0, and never T > 0.  With L0 = 0 the force is
 * k d + c dd/dt, alike in all directions. */
#ifndef SOLID_SPRING_H
#define SOLID_SPRING_H
#include <math.h>

enum { MAX_SPRINGS = 64 };
typedef enum { SPRING_PULLS_AND_PUSHES, SPRING_PULLS, SPRING_PUSHES } SpringActs;

typedef struct {
  int element;      /* of the model, which has the point */
  double weight[3]; /* of its nodes: the point's barycentric coordinates */
} SpringEnd;

typedef struct {
  SpringEnd end[2];
  int anchored;     /* the other end is the anchor, and end[1] is not used */
  double anchor[2]; /* m */
  double stiffness; /* k, N/m per metre of depth */
  double damping;   /* c, N s/m per metre of depth */
  double length;    /* L0, m */
  SpringActs acts;
} Spring;

typedef struct {
  double d[2], rate[2]; /* the other end less the point, m, and its rate, m/s */
} SpringExtent;

typedef struct {
  double length, tension; /* L, m; T, N/m */
} SpringState;

/* force[2] on the point. */
static inline SpringState SpringForce(const Spring *s, const SpringExtent *at, double force[2])
{
  const double length = hypot(at->d[0], at->d[1]);
  if (s->length == 0.0) {
    for (int c = 0; c < 2; c++) force[c] = s->stiffness * at->d[c] + s->damping * at->rate[c];
    return (SpringState){length, hypot(force[0], force[1])};
  }
  const double n[2] = {length > 0.0 ? at->d[0] / length : 0.0, length > 0.0 ? at->d[1] / length : 0.0};
  double tension =
      s->stiffness * (length - s->length) + s->damping * (n[0] * at->rate[0] + n[1] * at->rate[1]);
  if (s->acts == SPRING_PULLS && (length <= s->length || tension < 0.0)) tension = 0.0;
  if (s->acts == SPRING_PUSHES && (length >= s->length || tension > 0.0)) tension = 0.0;
  for (int c = 0; c < 2; c++) force[c] = tension * n[c];
  return (SpringState){length, tension};
}

/* stiffness[2][2], N/m: d(force)/dd, k n n^T + T/L (1 - n n^T), T without the dashpot's part.  Across itself a spring counts
 * where it pulls alone, so that there is no negative stiffness, and one that does not act has none. */
static inline void SpringStiffness(const Spring *s, const SpringExtent *at, double stiffness[4])
{
  double n[2], force[2];
  const SpringState now = SpringForce(s, at, force);
  const int idle = s->acts != SPRING_PULLS_AND_PUSHES && now.tension == 0.0;
  const double along = s->length == 0.0 || (now.length > 0.0 && !idle) ? s->stiffness : 0.0;
  const double stretched = s->length == 0.0 ? 1.0 : fmax(0.0, 1.0 - s->length / fmax(s->length, now.length));
  const double lateral = along * stretched;
  for (int c = 0; c < 2; c++) n[c] = now.length > 0.0 ? at->d[c] / now.length : 0.0;
  for (int k = 0; k < 4; k++)
    stiffness[k] = (along - lateral) * n[k / 2] * n[k % 2] + (k / 2 == k % 2 ? lateral : 0.0);
}
#endif
