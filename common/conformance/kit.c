#include "common/conformance/kit.h"
#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

static void Fail(void *server, const char *message)
{
  ServerFail(server, "%s", message);
}

/* The middle third of the fluid's mesh, or what is given. */
static void ReadBox(Kit *k, CoracleCase c)
{
  double lower[2], upper[2];
  if (CoracleCaseHas(c, "coupler.conformance.box")) {
    CoracleCaseVector(c, "coupler.conformance.box", 4, k->box);
    return;
  }
  CoracleCaseVector(c, "fluid.mesh.lower", 2, lower);
  CoracleCaseVector(c, "fluid.mesh.upper", 2, upper);
  for (int d = 0; d < 2; d++) {
    k->box[d] = (2.0 * lower[d] + upper[d]) / 3.0;
    k->box[2 + d] = (lower[d] + 2.0 * upper[d]) / 3.0;
  }
}

static void ReadCase(Kit *k, int argc, char **argv)
{
  static const char *const OF[] = {"solid", "fluid", NULL};
  CoracleCase c;
  double gravity[2];
  CoracleCaseOpen(argc, argv, Fail, k->server, &c);
  CoracleCaseVector(c, "gravity", 2, gravity);
  k->gravity = hypot(gravity[0], gravity[1]);
  if (!(k->gravity > 0.0)) k->gravity = 1.0;
  k->density = CoracleCaseNumberOr(c, "fluid.density", 1000.0, 0.0, HUGE_VAL);
  k->dt_max = CoracleCasePositive(c, "time.dt_max");
  k->of_fluid = CoracleCaseWord(c, "coupler.conformance.of", 0, OF) == 1;
  k->steps = CoracleCaseIntegerOr(c, "coupler.conformance.steps", 12, 0, 1000);
  k->save = CoracleCaseIntegerOr(c, "coupler.conformance.save", 0, 0, 1000);
  snprintf(k->folder, sizeof k->folder, "%s", CoracleCaseString(c, "coupler.conformance.folder"));
  if (k->of_fluid) ReadBox(k, c);
  CoracleCaseClose(&c);
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

void KitOpen(int argc, char **argv, Kit *k)
{
  ServerOpen(argc, argv, &k->comm, &k->server);
  MPI_Comm_rank(k->comm, &k->rank);
  ReadCase(k, argc, argv);
  Resume(k);
}

int KitClose(Kit *k)
{
  ServerFinish(k->server);
  if (k->rank == 0 && k->changed > 0)
    printf("conformance: note: the mesh has changed %d times\n", k->changed);
  if (k->rows && fclose(k->rows)) ServerFail(k->server, "rows.csv: %s", strerror(errno));
  return ServerClose(&k->server);
}

void KitRefuseRejection(const Kit *k, int step)
{
  const char *why = ServerRejection(k->server);
  if (why)
    ServerFail(
        k->server,
        "conformance: step %d, over %g s, is rejected (CoracleRejectStep) by the %s; a smaller time.dt_max?",
        step, k->dt, why);
}

double KitStepSize(const Kit *k, int step)
{
  static const double PART[] = {1.0, 1.0 / 3.0, 1.0 / 7.0, 0.9};
  const double dt = k->dt_max * PART[step % 4];
  return k->of_fluid ? fmin(dt, ServerProposedStep(k->server)) : dt;
}

double KitPhase(const Kit *k)
{
  return 2.0 * M_PI * (k->t + k->dt) / (5.0 * k->dt_max);
}

/* --- rows ----------------------------------------------------------------------------------------------- */

void KitOpenRows(Kit *k, const char *columns)
{
  char path[4000];
  if (k->rank) return;
  snprintf(path, sizeof path, "%s/rows.csv", k->folder);
  k->rows = fopen(path, "w");
  if (!k->rows) ServerFail(k->server, "%s: %s", path, strerror(errno));
  fprintf(k->rows, "step,t [s],%s\n", columns);
}

void KitRow(Kit *k, int step, int n, const double value[])
{
  if (!k->rows) return;
  fprintf(k->rows, "%d,%.17g", step, k->t);
  for (int i = 0; i < n; i++) fprintf(k->rows, ",%.17g", value[i]);
  fputc('\n', k->rows);
}

/* --- checkpoints ---------------------------------------------------------------------------------------- */

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

void KitCheckpoint(Kit *k, int step)
{
  if (step == k->save) {
    const char *role = ServerUnsaved(k->server);
    if (role && k->rank == 0)
      printf("conformance: note: the %s has not saved a checkpoint: its runs cannot resume\n", role);
  }
  if (step + 1 == k->save) Save(k, step + 1);
}
