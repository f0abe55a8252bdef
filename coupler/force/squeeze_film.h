/* The film of fluid in a gap that closes (uplift.h): how fast it lets its two sides come together.
 *
 * A gap thinner than an element cannot lose its fluid in the fluid's solve, which holds the two sides apart by a pressure whose excess e over
 * the head at the gap's ends is that of the film.  In nature that pressure drives the fluid out.  With s along a gap of width h whose sides approach
 * with w = k h, k the same in the whole gap, fluid leaves with v(s), dv/ds = k; the momentum of the film, plug flow with the friction of Poiseuille's,
 *
 *     -de/ds  =  rho v dv/ds + 12 mu v/h^2     so that     e  =  (rho k^2 + 12 mu k/h^2) profile(s),     -d2 profile/ds2 = 1,  0 at the ends
 *
 * (gap_head.h).  Friction counts as that of a gap of SQUEEZE_FILM_ROUGHNESS times half of its length at least, as between rough surfaces: a film between
 * smooth ones would never be gone.  At each close point k follows from e, rho and mu there.  A block of 8 cm on water that presses with 1250 Pa on it sinks as
 * exp(-48 t/s).  What is handed to the solid are, of all close points,
 *
 *     load_i  =  int N_i r (w - v) n  >=  0,       resistance_i  =  int N_i r/share (n n + SQUEEZE_FILM_ALONG t t),       r = e/w,
 *
 * whose balance over a body gives its rigid motion beside its velocity (CoracleGetFilm): the fluid and the forces do not see it.  v is the velocity with
 * which the sides come together as it is; sides that part have no load: there e > 0 is what stops the fluid that comes in (rho k^2 is the same for k < 0), and a film that
 * yielded to it held a light block down that rises from a floor.  A film that holds sides together, e < 0, does not yield: bodies that lie on each other under water
 * would be lifted off their contacts.  So an e that swings about 0 draws a body that does not part to a wall that it is close to.
 * share: 1/2 where both sides are free to move.  The part along the surface, t, which a film has not, is for facets of one gap whose normals
 * differ by little: their loads would move a body along it.  A step closes at most half of a gap. */
#ifndef CORACLE_COUPLER_SQUEEZE_FILM_H
#define CORACLE_COUPLER_SQUEEZE_FILM_H

#define SQUEEZE_FILM_ALONG 0.1
#define SQUEEZE_FILM_ROUGHNESS 0.005

/* At a close point. */
typedef struct {
  double excess;             /* e, Pa */
  double profile;            /* m2 */
  double density, viscosity; /* of the fluid beside, kg/m3, Pa s */
  double gap;                /* h in the middle of the step, m */
  double closing;            /* the velocity with which the sides come together as it is, m/s */
} SqueezeFilm;

typedef struct {
  double load, resistance; /* Pa, Pa s/m; neither is negative */
} SqueezeFilmYield;

/* Of a step of dt. */
SqueezeFilmYield SqueezeFilmYieldOf(const SqueezeFilm *film, double dt);
#endif
