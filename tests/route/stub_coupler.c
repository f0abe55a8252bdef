/* A coupler without physics: checks that all arrives where it must, and that a redone step is the same bit by
 * bit. */
#include "common/link/server.h"
#include "tests/route/analytic.h"
#include <stdio.h>

enum { MAX = 512 };

typedef struct {
  Server server;
  MPI_Comm comm;
  int rank, size, step;
  double t;
  int n, id[MAX];                         /* fluid elements */
  int ncoupled, entry[MAX];               /* ids by coupling entry */
  double motion[4 * MAX], flow[26 * MAX]; /* of the first try of a step */
  bool kept_motion, kept_flow, solid_has_begun;
  bool needs_pressure;
  Fault fault;
} Stub;

/* Whether the attempt is rejected, as it must be, by a role. */
static bool IsRejected(const Stub *s, const char *role, int expected)
{
  const char *why = ServerRejection(s->server);
  char right[80];
  (void)snprintf(right, sizeof right, "%s: " REASON, role);
  if (expected ? !why || strcmp(why, right) : why != NULL)
    ServerFail(s->server, "step %d is rejected because of '%s'", s->step, why ? why : "nothing");
  return expected;
}

/* --- the solid ------------------------------------------------------------------------------------------ */

/* The lists must be the ranks' own, in order of rank. */
static void CheckMesh(const Stub *s, const ServerSolid *solid, int remeshed)
{
  int n = 0, nf = 0, ne = 0;
  for (int r = s->rank; r < ServerRanks(s->server, "solid"); r += s->size) {
    for (int e = 0; e < FacetCount(r, remeshed); e++, nf++)
      for (int i = 0; i < 2; i++)
        if (nf >= solid->nfacets || solid->facet[2 * nf + i] != n + FacetNode(NodeCount(r, remeshed), e, i))
          ServerFail(s->server, "facet %d of solid rank %d", e, r);
    for (int e = 0; e < ElementCount(r, remeshed); e++, ne++)
      for (int i = 0; i < 3; i++)
        if (ne >= solid->nelements || solid->element[3 * ne + i] != n + ElementNode(e, i))
          ServerFail(s->server, "element %d of solid rank %d", e, r);
    for (int i = 0; i < NodeCount(r, remeshed); i++, n++)
      if (n >= solid->nnodes || solid->gid[n] != NodeId(r, i))
        ServerFail(s->server, "node %d of solid rank %d", i, r);
  }
  if (n != solid->nnodes || nf != solid->nfacets || ne != solid->nelements)
    ServerFail(s->server, "%d nodes, %d facets, %d elements", solid->nnodes, solid->nfacets,
               solid->nelements);
}

static void CheckMotion(const Stub *s, const ServerSolid *solid, double mean_time)
{
  for (int i = 0; i < solid->nnodes; i++)
    for (int c = 0; c < 2; c++) {
      const double u = NodeVelocity(solid->gid[i], c, mean_time);
      if (solid->x[2 * i + c] != NodePosition(solid->gid[i], c, StepEnd(s->step)))
        ServerFail(s->server, "position of node %d in step %d", i, s->step);
      if (fabs(solid->mean[2 * i + c] - u) > 1e-13 * (1 + fabs(u)))
        ServerFail(s->server, "mean velocity of node %d in step %d is %.17g instead of %.17g", i, s->step,
                   solid->mean[2 * i + c], u);
    }
}

/* Velocities linear in time lie on their fitted line: at one time for all nodes, that of the last substep. */
static void CheckFit(const Stub *s, const ServerSolid *solid)
{
  const double start = s->step ? s->t : 0.0, end = s->step ? s->t + StepSize(s->step) : 0.0;
  for (int i = 0; i < solid->nnodes; i++)
    for (int c = 0; c < 2; c++) {
      const double u0 = NodeVelocity(solid->gid[i], c, 0.0), slope = NodeVelocity(solid->gid[i], c, 1.0) - u0;
      const double t = (solid->u[2 * i + c] - u0) / slope;
      const double first = (solid->u[0] - NodeVelocity(solid->gid[0], 0, 0.0)) /
                           (NodeVelocity(solid->gid[0], 0, 1.0) - NodeVelocity(solid->gid[0], 0, 0.0));
      if (fabs(t - first) > 1e-12 || t < 0.5 * (start + end) - 1e-12 || t > end)
        ServerFail(s->server, "fitted velocity of node %d in step %d is that of t = %.17g in [%g, %g]", i,
                   s->step, t, start, end);
    }
}

static void ReceiveSolid(Stub *s, int attempt)
{
  ServerSolid solid;
  ServerReceiveSolid(s->server, &solid);
  if (IsRejected(s, "solid", SolidRejects(s->step, attempt))) return;
  const size_t bytes = 2 * (size_t)solid.nnodes * sizeof(double);
  if (solid.changed != (s->step == 0 || s->step == REMESH_STEP))
    ServerFail(s->server, "changed is %d in step %d", solid.changed, s->step);
  CheckMesh(s, &solid, s->step >= REMESH_STEP);
  CheckMotion(s, &solid, s->step ? s->t + 0.5 * StepSize(s->step) : 0.0);
  if (s->step != REMESH_STEP) CheckFit(s, &solid); /* a new node's line is not known */
  if (s->kept_motion && (memcmp(s->motion, solid.x, bytes) || memcmp(s->motion + 2 * MAX, solid.u, bytes)))
    ServerFail(s->server, "the redone motion of step %d is another", s->step);
  memcpy(s->motion, solid.x, bytes);
  memcpy(s->motion + 2 * MAX, solid.u, bytes);
  s->kept_motion = true;
}

static void SendForce(Stub *s)
{
  double force[MAX][2], load[MAX][2], resistance[MAX][4];
  int n = 0;
  for (int r = s->rank; r < ServerRanks(s->server, "solid"); r += s->size)
    for (int i = 0; i < NodeCount(r, s->step > REMESH_STEP); i++, n++) {
      for (int c = 0; c < 2; c++) force[n][c] = NodeForce(NodeId(r, i), c, s->step);
      for (int c = 0; c < 2; c++) load[n][c] = NodeFilm(NodeId(r, i), c, s->step);
      for (int c = 0; c < 4; c++) resistance[n][c] = NodeFilm(NodeId(r, i), 2 + c, s->step);
    }
  if (HasFilm(s->step)) ServerSetFilm(s->server, load[0], resistance[0]);
  if (s->fault == FAULT_NAN && s->step == 4 && n) force[0][0] = NAN;
  ServerSendForce(s->server, s->t, StepSize(s->step), s->solid_has_begun ? CORACLE_REDO : CORACLE_RUN,
                  &force[0][0]);
  s->solid_has_begun = true;
}

/* --- the fluid ------------------------------------------------------------------------------------------ */

static void AskElements(Stub *s)
{
  const double box[] = {-1.0, -1.0, 1.0, 1.0, 2.0, 2.0, 1e6, 1e6};
  const int adapted = s->step >= ADAPT_STEP;
  ServerElements e;
  ServerAskElements(s->server, 2, box, &e);
  s->n = 0;
  for (int r = s->rank; r < ServerRanks(s->server, "fluid"); r += s->size)
    for (int k = 0; k < CellCount(r, adapted); k++, s->n++) {
      s->id[s->n] = CellOfDensity(e.rho[s->n]);
      if (s->id[s->n] != CellId(r, k, adapted)) ServerFail(s->server, "element %d of fluid rank %d", k, r);
      if (e.mu[s->n] != CellViscosity(s->id[s->n], s->step))
        ServerFail(s->server, "viscosity of element %d of fluid rank %d", k, r);
      for (int i = 0; i < 6; i++)
        if (e.x[6 * s->n + i] != CellVertex(s->id[s->n], i / 2, i % 2))
          ServerFail(s->server, "vertices of element %d of fluid rank %d", k, r);
    }
  if (s->n != e.n) ServerFail(s->server, "%d elements instead of %d", e.n, s->n);
  if (e.lower[0] != -2.0 || e.lower[1] != -3.0 || e.upper[0] != 4.0 || e.upper[1] != 5.0)
    ServerFail(s->server, "bounds of the domain");
}

static void CheckFlow(const Stub *s, const CoracleFlow *f)
{
  if ((f->p != NULL) != s->needs_pressure) ServerFail(s->server, "the pressure travels when it must not");
  for (int e = 0; e < s->n; e++) {
    for (int k = 0; k < 6; k++)
      if (f->u_start[6 * e + k] != CellFlow(s->id[e], 4, k, s->step) ||
          f->u_star[6 * e + k] != CellFlow(s->id[e], 1, k, s->step) ||
          f->u_projected[6 * e + k] != CellFlow(s->id[e], 2, k, s->step) ||
          (f->p && f->p[6 * e + k] != CellFlow(s->id[e], 3, k, s->step)))
        ServerFail(s->server, "flow of element %d in step %d", e, s->step);
    if (f->rho[e] != CellDensity(s->id[e]) + s->step) ServerFail(s->server, "density of element %d", e);
    if (f->mu[e] != CellViscosity(s->id[e], s->step)) ServerFail(s->server, "viscosity of element %d", e);
  }
}

/* Whether there is one. */
static bool ReceiveFlow(Stub *s, int attempt)
{
  CoracleFlow f;
  ServerReceiveFlow(s->server, &f);
  if (IsRejected(s, "fluid", FluidRejects(s->step, attempt))) return false;
  CheckFlow(s, &f);
  const double *lists[] = {f.u_start, f.u_star, f.u_projected, f.p, f.rho, f.mu};
  for (int k = 0; k < 6; k++) {
    const size_t bytes = (k < 4 ? 6 : 1) * (size_t)s->n * sizeof(double);
    double *first = s->flow + (k < 4 ? 6 * k : 20 + k) * MAX;
    if (!lists[k]) continue;
    if (s->kept_flow && memcmp(first, lists[k], bytes)) ServerFail(s->server, "the redone flow is another");
    memcpy(first, lists[k], bytes);
  }
  s->kept_flow = true;
  if (ServerProposedStep(s->server) != CellProposal(0, s->step)) ServerFail(s->server, "proposed step");
  if (ServerElementsChanged(s->server) != (s->step == ADAPT_STEP)) ServerFail(s->server, "elements changed");
  return true;
}

/* Entries in an order that mixes the fluid's ranks: from both ends to the middle. */
static void SendCoupling(Stub *s, CoracleAction action, int coming)
{
  static CoracleCoupling coupling[MAX];
  CoracleCorrection correction[MAX] = {0};
  const int ncorrection = s->step ? s->ncoupled : 0;
  for (int i = 0; i < ncorrection; i++)
    for (int k = 0; k < 6; k++) (&correction[i].r[0][0])[k] = CellCorrection(s->entry[i], k, s->step);
  s->ncoupled = 0;
  for (int i = 0; i < s->n && action != CORACLE_STOP; i++) {
    const int e = i % 2 ? s->n - 1 - i / 2 : i / 2;
    if (!CellCoupled(s->id[e])) continue;
    s->entry[s->ncoupled] = s->id[e];
    coupling[s->ncoupled] = CellCoupling(s->id[e], coming);
    coupling[s->ncoupled++].element = e;
  }
  CoracleGauge gauge[STEPS];
  for (int i = 0; i < GaugeCount(s->step); i++) gauge[i] = GaugeAt(i, s->step);
  ServerSetGauges(s->server, GaugeCount(s->step), gauge);
  ServerSendStep(s->server, s->t, StepSize(coming), action, ncorrection, correction);
  if (action != CORACLE_STOP) ServerSendCoupling(s->server, s->ncoupled, coupling);
}

/* --- the run -------------------------------------------------------------------------------------------- */

/* An attempt of step s->step, from 0; the fluid has its coupling already. */
static void Step(Stub *s, int attempt)
{
  const int last = attempt == Redos(s->step);
  if (attempt == 0) s->kept_motion = s->kept_flow = s->solid_has_begun = false;
  if (s->fault != FAULT_NONE && s->fault != FAULT_NAN && s->step == 4 && s->rank == s->size - 1)
    Misbehave(s->fault);
  if (ReceiveFlow(s, attempt)) {
    SendForce(s);
    ReceiveSolid(s, attempt);
  }
  if (ServerElementsChanged(s->server)) AskElements(s);
  if (last) s->t += StepSize(s->step);
  SendCoupling(s,
               !last             ? CORACLE_REDO
               : s->step < STEPS ? CORACLE_RUN
                                 : CORACLE_STOP,
               last ? s->step + 1 : s->step);
}

static void CheckReport(void *context, const char *role, const char *key, double value)
{
  Stub *s = context;
  double expected = value;
  const int fluids = ServerRanks(s->server, "fluid"), solids = ServerRanks(s->server, "solid");
  if (!strcmp(key, "cells"))
    for (int r = expected = 0; r < fluids; r++) expected += CellCount(r, 1);
  if (!strcmp(key, "nodes"))
    for (int r = expected = 0; r < solids; r++) expected += NodeCount(r, 1);
  if (!strcmp(key, "largest")) expected = fluids - 0.5;
  if (!strcmp(key, "ranks")) expected = ServerRanks(s->server, role);
  if (!strcmp(key, "seconds_wall") && !(value > 0.0)) expected = 1.0;
  if (value != expected)
    ServerFail(s->server, "report %s.%s is %g instead of %g", role, key, value, expected);
  s->n++;
}

static const char *const SECTIONS[] = {"coupler", NULL};

static void Fail(void *server, const char *message)
{
  ServerFail(server, "%s", message);
}

int main(int argc, char **argv)
{
  static Stub s;
  CoracleCase c;
  MPI_Comm job = TestJob(argc, argv);
  ServerOpenComm(job, argc, argv, &s.comm, &s.server);
  CoracleCaseOpen(argc, argv, Fail, s.server, &c);
  MPI_Comm_rank(s.comm, &s.rank);
  MPI_Comm_size(s.comm, &s.size);
  s.fault = (Fault)CoracleCaseWord(c, "coupler.fault", FAULT_NONE, FAULT_WORDS);
  s.needs_pressure = CoracleCaseBoolOr(c, "coupler.pressure", true);
  CoracleCaseFinish(c, SECTIONS);
  CoracleCaseClose(&c);
  ReceiveSolid(&s, 0);
  if (s.needs_pressure) ServerNeedPressure(s.server);
  AskElements(&s);
  if (ServerProposedStep(s.server) != CellProposal(0, 0)) ServerFail(s.server, "first proposed step");
  SendCoupling(&s, CORACLE_RUN, 1);
  for (s.step = 1; s.step <= STEPS; s.step++)
    for (int attempt = 0; attempt <= Redos(s.step); attempt++) Step(&s, attempt);
  ServerSendForce(s.server, s.t, 0.0, CORACLE_STOP, NULL);
  ServerFinish(s.server);
  s.n = 0;
  ServerReports(s.server, CheckReport, &s);
  if (s.rank == 0 && s.n != 3 * 5 + 3) ServerFail(s.server, "%d reports", s.n);
  ServerClose(&s.server);
  return TestEnd(&job);
}
