// ranks: 1 2 3
/* What is written is read back: values in place on any number of ranks, unchanged points shared, ranks and
 * whole grids without cells, one entry a snapshot in the index, and misuse told. */
#include "tests/output/read_back.h"
#include <unistd.h>

/* Rank r has r + 1 - (last rank) strips ... rank k owns k triangles in the row y = k, so that rank 0 has
 * none. */
typedef struct {
  int rank, size, n, ne;
  double x[64], node[64], cell[64];
  int triangle[64];
} Piece;

static Piece MakePiece(double t)
{
  Piece p = {0};
  MPI_Comm_rank(PETSC_COMM_WORLD, &p.rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &p.size);
  p.ne = p.size == 1 ? 2 : p.rank;
  p.n = 3 * p.ne;
  for (int k = 0; k < p.n; k++) {
    p.x[2 * k] = k / 3 + (k % 3 == 1);
    p.x[2 * k + 1] = p.rank + (k % 3 == 2);
    p.node[2 * k] = t + p.x[2 * k];
    p.node[2 * k + 1] = -p.x[2 * k + 1];
    p.triangle[k] = k;
  }
  for (int e = 0; e < p.ne; e++) {
    p.cell[3 * e] = 100.0 * p.rank + e; /* xx */
    p.cell[3 * e + 1] = 1.0;            /* yy */
    p.cell[3 * e + 2] = 2.0;            /* xy */
  }
  return p;
}

static PetscErrorCode Write(const char *folder)
{
  Output out;
  const double x[4] = {0.0, 0.0, 1.0, 1.0}, one[2] = {1.0, 2.0};
  const int edge[2] = {0, 1};
  PetscFunctionBeginUser;
  PetscCall(OutputCreate(PETSC_COMM_WORLD, folder, "test", 1.0, 9.0, NULL, &out));
  for (int k = 0; k < 3; k++) {
    const Piece p = MakePiece(0.5 * k);
    const int n = p.rank == p.size - 1 ? 2 : 0; /* on the last rank only */
    PetscCall(OutputBegin(out, 0.5 * k));
    PetscCall(OutputGrid(out, "body", k / 2, p.n, p.x, p.ne, 3, p.triangle));
    PetscCall(OutputField(out, "velocity", OUTPUT_NODE, 2, p.node));
    PetscCall(OutputField(out, "stress", OUTPUT_CELL, 3, p.cell));
    PetscCall(OutputGrid(out, "edges", 0, n, n ? x : NULL, n / 2, 2, n ? edge : NULL));
    PetscCall(OutputField(out, "level", OUTPUT_NODE, 1, n ? one : NULL));
    PetscCall(OutputGrid(out, "nothing", 0, 0, NULL, 0, 6, NULL));
    PetscCall(OutputField(out, "void", OUTPUT_CELL, 1, NULL));
    PetscCall(OutputEnd(out));
  }
  PetscCall(OutputDestroy(&out));
  CHECK(!out, "the handle is not nulled");
  PetscFunctionReturn(0);
}

/* Snapshot k against what the ranks, one after the other, should have written. */
static void CheckSnapshot(hid_t file, int k, int size)
{
  char path[128];
  hsize_t dims[2];
  double time;
  const int ne = size == 1 ? 2 : size * (size - 1) / 2;
  snprintf(path, sizeof path, "/snapshot/%06d", k);
  const hid_t attribute = H5Aopen_by_name(file, path, "time", H5P_DEFAULT, H5P_DEFAULT);
  CHECK(H5Aread(attribute, H5T_NATIVE_DOUBLE, &time) >= 0 && time == 0.5 * k, "%s: time %g", path, time);
  H5Aclose(attribute);
  snprintf(path, sizeof path, "/snapshot/%06d/body/points", k);
  double *x = ReadDataset(file, path, dims);
  CHECK((int)dims[0] == 3 * ne && dims[1] == 2, "%s is %d x %d", path, (int)dims[0], (int)dims[1]);
  snprintf(path, sizeof path, "/snapshot/%06d/body/cells", k);
  double *cell = ReadDataset(file, path, dims);
  CHECK((int)dims[0] == ne && dims[1] == 3, "%s is %d x %d", path, (int)dims[0], (int)dims[1]);
  snprintf(path, sizeof path, "/snapshot/%06d/body/node/velocity", k);
  double *u = ReadDataset(file, path, dims);
  CHECK((int)dims[0] == 3 * ne && dims[1] == 3, "%s is %d x %d", path, (int)dims[0], (int)dims[1]);
  snprintf(path, sizeof path, "/snapshot/%06d/body/cell/stress", k);
  double *s = ReadDataset(file, path, dims);
  CHECK((int)dims[0] == ne && dims[1] == 6, "%s is %d x %d", path, (int)dims[0], (int)dims[1]);
  for (int e = 0, rank = size == 1 ? 0 : 1, i = 0; e < ne; e++) {
    for (int c = 0; c < 3; c++) {
      const int v = (int)cell[3 * e + c];
      CHECK(v == 3 * e + c && x[2 * v] == i + (c == 1) && x[2 * v + 1] == rank + (c == 2),
            "cell %d, corner %d", e, c);
      CHECK(u[3 * v] == 0.5 * k + x[2 * v] && u[3 * v + 1] == -x[2 * v + 1] && u[3 * v + 2] == 0.0,
            "velocity at %d", v);
    }
    const double tensor[6] = {100.0 * rank + i, 2.0, 0.0, 1.0, 0.0, 0.0};
    CHECK(!memcmp(&s[6 * e], tensor, sizeof tensor), "stress in cell %d", e);
    i++;
    if (size > 1 && i == rank) {
      i = 0;
      rank++;
    }
  }
  free(x);
  free(cell);
  free(u);
  free(s);
}

static haddr_t Place(hid_t file, const char *path)
{
  const hid_t set = H5Dopen2(file, path, H5P_DEFAULT);
  const haddr_t place = H5Dget_offset(set);
  H5Dclose(set);
  return place;
}

static void CheckFile(const char *folder, int size)
{
  char path[512];
  hsize_t dims[2];
  snprintf(path, sizeof path, "%s/test.h5", folder);
  const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  CHECK(file >= 0, "%s cannot be opened", path);
  for (int k = 0; k < 3; k++) CheckSnapshot(file, k, size);
  const haddr_t first = Place(file, "/snapshot/000000/body/points"),
                second = Place(file, "/snapshot/000001/body/points");
  const haddr_t third = Place(file, "/snapshot/000002/body/points");
  CHECK(first == second && first != third,
        "points are shared where the revision is the same, and there only");
  double *level = ReadDataset(file, "/snapshot/000002/edges/node/level", dims);
  CHECK(dims[0] == 2 && level[0] == 1.0 && level[1] == 2.0, "the field of the last rank");
  free(level);
  level = ReadDataset(file, "/snapshot/000002/nothing/cell/void", dims);
  CHECK(dims[0] == 0, "a field without cells");
  free(level);
  H5Fclose(file);
}

/* The index has each snapshot once, and every path in it is in the file, with the dimensions it says. */
static void CheckIndex(const char *folder)
{
  char path[512];
  snprintf(path, sizeof path, "%s/test.h5", folder);
  const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  snprintf(path, sizeof path, "%s/test.xdmf", folder);
  char *text = ReadText(path);
  CHECK(Occurrences(text, "<Time ") == 6 && Occurrences(text, "Name=\"body\"") == 4, "%s", text);
  CHECK(Occurrences(text, "<Grid ") == Occurrences(text, "</Grid>") && strstr(text, "</Xdmf>"), "%s", text);
  CHECK(!strstr(text, "nothing"), "a grid without cells is in the index");
  int items = 0;
  for (const char *item = text; (item = strstr(item, "<DataItem ")); item++, items++) {
    char inside[128];
    long long said[2] = {0, 0};
    hsize_t dims[2];
    sscanf(strstr(item, "Dimensions="), "Dimensions=\"%lld %lld", &said[0], &said[1]);
    CHECK(sscanf(strchr(item, '>'), ">test.h5:%127[^<]", inside) == 1, "%.200s", item);
    free(ReadDataset(file, inside, dims));
    CHECK((long long)dims[0] == said[0] && (long long)dims[1] == said[1], "%s is %d x %d", inside,
          (int)dims[0], (int)dims[1]);
  }
  CHECK(items == 3 * 7, "%d data items", items);
  free(text);
  H5Fclose(file);
}

/* Misuse is an error on all ranks, not a file that nobody can read. */
static PetscErrorCode CheckMisuse(const char *folder)
{
  Output out;
  const Piece p = MakePiece(0.0);
  PetscFunctionBeginUser;
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  CHECK(OutputCreate(PETSC_COMM_WORLD, "/dev/null/x", "test", 1.0, 9.0, NULL, &out),
        "a folder that cannot be made");
  CHECK(!OutputCreate(PETSC_COMM_WORLD, folder, "misuse", 1.0, 9.0, NULL, &out), "cannot be made");
  CHECK(OutputGrid(out, "body", 0, p.n, p.x, p.ne, 3, p.triangle), "a grid outside a snapshot");
  CHECK(!OutputBegin(out, 0.0) && OutputBegin(out, 0.0), "two snapshots at once");
  CHECK(OutputField(out, "u", OUTPUT_NODE, 1, p.node), "a field without a grid");
  CHECK(OutputGrid(out, "a/b", 0, p.n, p.x, p.ne, 3, p.triangle), "a name that is a path");
  CHECK(OutputGrid(out, "quadrangles", 0, p.n, p.x, 0, 4, p.triangle), "cells of four nodes");
  CHECK(!OutputGrid(out, "body", 0, p.n, p.x, p.ne, 3, p.triangle), "a grid");
  CHECK(OutputField(out, "u", OUTPUT_NODE, 4, p.node), "four components");
  CHECK(!OutputEnd(out) && !OutputBegin(out, 1.0), "next snapshot");
  CHECK(OutputGrid(out, "body", 0, p.n / 3, p.x, p.ne, 3, p.triangle), "fewer nodes in the same revision");
  CHECK(!OutputEnd(out) && OutputEnd(out), "an end without a beginning");
  PetscCall(PetscPopErrorHandler());
  PetscCall(OutputDestroy(&out));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  char folder[256], command[512];
  PetscMPIInt rank, size;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  snprintf(folder, sizeof folder, "/tmp/coracle_output_%d/made/new", (int)getpid());
  PetscCallMPI(MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, PETSC_COMM_WORLD));
  PetscCall(Write(folder));
  if (rank == 0) {
    CheckFile(folder, size);
    CheckIndex(folder);
  }
  PetscCall(CheckMisuse(folder));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  if (rank == 0) {
    *strstr(folder, "/made") = 0;
    snprintf(command, sizeof command, "rm -r %s", folder);
    CHECK(!system(command), "%s", command);
  }
  return PetscFinalize();
}
