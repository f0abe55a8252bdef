/* The velocity that the fluid sees. */
#include "solid_impl.h"

/* Sums over a body of w, the velocity now less the mean: mass, m x, m w, m x cross w, m |x|^2. */
enum { M, MX, MY, MU, MV, SPIN, INERTIA, NSUMS };

static PetscErrorCode BodySums(const Solid s, const double w[], double sum[][NSUMS])
{
  PetscFunctionBeginUser;
  for (int i = 0; i < s->nnodes; i++) {
    if (!ShareOwns(s->share, i)) continue;
    double *k = sum[s->node_body[i]];
    const double m = s->mass[i], *x = s->x + 2 * i, *wi = w + 2 * i;
    k[M] += m;
    for (int c = 0; c < 2; c++) {
      k[MX + c] += m * x[c];
      k[MU + c] += m * wi[c];
    }
    k[SPIN] += m * (x[0] * wi[1] - x[1] * wi[0]);
    k[INERTIA] += m * (x[0] * x[0] + x[1] * x[1]);
  }
  if (s->size > 1)
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, NSUMS * s->nbodies, MPI_DOUBLE, MPI_SUM, s->comm));
  PetscFunctionReturn(0);
}

/* The rigid motion with the body's momentum and angular momentum, at x. */
static void RigidVelocity(const double k[NSUMS], const double x[2], double v[2])
{
  const double centre[2] = {k[MX] / k[M], k[MY] / k[M]};
  const double spin = k[SPIN] - (centre[0] * k[MV] - centre[1] * k[MU]);
  const double omega = spin / (k[INERTIA] - (centre[0] * k[MX] + centre[1] * k[MY]));
  v[0] = k[MU] / k[M] - omega * (x[1] - centre[1]);
  v[1] = k[MV] / k[M] + omega * (x[0] - centre[0]);
}

PetscErrorCode SolidSeenVelocity(Solid s, const double **seen)
{
  double(*sum)[NSUMS];
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)s->nbodies, &sum));
  for (int i = 0; i < 2 * s->nnodes; i++) s->seen[i] = s->v[i] - (s->x[i] - s->start[i]) / s->dt;
  PetscCall(BodySums(s, s->seen, sum));
  for (int i = 0; i < s->nnodes; i++) {
    double rigid[2];
    RigidVelocity(sum[s->node_body[i]], s->x + 2 * i, rigid);
    for (int c = 0; c < 2; c++)
      s->seen[2 * i + c] = (s->x[2 * i + c] - s->start[2 * i + c]) / s->dt + rigid[c];
  }
  PetscCall(PetscFree(sum));
  *seen = s->seen;
  PetscFunctionReturn(0);
}
