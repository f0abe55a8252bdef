/* What the fluid sees, piece by piece (a body that has not come apart is one).
 *
 * Where the fluid's step resolves the waves in a piece it sees the velocities as they are, and every node
 * is compliant by itself (coracle.h, CoracleSetInertia): the exchange is implicit.  Any other piece is compliant as
 * a whole only: the fluid sees its rigid motion at the step's end, and of its deformation what the step can
 * resolve.  That exchange answers a vibration about one and a half steps late; late by more than half a
 * period the answer drives the vibration instead of damping it. */
#include "solid/solid_impl.h"

/* Deformation slower than the first is seen whole, faster than the second not at all: omega dt. */
#define DEFORMATION_KEPT 0.1
#define DEFORMATION_DROPPED 0.25
/* Waves are resolved up to w dt, w the bound on the fastest vibration that substeps obey: 1.5 to 2.5 times
 * the real one. */
#define RESOLVED 12.0

/* Sums over a piece: mass, m x; m v, m x cross v, m |x|^2, v the velocity now; and the same two of the mean
 * velocity.  Then of the mean's deformation d: m |d|^2, and int 2 mu e:e + lambda (tr e)^2 of its strain rate
 * e. */
enum { M, MX, MY, MU, MV, SPIN, INERTIA, MEAN_U, MEAN_V, MEAN_SPIN, NSUMS };
enum { KINETIC, STRAIN, NENERGIES };

typedef struct {
  double centre[2], end[2], end_spin, mean[2], mean_spin;
} RigidMotion;

static void RigidVelocity(const double centre[2], const double v[2], double omega, const double x[2],
                          double u[2])
{
  u[0] = v[0] - omega * (x[1] - centre[1]);
  u[1] = v[1] + omega * (x[0] - centre[0]);
}

static double MeanVelocity(const Solid s, int i)
{
  return (s->x[i] - s->start[i]) / s->dt;
}

static void AddMotion(const Solid s, const int piece[], double sum[][NSUMS])
{
  for (int i = 0; i < s->nnodes; i++) {
    if (!SubdomainOwns(s->subdomain, i)) continue;
    double *k = sum[piece[i]];
    const double m = s->mass[i], *x = s->x + 2 * i, *v = s->v + 2 * i;
    const double mean[2] = {MeanVelocity(s, 2 * i), MeanVelocity(s, 2 * i + 1)};
    k[M] += m;
    for (int c = 0; c < 2; c++) {
      k[MX + c] += m * x[c];
      k[MU + c] += m * v[c];
      k[MEAN_U + c] += m * mean[c];
    }
    k[SPIN] += m * (x[0] * v[1] - x[1] * v[0]);
    k[MEAN_SPIN] += m * (x[0] * mean[1] - x[1] * mean[0]);
    k[INERTIA] += m * (x[0] * x[0] + x[1] * x[1]);
  }
}

/* The rigid motions with the pieces' momentum and angular momentum, of the velocity now and of the mean. */
static PetscErrorCode RigidMotions(const Solid s, int n, const int piece[], RigidMotion motion[])
{
  double(*sum)[NSUMS];
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)n, &sum));
  AddMotion(s, piece, sum);
  if (s->size > 1) PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, NSUMS * n, MPI_DOUBLE, MPI_SUM, s->comm));
  for (int b = 0; b < n; b++) {
    const double *k = sum[b], x = k[MX] / k[M], y = k[MY] / k[M];
    const double inertia = k[INERTIA] - (x * k[MX] + y * k[MY]);
    motion[b] = (RigidMotion){.centre = {x, y},
                              .end = {k[MU] / k[M], k[MV] / k[M]},
                              .end_spin = (k[SPIN] - (x * k[MV] - y * k[MU])) / inertia,
                              .mean = {k[MEAN_U] / k[M], k[MEAN_V] / k[M]},
                              .mean_spin = (k[MEAN_SPIN] - (x * k[MEAN_V] - y * k[MEAN_U])) / inertia};
  }
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}

/* seen = the deformation's share of the mean velocity */
static void Deformation(const Solid s, const int piece[], const RigidMotion motion[])
{
  for (int i = 0; i < s->nnodes; i++) {
    const RigidMotion *r = motion + piece[i];
    double rigid[2];
    RigidVelocity(r->centre, r->mean, r->mean_spin, s->x + 2 * i, rigid);
    for (int c = 0; c < 2; c++) s->interface_velocity[2 * i + c] = MeanVelocity(s, 2 * i + c) - rigid[c];
  }
}

/* 2 mu e:e + lambda (tr e)^2 times the area, e the symmetric gradient of d on element k as it is now */
static double StrainPower(const Elements *e, int k, const double x[], const double d[])
{
  double g[2][2] = {{0}}, area = 0.0;
  for (int i = 0; i < 3; i++) {
    const double *p = x + 2 * e->node[(i + 1) % 3][k], *q = x + 2 * e->node[(i + 2) % 3][k];
    const double *di = d + 2 * e->node[i][k], normal[2] = {p[1] - q[1], q[0] - p[0]};
    area += 0.5 * (p[0] * q[1] - q[0] * p[1]);
    for (int c = 0; c < 2; c++)
      for (int b = 0; b < 2; b++) g[c][b] += di[c] * normal[b];
  }
  const double shear = 0.5 * (g[0][1] + g[1][0]), trace = g[0][0] + g[1][1];
  const double square = g[0][0] * g[0][0] + g[1][1] * g[1][1] + 2.0 * shear * shear;
  const double mu = e->mu[k], lambda = e->lambda[k];
  const double bulk = e->plane_stress[k] > 0.0 ? 2.0 * lambda * mu / (lambda + 2.0 * mu) : lambda;
  return (2.0 * mu * square + bulk * trace * trace) / (4.0 * area);
}

/* share[b]: how much of piece b's deformation is seen, by its Rayleigh quotient omega^2 = strain power / (m
 * |d|^2): never below the square of the piece's slowest vibration, whatever the deformation.  Living joints
 * are springs of it. */
static PetscErrorCode DeformationFactors(const Solid s, int n, const int piece[], double factor[])
{
  double(*sum)[NENERGIES];
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)n, &sum));
  for (int i = 0; i < s->nnodes; i++) {
    const double *d = s->interface_velocity + 2 * i;
    if (SubdomainOwns(s->subdomain, i)) sum[piece[i]][KINETIC] += s->mass[i] * (d[0] * d[0] + d[1] * d[1]);
  }
  for (int k = 0; k < s->elements.n; k++)
    sum[piece[s->element[3 * k]]][STRAIN] += StrainPower(&s->elements, k, s->x, s->interface_velocity);
  JointsAddStrainPower(s->joints, s, s->interface_velocity, piece, NENERGIES, &sum[0][STRAIN]);
  if (s->size > 1)
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, NENERGIES * n, MPI_DOUBLE, MPI_SUM, s->comm));
  for (int b = 0; b < n; b++) {
    const double omega = sum[b][KINETIC] > 0.0 ? sqrt(sum[b][STRAIN] / sum[b][KINETIC]) : 0.0;
    factor[b] = fmin(
        1.0, fmax(0.0, (DEFORMATION_DROPPED - omega * s->dt) / (DEFORMATION_DROPPED - DEFORMATION_KEPT)));
  }
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}

/* resolved[b]: a step of dt resolves the waves in piece b; *any of them, on all ranks. */
static PetscErrorCode FindResolved(const Solid s, int n, const int piece[], PetscBool resolved[],
                                   PetscBool *any)
{
  double *fastest; /* w^2 */
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)n, &fastest));
  for (int k = 0; k < s->elements.n; k++) {
    const int b = piece[s->element[3 * k]];
    fastest[b] = fmax(fastest[b], SolidElementRates(s, k).stiffness);
  }
  if (s->size > 1) PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, fastest, n, MPI_DOUBLE, MPI_MAX, s->comm));
  *any = PETSC_FALSE;
  for (int b = 0; b < n; b++) {
    resolved[b] = (PetscBool)(sqrt(fastest[b]) * s->dt < RESOLVED);
    if (resolved[b]) *any = PETSC_TRUE;
  }
  PetscCall(PetscFree(fastest));
  PetscFunctionReturn(0);
}

static void SetNodeMotion(Solid s, int i, const double force[2])
{
  s->mobility[i] = s->inverse_mass[i];
  for (int c = 0; c < 2; c++) {
    const double gravity = s->inverse_mass[i] > 0.0 ? s->setup.gravity[c] : 0.0;
    s->interface_velocity[2 * i + c] = s->v[2 * i + c];
    s->acceleration[2 * i + c] = s->inverse_mass[i] * force[c] + gravity;
  }
}

/* seen: the mean deformation until now */
static void SetRigidMotion(Solid s, int i, const RigidMotion *r, double factor)
{
  double rigid[2];
  RigidVelocity(r->centre, r->end, r->end_spin, s->x + 2 * i, rigid);
  s->mobility[i] = 0.0;
  for (int c = 0; c < 2; c++) {
    s->interface_velocity[2 * i + c] = rigid[c] + factor * s->interface_velocity[2 * i + c];
    s->acceleration[2 * i + c] = 0.0;
  }
}

PetscErrorCode SolidUpdateInterfaceMotion(Solid s, InterfaceMotion *interface)
{
  const double *force = NULL;
  RigidMotion *motion;
  PetscBool *resolved, any;
  double *factor;
  const int *piece;
  int n;
  PetscFunctionBeginUser;
  PetscCall(SolidPieces(s, &n, &piece));
  PetscCall(PetscMalloc3((size_t)n, &motion, (size_t)n, &factor, (size_t)n, &resolved));
  PetscCall(RigidMotions(s, n, piece, motion));
  Deformation(s, piece, motion);
  PetscCall(DeformationFactors(s, n, piece, factor));
  PetscCall(FindResolved(s, n, piece, resolved, &any));
  if (any) PetscCall(SolidForces(s, &force));
  for (int i = 0; i < s->nnodes; i++) {
    const int b = piece[i];
    if (resolved[b])
      SetNodeMotion(s, i, force + 2 * i);
    else
      SetRigidMotion(s, i, motion + b, factor[b]);
  }
  PetscCall(PetscFree3(motion, factor, resolved));
  SolidGetInterfaceMotion(s, interface);
  PetscFunctionReturn(0);
}

void SolidGetInterfaceMotion(Solid s, InterfaceMotion *interface)
{
  *interface = (InterfaceMotion){s->interface_velocity, s->mobility, s->acceleration};
}
