#include "coupler/force/squeeze_film.h"
#include <math.h>

/* Of a gap, by which a step closes it at most. */
#define MOST_CLOSED 0.5
/* Of half of the gap's length: below this a gap counts as closed. */
#define CLOSED 1e-6

SqueezeFilmYield SqueezeFilmYieldOf(const SqueezeFilm *f, double dt)
{
  if (f->profile <= 0.0) return (SqueezeFilmYield){0.0, 0.0};
  const double length = sqrt(2.0 * f->profile), closing = fmax(f->closing, 0.0),
               h = fmax(f->gap - 0.5 * dt * closing, CLOSED * length),
               rough = fmax(h, SQUEEZE_FILM_ROUGHNESS * length),
               friction = 6.0 * f->viscosity / (rough * rough), e = fmax(f->excess, 0.0);
  /* rho k^2 + 2 friction k = e/profile */
  const double root = sqrt(friction * friction + f->density * e / f->profile),
               resistance = fmax(f->profile * (friction + root) / h, e * dt / (MOST_CLOSED * h));
  return (SqueezeFilmYield){fmax(f->closing < 0.0 ? 0.0 : e - resistance * closing, 0.0), resistance};
}
