// ranks: 1 2 3
/* Series: the header, rows of rank 0 only, on disk as soon as they are given. */
#include "tests/output/read_back.h"
#include <unistd.h>

int main(int argc, char **argv)
{
  char folder[256], path[512];
  PetscMPIInt rank;
  Series s;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  snprintf(folder, sizeof folder, "/tmp/coracle_series_%d", (int)getpid());
  PetscCallMPI(MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, PETSC_COMM_WORLD));
  PetscCall(SeriesCreate(PETSC_COMM_WORLD, folder, "drop", "t [s],U [m/s],n", NULL, &s));
  snprintf(path, sizeof path, "%s/drop.csv", folder);
  PetscCall(SeriesRow(s, (double[]){0.0, 1.0 / 3.0, 1e6 + rank}));
  PetscCall(SeriesRow(s, (double[]){1e-300, -2.0, 3.0}));
  if (rank == 0) {
    char *text = ReadText(path);
    CHECK(!strcmp(text, "t [s],U [m/s],n\n0,0.3333333333,1000000\n1e-300,-2,3\n"), "%s", text);
    free(text);
  }
  PetscCall(SeriesDestroy(&s));
  CHECK(!s, "the handle is not nulled");
  if (rank == 0) {
    remove(path);
    remove(folder);
  }
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  CHECK(SeriesCreate(PETSC_COMM_WORLD, "/dev/null", "x", "t", NULL, &s), "a folder that is a file");
  PetscCall(PetscPopErrorHandler());
  return PetscFinalize();
}
