/* The interface between two phases as a polygon. */
#include "fluid/phases/phases_impl.h"

int PhasesCrossing(Phases f, int e, int i, double x[2])
{
  const double *a = f->stars->element[e].x[(i + 1) % 3], *b = f->stars->element[e].x[(i + 2) % 3];
  const HalfPlane line = PhasesLine(f, e, 0, a);
  const double da = -line.d, db = line.n[0] * (b[0] - a[0]) + line.n[1] * (b[1] - a[1]) - line.d;
  if ((da > 0.0) == (db > 0.0)) return 0;
  for (int c = 0; c < 2; c++) x[c] = a[c] + da / (da - db) * (b[c] - a[c]);
  return 1;
}

/* The face of the neighbour o that it shares with element e. */
static int FaceTowards(const Stars *s, int o, int e)
{
  int j = 0;
  while (j < 2 && s->neighbor[o][j] != e) j++;
  return j;
}

/* Between its ends on the faces of cut element e. */
static double Length(Phases f, int e)
{
  double end[3][2], other[2];
  int n = 0;
  for (int i = 0; i < 3; i++) {
    const int o = f->stars->neighbor[e][i];
    if (!PhasesCrossing(f, e, i, end[n])) continue;
    if (o >= 0 && f->single[o] < 0 && PhasesCrossing(f, o, FaceTowards(f->stars, o, e), other))
      for (int c = 0; c < 2; c++) end[n][c] = 0.5 * (end[n][c] + other[c]);
    n++;
  }
  return n > 1 ? hypot(end[1][0] - end[0][0], end[1][1] - end[0][1]) : 0.0;
}

PetscErrorCode PhasesInterfaceLength(Phases f, double *length)
{
  const Stars *s = f->stars;
  PetscFunctionBeginUser;
  PetscCheck(f->has_lines && f->np == 2, s->mesh->comm, PETSC_ERR_ORDER,
             "the interface's length needs two phases, and their lines: call PhasesReconstruct");
  *length = 0.0;
  for (int e = 0; e < s->ne; e++)
    if (f->single[e] < 0) *length += Length(f, e);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, length, 1, MPI_DOUBLE, MPI_SUM, s->mesh->comm));
  PetscFunctionReturn(0);
}
