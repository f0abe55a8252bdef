#include "coupler/divergence_monitor.h"
#include <math.h>
#include <stdio.h>

/* m / m_f of a free body with this motion: m (dv/dt - g) = F in the least-squares sense, m_f the displaced
 * mass. */
static double DensityRatio(const DivergenceMonitorStep *s, const double change[2])
{
  double b[2], along = 0.0, square = 0.0;
  for (int c = 0; c < 2; c++) {
    b[c] = change[c] / s->dt - s->gravity[c];
    along += s->force[c] * b[c];
    square += b[c] * b[c];
  }
  return square > 0.0 && s->displaced > 0.0 ? along / square / s->displaced : 0.0;
}

static int IsFinite(const DivergenceMonitorStep *s)
{
  return isfinite(s->velocity[0]) && isfinite(s->velocity[1]) && isfinite(s->force[0]) &&
         isfinite(s->force[1]);
}

/* A change within that of free fall over one step is negligible, and so is one with hardly any energy compared with the flow's, or that
 * hardly moves the solid. */
static int Matters(const DivergenceMonitorStep *s, double size)
{
  return size > hypot(s->gravity[0], s->gravity[1]) * s->dt &&
         size * s->dt > DIVERGENCE_DISPLACEMENT * s->thickness &&
         size * size > DIVERGENCE_ENERGY * s->speed * s->speed;
}

/* Counts alternating, growing changes, from the first one that matters on: a vibration that begins grows from nothing, by any factor. */
static int Alternates(DivergenceMonitor *g, const DivergenceMonitorStep *s, const double change[2])
{
  const double size = hypot(change[0], change[1]), before = hypot(g->change[0], g->change[1]);
  const int opposite = change[0] * g->change[0] + change[1] * g->change[1] < -0.5 * size * before;
  g->alternations =
      opposite && size > DIVERGENCE_GROWTH * before && Matters(s, before) ? g->alternations + 1 : 0;
  if (g->alternations == 0) g->first = size;
  const int fast =
      2 * g->alternations >= DIVERGENCE_ALTERNATIONS && size > DIVERGENCE_TOTAL_GROWTH * g->first;
  return (fast || g->alternations >= DIVERGENCE_ALTERNATIONS) && Matters(s, size);
}

/* what: how the velocity diverges; the message adds the likely cause and what to do.  The motion of a body that is held implies no density
 * ratio, nor does a force against the acceleration. */
static void WriteMessage(const DivergenceMonitorStep *s, const double change[2], const char *what,
                         int nmessage, char message[])
{
  const double ratio = s->held ? 0.0 : DensityRatio(s, change);
  const int iterates = s->max_iterations > 1;
  char cause[256];
  if (ratio > 0.0 && isfinite(ratio))
    snprintf(cause, sizeof cause,
             "with a solid to fluid density ratio of about %.2g the added mass is too large for %s", ratio,
             iterates ? "steps of this length; shorter ones (time.dt_max) or a heavier solid are needed"
                      : "a staggered exchange; a heavier solid is needed, or strong coupling "
                        "(coupler.max_iterations: 30)");
  else
    snprintf(cause, sizeof cause, "shorter steps (time.dt_max)%s or damping of the solid's material may help",
             iterates ? "" : ", strong coupling (coupler.max_iterations: 30)");
  snprintf(message, (size_t)nmessage, "at t = %g s the solid's velocity has become (%g, %g) m/s, %s: %s",
           s->t, s->velocity[0], s->velocity[1], what, cause);
}

int DivergenceMonitorCheck(DivergenceMonitor *g, const DivergenceMonitorStep *s, int nmessage, char message[])
{
  double change[2];
  if (!IsFinite(s)) {
    snprintf(message, (size_t)nmessage, "at t = %g s the force on the solid or its velocity is not a number",
             s->t);
    return 1;
  }
  for (int c = 0; c < 2; c++) change[c] = s->velocity[c] - g->velocity[c];
  /* the initial velocity is unknown here, so the first step has no change */
  const int diverges = g->nsteps > 0 && Alternates(g, s, change);
  const int leaps = hypot(s->velocity[0], s->velocity[1]) * s->dt > s->extent;
  if (diverges)
    WriteMessage(s, change, "changing with alternating sign and growing size from step to step", nmessage,
                 message);
  else if (leaps)
    WriteMessage(s, change, "more than the fluid's whole domain in one step", nmessage, message);
  for (int c = 0; c < 2; c++) {
    g->change[c] = g->nsteps > 0 ? change[c] : 0.0;
    g->velocity[c] = s->velocity[c];
  }
  g->nsteps++;
  return diverges || leaps;
}
