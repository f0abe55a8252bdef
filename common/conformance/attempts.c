#include "common/conformance/attempts.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

const double AttemptKept[2][2] = {{1.0, 0.25}, {0.25, 1.0}};
const double AttemptTensor[2][2] = {{0.85, 0.15}, {0.15, 0.7}};

bool AttemptHasInertia(Kind kind)
{
  return kind == INERTIA || kind == KEPT || kind == COVERED;
}

double AttemptStep(const Fluid *f, Kind kind)
{
  return kind >= FREE && kind <= COVERED ? SHORT * f->kit->dt : f->kit->dt;
}

void AttemptTarget(const Fluid *f, Kind kind, double v[2])
{
  const double phase = KitPhase(f->kit), speed = hypot(f->w[0], f->w[1]);
  v[0] = speed * (cos(phase) + 0.5 * (kind == MORE));
  v[1] = speed * (sin(phase) - 0.25 * (kind == MORE));
}

static void SetBlocks(CoracleCoupling *c, Kind kind, double rho, double area, double dt)
{
  double a[3][3];
  const double factor = kind == HELD || kind == MORE || kind == AGAIN || kind == COEFFICIENT ? 9.0 : 0.0;
  PatchMass(area, factor * rho / dt, a);
  PatchMass(area, AttemptHasInertia(kind) ? 9.0 * rho / dt : 0.0, c->implicit_inertia);
  if (kind == INERTIA) c->kept[0][0] = c->kept[1][1] = 1.0;
  if (AttemptHasInertia(kind)) c->inertia_tensor[0][0] = c->inertia_tensor[1][1] = 1.0;
  if (kind == KEPT) {
    memcpy(c->kept, AttemptKept, sizeof c->kept);
    memcpy(c->inertia_tensor, AttemptTensor, sizeof c->inertia_tensor);
  }
  for (int d = 0; d < 2; d++)
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) c->a[d][i][d][j] = a[i][j];
}

/* s = factor rho B v/dt, and the bulk velocity's part where the disc is held */
static void SetLoads(CoracleCoupling *c, Kind kind, double rho, double area, double dt, const double v[2])
{
  const double factor = kind == COEFFICIENT || kind == BULK ? 0.0
                        : kind == SOURCE                    ? 1.0
                        : AttemptHasInertia(kind)           ? 10.0
                                                            : 9.0;
  const bool bulk = kind != SOURCE && kind != COEFFICIENT && !AttemptHasInertia(kind);
  if (bulk) PatchMass(area, 1.0, c->ms);
  for (int d = 0; d < 2; d++)
    for (int i = 0; i < 3; i++) {
      c->s[d][i] = factor * rho / dt * area / 3.0 * v[d];
      c->us[d][i] = bulk ? area / 3.0 * v[d] : 0.0;
    }
}

void AttemptSend(Fluid *f, Kind kind, CoracleAction action, int ncorrection)
{
  const Kit *k = f->kit;
  const Patch *p = &f->patch;
  const double dt = AttemptStep(f, kind);
  double v[2] = {f->w[0], f->w[1]};
  if (kind == HELD || kind == MORE || kind == AGAIN) AttemptTarget(f, kind, v);
  f->coupling = realloc(f->coupling, (size_t)p->ncoupled * sizeof *f->coupling + 1);
  for (int i = 0; i < p->ncoupled; i++) {
    const int e = p->coupled[i];
    CoracleCoupling *c = &f->coupling[i];
    *c = (CoracleCoupling){.element = e, .alpha = 1.0};
    if (AttemptHasInertia(kind)) c->flags |= CORACLE_HAS_INERTIA;
    if (kind == COVERED) c->flags |= CORACLE_IS_COVERED;
    for (int d = 0; d < 2; d++) c->velocity[d] = 0.5 * v[d]; /* at the step's start */
    SetBlocks(c, kind, p->rho[e], p->area[e], dt);
    SetLoads(c, kind, p->rho[e], p->area[e], dt, v);
  }
  ServerSendStep(k->server, k->t, action == CORACLE_STOP ? 0.0 : dt, action, ncorrection, f->correction);
  if (action != CORACLE_STOP) ServerSendCoupling(k->server, kind == FREE ? 0 : p->ncoupled, f->coupling);
}

void AttemptCorrection(Fluid *f)
{
  const Patch *p = &f->patch;
  const double *u = f->flow[HELD].u_projected;
  double v[2];
  AttemptTarget(f, HELD, v);
  f->correction = realloc(f->correction, (size_t)p->ncoupled * sizeof *f->correction + 1);
  memset(f->corrected, 0, sizeof f->corrected);
  for (int i = 0; i < p->ncoupled; i++) {
    const int e = p->coupled[i];
    double mass[3][3];
    PatchMass(p->area[e], 1.0, mass);
    f->correction[i] = (CoracleCorrection){.element = e};
    for (int d = 0; d < 2; d++)
      for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) f->correction[i].r[d][a] += mass[a][b] * (v[d] - u[6 * e + 3 * d + b]);
        f->corrected[d] += p->rho[e] * f->correction[i].r[d][a];
      }
  }
  MPI_Allreduce(MPI_IN_PLACE, f->corrected, 2, MPI_DOUBLE, MPI_SUM, f->kit->comm);
  PatchMomentum(f->kit, p, u, f->momentum);
}
