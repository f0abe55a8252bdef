#include "fluid/discretization/boundary.h"

PetscErrorCode BoundaryBoxes(const Mesh *m, Boundary boundary[])
{
  PetscFunctionBeginUser;
  for (int b = 0; b < m->ntags; b++) {
    double lower[2] = {PETSC_MAX_REAL, PETSC_MAX_REAL}, upper[2] = {PETSC_MIN_REAL, PETSC_MIN_REAL};
    for (int e = 0; e < m->ne; e++)
      for (int i = 0; i < 3; i++)
        for (int k = 1; k < 3 && m->tag[3 * e + i] == b; k++)
          for (int c = 0; c < 2; c++) {
            const double x = m->x[2 * m->vertex[3 * e + (i + k) % 3] + c];
            lower[c] = PetscMin(lower[c], x);
            upper[c] = PetscMax(upper[c], x);
          }
    PetscCallMPI(MPI_Allreduce(lower, boundary[b].lower, 2, MPI_DOUBLE, MPI_MIN, m->comm));
    PetscCallMPI(MPI_Allreduce(upper, boundary[b].upper, 2, MPI_DOUBLE, MPI_MAX, m->comm));
  }
  PetscFunctionReturn(0);
}

/* Of a table that repeats itself, unless the period is 0. */
static double Repeated(const TimeTable *table, double period, double t)
{
  return TimeTableValue(table, 1, period > 0.0 ? t - period * floor(t / period) : t);
}

double BoundaryFactor(const Boundary *b, double t)
{
  double factor = t < b->rise && b->rise > 0.0 ? 0.5 * (1.0 - cos(M_PI * fmax(t, 0.0) / b->rise)) : 1.0;
  if (b->factor.nrows)
    factor *= Repeated(&b->factor, b->period, t);
  else if (b->period > 0.0)
    factor *= sin(2.0 * M_PI * t / b->period);
  return factor;
}

double BoundaryLevel(const BoundaryPhases *b, int k, double t)
{
  return b->level_table[k].nrows ? Repeated(&b->level_table[k], b->level_period, t) : b->level[k];
}

PetscBool BoundaryVaries(const Boundary *b)
{
  for (int k = 0; k < b->phases.nlevels; k++)
    if (b->phases.level_table[k].nrows) return PETSC_TRUE;
  return (PetscBool)(b->rise > 0.0 || b->factor.nrows || b->period > 0.0);
}

/* The coordinate along b. */
static int Along(const Boundary *b)
{
  return b->upper[0] - b->lower[0] > b->upper[1] - b->lower[1] ? 0 : 1;
}

void BoundaryVelocity(const Boundary *b, double t, const double x[2], double v[2])
{
  if (b->function) {
    b->function(b->context, t, x, v);
    return;
  }
  const int along = Along(b);
  double scale = BoundaryFactor(b, t);
  if (b->parabolic) {
    const double s = (x[along] - b->lower[along]) / (b->upper[along] - b->lower[along]);
    scale *= 4.0 * s * (1.0 - s);
  }
  if (b->profile.nrows) scale *= TimeTableValue(&b->profile, 1, x[along]);
  for (int c = 0; c < 2; c++) v[c] = scale * b->velocity[c];
}

void BoundaryProjection(const Boundary *b, const double n[2], double project[2][2])
{
  for (int c = 0; c < 2; c++)
    for (int d = 0; d < 2; d++)
      project[c][d] = b->kind == BOUNDARY_FREE_SLIP  ? n[c] * n[d]
                      : b->kind == BOUNDARY_VELOCITY ? (double)(c == d)
                                                     : 0.0;
}

/* The volume that b takes through the part `begin` .. `end`, 0 .. 1, of the edge from -> to, m2/s, by Simpson's rule. */
static double PartFlux(const Boundary *b, const double from[2], const double to[2], double begin, double end,
                       double t)
{
  static const double WEIGHT[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
  double flux = 0.0, v[2];
  for (int k = 0; k < 3; k++) {
    const double s = begin + 0.5 * k * (end - begin);
    const double x[2] = {from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])};
    BoundaryVelocity(b, t, x, v);
    flux += WEIGHT[k] * BoundaryNormalPart(v, (const double[2]){to[1] - from[1], from[0] - to[0]});
  }
  return (end - begin) * flux;
}

/* The same of edge i of element e, exact for all profiles: in parts between the rows of a table. */
static double EdgeFlux(const Mesh *m, const Boundary *b, int e, int i, double t)
{
  const double *from = m->x + 2 * m->vertex[3 * e + (i + 1) % 3],
               *to = m->x + 2 * m->vertex[3 * e + (i + 2) % 3];
  const int c = Along(b), n = b->profile.nrows;
  double flux = 0.0, at = 0.0;
  for (int k = 0; k < n; k++) {
    const double row = TimeTableAt(&b->profile, to[c] > from[c] ? k : n - 1 - k, 0),
                 s = (row - from[c]) / (to[c] - from[c]);
    if (!(s > at && s < 1.0)) continue;
    flux += PartFlux(b, from, to, at, s, t);
    at = s;
  }
  return flux + PartFlux(b, from, to, at, 1.0, t);
}

PetscErrorCode BoundaryPrescribedFlux(const Mesh *m, Boundary boundary[], double t, double *net,
                                      double *gross)
{
  double sum[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  PetscCall(BoundaryBoxes(m, boundary));
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      if (m->neighbor[3 * e + i] >= 0 || boundary[m->tag[3 * e + i]].kind != BOUNDARY_VELOCITY) continue;
      const double flux = EdgeFlux(m, &boundary[m->tag[3 * e + i]], e, i, t);
      sum[0] += flux;
      sum[1] += fabs(flux);
    }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, m->comm));
  *net = sum[0];
  *gross = sum[1];
  PetscFunctionReturn(0);
}
