/* Wrong use of each public function of the client library, by the role TEST_ROLE: each must be refused with a message that
 * says what was expected.  The partners are those of the conformance kit, or a rigid disc. */
#include <coracle.h>
#include <math.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static jmp_buf JUMP;
static char MESSAGE[4096];
static int COUNT;

static void Catch(void *context, const char *message)
{
  snprintf(MESSAGE, sizeof MESSAGE, "%s", message);
  longjmp(JUMP, 1);
}

static void Accepted(const char *call, const char *expected, const char *found)
{
  printf("misuse: %s: expected '%s', %s%s\n", call, expected, found ? "found " : "it was accepted",
         found ? found : "");
  fflush(stdout);
  MPI_Abort(MPI_COMM_WORLD, 3);
}

#define REFUSED(call, expected)                                                                              \
  do {                                                                                                       \
    if (!setjmp(JUMP)) {                                                                                     \
      call;                                                                                                  \
      Accepted(#call, expected, NULL);                                                                       \
    } else if (!strstr(MESSAGE, expected)) {                                                                 \
      Accepted(#call, expected, MESSAGE);                                                                    \
    }                                                                                                        \
    COUNT++;                                                                                                 \
  } while (0)

static const double X[] = {0, 0, 1, 0, 0, 1}, ZERO[6], BAD[] = {0, 0, 0, NAN, 0, 0};
static const long long GID[] = {1, 2, 3}, SAME[] = {1, 2, 1};
static const int FACET[] = {0, 1, 1, 2, 2, 0}, TRIANGLE[] = {0, 1, 2}, FAR[] = {0, 1, 3}, BACK[] = {0, 2, 1};
static const double MORE_X[] = {0, 0, 1, 0, 0, 1, 1, 1}, MORE_ZERO[8];
static const long long MORE_GID[] = {1, 2, 3, 4};
static const double ONE[] = {1, 1, 1}, NEGATIVE[] = {1, -1, 1};

static int Region(void *context, int nbox, const double box[], CoracleElements *e)
{
  static const double rho[] = {1000.0}, mu[] = {1.0}, thin[] = {0.0};
  *e = (CoracleElements){.n = 1, .x = X, .rho = context ? thin : rho, .mu = mu};
  return 0;
}
static int Failing(void *context, int nbox, const double box[], CoracleElements *e)
{
  return 1;
}

/* --- without a client --------------------------------------------------------------------------------- */

static void Nobody(void)
{
  const CoracleCoupling *coupling;
  const CoracleCorrection *correction;
  const CoracleGauge *gauge;
  const CoracleFlow flow = {0};
  const double *force, *box, corner[2] = {0, 0};
  const CoracleClient c = NULL;
  CoracleAction action;
  CoracleClient opened;
  MPI_Comm comm;
  double t, dt;
  int n;
#define NOBODY(name, arguments) REFUSED(name arguments, #name ": the client is NULL: CoracleOpen comes first")
  NOBODY(CoracleBegin, (c, &t, &dt, &action));
  NOBODY(CoracleBindState, (c, &t, sizeof t));
  NOBODY(CoracleBindStateFunction, (c, NULL, NULL));
  NOBODY(CoracleCheckpointPath, (c));
  NOBODY(CoracleElementsChanged, (c));
  NOBODY(CoracleEnd, (c, X));
  NOBODY(CoracleGetCorrection, (c, &n, &correction));
  NOBODY(CoracleGetCoupling, (c, &n, &coupling));
  NOBODY(CoracleGetFilm, (c, &force, &force));
  NOBODY(CoracleGetForce, (c, &force));
  NOBODY(CoracleGetGauges, (c, &n, &gauge));
  NOBODY(CoracleGetRegion, (c, &n, &box));
  NOBODY(CoracleNeedsPressure, (c));
  NOBODY(CoraclePhase, (c, "a phase"));
  NOBODY(CoracleProposeStep, (c, 0.1));
  NOBODY(CoracleReady, (c));
  NOBODY(CoracleRejectStep, (c, "a reason"));
  NOBODY(CoracleReport, (c, "a key", 0.0, 0));
  NOBODY(CoracleResumePath, (c));
  NOBODY(CoracleSetFlow, (c, &flow));
  NOBODY(CoracleSetInertia, (c, ONE, ZERO));
  NOBODY(CoracleSetNodes, (c, 2, 3, GID, X, ZERO));
  NOBODY(CoracleSetPressureLoad, (c));
  NOBODY(CoracleSetRegion, (c, 2, corner, corner, Region, NULL));
  NOBODY(CoracleSetSurface, (c, 3, FACET));
  NOBODY(CoracleSetVelocity, (c, ZERO));
  NOBODY(CoracleSetVolume, (c, 1, TRIANGLE));
  NOBODY(CoracleStepAccepted, (c));
  NOBODY(CoracleSubstep, (c, 0.1, ZERO));
  REFUSED(CoracleFail(c, "nobody's %s", "words"), "nobody's words");
  REFUSED(CoracleFailMessage(c, "nobody's words"), "nobody's words");
  REFUSED(CoracleOpen(NULL, 0, NULL, &comm, &opened), "role is NULL, expected \"fluid\" or \"solid\"");
}

/* --- the solid ------------------------------------------------------------------------------------------ */

static void GiveMesh(CoracleClient c, const long long gid[], const int triangle[])
{
  CoracleSetNodes(c, 2, 3, gid, X, ZERO);
  CoracleSetSurface(c, 3, FACET);
  CoracleSetVolume(c, 1, triangle);
}

static void Setup(CoracleClient c)
{
  double lower[2] = {0, 0}, t, dt;
  const double *force;
  int n;
  CoracleAction action;
  const CoracleCoupling *coupling;
  const CoracleFlow flow = {0};
  REFUSED(CoracleReady(c), "CoracleReady: CoracleSetNodes comes first (with n = 0 on empty ranks)");
  REFUSED(CoracleBegin(c, &t, &dt, &action),
          "CoracleBegin was called before CoracleReady: its place is between CoracleEnd and CoracleBegin");
  REFUSED(CoracleEnd(c, X),
          "CoracleEnd was called before CoracleReady: its place is between CoracleBegin and CoracleEnd");
  REFUSED(CoracleGetFilm(c, &force, &force), "CoracleGetFilm was called before CoracleReady");
  REFUSED(CoracleGetForce(c, &force), "CoracleGetForce was called before CoracleReady");
  REFUSED(CoracleSubstep(c, 0.1, ZERO), "CoracleSubstep was called before CoracleReady");
  REFUSED(CoracleSetVelocity(c, ZERO), "CoracleSetVelocity was called before CoracleReady");
  REFUSED(CoracleRejectStep(c, "a reason"), "CoracleRejectStep was called before CoracleReady");
  REFUSED(CoracleCheckpointPath(c), "CoracleCheckpointPath was called before CoracleReady: its place is "
                                    "between CoracleBegin and CoracleEnd or after");
  REFUSED(CoracleClose(&c), "closed in step 0, before the end of the run (CORACLE_STOP)");
  REFUSED(CoracleSetNodes(c, 3, 3, GID, X, ZERO), "CoracleSetNodes: dim is 3, only 2 is there yet");
  REFUSED(CoracleSetNodes(c, 2, -1, GID, X, ZERO), "CoracleSetNodes: n is negative");
  REFUSED(CoracleSetNodes(c, 2, 3, GID, BAD, ZERO), "position is nan at node 1, component 1");
  REFUSED(CoracleSetNodes(c, 2, 3, GID, X, BAD), "velocity is nan at node 1, component 1");
  REFUSED(CoracleSetNodes(c, 2, 3, NULL, X, ZERO), "CoracleSetNodes: gid is NULL, expected an array for 3");
  REFUSED(CoracleSetNodes(c, 2, 3, GID, NULL, ZERO), "CoracleSetNodes: x is NULL");
  REFUSED(CoracleSetNodes(c, 2, 3, GID, X, NULL), "CoracleSetNodes: u is NULL");
  REFUSED(CoracleSetSurface(c, 3, NULL), "CoracleSetSurface: conn is NULL");
  REFUSED(CoracleSetVolume(c, 1, NULL), "CoracleSetVolume: conn is NULL");
  REFUSED(CoracleSetSurface(c, -1, FACET), "CoracleSetSurface: ne is negative");
  REFUSED(CoracleSetVolume(c, -1, TRIANGLE), "CoracleSetVolume: ne is negative");
  REFUSED((GiveMesh(c, SAME, TRIANGLE), CoracleReady(c)), "two nodes of this rank have the id 1");
  REFUSED((GiveMesh(c, GID, FAR), CoracleReady(c)), "element 0 refers to node 3 of this rank's 3");
  REFUSED((GiveMesh(c, GID, BACK), CoracleReady(c)), "its nodes must be in counter-clockwise order");
  GiveMesh(c, GID, TRIANGLE);
  REFUSED((CoracleSetInertia(c, NEGATIVE, ZERO), CoracleReady(c)),
          "mobility is -1 1/kg at node 1 in step 0: it must not be negative");
  REFUSED((CoracleSetInertia(c, ONE, BAD), CoracleReady(c)), "acceleration is nan at node 1, component 1");
  REFUSED(CoracleBindState(c, NULL, 8), "CoracleBindState: state is NULL");
  REFUSED(CoracleBindStateFunction(c, NULL, NULL), "CoracleBindStateFunction: there must be a function");
  REFUSED(CoracleReport(
              c, "a.name.that.is.far.too.long.to.be.a.key.of.the.summary.of.any.run.of.this.program.I.think",
              0, 0),
          "CoracleReport: the key is too long");
  REFUSED(CoracleFail(c, "my %s", "words"), "my words");
  REFUSED(CoracleFailMessage(c, "my 100 %s"), "my 100 %s");
  REFUSED(CoracleSetRegion(c, 2, lower, lower, Region, NULL), "CoracleSetRegion is for a fluid");
  REFUSED(CoracleProposeStep(c, 0.1), "CoracleProposeStep is for a fluid");
  REFUSED(CoracleGetCoupling(c, &n, &coupling), "CoracleGetCoupling is for a fluid");
  REFUSED(CoracleSetFlow(c, &flow), "CoracleSetFlow is for a fluid");
  REFUSED(CoracleStepAccepted(c), "CoracleStepAccepted is for a fluid");
  REFUSED(CoracleNeedsPressure(c), "CoracleNeedsPressure is for a fluid");
  REFUSED(CoracleElementsChanged(c), "CoracleElementsChanged is for a fluid");
}

static void InStep(CoracleClient c)
{
  double t, dt;
  CoracleAction action;
  CoracleSetInertia(c, ONE, ZERO);
  CoracleReady(c);
  REFUSED(CoracleReady(c),
          "CoracleReady was called between CoracleEnd and CoracleBegin: its place is before CoracleReady");
  REFUSED(CoracleEnd(c, X), "CoracleEnd was called between CoracleEnd and CoracleBegin");
  REFUSED(CoracleSetNodes(c, 2, 3, GID, X, ZERO),
          "CoracleSetNodes was called between CoracleEnd and CoracleBegin");
  REFUSED(CoracleResumePath(c), "CoracleResumePath was called between CoracleEnd and CoracleBegin");
  REFUSED(CoracleSetPressureLoad(c), "its place is before CoracleReady");
  CoracleBegin(c, &t, &dt, &action);
  REFUSED(CoracleBegin(c, &t, &dt, &action), "CoracleBegin was called between CoracleBegin and CoracleEnd");
  REFUSED(CoracleRejectStep(c, NULL), "CoracleRejectStep: it must say why");
  REFUSED(CoracleBindState(c, &t, sizeof t), "CoracleBindState: state is bound before the first step");
  REFUSED(CoracleSubstep(c, 0.0, ZERO), "CoracleSubstep: h is 0 s in step 1");
  REFUSED(CoracleSubstep(c, NAN, ZERO), "CoracleSubstep: h is nan s in step 1");
  REFUSED(CoracleSubstep(c, dt, NULL), "CoracleSubstep: u is NULL");
  REFUSED(CoracleSetVelocity(c, NULL), "CoracleSetVelocity: u is NULL");
  REFUSED(CoracleSetInertia(c, NULL, ZERO), "CoracleSetInertia: mobility is NULL");
  REFUSED(CoracleSetInertia(c, ONE, NULL), "CoracleSetInertia: acceleration is NULL");
  REFUSED(CoracleSubstep(c, dt, BAD), "velocity is nan at node 1, component 1, in step 1");
  REFUSED(CoracleSetVelocity(c, BAD), "velocity is nan at node 1, component 1, in step 1");
  REFUSED(CoracleEnd(c, X), "the substeps of step 1 sum up to 0 s");
  CoracleSubstep(c, dt, ZERO);
  REFUSED(CoracleEnd(c, NULL), "CoracleEnd: a solid gives its positions");
  REFUSED(CoracleEnd(c, BAD), "position is nan at node 1, component 1, in step 1");
  REFUSED(CoracleClose(&c), "closed in step 1, before the end of the run");
  CoracleSetVelocity(c, ZERO);
  CoracleSetNodes(c, 2, 4, MORE_GID, MORE_X, MORE_ZERO);
  REFUSED(CoracleEnd(c, MORE_X), "CoracleSetVelocity: it comes after CoracleSetNodes");
}

/* --- the fluid ------------------------------------------------------------------------------------------ */

static void Fluid(CoracleClient c)
{
  const double lower[2] = {0, 0}, upper[2] = {1, 1}, u[6] = {0}, nan[6] = {NAN}, rho[1] = {1000.0},
               mu[1] = {1.0};
  const CoracleFlow good = {.u_start = u, .u_star = u, .u_projected = u, .p = u, .rho = rho, .mu = mu};
  CoracleFlow bad = good;
  const CoracleCoupling *coupling;
  const CoracleCorrection *correction;
  const CoracleGauge *gauge;
  CoracleAction action;
  double t, dt;
  int n;
  REFUSED(CoracleReady(c), "CoracleReady: CoracleSetRegion comes first");
  REFUSED(CoracleSetRegion(c, 3, lower, upper, Region, NULL),
          "CoracleSetRegion: dim is 3, only 2 is there yet");
  REFUSED(CoracleSetRegion(c, 2, lower, upper, NULL, NULL),
          "CoracleSetRegion: there must be a region function");
  REFUSED(CoracleProposeStep(c, 0.0), "proposes a time step of 0 s");
  REFUSED(CoracleProposeStep(c, NAN), "proposes a time step of nan s");
  REFUSED(CoracleNeedsPressure(c), "CoracleNeedsPressure was called before CoracleReady");
  REFUSED(CoracleGetCoupling(c, &n, &coupling), "CoracleGetCoupling was called before CoracleReady");
  REFUSED(CoracleGetCorrection(c, &n, &correction), "CoracleGetCorrection was called before CoracleReady");
  REFUSED(CoracleStepAccepted(c), "CoracleStepAccepted was called before CoracleReady");
  REFUSED(CoracleElementsChanged(c), "CoracleElementsChanged was called before CoracleReady");
  REFUSED(CoracleSetFlow(c, &good), "CoracleSetFlow was called before CoracleReady");
  REFUSED(CoracleGetGauges(c, &n, &gauge), "CoracleGetGauges was called before CoracleReady");
  REFUSED(CoracleSetNodes(c, 2, 3, GID, X, ZERO), "CoracleSetNodes is for a solid");
  REFUSED(CoracleSetInertia(c, ONE, ZERO), "CoracleSetInertia is for a solid");
  REFUSED(CoracleSubstep(c, 0.1, ZERO), "CoracleSubstep is for a solid");
  CoracleGetRegion(c, &n, &(const double *){NULL});
  CoracleSetRegion(c, 2, lower, upper, Failing, NULL);
  REFUSED(CoracleReady(c), "the region function failed in step 0");
  CoracleSetRegion(c, 2, lower, upper, Region, &t);
  REFUSED(CoracleReady(c), "density is 0 kg/m3 at element 0 in step 0: it must be positive");
  CoracleSetRegion(c, 2, lower, upper, Region, NULL);
  CoracleProposeStep(c, 0.1);
  CoracleReady(c);
  REFUSED(CoracleGetRegion(c, &n, &(const double *){NULL}),
          "CoracleGetRegion was called between CoracleEnd and CoracleBegin");
  CoracleBegin(c, &t, &dt, &action);
  REFUSED(CoracleEnd(c, NULL), "CoracleEnd: CoracleSetFlow comes first, in every step");
  REFUSED(CoracleSetFlow(c, NULL), "CoracleSetFlow: the flow is NULL");
  bad.u_star = nan;
  REFUSED(CoracleSetFlow(c, &bad),
          "velocity before the projection is nan at element 0, component 0, in step 1");
  bad.u_star = NULL;
  REFUSED(CoracleSetFlow(c, &bad), "the velocity before the projection of 1 elements is missing in step 1");
}

int main(int argc, char **argv)
{
  const char *role = getenv("TEST_ROLE");
  MPI_Comm comm;
  CoracleClient c;
  CoracleSetErrorHandler(Catch, NULL);
  Nobody();
  CoracleOpen(role, argc, argv, &comm, &c);
  if (!strcmp(role, "solid")) {
    Setup(c);
    InStep(c);
  } else {
    Fluid(c);
  }
  printf("misuse: %d wrong calls of a %s were refused\n", COUNT, role);
  fflush(stdout);
  sleep(1); /* MPICH's launcher drops what it has not read */
  MPI_Abort(MPI_COMM_WORLD, 0);
  return 0;
}
