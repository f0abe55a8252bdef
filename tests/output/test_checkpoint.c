// ranks: 1 2 3
/* Checkpoints give back what was put into them, and say what is missing; files go on from one as if what
 * came after it had never been, and anew where they are not. */
#include "tests/output/read_back.h"
#include <sys/stat.h>
#include <unistd.h>

static char folder[64], inside[80]; /* inside: where the run in folder has its checkpoints */

static void Path(char path[128], const char *name)
{
  snprintf(path, 128, "%s/%s", folder, name);
}

/* --- numbers and tables --------------------------------------------------------------------------------- */

static PetscErrorCode Put(int rank, int size)
{
  Checkpoint c;
  double row[4][2];
  long long id[4];
  const int n = rank == 1 ? 0 : 2 + rank; /* 2, 0, 4 */
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) {
    id[k] = 1000000000000LL * rank + k;
    row[k][0] = 1.0 / 3.0 + rank;
    row[k][1] = k;
  }
  PetscCall(CheckpointCreate(PETSC_COMM_WORLD, folder, "part", &c));
  PetscCall(CheckpointPutNumber(c, "a third", 1.0 / 3.0));
  PetscCall(CheckpointPutDoubles(c, "rows", n, 2, &row[0][0]));
  PetscCall(CheckpointPutIndices(c, "ids", n, 1, id));
  PetscCall(CheckpointPutDoubles(c, "nothing", 0, 3, NULL));
  PetscCall(CheckpointClose(&c));
  PetscFunctionReturn(0);
}

/* On one rank all of it; on all ranks each the last row. */
static PetscErrorCode Get(MPI_Comm comm, int size)
{
  Checkpoint c;
  double third, row[6][2];
  long long id[6], total;
  const int n = size == 1 ? 2 : size == 2 ? 2 : 6, last = size < 3 ? 0 : 2;
  PetscMPIInt readers;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &readers));
  const int first = readers == 1 ? 0 : n - 1;
  PetscCall(CheckpointOpen(comm, folder, "part", &c));
  PetscCall(CheckpointGetNumber(c, "a third", &third));
  CHECK(third == 1.0 / 3.0, "%.17g", third);
  PetscCall(CheckpointRows(c, "rows", &total));
  CHECK(total == n, "%lld rows of %d", total, n);
  PetscCall(CheckpointGetDoubles(c, "rows", first, n - first, 2, &row[0][0]));
  PetscCall(CheckpointGetIndices(c, "ids", first, n - first, 1, id));
  CHECK(row[n - 1 - first][0] == 1.0 / 3.0 + last, "row %g", row[n - 1 - first][0]);
  CHECK(id[n - 1 - first] == 1000000000000LL * last + (last ? 3 : 1), "id %lld", id[n - 1 - first]);
  PetscCall(CheckpointRows(c, "nothing", &total));
  CHECK(total == 0, "%lld rows of nothing", total);
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  CHECK(CheckpointGetNumber(c, "no such", &third), "a number that is not there");
  CHECK(CheckpointGetDoubles(c, "rows", 0, 1, 3, &row[0][0]), "a table of another width");
  CHECK(CheckpointGetDoubles(c, "rows", 1, n, 2, &row[0][0]), "rows that are not there");
  PetscCall(PetscPopErrorHandler());
  PetscCall(CheckpointClose(&c));
  PetscFunctionReturn(0);
}

/* --- files that go on ----------------------------------------------------------------------------------- */

static PetscErrorCode Write(Output out, Series s, int from, int to)
{
  static const double x[3][2] = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  static const int cell[3] = {0, 1, 2};
  PetscFunctionBeginUser;
  for (int k = from; k < to; k++) {
    const double t = 0.1 * k, value[3] = {k, k, k};
    PetscCall(SeriesRow(s, (double[2]){t, k}));
    if (!OutputDue(out, t)) continue;
    PetscCall(OutputBegin(out, t));
    PetscCall(OutputGrid(out, "grid", 0, 3, &x[0][0], 1, 3, cell));
    PetscCall(OutputField(out, "k", OUTPUT_NODE, 1, value));
    PetscCall(OutputEnd(out));
  }
  PetscFunctionReturn(0);
}

/* Rows 0 .. 9 of which 0 .. 4 are in the checkpoint (if there is one to make), then `from` on to 11; each run ends between two
 * snapshots. */
static PetscErrorCode Run(PetscBool resume, int from)
{
  Checkpoint c = NULL;
  Output out;
  Series s;
  PetscFunctionBeginUser;
  if (resume) PetscCall(CheckpointOpen(PETSC_COMM_WORLD, inside, "files", &c));
  PetscCall(OutputCreate(PETSC_COMM_WORLD, folder, "run", 0.2, resume ? 1.1 : 0.9, c, &out));
  PetscCall(SeriesCreate(PETSC_COMM_WORLD, folder, "run", "t [s],k", 0.0, c, &s));
  PetscCall(CheckpointClose(&c));
  PetscCall(Write(out, s, from, resume ? 12 : 5));
  if (!resume) {
    PetscCall(CheckpointCreate(PETSC_COMM_WORLD, inside, "files", &c));
    PetscCall(OutputSave(out, c));
    PetscCall(SeriesSave(s, c));
    PetscCall(CheckpointClose(&c));
    PetscCall(Write(out, s, 5, 10));
  }
  PetscCall(OutputDestroy(&out));
  PetscCall(SeriesDestroy(&s));
  PetscFunctionReturn(0);
}

/* Rows first .. 11, and the snapshots among them, of which one is at the end. */
static void CheckFiles(int first)
{
  char path[128], expected[1024] = "t [s],k\n";
  int snapshots = 0;
  hsize_t dims[2];
  for (int k = first; k < 12; k++) {
    const size_t used = strlen(expected);
    snprintf(expected + used, sizeof expected - used, "%.15g,%d\n", 0.1 * k, k);
    snapshots += k % 2 == 0 || k == 11;
  }
  Path(path, "run.csv");
  char *text = ReadText(path);
  CHECK(!strcmp(text, expected), "run.csv is\n%s", text);
  free(text);
  Path(path, "run.xdmf");
  text = ReadText(path);
  CHECK(Occurrences(text, "<Time ") == snapshots && Occurrences(text, "Value=\"1\"") == 1 &&
            Occurrences(text, "</Xdmf>") == 1,
        "run.xdmf is\n%s", text);
  free(text);
  Path(path, "run.h5");
  const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  for (int k = 0; k < snapshots; k++) {
    char field[64];
    snprintf(field, sizeof field, "/snapshot/%06d/grid/node/k", k);
    double *value = ReadDataset(file, field, dims);
    CHECK(value[0] == fmin(2 * k + (first + 1) / 2 * 2, 11), "%s is %g", field, value[0]);
    free(value);
  }
  snprintf(path, sizeof path, "/snapshot/%06d", snapshots);
  CHECK(H5Lexists(file, path, H5P_DEFAULT) == 0, "there is %s", path);
  H5Fclose(file);
}

static void RemoveAll(int rank, PetscBool folder_too)
{
  static const char *const FILES[] = {"run.csv", "run.h5", "run.xdmf", "part.h5", "checkpoint.5/files.h5"};
  char path[128];
  for (int k = 0; k < (folder_too ? 5 : 3) && rank == 0; k++) {
    Path(path, FILES[k]);
    unlink(path);
  }
  if (rank == 0 && folder_too) CHECK(!rmdir(inside) && !rmdir(folder), "files are left");
  MPI_Barrier(PETSC_COMM_WORLD);
}

int main(int argc, char **argv)
{
  PetscMPIInt rank, size;
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL), "PETSc");
  CHECK(!MPI_Comm_rank(PETSC_COMM_WORLD, &rank) && !MPI_Comm_size(PETSC_COMM_WORLD, &size), "comm");
  snprintf(folder, sizeof folder, "/tmp/coracle_checkpoint_XXXXXX");
  if (rank == 0) CHECK(mkdtemp(folder), "no folder");
  CHECK(!MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, PETSC_COMM_WORLD), "broadcast");
  snprintf(inside, sizeof inside, "%s/checkpoint.5", folder);
  if (rank == 0) CHECK(!mkdir(inside, 0777), "no folder");
  CHECK(!Put(rank, size) && !Get(PETSC_COMM_WORLD, size), "all ranks");
  if (rank == 0) CHECK(!Get(PETSC_COMM_SELF, size), "one rank");
  CHECK(!MPI_Barrier(PETSC_COMM_WORLD), "barrier");
  CHECK(!Run(PETSC_FALSE, 0) && !Run(PETSC_TRUE, 5), "run");
  if (rank == 0) CheckFiles(0);
  RemoveAll(rank, PETSC_FALSE);
  CHECK(!Run(PETSC_TRUE, 5), "in an empty folder");
  if (rank == 0) CheckFiles(5);
  RemoveAll(rank, PETSC_TRUE);
  return PetscFinalize();
}
