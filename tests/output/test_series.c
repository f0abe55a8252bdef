// ranks: 1 2 3
/* Series: the header, rows of rank 0 only, on disk as soon as they are given; two of them resume from one checkpoint, each
 * where it was, and not with other columns. */
#include "tests/output/read_back.h"
#include <math.h>
#include <unistd.h>

enum { SERIES = 2 };
static const char *const NAME[SERIES] = {"long", "short"};

/* A run that writes some rows, a checkpoint, and more rows; or one that resumes from that and writes the last of these. */
static PetscErrorCode Write(const char *folder, const char *checkpoint, PetscBool resumes)
{
  Series series[SERIES];
  Checkpoint file = NULL;
  PetscFunctionBeginUser;
  if (resumes) PetscCall(CheckpointOpen(PETSC_COMM_WORLD, checkpoint, "test", &file));
  for (int k = 0; k < SERIES; k++)
    PetscCall(SeriesCreate(PETSC_COMM_WORLD, folder, NAME[k], "t [s]", 0.0, file, &series[k]));
  if (!resumes) {
    for (int row = 0; row < 5; row++) PetscCall(SeriesRow(series[0], (double[]){row}));
    PetscCall(CheckpointCreate(PETSC_COMM_WORLD, checkpoint, "test", &file));
    for (int k = 0; k < SERIES; k++) PetscCall(SeriesSave(series[k], file));
  }
  PetscCall(CheckpointClose(&file));
  for (int k = 0; k < SERIES; k++) {
    if (!resumes) PetscCall(SeriesRow(series[k], (double[]){7.0}));
    PetscCall(SeriesRow(series[k], (double[]){8.0}));
    PetscCall(SeriesDestroy(&series[k]));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckResumed(const char *folder, PetscMPIInt rank)
{
  static const char *const EXPECTED[SERIES] = {"t [s]\n0\n1\n2\n3\n4\n8\n", "t [s]\n8\n"};
  char checkpoint[300], path[512];
  Checkpoint file;
  Series s;
  PetscFunctionBeginUser;
  snprintf(checkpoint, sizeof checkpoint, "%s/checkpoint", folder);
  if (rank == 0) PetscCall(PetscMkdir(checkpoint));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscCall(Write(folder, checkpoint, PETSC_FALSE));
  PetscCall(Write(folder, checkpoint, PETSC_TRUE));
  PetscCall(CheckpointOpen(PETSC_COMM_WORLD, checkpoint, "test", &file));
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  CHECK(SeriesCreate(PETSC_COMM_WORLD, folder, NAME[0], "t [s],u [m/s]", 0.0, file, &s),
        "goes on with other columns");
  PetscCall(PetscPopErrorHandler());
  PetscCall(SeriesDestroy(&s));
  PetscCall(CheckpointClose(&file));
  for (int k = 0; rank == 0 && k < SERIES; k++) {
    snprintf(path, sizeof path, "%s/%s.csv", folder, NAME[k]);
    char *text = ReadText(path);
    CHECK(!strcmp(text, EXPECTED[k]), "%s", text);
    free(text);
    remove(path);
  }
  snprintf(path, sizeof path, "%s/test.h5", checkpoint);
  if (rank == 0) CHECK(!remove(path) && !remove(checkpoint), "remove");
  PetscFunctionReturn(0);
}

/* Rows at the first time, at multiples of 0.3 (the sums of steps miss them by round-off), where it was saved, at multiples of
 * 0.5 from then on, and at the end. */
static PetscErrorCode CheckEvery(const char *folder, PetscMPIInt rank)
{
  static const double EXPECTED[] = {0.1, 0.3, 0.6, 0.9, 1.0, 1.5, 1.7};
  char checkpoint[300], path[512];
  Checkpoint file = NULL;
  Series s;
  double t = 0.0;
  PetscFunctionBeginUser;
  snprintf(checkpoint, sizeof checkpoint, "%s/checkpoint", folder);
  if (rank == 0) PetscCall(PetscMkdir(checkpoint));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  for (int run = 0; run < 2; run++) {
    if (run) PetscCall(CheckpointOpen(PETSC_COMM_WORLD, checkpoint, "test", &file));
    PetscCall(SeriesCreate(PETSC_COMM_WORLD, folder, "every", "t [s]", run ? 0.5 : 0.3, file, &s));
    PetscCall(CheckpointClose(&file));
    for (int k = 0; k < (run ? 8 : 9); k++) PetscCall(SeriesRow(s, (double[]){t += 0.1}));
    if (!run) {
      PetscCall(CheckpointCreate(PETSC_COMM_WORLD, checkpoint, "test", &file));
      PetscCall(SeriesSave(s, file));
      PetscCall(CheckpointClose(&file));
      PetscCall(SeriesRow(s, (double[]){1.2})); /* lost, as the run resumes before */
    }
    PetscCall(SeriesDestroy(&s));
  }
  snprintf(path, sizeof path, "%s/every.csv", folder);
  if (rank == 0) {
    char *text = ReadText(path), *at = text + strlen("t [s]\n");
    for (size_t k = 0; k < sizeof EXPECTED / sizeof *EXPECTED; k++) {
      const double value = strtod(at, &at);
      CHECK(fabs(value - EXPECTED[k]) < 1e-12, "row %zu has %g, expected %g", k, value, EXPECTED[k]);
    }
    CHECK(!strcmp(at, "\n"), "%s", text);
    free(text);
    remove(path);
    snprintf(path, sizeof path, "%s/test.h5", checkpoint);
    CHECK(!remove(path) && !remove(checkpoint), "remove");
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  char folder[256], path[512];
  PetscMPIInt rank;
  Series s;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  snprintf(folder, sizeof folder, "/tmp/coracle_series_%d", (int)getpid());
  PetscCallMPI(MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, PETSC_COMM_WORLD));
  PetscCall(SeriesCreate(PETSC_COMM_WORLD, folder, "drop", "t [s],U [m/s],n", 0.0, NULL, &s));
  snprintf(path, sizeof path, "%s/drop.csv", folder);
  PetscCall(SeriesRow(s, (double[]){0.0, 1.0 / 3.0, 1e6 + rank}));
  PetscCall(SeriesRow(s, (double[]){1e-300, -2.0, 3.0}));
  if (rank == 0) {
    char *text = ReadText(path);
    CHECK(!strcmp(text, "t [s],U [m/s],n\n0,0.333333333333333,1000000\n1e-300,-2,3\n"), "%s", text);
    free(text);
  }
  PetscCall(SeriesDestroy(&s));
  CHECK(!s, "the handle is not nulled");
  if (rank == 0) remove(path);
  PetscCall(CheckResumed(folder, rank));
  PetscCall(CheckEvery(folder, rank));
  if (rank == 0) remove(folder);
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  CHECK(SeriesCreate(PETSC_COMM_WORLD, "/dev/null", "x", "t", 0.0, NULL, &s), "a folder that is a file");
  PetscCall(PetscPopErrorHandler());
  return PetscFinalize();
}
