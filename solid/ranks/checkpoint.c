/* The solid in a checkpoint: its state (state_file.c), time and counters; "solid seconds" has SolidStats's, the largest
 * of all ranks. */
#include "solid/ranks/state.h"

/* --- numbers ------------------------------------------------------------------------------------------ */

enum { T, H, PLANNED, REVISION, SUBSTEPS, TOTAL, SEARCHES, REBALANCED, ITERATIONS, BEST, LOSS, NNUMBERS };
static const char *const NUMBERS[NNUMBERS] = {"solid t",
                                              "solid h",
                                              "solid planned h",
                                              "solid revision",
                                              "solid substeps",
                                              "solid substeps so far",
                                              "solid searches",
                                              "solid rebalanced",
                                              "solid response iterations",
                                              "solid best balance",
                                              "solid loss of balance"};
enum { NSECONDS = 6 };

/* Between two steps the last substep's length and what the next one may be is all that there is of one. */
static PetscErrorCode PutNumbers(Solid s, Checkpoint to)
{
  const SolidStats *stats = &s->stats;
  const double value[NNUMBERS] = {[T] = stats->t,
                                  [H] = s->moved_for,
                                  [PLANNED] = s->planned,
                                  [REVISION] = s->revision,
                                  [SUBSTEPS] = stats->substeps,
                                  [TOTAL] = (double)stats->total,
                                  [SEARCHES] = stats->searches,
                                  [REBALANCED] = stats->rebalanced,
                                  [ITERATIONS] = (double)stats->response_iterations,
                                  [BEST] = s->balance.best,
                                  [LOSS] = s->balance.loss};
  double seconds[NSECONDS];
  PetscFunctionBeginUser;
  for (int k = 0; k < NNUMBERS; k++) PetscCall(CheckpointPutNumber(to, NUMBERS[k], value[k]));
  PetscCallMPI(MPI_Allreduce(stats->seconds, seconds, NSECONDS, MPI_DOUBLE, MPI_MAX, s->comm));
  PetscCall(CheckpointPutDoubles(to, "solid seconds", s->rank ? 0 : NSECONDS, 1, seconds));
  PetscFunctionReturn(0);
}

static PetscErrorCode GetNumbers(Solid s, Checkpoint from)
{
  double value[NNUMBERS];
  PetscFunctionBeginUser;
  for (int k = 0; k < NNUMBERS; k++) PetscCall(CheckpointGetNumber(from, NUMBERS[k], &value[k]));
  s->h = s->moved_for = value[H];
  s->planned = value[PLANNED];
  s->revision = (int)value[REVISION];
  s->balance = (Balance){value[BEST], value[LOSS]};
  s->stats = (SolidStats){.t = value[T],
                          .substeps = (int)value[SUBSTEPS],
                          .h = value[H],
                          .total = (long long)value[TOTAL],
                          .searches = (int)value[SEARCHES],
                          .rebalanced = (int)value[REBALANCED],
                          .response_iterations = (long long)value[ITERATIONS]};
  PetscCall(CheckpointGetDoubles(from, "solid seconds", 0, NSECONDS, 1, s->stats.seconds));
  PetscFunctionReturn(0);
}

/* --- all ---------------------------------------------------------------------------------------------- */

enum { NCOUNTS = 4 };
static const char *const COUNTS[NCOUNTS] = {"bodies", "elements", "nodes", "joints"};

static void CountsOf(const Solid s, int count[NCOUNTS])
{
  const int all[NCOUNTS] = {s->nbodies, s->global.elements, s->global.nodes, s->global.joints};
  for (int k = 0; k < NCOUNTS; k++) count[k] = all[k];
}

static PetscErrorCode CheckFits(Solid s, Checkpoint from)
{
  double found;
  int expected[NCOUNTS];
  PetscFunctionBeginUser;
  CountsOf(s, expected);
  for (int k = 0; k < NCOUNTS; k++) {
    PetscCall(CheckpointGetNumber(from, COUNTS[k], &found));
    PetscCheck(found == expected[k], s->comm, PETSC_ERR_FILE_UNEXPECTED,
               "cannot resume from %s/solid.h5: it is of other bodies: it has %.0f %s, the case has %d",
               CheckpointFolder(from), found, COUNTS[k], expected[k]);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SolidSave(Solid s, Checkpoint to)
{
  int count[NCOUNTS];
  PetscFunctionBeginUser;
  CountsOf(s, count);
  for (int k = 0; k < NCOUNTS; k++) PetscCall(CheckpointPutNumber(to, COUNTS[k], count[k]));
  PetscCall(CheckpointPutNumber(to, "ranks", s->size));
  PetscCall(StateToFile(s, to));
  PetscCall(PutNumbers(s, to));
  PetscFunctionReturn(0);
}

/* What is fixed now may have moved before: in itself, and as the fluid sees it. */
static void StopFixed(Solid s)
{
  for (int n = 0; n < s->nnodes; n++) {
    if (s->inverse_mass[n] > 0.0) continue;
    s->mobility[n] = 0.0;
    for (int k = 2 * n; k < 2 * n + 2; k++) s->v[k] = s->interface_velocity[k] = s->acceleration[k] = 0.0;
  }
}

PetscErrorCode SolidLoad(Solid s, Checkpoint from)
{
  const StateSource file = StateFromFile(from);
  double ranks;
  PetscFunctionBeginUser;
  PetscCall(CheckFits(s, from));
  PetscCall(CheckpointGetNumber(from, "ranks", &ranks));
  if (s->part && ranks == s->size) PetscCall(StateTakePartition(s, from));
  PetscCall(SolidTakeState(s, &file));
  PetscCall(GetNumbers(s, from));
  StopFixed(s);
  if (s->part && ranks != s->size) PetscCall(SolidDealOut(s));
  PetscFunctionReturn(0);
}
