/* A solid without mechanics: checks each force, and gives positions and velocities that the coupler knows. */
#include "tests/route/analytic.h"
#include <stdio.h>

typedef struct {
  CoracleClient client;
  int rank, n, remeshed, step, attempt;
  double x[64][2], u[64][2]; /* [n] */
  double memory[16];         /* state that a step changes beyond recognition */
  double shadow[16];         /* what it was when the step began */
  int function_state, function_saved;
  Fault fault;
  int fault_step;
} Solid;

/* Spoils what is about to be given as the mesh. */
static void SpoilMesh(const Solid *s, long long gid[], int facet[][2], int *nf, int element[][3])
{
  const int turned[2] = {facet[1][1], facet[1][0]};
  if (s->fault == FAULT_CLOCKWISE) {
    element[1][0] = ElementNode(1, 1);
    element[1][1] = ElementNode(1, 0);
  }
  if (s->fault == FAULT_TWICE) memcpy(element[1], element[0], sizeof element[1]);
  if (s->fault == FAULT_TURNED) memcpy(facet[1], turned, sizeof turned);
  if (s->fault == FAULT_OPEN) --*nf;
  if (s->fault == FAULT_IDS) gid[2] = gid[0];
}

/* Positions and velocities at two times. */
static void SetMesh(Solid *s, double position_time, double velocity_time)
{
  long long gid[64];
  int facet[64][2], element[64][3];
  s->n = NodeCount(s->rank, s->remeshed);
  for (int i = 0; i < s->n; i++) {
    gid[i] = NodeId(s->rank, i);
    for (int c = 0; c < 2; c++) {
      s->x[i][c] = NodePosition(gid[i], c, position_time);
      s->u[i][c] = NodeVelocity(gid[i], c, velocity_time);
    }
  }
  const int ne = ElementCount(s->rank, s->remeshed);
  int nf = FacetCount(s->rank, s->remeshed);
  for (int e = 0; e < nf; e++)
    for (int i = 0; i < 2; i++) facet[e][i] = FacetNode(s->n, e, i);
  for (int e = 0; e < ne; e++)
    for (int i = 0; i < 3; i++) element[e][i] = ElementNode(e, i);
  if (s->fault_step > 0 && s->n) SpoilMesh(s, gid, facet, &nf, element);
  CoracleSetNodes(s->client, 2, s->n, gid, &s->x[0][0], &s->u[0][0]);
  CoracleSetSurface(s->client, nf, &facet[0][0]);
  CoracleSetVolume(s->client, ne, &element[0][0]);
}

static int SaveFunctionState(void *context, int save)
{
  Solid *s = context;
  if (save)
    s->function_saved = s->function_state;
  else
    s->function_state = s->function_saved;
  return 0;
}

static void CheckForce(const Solid *s)
{
  const double *force;
  CoracleGetForce(s->client, &force);
  for (int i = 0; i < s->n; i++)
    for (int c = 0; c < 2; c++)
      if (force[2 * i + c] != NodeForce(NodeId(s->rank, i), c, s->step))
        CoracleFail(s->client, "force %g on node %d in step %d", force[2 * i + c], i, s->step);
}

static void CheckFilm(const Solid *s)
{
  const double *load, *resistance;
  CoracleGetFilm(s->client, &load, &resistance);
  if (!load != !HasFilm(s->step) || !resistance != !load)
    CoracleFail(s->client, "films are %s in step %d", load ? "there" : "missing", s->step);
  for (int k = 0; k < 6 * s->n && load; k++) {
    const double film = k % 6 < 2 ? load[2 * (k / 6) + k % 6] : resistance[4 * (k / 6) + k % 6 - 2];
    if (film != NodeFilm(NodeId(s->rank, k / 6), k % 6, s->step))
      CoracleFail(s->client, "film %g, component %d, on node %d in step %d", film, k % 6, k / 6, s->step);
  }
}

/* State at the start of a redone step must be the state at the start of its first try, bit by bit. */
static void CheckState(Solid *s, CoracleAction action)
{
  if (action == CORACLE_RUN) {
    s->attempt = 0;
    s->step++;
    memcpy(s->shadow, s->memory, sizeof s->memory);
  } else {
    s->attempt++;
    s->remeshed = s->step > REMESH_STEP;
    s->n = NodeCount(s->rank, s->remeshed);
  }
  if (memcmp(s->shadow, s->memory, sizeof s->memory) || s->function_state != s->step - 1)
    CoracleFail(s->client, "the state of step %d has not been put back", s->step);
}

/* 1, 7, or a few uneven substeps; the mesh changes in the middle of REMESH_STEP. */
static void Substeps(Solid *s, double t, double dt)
{
  const int m = s->step % 3 == 1 ? 1 : s->step % 3 == 2 ? 7 : 4;
  double done = 0.0;
  for (int k = 0; k < m; k++) {
    const double h = m == 4 ? dt * (k + 1) / 10.0 : dt / m;
    for (int i = 0; i < s->n; i++)
      for (int c = 0; c < 2; c++) s->u[i][c] = NodeVelocity(NodeId(s->rank, i), c, t + done + 0.5 * h);
    if (s->step == s->fault_step && s->fault == FAULT_NAN && k == m - 1 && s->n) s->u[s->n - 1][1] = NAN;
    CoracleSubstep(s->client, h, &s->u[0][0]);
    done += h;
    if (s->step == REMESH_STEP && k == 1) {
      s->remeshed = 1; /* a new node has moved with its velocity's mean so far */
      SetMesh(s, t + done, t + 0.5 * done);
    }
  }
}

static void Step(Solid *s, double t, double dt)
{
  if (s->step == s->fault_step) {
    if (s->fault == FAULT_CLOSE) CoracleClose(&s->client);
    Misbehave(s->fault);
  }
  CheckForce(s);
  CheckFilm(s);
  Substeps(s, t, dt);
  for (int i = 0; i < s->n; i++)
    for (int c = 0; c < 2; c++) s->x[i][c] = NodePosition(NodeId(s->rank, i), c, StepEnd(s->step));
  if (s->fault == FAULT_DRIFT && s->step == s->fault_step && s->n) s->x[s->n - 1][1] += 0.1;
  for (int k = 0; k < 16; k++) s->memory[k] = sin(1e3 * s->memory[k] + t + k);
  s->function_state++;
  const bool rejects = s->rank == 0 && SolidRejects(s->step, s->attempt);
  if (rejects) CoracleRejectStep(s->client, REASON);
  CoracleEnd(s->client, rejects ? NULL : &s->x[0][0]);
}

static const char *const SECTIONS[] = {"solid", NULL};

static void Handler(void *context, const char *message)
{
  fprintf(stderr, "the host's %s has received: %s\n", (const char *)context, message);
}

static void Fail(void *client, const char *message)
{
  CoracleFail(client, "%s", message);
}

int main(int argc, char **argv)
{
  static Solid s;
  MPI_Comm comm;
  CoracleCase c;
  int size;
  double t, dt;
  CoracleAction action;
  const char *role = getenv("TEST_SOLID_ROLE");
  MPI_Comm job = TestJob(argc, argv);
  if (getenv("TEST_HANDLER")) CoracleSetErrorHandler(Handler, "handler");
  CoracleOpenComm(job, role ? role : "solid", argc, argv, &comm, &s.client);
  CoracleCaseOpen(argc, argv, Fail, s.client, &c);
  MPI_Comm_rank(comm, &s.rank);
  MPI_Comm_size(comm, &size);
  s.fault = (Fault)CoracleCaseWord(c, "solid.fault", FAULT_NONE, FAULT_WORDS);
  s.fault_step = s.rank == size - 1 ? 4 : -1;
  CoracleCaseFinish(c, SECTIONS);
  CoracleCaseClose(&c);
  SetMesh(&s, 0.0, 0.0);
  if (s.fault == FAULT_ORDER) CoracleSubstep(s.client, 0.1, &s.u[0][0]);
  CoracleBindState(s.client, s.memory, sizeof s.memory);
  CoracleBindStateFunction(s.client, SaveFunctionState, &s);
  if (s.fault == FAULT_LOAD) CoracleSetPressureLoad(s.client);
  CoracleReady(s.client);
  for (;;) {
    CoracleBegin(s.client, &t, &dt, &action);
    if (action == CORACLE_STOP) break;
    CheckState(&s, action);
    Step(&s, t, dt);
  }
  if (s.step != STEPS) CoracleFail(s.client, "stopped after %d steps", s.step);
  CoracleReport(s.client, "nodes", s.n, 1);
  CoracleClose(&s.client);
  return TestEnd(&job);
}
