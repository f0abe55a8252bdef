/* The coupler of the conformance kit: forces on an outside solid that are functions of time alone, in an order of steps in
 * which a sound adapter repeats itself, and what it does wrong is said.  scripts/conform.py runs it.
 *
 * Step k is dt_max times 1, 1/3, 1/7 or 0.9 long (k mod 4).  The force on a node is its part of the solid's area times
 * fluid.density |gravity|, in a direction that turns with time, so that it is about the weight of the displaced fluid.
 * In every third step, from the second on:
 *
 *     RUN force F  ->  REDO force F + G  ->  REDO force F:   the last must give the first's bits, the second must have moved
 *                                                            with G, not against it
 *
 * Keys, given by --set coupler.conformance.*: steps (12), save (the step that begins with a checkpoint; 0: none), folder
 * (of the checkpoint and of motion.csv, one row a step). */
#include "common/conformance/motion.h"
#include "common/link/case_file.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct {
  Server server;
  MPI_Comm comm;
  int rank, steps, save, first; /* first: step of the run that resumes, else 1 */
  int changed;                  /* how often the solid has given another mesh */
  double t, dt_max, pressure;   /* pressure: fluid.density |gravity|, N/m3 */
  char folder[3000];
  Motion now, start, attempt, other; /* of the step: its start, its first and second attempt */
  FILE *rows;
} Kit;

static void Fail(void *server, const char *message)
{
  ServerFail(server, "%s", message);
}

static void ReadCase(Kit *k, int argc, char **argv)
{
  CoracleCase c;
  double gravity[2];
  CoracleCaseOpen(argc, argv, Fail, k->server, &c);
  CoracleCaseVector(c, "gravity", 2, gravity);
  const double g = hypot(gravity[0], gravity[1]);
  k->pressure = CoracleCaseNumberOr(c, "fluid.density", 1000.0, 0.0, HUGE_VAL) * (g > 0.0 ? g : 1.0);
  k->dt_max = CoracleCasePositive(c, "time.dt_max");
  k->steps = CoracleCaseIntegerOr(c, "coupler.conformance.steps", 12, 0, 1000);
  k->save = CoracleCaseIntegerOr(c, "coupler.conformance.save", 0, 0, 1000);
  snprintf(k->folder, sizeof k->folder, "%s", CoracleCaseString(c, "coupler.conformance.folder"));
  CoracleCaseClose(&c);
}

static double StepSize(const Kit *k, int step)
{
  static const double PART[] = {1.0, 1.0 / 3.0, 1.0 / 7.0, 0.9};
  return k->dt_max * PART[step % 4];
}

static int Attempts(int step)
{
  return step % 3 == 2 ? 3 : 1;
}

/* --- the exchanges -------------------------------------------------------------------------------------- */

static void AskElements(Kit *k)
{
  const double box[] = {-1e9, -1e9, 1e9, 1e9};
  ServerElements e;
  ServerAskElements(k->server, 1, box, &e);
}

static void Receive(Kit *k)
{
  ServerSolid solid;
  ServerReceiveSolid(k->server, &solid);
  MotionTake(&k->now, &solid);
  k->changed += solid.changed;
}

/* Force F, with G when `more`, on the nodes of the step's start. */
static void SendForce(Kit *k, int step, CoracleAction action, int more)
{
  const double dt = StepSize(k, step), phase = 2.0 * M_PI * (k->t + dt) / (5.0 * k->dt_max);
  const double density[2] = {k->pressure * (cos(phase) + 0.5 * more),
                             k->pressure * (sin(phase) - 0.25 * more)};
  double *force = malloc(2 * sizeof *force * (size_t)k->start.n + 1);
  for (int i = 0; i < 2 * k->start.n; i++) force[i] = k->start.area[i / 2] * density[i % 2];
  ServerSendForce(k->server, k->t, dt, action, force);
  free(force);
}

static void SendCoupling(Kit *k, int step, CoracleAction action)
{
  ServerSendCoupling(k->server, k->t, action == CORACLE_STOP ? 0.0 : StepSize(k, step), action, 0, NULL, 0,
                     NULL);
}

/* --- what is checked ------------------------------------------------------------------------------------ */

static void CheckRepeats(const Kit *k, int step)
{
  char what[128];
  if (MotionDiffers(&k->attempt, &k->now, what, sizeof what))
    ServerFail(k->server,
               "conformance: step %d, redone with the force of its first attempt, has another %s: bind all "
               "state that a step changes "
               "(CoracleBindState) and let nothing else depend on the attempts before",
               step, what);
}

static void CheckDirection(const Kit *k, int step)
{
  const double G[2] = {0.5, -0.25};
  double work = 0.0, path = 0.0;
  if (k->attempt.n == k->other.n && k->attempt.n == k->start.n)
    for (int i = 0; i < 2 * k->start.n; i++) {
      const double moved = k->other.x[i] - k->attempt.x[i];
      work += k->start.area[i / 2] * G[i % 2] * moved;
      path += k->start.area[i / 2] * fabs(moved);
    }
  MPI_Allreduce(MPI_IN_PLACE, &work, 1, MPI_DOUBLE, MPI_SUM, k->comm);
  MPI_Allreduce(MPI_IN_PLACE, &path, 1, MPI_DOUBLE, MPI_SUM, k->comm);
  if (work < -1e-6 * path)
    ServerFail(k->server,
               "conformance: in step %d an additional force moves the solid against its direction: sign of "
               "the force?",
               step);
}

/* --- checkpoint ----------------------------------------------------------------------------------------- */

static void Save(Kit *k, int step)
{
  char path[4000];
  snprintf(path, sizeof path, "%s/checkpoint", k->folder);
  if (k->rank == 0) {
    if (mkdir(path, 0777) && errno != EEXIST) ServerFail(k->server, "%s: %s", path, strerror(errno));
    strcat(path, "/step");
    FILE *file = fopen(path, "w");
    if (!file || fprintf(file, "%d %.17g\n", step, k->t) < 0 || fclose(file))
      ServerFail(k->server, "%s: %s", path, strerror(errno));
  }
  MPI_Barrier(k->comm);
  snprintf(path, sizeof path, "%s/checkpoint", k->folder);
  ServerSave(k->server, path);
}

static void Resume(Kit *k)
{
  char path[4000];
  const char *folder = ServerResumePath(k->server);
  k->first = 1;
  if (!folder) return;
  snprintf(path, sizeof path, "%s/step", folder);
  FILE *file = fopen(path, "r");
  if (!file || fscanf(file, "%d %lf", &k->first, &k->t) != 2)
    ServerFail(k->server, "%s cannot be read", path);
  fclose(file);
}

static void CheckSaved(Kit *k)
{
  const char *role = ServerUnsaved(k->server);
  if (role && k->rank == 0)
    printf("conformance: note: the %s has not saved a checkpoint: its runs cannot resume\n", role);
}

/* --- the run -------------------------------------------------------------------------------------------- */

static void Attempt(Kit *k, int step, int attempt)
{
  const int last = attempt == Attempts(step) - 1;
  CoracleFlow flow;
  ServerReceiveFlow(k->server, &flow);
  SendForce(k, step, attempt ? CORACLE_REDO : CORACLE_RUN, attempt == 1);
  Receive(k);
  if (attempt == 0) MotionCopy(&k->attempt, &k->now);
  if (attempt == 1) MotionCopy(&k->other, &k->now);
  if (attempt == 2) CheckRepeats(k, step);
  if (attempt == 2) CheckDirection(k, step);
  if (last) k->t += StepSize(k, step);
  if (last && step == k->save) CheckSaved(k);
  if (last && step + 1 == k->save) Save(k, step + 1);
  if (ServerElementsChanged(k->server) && last) AskElements(k);
  SendCoupling(k, last ? step + 1 : step,
               !last             ? CORACLE_REDO
               : step < k->steps ? CORACLE_RUN
                                 : CORACLE_STOP);
}

static void Row(Kit *k, int step)
{
  double sum[MOTION_SUMS];
  MotionSum(&k->now, sum);
  MPI_Allreduce(MPI_IN_PLACE, sum, MOTION_SUMS, MPI_DOUBLE, MPI_SUM, k->comm);
  if (!k->rows) return;
  fprintf(k->rows, "%d,%.17g", step, k->t);
  for (int i = 0; i < MOTION_SUMS; i++) fprintf(k->rows, ",%.17g", sum[i] / (i ? sum[0] : 1.0));
  fputc('\n', k->rows);
}

static void OpenRows(Kit *k)
{
  char path[4000];
  if (k->rank) return;
  snprintf(path, sizeof path, "%s/motion.csv", k->folder);
  k->rows = fopen(path, "w");
  if (!k->rows) ServerFail(k->server, "%s: %s", path, strerror(errno));
  fprintf(
      k->rows,
      "step,t [s],area [m2],x [m],y [m],x2 [m2],y2 [m2],u_x [m/s],u_y [m/s],given_x [m/s],given_y [m/s]\n");
}

int main(int argc, char **argv)
{
  static Kit k;
  ServerOpen(argc, argv, &k.comm, &k.server);
  MPI_Comm_rank(k.comm, &k.rank);
  ReadCase(&k, argc, argv);
  Resume(&k);
  OpenRows(&k);
  Receive(&k);
  AskElements(&k);
  Row(&k, k.first - 1);
  SendCoupling(&k, k.first, k.steps >= k.first ? CORACLE_RUN : CORACLE_STOP);
  for (int step = k.first; step <= k.steps; step++) {
    MotionCopy(&k.start, &k.now);
    for (int attempt = 0; attempt < Attempts(step); attempt++) Attempt(&k, step, attempt);
    Row(&k, step);
  }
  MotionCopy(&k.start, &k.now);
  ServerSendForce(k.server, k.t, 0.0, CORACLE_STOP, NULL);
  ServerFinish(k.server);
  if (k.rank == 0 && k.changed > 1)
    printf("conformance: note: the mesh has changed %d times\n", k.changed - 1);
  if (k.rows && fclose(k.rows)) ServerFail(k.server, "motion.csv: %s", strerror(errno));
  for (Motion *m[] = {&k.now, &k.start, &k.attempt, &k.other}, **p = m; p < m + 4; p++) MotionFree(*p);
  return ServerClose(&k.server);
}
