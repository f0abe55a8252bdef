/* A writer that is killed in the middle of a snapshot leaves every whole snapshot readable: on one rank and
 * on two. */
#include "tests/output/read_back.h"
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

enum { N = 3000, WHOLE = 40 }; /* many snapshots, so that metadata outgrows the cache that HDF5 begins with */

/* Writes WHOLE snapshots, begins one more and is gone. */
static PetscErrorCode Writer(const char *folder)
{
  Output out;
  static double x[2 * N], u[N];
  static int cell[N];
  PetscFunctionBeginUser;
  for (int k = 0; k < N; k++) {
    x[2 * k] = k;
    cell[k] = k;
  }
  PetscCall(OutputCreate(PETSC_COMM_WORLD, folder, "killed", 1.0, WHOLE, NULL, &out));
  for (int t = 0; t <= WHOLE; t++) {
    PetscCall(OutputBegin(out, t));
    for (int k = 0; k < N; k++) u[k] = t + k;
    for (int g = 0; g < 6; g++) {
      char name[16];
      snprintf(name, sizeof name, "grid-%d", g);
      PetscCall(OutputGrid(out, name, t, N, x, N / 3, 3, cell));
      PetscCall(OutputField(out, "u", OUTPUT_NODE, 1, u));
      PetscCall(OutputField(out, "again", OUTPUT_NODE, 1, u));
    }
    if (t == WHOLE) raise(SIGKILL);
    PetscCall(OutputEnd(out));
  }
  PetscFunctionReturn(0);
}

static void CheckLeft(const char *folder, int ranks)
{
  char path[512];
  hsize_t dims[2];
  snprintf(path, sizeof path, "%s/killed.xdmf", folder);
  char *text = ReadText(path);
  CHECK(Occurrences(text, "<Time ") == 6 * WHOLE && strstr(text, "</Xdmf>"),
        "%d ranks: the index is not whole", ranks);
  free(text);
  snprintf(path, sizeof path, "%s/killed.h5", folder);
  const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  CHECK(file >= 0, "%d ranks: the file does not open", ranks);
  for (int t = 0; t < WHOLE; t++) {
    snprintf(path, sizeof path, "/snapshot/%06d/grid-5/node/again", t);
    double *u = ReadDataset(file, path, dims);
    CHECK((int)dims[0] == N * ranks, "%d values", (int)dims[0]);
    for (int k = 0; k < N * ranks; k++) CHECK(u[k] == t + k % N, "snapshot %d, value %d: %g", t, k, u[k]);
    free(u);
  }
  H5Fclose(file);
}

int main(int argc, char **argv)
{
  char folder[256], command[1024];
  if (argc > 1) {
    PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
    PetscCall(Writer(argv[1]));
    return 0;
  }
  unsetenv("OMPI_MCA_orte_create_session_dirs"); /* is for this process alone (tests/CMakeLists.txt) */
  for (int ranks = 1; ranks <= 2; ranks++) {
    snprintf(folder, sizeof folder, "/tmp/coracle_killed_%d", (int)getpid());
    snprintf(command, sizeof command, "timeout -k 5 60 " MPIRUN " -n %d %s %s >/dev/null 2>&1", ranks,
             argv[0], folder);
    CHECK(system(command), "the writer lived");
    CheckLeft(folder, ranks);
    snprintf(command, sizeof command, "rm -r %s", folder);
    CHECK(!system(command), "%s", command);
  }
  return 0;
}
