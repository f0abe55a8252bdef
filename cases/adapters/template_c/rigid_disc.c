/* A complete solid in one page: a rigid disc that falls, drifts and rolls.  It replaces coracle-solid in any
 * case whose first body is a disc, and needs nothing but the client library:
 *
 *     mpirun -n 2 coracle-fluid CASE : -n 1 coracle-coupler CASE : -n 1 rigid_disc CASE
 *
 * A key of its own, solid.bodies[0].spring (N/m a metre of depth), ties the centre to where it starts.
 *
 *       2 ___ 1      nodes 0 .. n-1 on the circle, node n in the centre;
 *        /\ /\       facets i -> i + 1 run counter-clockwise, so that the disc lies on their left;
 *     3 |--n--| 0    triangles (n, i, i + 1) are the slices of the pie;
 *        \/_\/       rank 0 holds it all, other ranks are empty. */
#include <case_file.h>
#include <coracle.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a step changes; the library saves it and puts it back when a step is redone. */
typedef struct {
  double x[2], angle; /* centre, m; rad */
  double v[2], spin;  /* m/s, rad/s */
} BulkMotion;

typedef struct {
  CoracleClient client;
  int n; /* nodes on the circle; 0 on empty ranks */
  double radius, mass, inertia, gravity[2];
  double spring, start[2]; /* N/m a metre of depth; where it has no force, m */
  BulkMotion now;
} Disc;

/* position[n + 1][2] of the nodes */
static void Nodes(const Disc *d, const BulkMotion *m, double position[])
{
  for (int i = 0; d->n && i <= d->n; i++) {
    const double phi = m->angle + 2.0 * M_PI * i / d->n, r = i < d->n ? d->radius : 0.0;
    position[2 * i] = m->x[0] + r * cos(phi);
    position[2 * i + 1] = m->x[1] + r * sin(phi);
  }
}

/* The velocity of the nodes, [n + 1][2] */
static void Velocities(const Disc *d, const double x[], double u[])
{
  for (int i = 0; d->n && i <= d->n; i++) {
    u[2 * i] = d->now.v[0] - d->now.spin * (x[2 * i + 1] - d->now.x[1]);
    u[2 * i + 1] = d->now.v[1] + d->now.spin * (x[2 * i] - d->now.x[0]);
  }
}

/* One over the mass of node i: a third of its slices, two of the n on the circle, all in the centre. */
static double Mobility(const Disc *d, int i)
{
  return (i < d->n ? 1.5 * d->n : 3.0) / d->mass;
}

/* The first body of the case, per metre of depth; mass and inertia are the polygon's, which is what displaces
 * fluid. */
static void ReadCase(Disc *d, int argc, char **argv, int rank)
{
  CoracleCase c;
  char key[256];
  CoracleCaseOpen(argc, argv, CoracleFailMessage, d->client, &c);
  CoracleCaseVector(c, "gravity", 2, d->gravity);
  CoracleCaseVector(c, "solid.bodies[0].centre", 2, d->now.x);
  if (CoracleCaseHas(c, "solid.bodies[0].velocity"))
    CoracleCaseVector(c, "solid.bodies[0].velocity", 2, d->now.v);
  memcpy(d->start, d->now.x, sizeof d->start);
  if (CoracleCaseHas(c, "solid.bodies[0].spring"))
    d->spring = CoracleCasePositive(c, "solid.bodies[0].spring");
  d->radius = CoracleCasePositive(c, "solid.bodies[0].radius");
  const int n = (int)ceil(2.0 * M_PI * d->radius / CoracleCasePositive(c, "solid.bodies[0].size"));
  snprintf(key, sizeof key, "solid.materials.%s.density", CoracleCaseString(c, "solid.bodies[0].material"));
  const double area = 0.5 * n * d->radius * d->radius * sin(2.0 * M_PI / n);
  d->mass = CoracleCasePositive(c, key) * area;
  d->inertia = d->mass * d->radius * d->radius * (2.0 + cos(2.0 * M_PI / n)) / 6.0;
  d->n = rank == 0 ? n : 0;
  CoracleCaseClose(&c);
}

static void GiveMesh(const Disc *d, double x[])
{
  const int n = d->n, nodes = n ? n + 1 : 0;
  long long *gid = malloc(((size_t)n + 1) * sizeof *gid);
  double *u = malloc(2 * ((size_t)n + 1) * sizeof *u);
  int(*facet)[2] = malloc(((size_t)n + 1) * sizeof *facet),
  (*slice)[3] = malloc(((size_t)n + 1) * sizeof *slice);
  for (int i = 0; i <= n; i++) {
    gid[i] = i;
    u[2 * i] = d->now.v[0];
    u[2 * i + 1] = d->now.v[1];
  }
  for (int i = 0; i < n; i++) {
    facet[i][0] = slice[i][1] = i;
    facet[i][1] = slice[i][2] = (i + 1) % n;
    slice[i][0] = n;
  }
  Nodes(d, &d->now, x);
  CoracleSetNodes(d->client, 2, nodes, gid, x, u);
  CoracleSetSurface(d->client, n, n ? facet[0] : NULL);
  CoracleSetVolume(d->client, n, n ? slice[0] : NULL);
  free(gid);
  free(u);
  free(facet);
  free(slice);
}

/* How the nodes answer the fluid (CoracleSetInertia): each with its part of the mass, as a rigid body.  What
 * moves it beside the fluid is the rest of the body: its acceleration from velocities u to w, less the fluid's
 * force over its mass. */
static void FindOwn(const Disc *d, double dt, const double u[], const double w[], const double force[],
                    double own[])
{
  for (int k = 0; d->n && k < 2 * d->n + 2; k++) own[k] = (w[k] - u[k]) / dt - Mobility(d, k / 2) * force[k];
}

static void TellInertia(const Disc *d, const double own[])
{
  double *mobility = malloc(((size_t)d->n + 1) * sizeof *mobility);
  for (int i = 0; i <= d->n; i++) mobility[i] = d->n ? Mobility(d, i) : 0.0;
  CoracleSetInertia(d->client, mobility, own);
  free(mobility);
}

/* Newton and Euler: m dv/dt = F + m g - k (x - x_start), I dw/dt = M, over one step. */
static void Advance(Disc *d, double dt, const double x[], const double force[])
{
  double f[2], moment = 0.0;
  for (int c = 0; c < 2; c++) f[c] = d->mass * d->gravity[c] - d->spring * (d->now.x[c] - d->start[c]);
  for (int i = 0; d->n && i <= d->n; i++) {
    f[0] += force[2 * i];
    f[1] += force[2 * i + 1];
    moment += (x[2 * i] - d->now.x[0]) * force[2 * i + 1] - (x[2 * i + 1] - d->now.x[1]) * force[2 * i];
  }
  d->now.spin += dt * moment / d->inertia;
  d->now.angle += dt * d->now.spin;
  for (int c = 0; c < 2; c++) {
    d->now.v[c] += dt * f[c] / d->mass;
    d->now.x[c] += dt * d->now.v[c];
  }
}

int main(int argc, char **argv)
{
  static Disc d;
  MPI_Comm comm;
  CoracleAction action;
  double t, dt;
  int rank;
  CoracleOpen("solid", argc, argv, &comm, &d.client);
  MPI_Comm_rank(comm, &rank);
  ReadCase(&d, argc, argv, rank);
  const size_t bytes = 2 * ((size_t)d.n + 1) * sizeof(double);
  double *before = malloc(bytes), *after = malloc(bytes), *u = malloc(bytes), *w = malloc(bytes);
  double *own = malloc(bytes);
  for (int k = 0; k < 2 * d.n + 2; k++) own[k] = d.gravity[k % 2];
  CoracleBindState(d.client, &d.now, sizeof d.now); /* first: a resumed run now is where it was */
  CoracleBindState(d.client, own, bytes);
  GiveMesh(&d, before);
  TellInertia(&d, own);
  CoracleReady(d.client);
  for (;;) {
    const double *force;
    CoracleBegin(d.client, &t, &dt, &action);
    if (action == CORACLE_STOP) break;
    CoracleGetForce(d.client, &force);
    Nodes(&d, &d.now, before);
    Velocities(&d, before, u);
    Advance(&d, dt, before, force);
    Nodes(&d, &d.now, after);
    Velocities(&d, after, w);
    FindOwn(&d, dt, u, w, force, own);
    for (int i = 0; d.n && i < 2 * d.n + 2; i++) u[i] = (after[i] - before[i]) / dt;
    CoracleSubstep(d.client, dt, u); /* one substep: the library divides the displacement by dt again */
    CoracleSetVelocity(d.client, w);
    TellInertia(&d, own);
    CoracleEnd(d.client, after);
  }
  if (rank == 0) CoracleReport(d.client, "centre_y", d.now.x[1], 0);
  if (rank == 0) CoracleReport(d.client, "velocity_y", d.now.v[1], 0);
  free(before);
  free(after);
  free(u);
  free(w);
  free(own);
  return CoracleClose(&d.client);
}
