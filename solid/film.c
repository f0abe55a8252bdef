/* Films of fluid between bodies that are about to touch let them come together (SolidSetFilm, coracle.h).
 *
 * A piece that moves freely gets over the step, beside what its velocity does, the rigid motion w = u + omega x (x - c) for which
 *
 *     sum_i load_i  =  sum_i resistance_i w(x_i),        the same of moments about c,
 *
 * and of those the one with the least kinetic energy, by LEAST of the resistance in every motion.  c is the mass centre.  What is fixed or
 * prescribed in one direction moves in the other, without turning. */
#include "solid/solid_impl.h"

#define LEAST 1e-9

/* Of a piece: its mass, mass x, what holds its nodes in either direction. */
enum { MASS, CENTRE, HELD = CENTRE + 2, NPLACE = HELD + 2 };
/* About its mass centre: the films' load and moment, the symmetric matrix of resistance for (u_x, u_y, omega); moment of inertia. */
enum { LOAD, MOMENT = LOAD + 2, XX, XY, YY, XT, YT, TT, INERTIA, NFILM };

typedef struct {
  double centre[2], u[2], omega;
} RigidMotion;

static void AddPlace(const Solid s, const int piece[], double place[][NPLACE])
{
  for (int i = 0; i < s->nnodes; i++) {
    double *p = place[piece[i]];
    if (!SolidOwns(s, i)) continue;
    p[MASS] += s->mass[i];
    for (int c = 0; c < 2; c++) {
      p[CENTRE + c] += s->mass[i] * s->x[2 * i + c];
      p[HELD + c] += s->inverse_mass[i] == 0.0;
    }
  }
  for (int k = 0; k < s->nprescribed; k++) {
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    for (int c = 0; c < 2; c++)
      place[piece[s->prescribed[k].node]][HELD + c] += d->prescribed[c] && PrescribedActs(d, s->stats.t);
  }
}

static void AddFilm(const Solid s, const int piece[], const double place[][NPLACE], double film[][NFILM])
{
  for (int i = 0; i < s->nnodes; i++) {
    const double *p = place[piece[i]], *f = s->film_load + 2 * i, *r = s->film_resistance + 4 * i;
    const double arm[2] = {p[CENTRE + 1] / p[MASS] - s->x[2 * i + 1], s->x[2 * i] - p[CENTRE] / p[MASS]},
                 turned[2] = {r[0] * arm[0] + r[1] * arm[1], r[2] * arm[0] + r[3] * arm[1]};
    double *k = film[piece[i]];
    for (int c = 0; c < 2; c++) {
      k[LOAD + c] += f[c];
      k[MOMENT] += arm[c] * f[c];
      k[XT + c] += turned[c];
      k[TT] += arm[c] * turned[c];
    }
    k[XX] += r[0];
    k[XY] += r[1];
    k[YY] += r[3];
    if (SolidOwns(s, i)) k[INERTIA] += s->mass[i] * (arm[0] * arm[0] + arm[1] * arm[1]);
  }
}

/* x = a^-1 b, a symmetric and positive definite. */
static void Solve(double a[3][3], const double b[3], double x[3])
{
  for (int i = 0; i < 3; i++) { /* a becomes its Cholesky factor */
    for (int j = 0; j <= i; j++) {
      for (int k = 0; k < j; k++) a[i][j] -= a[i][k] * a[j][k];
      a[i][j] = i == j ? sqrt(a[i][j]) : a[i][j] / a[j][j];
    }
    x[i] = b[i];
    for (int k = 0; k < i; k++) x[i] -= a[i][k] * x[k];
    x[i] /= a[i][i];
  }
  for (int i = 2; i >= 0; i--) {
    for (int k = i + 1; k < 3; k++) x[i] -= a[k][i] * x[k];
    x[i] /= a[i][i];
  }
}

static RigidMotion MotionOf(const double place[NPLACE], const double film[NFILM])
{
  const double rate = (film[XX] + film[YY]) / place[MASS];
  const PetscBool held[2] = {place[HELD] > 0.0, place[HELD + 1] > 0.0};
  RigidMotion m = {.centre = {place[CENTRE] / place[MASS], place[CENTRE + 1] / place[MASS]}};
  double a[3][3] = {
      {film[XX], film[XY], film[XT]}, {film[XY], film[YY], film[YT]}, {film[XT], film[YT], film[TT]}};
  double b[3] = {film[LOAD], film[LOAD + 1], film[MOMENT]}, x[3];
  if (rate == 0.0) return m;
  for (int i = 0; i < 3; i++) {
    a[i][i] += LEAST * rate * (i < 2 ? place[MASS] : film[INERTIA]);
    if (i < 2 ? !held[i] : !held[0] && !held[1]) continue;
    for (int j = 0; j < 3; j++) a[i][j] = a[j][i] = 0.0;
    a[i][i] = 1.0;
    b[i] = 0.0;
  }
  Solve(a, b, x);
  m.u[0] = x[0];
  m.u[1] = x[1];
  m.omega = x[2];
  return m;
}

PetscErrorCode SolidMoveFilms(Solid s)
{
  const int *piece;
  double(*place)[NPLACE], (*film)[NFILM];
  RigidMotion *motion;
  int n;

  PetscFunctionBeginUser;
  if (!s->film_load) PetscFunctionReturn(0);
  PetscCall(SolidPieces(s, &n, &piece));
  PetscCall(PetscCalloc3((size_t)n, &place, (size_t)n, &film, (size_t)n, &motion));
  AddPlace(s, piece, place);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, place, n * NPLACE, MPI_DOUBLE, MPI_SUM, s->comm));
  AddFilm(s, piece, (const double(*)[NPLACE])place, film);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, film, n * NFILM, MPI_DOUBLE, MPI_SUM, s->comm));
  for (int k = 0; k < n; k++) motion[k] = MotionOf(place[k], film[k]);
  for (int i = 0; i < s->nnodes; i++) {
    const RigidMotion m = motion[piece[i]];
    if (m.u[0] == 0.0 && m.u[1] == 0.0 && m.omega == 0.0) continue;
    const double cosine = cos(s->dt * m.omega), sine = sin(s->dt * m.omega),
                 r[2] = {s->x[2 * i] - m.centre[0], s->x[2 * i + 1] - m.centre[1]};
    s->x[2 * i] = m.centre[0] + s->dt * m.u[0] + cosine * r[0] - sine * r[1];
    s->x[2 * i + 1] = m.centre[1] + s->dt * m.u[1] + sine * r[0] + cosine * r[1];
  }
  s->film_load = s->film_resistance = NULL;
  s->force_valid = PETSC_FALSE;
  PetscCall(PetscFree3(place, film, motion));
  PetscFunctionReturn(0);
}

void SolidSetFilm(Solid s, const double load[], const double resistance[])
{
  s->film_load = load;
  s->film_resistance = resistance;
}
