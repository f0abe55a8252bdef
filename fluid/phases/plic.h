/* Piecewise linear interface calculation: the line that separates a phase from the ones behind it in one
 * element.  Kernel: no mesh, no MPI.
 *
 * cell[0] is the element K, the others those around it.  In each, `part` is what earlier phases leave and
 * `volume` what of it belongs to this phase.  The line n.x = d keeps |part_K and n.x <= d| = volume_K and
 * minimises
 *
 *     E(theta) = sum_J ((A_J - volume_J) / area_J)^2,   A_J = |part_J and n.x <= d|,
 *     n = (cos theta, sin theta)
 *
 * (Puckett 1991; Pilliod and Puckett 2004 on squares).  When the line turns, it turns about the middle t_K of
 * its segment in K, because there the area must not change, so dA_J/dtheta = l_J (t_K - t_J), with l_J and
 * t_J the length and middle of its segment in part_J: Gauss-Newton with an exact derivative.  A straight
 * interface has E = 0 and is found to round-off on any mesh; then the convergence is quadratic. */
#ifndef CORACLE_PHASES_PLIC_H
#define CORACLE_PHASES_PLIC_H
#include "fluid/phases/polygon.h"

enum { PLIC_CELLS = 64, PLIC_ITERATIONS = 30 };

typedef struct {
  Polygon part;
  double center[2]; /* of the element */
  double area;      /* of the element, m2 */
  double rest;      /* of part, m2 */
  double volume;    /* m2 */
} PlicCell;

typedef struct {
  double theta, energy, step; /* step: Gauss-Newton's change of theta */
  HalfPlane line;
} PlicState;

static inline void PlicEvaluate(int n, const PlicCell cell[], double theta, PlicState *s)
{
  HalfPlane *h = &s->line;
  double eg = 0.0, gg = 0.0;
  s->theta = theta;
  h->n[0] = cos(theta);
  h->n[1] = sin(theta);
  h->d = PolygonFindOffset(&cell[0].part, h->n, cell[0].volume);
  const double middle = PolygonCutBy(&cell[0].part, cell[0].rest, h).middle;
  s->energy = 0.0;
  for (int j = 1; j < n; j++) {
    const PolygonCut cut = PolygonCutBy(&cell[j].part, cell[j].rest, h);
    const double e = (cut.area - cell[j].volume) / cell[j].area;
    const double g = cut.length * (middle - cut.middle) / cell[j].area;
    s->energy += e * e;
    eg += e * g;
    gg += g * g;
  }
  s->step = gg > 0.0 ? -eg / gg : 0.0;
}

/* Above this E the interface is not straight: what the last digits of theta change is below the error of any
 * line. */
#define PLIC_CURVED 1e-8

/* Gauss-Newton from theta; steps are halved until E decreases. */
static inline PlicState PlicDescend(int n, const PlicCell cell[], double theta)
{
  PlicState now, next;
  PlicEvaluate(n, cell, theta, &now);
  for (int k = 0; k < PLIC_ITERATIONS; k++) {
    double step = fmax(fmin(now.step, 0.5), -0.5);
    if (fabs(step) < 1e-15) break;
    PlicEvaluate(n, cell, now.theta + step, &next);
    for (int half = 0; half < 5 && next.energy > now.energy; half++) {
      step *= 0.5;
      PlicEvaluate(n, cell, now.theta + step, &next);
    }
    if (next.energy > now.energy) break;
    const double before = now.energy;
    now = next;
    if (fabs(step) < (now.energy > PLIC_CURVED ? 1e-4 : 1e-7) || before - now.energy < 1e-6 * now.energy)
      break;
  }
  return now;
}

/* Minus the gradient of the phase's fraction, by least squares over the cells; 0 where there is none. */
static inline void PlicGuess(int n, const PlicCell cell[], double normal[2])
{
  double a = 0.0, b = 0.0, c = 0.0, r[2] = {0.0, 0.0};
  const double own = cell[0].volume / cell[0].rest;
  for (int j = 1; j < n; j++) {
    const double x = cell[j].center[0] - cell[0].center[0], y = cell[j].center[1] - cell[0].center[1];
    const double w = 1.0 / (x * x + y * y), f = cell[j].volume / cell[j].rest - own;
    a += w * x * x, b += w * x * y, c += w * y * y;
    r[0] += w * x * f, r[1] += w * y * f;
  }
  const double det = a * c - b * b;
  normal[0] = det > 0.0 ? -(c * r[0] - b * r[1]) / det : 0.0;
  normal[1] = det > 0.0 ? -(a * r[1] - b * r[0]) / det : 0.0;
}

/* The line of cell[0].  Where the neighbours do not lie along one line (E above PLIC_POOR, a thin filament or
 * a corner) other starting angles are tried. */
#define PLIC_POOR 1e-3
static inline HalfPlane PlicFit(int n, const PlicCell cell[])
{
  double normal[2];
  PlicGuess(n, cell, normal);
  const int blind = normal[0] == 0.0 && normal[1] == 0.0;
  PlicState best = PlicDescend(n, cell, blind ? 0.0 : atan2(normal[1], normal[0]));
  if (best.energy > PLIC_POOR || blind) {
    const double start = best.theta;
    for (int k = 1; k < 6; k++) {
      const PlicState other = PlicDescend(n, cell, start + k * 1.0471975511965976);
      if (other.energy < best.energy) best = other;
    }
  }
  return best.line;
}

/* Whether the line tells the cells around no better than none would: E above that of A_J = 0 and that of A_J = rest_J. */
static inline int PlicIsBlind(int n, const PlicCell cell[], const HalfPlane *line)
{
  double energy = 0.0, none = 0.0, all = 0.0;
  for (int j = 1; j < n; j++) {
    const PlicCell *c = &cell[j];
    const double e = (PolygonCutBy(&c->part, c->rest, line).area - c->volume) / c->area;
    energy += e * e;
    none += c->volume * c->volume / (c->area * c->area);
    all += (c->rest - c->volume) * (c->rest - c->volume) / (c->area * c->area);
  }
  return energy > PLIC_CURVED + fmin(none, all);
}
#endif
