/* The monitor detects an added-mass instability within a few steps and accepts everything else: a fall, a
 * damped ringing, a bouncing body, a steady oscillation.  The iteration is that of explicit staggering: m (v'
 * - v)/dt = (m - m_f) g - m_a (v - v_old)/dt. */
#include "coupler/divergence_monitor.h"
#include "tests/supermesh/random_mesh.h"

enum { STEPS = 400 };

static const double DT = 0.001;
static double gravity = -9.81, flow = 0.0; /* of the runs to come, m/s2, m/s */
static double density = 1.0;               /* over the fluid's, of the body that the force moves */
static int held, max_iterations = 1;

/* Steps until divergence is detected, or STEPS; velocity(n) of step n. */
static int Watch(double (*velocity)(int n), char message[512])
{
  DivergenceMonitor monitor = {0};
  double v = velocity(0);
  for (int n = 0; n < STEPS; n++) {
    const double before = v, displaced = 2.0;
    if (n > 0) v = velocity(n);
    const DivergenceMonitorStep step = {.t = n * DT,
                                        .dt = DT,
                                        .velocity = {0.0, v},
                                        .force = {0.0, density * displaced * ((v - before) / DT - gravity)},
                                        .gravity = {0.0, gravity},
                                        .displaced = displaced,
                                        .speed = flow,
                                        .thickness = 1e-3,
                                        .held = held,
                                        .max_iterations = max_iterations,
                                        .extent = 5.0};
    if (DivergenceMonitorCheck(&monitor, &step, 512, message)) return n;
  }
  return STEPS;
}

static double AddedMass(int n, double ratio)
{
  static double v, change;
  if (n == 0) v = 0.0, change = -9.81 * DT;
  change = (ratio - 1.0) / ratio * -9.81 * DT - change / ratio;
  v += change;
  return v;
}

static double Light(int n)
{
  return AddedMass(n, 0.5);
}
static double VeryLight(int n)
{
  return AddedMass(n, 0.1);
}
static double Heavy(int n)
{
  return AddedMass(n, 2.0);
}
static double Ringing(int n)
{
  return 10.0 * (n % 2 ? 1.0 : -1.0) * pow(0.98, n);
}
static double Steady(int n)
{
  return n % 2 ? 3.0 : -3.0;
}
static double Bounce(int n)
{
  return (n / 20 % 2 ? 1.0 : -1.0) * (1.0 + 0.01 * n);
}
static double Noise(int n)
{
  return 1e-9 * (n % 2 ? 1.0 : -1.0) * pow(1.2, n % 40);
}
/* Round-off of a light solid at rest: twenty times as much in each step, until coupling iterations stop it. */
static double RoundOff(int n)
{
  const int grows = n % 10;
  return 1e-14 * (n % 2 ? 1.0 : -1.0) * pow(20.0, grows);
}
/* The mean velocity of clamped leaflets in a flow that begins: changes of 4e-5, -2.5e-4, 7.3e-3, -1.3e-2 m/s, then of less. */
static double Leaflets(int n)
{
  static const double CHANGE[] = {4e-5, -2.5e-4, 7.3e-3, -1.3e-2, 5e-3, 1e-3};
  double v = 0.0;
  for (int k = 0; k < n; k++) v += CHANGE[k % 6];
  return v;
}
static double NotANumber(int n)
{
  return n < 7 ? 0.0 : NAN;
}
static double Runaway(int n)
{
  return pow(1.5, n);
}

int main(void)
{
  char message[512] = "";
  density = 0.5;
  const int light = Watch(Light, message);
  CHECK(light < 25, "a ratio of 0.5 was stopped at step %d only", light);
  CHECK(strstr(message, "density ratio of about 0.5 ") && strstr(message, "coupler.max_iterations"),
        "message: %s", message);
  held = 1;
  CHECK(Watch(Light, message) == light && !strstr(message, "density") && strstr(message, "damping") &&
            strstr(message, "coupler.max_iterations"),
        "what is held has no density ratio: %s", message);
  held = 0;
  max_iterations = 30;
  density = -0.12; /* another force is larger than the fluid's */
  CHECK(Watch(Light, message) == light && !strstr(message, "density") && strstr(message, "time.dt_max") &&
            !strstr(message, "coupler.max_iterations"),
        "a negative density ratio: %s", message);
  max_iterations = 1;
  density = 0.1;
  CHECK(Watch(VeryLight, message) <= 5 && strstr(message, "density ratio"), "ratio 0.1: %s", message);
  CHECK(Watch(Heavy, message) == STEPS, "ratio 2: %s", message);
  CHECK(Watch(Ringing, message) == STEPS, "ringing: %s", message);
  CHECK(Watch(Steady, message) == STEPS, "steady: %s", message);
  CHECK(Watch(Bounce, message) == STEPS, "bounce: %s", message);
  CHECK(Watch(Noise, message) == STEPS, "noise: %s", message);
  gravity = 0.0;
  CHECK(Watch(RoundOff, message) == STEPS, "round-off at rest: %s", message);
  flow = 1.0; /* without gravity it is the flow's energy that a vibration is beside */
  CHECK(Watch(Noise, message) == STEPS, "noise in a flow: %s", message);
  flow = 0.05;
  CHECK(Watch(Leaflets, message) == STEPS, "leaflets: %s", message);
  flow = 1.0;
  CHECK(Watch(VeryLight, message) < 15 && strstr(message, "density ratio"), "a blow-up in a flow: %s",
        message);
  CHECK(Watch(NotANumber, message) == 7 && strstr(message, "not a number"), "message: %s", message);
  CHECK(Watch(Runaway, message) < 25 && strstr(message, "whole domain"), "message: %s", message);
  return 0;
}
