/* The coupling term s_c = a (u_s - u) in the fluid [37]-[39], assembled pair by pair.
 *
 * Each pair of the overlap (T, K) has one symmetric 2 x 2 coefficient a, kg/(m3 s): in mode reaction the friction of slip.h (or a penalty, inertia.h)
 * where T belongs to the solid's volume, the wall term where it belongs to the shell,
 *
 *     a = mu / (dr dxw) (I + n n / 3)          [37], dr the shell's thickness, dxw the extent of K along n
 *
 * times WALL_PENALTY in mode reaction.
 *
 * Element K receives, summed over its pairs (B = int N_K N_K^T, C = int N_T N_K^T),
 *
 *     a                 =  a B                s   =  a C^T u_s + C^T q + start C^T v
 *     implicit inertia  =  m B, with a tensor of the element (inertia.h)
 *     ms                =  B                  us  =  C^T u_s          T in the solid's volume: its velocity is the bulk's (BULK_LEAST)
 *
 * with q a body force, linear on T, m the solid's inertia in the fluid's solve and start the inertia that begins with the
 * solid's velocity v (inertia.h); the velocity of T is the bulk's where it has no inertia, or is held (SourceTerm.bulk).  The reaction (force.h) is made of the same coefficients and
 * integrals, so what the fluid gains the solid loses.  No field is projected, so none undershoots: a sum of
 * positive semidefinite coefficients times Gram matrices is positive semidefinite. */
#ifndef CORACLE_WALL_TERM_H
#define CORACLE_WALL_TERM_H
#include "coupler/geometry/linear_field.h"
#include "coupler/geometry/overlap.h"

/* The wall term of mode reaction is so many times [37], with which the velocity changes over a whole element: the body is as thin then
 * as if the fluid slipped over an element's length.  The drag of a cylinder in a channel (Schaefer and Turek, 2D-1), with
 * elements of D/12 and D/25 and a shell of D/200: with 1 it is 3.4 and 1.3 % low, with 4 0.5 % low and 0.1 % high, with 10 (D/12) 1.7 % high. */
#define WALL_PENALTY 4.0

/* In an element that the surface crosses the solid's velocity is the bulk's in all but this part of it at most.  Where less is open the velocity along the
 * surface would have to be that many times what the element conducts: beside a wedge that slides on a held slab it grew to 200 m/s (tests/coupled/wedge.sh slab,
 * le 0.0125 m), and with it the steps shrank.  With 0.2, 0.1 and 0 the drag of 2D-1 (tests/coupled/channel.sh) is - 0.05, - 0.07 and - 0.07 % off. */
#define BULK_LEAST 0.1

typedef struct {
  double xx, xy, yy; /* kg/(m3 s) */
} WallCoefficient;

/* dxw: the extent of fluid element x along n, m.  The wall function [33] lets the velocity change from the
 * wall's to the element's over one cell; the cell's length in that direction is the distance over which its
 * P1 functions can. */
static inline double WallExtent(const double x[3][2], const double n[2])
{
  double lower = HUGE_VAL, upper = -HUGE_VAL;
  for (int i = 0; i < 3; i++) {
    const double d = n[0] * x[i][0] + n[1] * x[i][1];
    lower = fmin(lower, d);
    upper = fmax(upper, d);
  }
  return upper - lower;
}

/* k (I + n n / 3): [37] written out. */
static inline WallCoefficient WallCoefficientOf(double k, const double n[2])
{
  return (WallCoefficient){k * (1.0 + n[0] * n[0] / 3.0), k * n[0] * n[1] / 3.0,
                           k * (1.0 + n[1] * n[1] / 3.0)};
}

static inline WallCoefficient WallCoefficientIsotropic(double k)
{
  return (WallCoefficient){k, 0.0, k};
}

static inline WallCoefficient WallCoefficientScaled(const WallCoefficient *a, double factor)
{
  return (WallCoefficient){factor * a->xx, factor * a->xy, factor * a->yy};
}

static inline int WallIsZero(const WallCoefficient *a)
{
  return (a->xx == 0.0) & (a->xy == 0.0) & (a->yy == 0.0);
}

/* a v */
static inline void WallApply(const WallCoefficient *a, const double v[2], double av[2])
{
  av[0] = a->xx * v[0] + a->xy * v[1];
  av[1] = a->xy * v[0] + a->yy * v[1];
}

/* What a pair gives the fluid, beside its integrals. */
typedef struct {
  WallCoefficient a;
  double inertia;        /* m, kg/(m3 s) */
  double rho;            /* rho_f, kg/m3, of which the inertia and the body force are */
  WallCoefficient start; /* how much of the inertia starts from the solid's velocity (inertia.h), kg/(m3 s) */
} PairTerm;

/* What a coupled element's pairs have in common. */
typedef struct {
  WallCoefficient along;      /* I - mean of n n over the shell in K, where crossed (slip.h), without unit */
  WallCoefficient tangential; /* D (slip.h), without unit */
  WallCoefficient kept;       /* of u^n, by the solid's inertia (inertia.h), without unit */
  WallCoefficient freed;      /* of the inertia, (1 - k) D (inertia.h), without unit */
  PetscBool covered;          /* K lies in the solid as a whole (inertia.h) */
  PetscBool shared;           /* two solids in K, one of which is held, share the reaction (slip.h) */
  PetscBool open;             /* K has fluid beside the solid */
  PetscBool corner;           /* the surface turns in K (slip.h) */
  double outside;             /* rho_o - rho_f of that (outside.h), kg/m3 */
} ElementTerm;

/* What a source triangle's vertices have, with its basis as the origin. */
typedef struct {
  double
      density; /* rho_s, kg/m3 (inertia.h); 0: of the shell, held by a penalty, or in other modes than reaction */
  PetscBool held;       /* its nodes have no mobility; shells, too */
  PetscBool bulk;       /* held, and its velocity is the bulk velocity there: ms, us */
  PetscBool given;      /* held, and velocity is that of a prescribed motion, whatever the fluid does */
  LinearField velocity; /* u_s, that the fluid couples to, m/s */
  LinearField start;    /* v, the solid's at the step's start, m/s */
  LinearField force;    /* rho_s a of the body force (inertia.h); weight of displaced.h; N/m3 */
  LinearField interface_acceleration; /* a' of the body force, m/s2 */
} SourceTerm;

/* What is held by inertia (inertia.h). */
static inline int IsHeldByInertia(const SourceTerm *source)
{
  return source->held && source->density > 0.0;
}

/* The velocity that the solid's inertia begins with (inertia.h). */
static inline const LinearField *InertiaBegins(const SourceTerm *source)
{
  return source->bulk || source->given ? &source->velocity : &source->start;
}

/* to += a q */
static inline void WallAdd(const WallCoefficient *a, const LinearField *q, LinearField *to)
{
  to->value[0] += a->xx * q->value[0] + a->xy * q->value[1];
  to->value[1] += a->xy * q->value[0] + a->yy * q->value[1];
  for (int d = 0; d < 2; d++) {
    to->gradient[d][0] += a->xx * q->gradient[d][0] + a->xy * q->gradient[d][1];
    to->gradient[d][1] += a->xy * q->gradient[d][0] + a->yy * q->gradient[d][1];
  }
}

/* The body force q on a pair with a triangle that has inertia, seen from the pair's centre. */
static inline LinearField PairBodyForce(const PairTerm *term, const ElementTerm *element,
                                        const SourceTerm *source, const double gravity[2],
                                        const double centre[2])
{
  const double excess = fmax(term->rho - source->density, 0.0);
  if (IsHeldByInertia(source) && element->open) /* the weight of displaced.h, less the fluid's own */
    return (LinearField){{element->outside * gravity[0], element->outside * gravity[1]}, {{0.0}}};
  const LinearField force = LinearFieldAt(&source->force, centre);
  if (IsHeldByInertia(source)) return force;
  LinearField q = force;
  if (!WallIsZero(&element->freed) && !element->shared) { /* the solid is heavier */
    const WallCoefficient freed = WallCoefficientScaled(&element->freed, term->rho / source->density - 1.0);
    WallAdd(&freed, &force, &q);
  }
  for (int c = 0; c < 2; c++) q.value[c] -= term->rho * gravity[c];
  if (excess > 0.0) {
    const LinearField a = LinearFieldAt(&source->interface_acceleration, centre);
    LinearFieldAdd(excess, &a, &q);
  }
  return q;
}

/* Local: coupling[overlap->ncoupled], one per coupled element (coracle.h has shapes and units), from term[pairs.n],
 * element[ncoupled] and source[nsources]; the elements' mean velocity is of the solid's at the step's start. */
PetscErrorCode WallTermAssemble(const Overlap overlap, const PairTerm term[], const ElementTerm element[],
                                const SourceTerm source[], const double gravity[2],
                                CoracleCoupling coupling[]);
#endif
