// ranks: 1 2 3
/* A solid that is saved while it slides, has a prescribed motion and breaks, and loaded into a new one: it continues with the
 * same bits on as many ranks, whoever had which elements, a step that is redone too; on other ranks to
 * round-off.  What is fixed from there on stays.  A checkpoint of other bodies is refused. */
#include "solid/contact/contact_impl.h"
#include "solid/cracks/joints_impl.h"
#include "tests/remove_folder.h"
#include "tests/solid/breaking.h"
#include "tests/solid/same_solid.h"
#include <sys/stat.h>
#include <unistd.h>

enum { BEFORE = 3, AFTER = 2, NBODIES = 4 };
/* What elements do after each step; or there are no joints. */
enum { STAY, SCATTER, REBALANCE, INTACT, NHOWS };
#define DIFFERENT 1e-10 /* relative, on other ranks */

static char folder[64];

/* --- the runs ----------------------------------------------------------------------------------------- */

/* On a floor that the disc touches. */
static PetscErrorCode Create(MPI_Comm comm, int how, Model *a, Solid *s)
{
  static const double LOST[NHOWS] = {[SCATTER] = 1e9, [REBALANCE] = 0.5};
  const SolidSetup options = {.courant = 0.8,
                              .rebalance = LOST[how],
                              .gravity = {0.0, -10.0},
                              .walls = PETSC_TRUE,
                              .lower = {-1.0, -0.0499},
                              .upper = {1.0, 1.0}};
  *a = (Model){0};
  Bodies(a);
  for (int e = 0; e < a->nelements && how == INTACT; e++) a->jointed[e] = 0;
  return SolidCreate(comm, a, &options, s);
}

/* first .. first + n - 1, as the participant makes them: the interface motion follows each step */
static PetscErrorCode Steps(Solid s, const Model *a, int how, int first, int n)
{
  BodyState body[NBODIES];
  InterfaceMotion interface;
  for (int k = first; k < first + n; k++) {
    PetscCall(PushStep(s, 1e6));
    PetscCall(SolidRebalance(s));
    if (how == SCATTER) PetscCall(ScatterElements(s, a->nelements, k));
    PetscCall(SolidUpdateInterfaceMotion(s, &interface));
    PetscCall(SolidBodies(s, NBODIES, body));
  }
  return 0;
}

static PetscErrorCode Save(Solid s, MPI_Comm comm, const char *name)
{
  Checkpoint to;
  PetscCall(CheckpointCreate(comm, folder, name, &to));
  PetscCall(SolidSave(s, to));
  return CheckpointClose(&to);
}

static PetscErrorCode Load(Solid s, MPI_Comm comm, const char *name)
{
  Checkpoint from;
  PetscCall(CheckpointOpen(comm, folder, name, &from));
  PetscCall(SolidLoad(s, from));
  return CheckpointClose(&from);
}

/* --- the same bits ------------------------------------------------------------------------------------ */

/* A state that has all that is to be saved. */
static PetscErrorCode CheckWorthSaving(Solid s, int how)
{
  FractureState f;
  const Slip *slip;
  int n, slips[2] = {0}; /* on bodies, on walls */
  PetscCall(SolidFracture(s, &f));
  PetscCall(ContactSlips(s->contact, &n, &slip));
  for (int k = 0; k < n; k++) slips[slip[k].other < 0]++;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, slips, 2, MPI_INT, MPI_SUM, PETSC_COMM_WORLD));
  if (getenv("VERBOSE"))
    printf("saved with %d live and %d broken joints, revision %d, %d and %d slips, rebalanced %d times\n",
           f.active, f.broken, s->revision, slips[0], slips[1], s->stats.rebalanced);
  CHECK(how == INTACT || (f.active > 5 && f.broken > 5 && s->revision > 5 && slips[0] > 5),
        "%d live and %d broken joints, revision %d, %d slips", f.active, f.broken, s->revision, slips[0]);
  CHECK(slips[1] > 0, "%d slips on walls", slips[1]);
  return 0;
}

static PetscErrorCode Same(int how, int redo)
{
  Model a, b;
  Solid one, two;
  PetscCall(Create(PETSC_COMM_WORLD, how, &a, &one));
  PetscCall(Steps(one, &a, how, 0, BEFORE));
  PetscCall(CheckWorthSaving(one, how));
  PetscCall(Save(one, PETSC_COMM_WORLD, "same"));
  PetscCall(Create(PETSC_COMM_WORLD, how, &b, &two));
  PetscCall(Load(two, PETSC_COMM_WORLD, "same"));
  SameNodes(one, two);
  SameJoints(one, two);
  SameStats(one, two);
  for (int k = 0; k < 5; k++)
    CHECK(two->stats.seconds[k] >= one->stats.seconds[k], "phase %d: %g and %g seconds", k,
          one->stats.seconds[k], two->stats.seconds[k]);
  if (redo) {
    PetscCall(SolidState(two, 1));
    PetscCall(PushStep(two, 2e7));
    if (how == SCATTER) PetscCall(ScatterElements(two, b.nelements, BEFORE + 1));
    PetscCall(SolidState(two, 0));
  }
  PetscCall(Steps(one, &a, how, BEFORE, AFTER));
  PetscCall(Steps(two, &b, how, BEFORE, AFTER));
  SameNodes(one, two);
  SameJoints(one, two);
  PetscCall(SameSums(NBODIES, one, two));
  if (!redo) SameStats(one, two);
  PetscCall(ModelDestroy(&a));
  PetscCall(ModelDestroy(&b));
  PetscCall(SolidDestroy(&one));
  return SolidDestroy(&two);
}

/* --- other ranks -------------------------------------------------------------------------------------- */

/* all[nids][4]: x and v of all ranks' nodes, NAN where there is none */
static PetscErrorCode Gather(Solid s, MPI_Comm comm, int nids, double all[])
{
  const SolidView v = ViewOf(s, NULL, NULL);
  for (int k = 0; k < 4 * nids; k++) all[k] = -HUGE_VAL;
  for (int n = 0; n < v.nnodes; n++)
    for (int c = 0; c < 2; c++) {
      all[4 * v.gid[n] + c] = v.x[2 * n + c];
      all[4 * v.gid[n] + 2 + c] = v.v[2 * n + c];
    }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, all, 4 * nids, MPI_DOUBLE, MPI_MAX, comm));
  for (int k = 0; k < 4 * nids; k++)
    if (all[k] == -HUGE_VAL) all[k] = NAN;
  return 0;
}

static void AlikeNodes(int n, const double one[], const double two[])
{
  double largest = 0.0;
  for (int k = 0; k < n; k++) {
    CHECK(isnan(one[k]) == isnan(two[k]), "node %d is there once only", k / 4);
    if (!isnan(one[k])) largest = fmax(largest, fabs(one[k] - two[k]) / (k % 4 < 2 ? 0.1 : 10.0));
  }
  if (getenv("VERBOSE")) printf("largest difference on other ranks %.2e\n", largest);
  CHECK(largest < DIFFERENT, "differs on other ranks by %g", largest);
}

static PetscErrorCode AlikeSums(Solid one, Solid two)
{
  FractureState f[2];
  double energy[2];
  PetscCall(TotalEnergy(one, NBODIES, &energy[0]));
  PetscCall(TotalEnergy(two, NBODIES, &energy[1]));
  PetscCall(SolidFracture(one, &f[0]));
  PetscCall(SolidFracture(two, &f[1]));
  CHECK(fabs(energy[0] - energy[1]) < DIFFERENT * energy[0], "energy %.15g and %.15g", energy[0], energy[1]);
  CHECK(fabs(f[0].energy - f[1].energy) < DIFFERENT * f[0].energy, "energy of fracture %.15g and %.15g",
        f[0].energy, f[1].energy);
  CHECK(f[0].broken == f[1].broken && f[0].active == f[1].active, "%d and %d broken, %d and %d live",
        f[0].broken, f[1].broken, f[0].active, f[1].active);
  return 0;
}

/* Saved by the ranks of `before` together, loaded by those of `after`. */
static PetscErrorCode Other(MPI_Comm before, MPI_Comm after, const char *name)
{
  Model a, b;
  Solid one, two;
  PetscMPIInt rank, size[2];
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(before, &size[0]);
  MPI_Comm_size(after, &size[1]);
  PetscCall(Create(before, REBALANCE, &a, &one));
  PetscCall(Steps(one, &a, STAY, 0, BEFORE));
  if (before == PETSC_COMM_WORLD || rank == 0) PetscCall(Save(one, before, name));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscCall(Create(after, REBALANCE, &b, &two));
  PetscCall(Load(two, after, name));
  CHECK(size[0] == size[1] || size[1] == 1 || two->stats.rebalanced == one->stats.rebalanced + 1,
        "rebalanced %d times, %d before", two->stats.rebalanced, one->stats.rebalanced);
  const long long iterations = one->stats.response_iterations + two->stats.response_iterations;
  PetscCall(Steps(one, &a, STAY, BEFORE, AFTER));
  PetscCall(Steps(two, &b, STAY, BEFORE, AFTER));
  CHECK(one->stats.response_iterations + two->stats.response_iterations < iterations + 200 * AFTER,
        "%lld iterations of the step's response",
        one->stats.response_iterations + two->stats.response_iterations - iterations);
  const int nids = a.nnodes + 3 * a.nelements;
  double *all = malloc(8 * (size_t)nids * sizeof *all);
  PetscCall(Gather(one, before, nids, all));
  PetscCall(Gather(two, after, nids, all + 4 * nids));
  AlikeNodes(4 * nids, all, all + 4 * nids);
  PetscCall(AlikeSums(one, two));
  free(all);
  PetscCall(ModelDestroy(&a));
  PetscCall(ModelDestroy(&b));
  PetscCall(SolidDestroy(&one));
  return SolidDestroy(&two);
}

/* --- bodies that are fixed from there on ------------------------------------------------------------------ */

/* All bodies have moved when they are saved, and stay where they are loaded. */
static PetscErrorCode Fixed(void)
{
  Model a, b;
  Solid one, two;
  double moved = 0.0, gone = 0.0;
  PetscCall(Create(PETSC_COMM_WORLD, INTACT, &a, &one));
  PetscCall(Steps(one, &a, INTACT, 0, BEFORE));
  PetscCall(Save(one, PETSC_COMM_WORLD, "free"));
  const SolidSetup options = {.courant = 0.8, .gravity = {0.0, -10.0}};
  b = (Model){0};
  Bodies(&b);
  memset(b.jointed, 0, (size_t)b.nelements * sizeof *b.jointed);
  for (int n = 0; n < b.nnodes; n++) b.fixed[n] = 1;
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &b, &options, &two));
  PetscCall(Load(two, PETSC_COMM_WORLD, "free"));
  double *x = malloc(2 * (size_t)two->nnodes * sizeof *x);
  memcpy(x, two->x, 2 * (size_t)two->nnodes * sizeof *x);
  for (int k = 0; k < 2 * one->nnodes; k++) moved = fmax(moved, fabs(one->v[k]));
  PetscCall(PushStep(two, 0.0));
  for (int k = 0; k < 2 * two->nnodes; k++)
    if (!two->is_prescribed[k / 2]) gone = fmax(gone, fabs(two->x[k] - x[k]));
  CHECK(moved > 1.0 && gone == 0.0, "fixed nodes that were %g m/s fast have moved by %g m", moved, gone);
  free(x);
  PetscCall(ModelDestroy(&a));
  PetscCall(ModelDestroy(&b));
  PetscCall(SolidDestroy(&one));
  return SolidDestroy(&two);
}

/* --- other bodies ------------------------------------------------------------------------------------- */

static char reported[512];

static PetscErrorCode Remember(MPI_Comm comm, int line, const char *function, const char *file,
                               PetscErrorCode code, PetscErrorType type, const char *message, void *context)
{
  if (message && !reported[0]) snprintf(reported, sizeof reported, "%s", message);
  return code;
}

static PetscErrorCode Refused(void)
{
  const SolidSetup options = {.courant = 0.8};
  const BodySetup setup = BodyAtRest(Rough());
  Model a = {0}, saved = {0};
  Solid s;
  Checkpoint from;
  char expected[64];
  Bodies(&saved);
  for (int k = 0; k < NBODIES; k++) AddDisc(&a, 0.1 * k, 0.0, 0.04, 0.01, &setup);
  snprintf(expected, sizeof expected, "it has %d elements, the case has %d", saved.nelements, a.nelements);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(CheckpointOpen(PETSC_COMM_WORLD, folder, "same", &from));
  PetscCall(PetscPushErrorHandler(Remember, NULL));
  CHECK(SolidLoad(s, from), "other bodies are taken");
  PetscCall(PetscPopErrorHandler());
  PetscCall(CheckpointClose(&from));
  CHECK(strstr(reported, expected), "'%s' instead of '%s'", reported, expected);
  PetscCall(SolidDestroy(&s));
  PetscCall(ModelDestroy(&saved));
  return ModelDestroy(&a);
}

/* --- the folder --------------------------------------------------------------------------------------- */

static void MakeFolder(void)
{
  PetscMPIInt rank;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  snprintf(folder, sizeof folder, "/tmp/coracle_saved_%d", (int)getpid());
  MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, PETSC_COMM_WORLD);
  if (rank == 0) CHECK(!mkdir(folder, 0700), "cannot make %s", folder);
  MPI_Barrier(PETSC_COMM_WORLD);
}

int main(int argc, char **argv)
{
  PetscMPIInt rank;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  MakeFolder();
  PetscCall(Same(STAY, 0));
  PetscCall(Same(SCATTER, 1));
  PetscCall(Same(REBALANCE, 0));
  PetscCall(Same(INTACT, 1));
  PetscCall(Other(PETSC_COMM_WORLD, PETSC_COMM_SELF, "parted"));
  PetscCall(Other(PETSC_COMM_SELF, PETSC_COMM_WORLD, "joined"));
  PetscCall(Fixed());
  PetscCall(Refused());
  MPI_Barrier(PETSC_COMM_WORLD);
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank == 0) RemoveFolder(folder);
  return PetscFinalize();
}
