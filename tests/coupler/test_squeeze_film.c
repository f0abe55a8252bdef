// ranks: 1
/* The film in a gap: an inviscid one under a plate that presses with a constant pressure sinks as exp(-k t), k = sqrt(12 p/rho)/length; one of a
 * viscous fluid as Reynolds's, whose rate goes as h^3; what comes together by itself is not moved further; steps close half of a gap at most. */
#include "coupler/force/squeeze_film.h"
#include "tests/check.h"
#include <math.h>

#define LENGTH 0.08

/* The rate of a plate of which the gap h bears the mean pressure p: load over resistance, by Gauss's rule of 5 points along it. */
static double Rate(double p, double rho, double mu, double h, double closing, double dt)
{
  static const double X[5] = {0.0, 0.538469310105683, -0.538469310105683, 0.906179845938664,
                              -0.906179845938664},
                      W[5] = {0.568888888888889, 0.478628670499366, 0.478628670499366, 0.236926885056189,
                              0.236926885056189};
  double load = 0.0, resistance = 0.0;
  for (int k = 0; k < 5; k++) {
    const double part = 1.5 * (1.0 - X[k] * X[k]); /* of the mean pressure */
    const SqueezeFilm film = {.excess = p * part,
                              .profile = LENGTH * LENGTH / 12.0 * part,
                              .density = rho,
                              .viscosity = mu,
                              .gap = h,
                              .closing = closing};
    const SqueezeFilmYield yield = SqueezeFilmYieldOf(&film, dt);
    load += W[k] * yield.load;
    resistance += W[k] * yield.resistance;
  }
  return load > 0.0 ? load / resistance : 0.0;
}

static void Expect(double found, double expected, const char *what)
{
  CHECK(fabs(found - expected) <= 1e-9 * fabs(expected), "%s: %.12g instead of %.12g", what, found, expected);
}

int main(void)
{
  const double p = 1250.0, rho = 1000.0, h = 2e-3, k = sqrt(12.0 * p / rho) / LENGTH, dt = 1e-4;
  Expect(Rate(p, rho, 0.0, h, 0.0, dt), k * h, "inviscid");
  Expect(Rate(-p, rho, 0.0, h, 0.0, dt), 0.0, "held together");
  Expect(Rate(p, rho, 0.0, h, 0.25 * k * h, dt), k * (0.75 * h - 0.125 * k * h * dt), "it closes by itself");
  Expect(Rate(p, rho, 0.0, h, 2.0 * k * h, dt), 0.0, "it closes faster by itself");
  Expect(Rate(p, 1e-9, 1e3, h, 0.0, dt), h * h * h * p / (1e3 * LENGTH * LENGTH), "viscous");
  Expect(Rate(p, rho, 0.0, h, 0.0, 1.0), 0.5 * h, "a long step");
  return 0;
}
