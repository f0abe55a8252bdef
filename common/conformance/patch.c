#include "common/conformance/patch.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 400 }; /* of the box, in which elements are counted */

static double Cross(const double a[2], const double b[2], const double c[2])
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static void Place(const Kit *k, bool moved, Patch *p)
{
  memcpy(p->box, k->box, sizeof p->box);
  for (int i = 0; moved && i < 4; i += 2) p->box[i] += 0.25 * (k->box[2] - k->box[0]);
  for (int d = 0; d < 2; d++) p->centre[d] = 0.5 * (p->box[d] + p->box[2 + d]);
  p->radius = 0.3 * fmin(p->box[2] - p->box[0], p->box[3] - p->box[1]);
  if (!(p->radius > 0.0)) ServerFail(k->server, "conformance: coupler.conformance.box is empty");
}

static void CheckElement(const Kit *k, const Patch *p, int e)
{
  const double *x = p->x + 6 * e;
  if (!(p->area[e] > 0.0))
    ServerFail(k->server,
               "conformance: element (%g, %g) (%g, %g) (%g, %g) has area %g m2: its vertices must be in "
               "counter-clockwise order",
               x[0], x[1], x[2], x[3], x[4], x[5], p->area[e]);
  for (int d = 0; d < 2; d++) {
    const double lower = fmin(fmin(x[d], x[2 + d]), x[4 + d]), upper = fmax(fmax(x[d], x[2 + d]), x[4 + d]);
    if (lower > p->box[2 + d] || upper < p->box[d])
      ServerFail(k->server,
                 "conformance: element (%g, %g) (%g, %g) (%g, %g) is not in the box (%g, %g) to (%g, %g) "
                 "that was asked for",
                 x[0], x[1], x[2], x[3], x[4], x[5], p->box[0], p->box[1], p->box[2], p->box[3]);
  }
}

/* Each point of the box is in one element, or, in a fluid that is not everywhere, in none. */
static void CheckCover(const Kit *k, const Patch *p)
{
  int count[POINTS] = {0}, missing = 0;
  for (int i = 0; i < POINTS; i++) {
    const double y[2] = {p->box[0] + fmod(0.7548776662 * (i + 1), 1.0) * (p->box[2] - p->box[0]),
                         p->box[1] + fmod(0.5698402910 * (i + 1), 1.0) * (p->box[3] - p->box[1])};
    for (int e = 0; e < p->n; e++) {
      const double *a = p->x + 6 * e, *b = a + 2, *c = a + 4;
      count[i] += Cross(a, b, y) > 0.0 && Cross(b, c, y) > 0.0 && Cross(c, a, y) > 0.0;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, count, POINTS, MPI_INT, MPI_SUM, k->comm);
  for (int i = 0; i < POINTS; i++) {
    if (count[i] > 1)
      ServerFail(k->server, "conformance: %d elements are in one place: each must be given once, by one rank",
                 count[i]);
    missing += count[i] == 0;
  }
  if (missing > POINTS / 20 && k->rank == 0)
    printf("conformance: note: no element covers %d %% of the box\n", 100 * missing / POINTS);
}

static void FindCoupled(const Kit *k, Patch *p)
{
  int all;
  p->ncoupled = 0;
  for (int e = 0; e < p->n; e++) {
    const double *x = p->x + 6 * e;
    const double d[2] = {(x[0] + x[2] + x[4]) / 3.0 - p->centre[0],
                         (x[1] + x[3] + x[5]) / 3.0 - p->centre[1]};
    if (hypot(d[0], d[1]) < p->radius) p->coupled[p->ncoupled++] = e;
  }
  MPI_Allreduce(&p->ncoupled, &all, 1, MPI_INT, MPI_SUM, k->comm);
  if (all == 0)
    ServerFail(k->server,
               "conformance: the fluid has no element within %g m of (%g, %g): give coupler.conformance.box "
               "where it has some",
               p->radius, p->centre[0], p->centre[1]);
}

void PatchAsk(Kit *k, bool moved, Patch *p)
{
  ServerElements e;
  Place(k, moved, p);
  ServerAskElements(k->server, 1, p->box, &e);
  const size_t n = (size_t)e.n;
  p->n = e.n;
  p->x = realloc(p->x, 6 * n * sizeof *p->x + 1);
  p->rho = realloc(p->rho, n * sizeof *p->rho + 1);
  p->area = realloc(p->area, n * sizeof *p->area + 1);
  p->coupled = realloc(p->coupled, n * sizeof *p->coupled + 1);
  if (n) memcpy(p->x, e.x, 6 * n * sizeof *p->x);
  if (n) memcpy(p->rho, e.rho, n * sizeof *p->rho);
  for (int i = 0; i < e.n; i++) {
    p->area[i] = 0.5 * Cross(p->x + 6 * i, p->x + 6 * i + 2, p->x + 6 * i + 4);
    CheckElement(k, p, i);
  }
  CheckCover(k, p);
  FindCoupled(k, p);
}

void PatchFree(Patch *p)
{
  free(p->x);
  free(p->rho);
  free(p->area);
  free(p->coupled);
}

void PatchMomentum(const Kit *k, const Patch *p, const double u[], double momentum[2])
{
  for (int c = 0; c < 2; c++) {
    momentum[c] = 0.0;
    for (int e = 0; e < p->n; e++) momentum[c] += p->rho[e] * p->area[e] * PatchMean(u, e, c);
  }
  MPI_Allreduce(MPI_IN_PLACE, momentum, 2, MPI_DOUBLE, MPI_SUM, k->comm);
}

void PatchCoupled(const Kit *k, const Patch *p, const double u[], double momentum[2], double *mass)
{
  double all[3] = {0.0};
  for (int i = 0; i < p->ncoupled; i++) {
    const int e = p->coupled[i];
    for (int c = 0; c < 2; c++) all[c] += p->rho[e] * p->area[e] * PatchMean(u, e, c);
    all[2] += p->rho[e] * p->area[e];
  }
  MPI_Allreduce(MPI_IN_PLACE, all, 3, MPI_DOUBLE, MPI_SUM, k->comm);
  momentum[0] = all[0];
  momentum[1] = all[1];
  *mass = all[2];
}

void PatchDifference(const Kit *k, const Patch *p, const double u[], const double v[], double *all,
                     double *disc)
{
  double a[2], b[2], mass;
  *all = 0.0;
  for (int e = 0; e < p->n; e++)
    *all +=
        p->area[e] * hypot(PatchMean(u, e, 0) - PatchMean(v, e, 0), PatchMean(u, e, 1) - PatchMean(v, e, 1));
  MPI_Allreduce(MPI_IN_PLACE, all, 1, MPI_DOUBLE, MPI_SUM, k->comm);
  PatchCoupled(k, p, u, a, &mass);
  PatchCoupled(k, p, v, b, &mass);
  *disc = hypot(a[0] - b[0], a[1] - b[1]) / mass;
}
