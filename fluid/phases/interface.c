/* The interface of a phase as a polygon. */
#include "fluid/phases/phases_impl.h"

#define ON_EDGE 1e-9 /* of an edge: a point this near to it is on it */

int PhasesCrossing(Phases f, int e, int k, int i, double x[2])
{
  const double *a = f->stars->element[e].x[(i + 1) % 3], *b = f->stars->element[e].x[(i + 2) % 3];
  const HalfPlane line = PhasesLine(f, e, k, a);
  const double da = -line.d, db = line.n[0] * (b[0] - a[0]) + line.n[1] * (b[1] - a[1]) - line.d;
  if ((da > 0.0) == (db > 0.0)) return 0;
  for (int c = 0; c < 2; c++) x[c] = a[c] + da / (da - db) * (b[c] - a[c]);
  return 1;
}

/* Of line k, the only one of element e, between its ends on the faces. */
static double LineLength(Phases f, int e, int k)
{
  double end[3][2], other[2];
  int n = 0;
  for (int i = 0; i < 3; i++) {
    const int o = f->stars->neighbor[e][i];
    if (!PhasesCrossing(f, e, k, i, end[n])) continue;
    if (o >= 0 && PhasesHasLine(f, o, k) && PhasesCrossing(f, o, k, StarsFaceTo(f->stars, o, e), other))
      for (int c = 0; c < 2; c++) end[n][c] = 0.5 * (end[n][c] + other[c]);
    n++;
  }
  return n > 1 ? hypot(end[1][0] - end[0][0], end[1][1] - end[0][1]) : 0.0;
}

/* Distance of x from the line through a and b, as a share of their distance. */
static double Off(const double a[2], const double b[2], const double x[2])
{
  const double t[2] = {b[0] - a[0], b[1] - a[1]};
  return fabs(t[0] * (x[1] - a[1]) - t[1] * (x[0] - a[0])) / (t[0] * t[0] + t[1] * t[1]);
}

/* Of the outline of phase p in element e, what is not the element's. */
static double InnerOutline(Phases f, int e, int p)
{
  const double(*x)[2] = (const double(*)[2])f->stars->element[e].x;
  Polygon part, whole;
  double length = 0.0;
  PhasesPart(f, e, p, x[0], &part);
  PolygonTriangle(x, x[0], &whole);
  for (int k = 0; k < part.n; k++) {
    const double *a = part.x[k], *b = part.x[(k + 1) % part.n];
    int on = 0;
    for (int i = 0; i < 3; i++) {
      const double *u = whole.x[i], *w = whole.x[(i + 1) % 3];
      on |= Off(u, w, a) < ON_EDGE && Off(u, w, b) < ON_EDGE;
    }
    if (!on) length += hypot(b[0] - a[0], b[1] - a[1]);
  }
  return length;
}

/* Of phase p in element e. */
static double Length(Phases f, int e, int p)
{
  int n = 0, line = -1;
  for (int k = 0; k + 1 < f->np; k++)
    if (PhasesHasLine(f, e, k)) line = k, n++;
  if (n > 1) return InnerOutline(f, e, p);
  if (!n || PhasesHasFragments(f, e)) return 0.0;
  return p == line || p == PhasesBehind(f, e, line) ? LineLength(f, e, line) : 0.0;
}

PetscErrorCode PhasesInterfaceLength(Phases f, int phase, double *length)
{
  const Stars *s = f->stars;
  PetscFunctionBeginUser;
  PetscCheck(f->has_lines, s->mesh->comm, PETSC_ERR_ORDER,
             "the interface's length needs the lines: call PhasesReconstruct");
  *length = 0.0;
  for (int e = 0; e < s->ne; e++) *length += Length(f, e, phase);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, length, 1, MPI_DOUBLE, MPI_SUM, s->mesh->comm));
  PetscFunctionReturn(0);
}
