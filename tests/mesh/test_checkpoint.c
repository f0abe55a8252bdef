// ranks: 1 2 3 5
/* A mesh in a checkpoint: as many ranks get back what they saved to the last bit, others the same triangles;
 * what was saved with the elements comes to them. */
#include "common/mesh/mesh_checkpoint.h"
#include "tests/mesh/distributed.h"
#include <unistd.h>

static const BoxCase GRADED = {{1.0, 2.0}, 0.2, {0.04, {0.3, 0.3}, {0.4, 1.0}, 0.3}};
static const BoxCase FEW = {{1.0, 1.0}, 1.0, {1.0, {0.0, 0.0}, {1.0, 1.0}, 0.0}}; /* some ranks have none */
static char folder[256];
static int rank, size;

static void Distribute(MPI_Comm comm, const BoxCase *box, Mesh **mesh)
{
  Strip strip = box->strip;
  MeshSerial serial = {0};
  PetscMPIInt mine;
  MPI_Comm_rank(comm, &mine);
  if (mine == 0) CHECK(!MeshBox(LOWER, box->upper, box->size_max, StripSize, &strip, &serial), "no box");
  CHECK(!MeshDistribute(comm, &serial, mesh), "not distributed");
  CHECK(!MeshSerialDestroy(&serial), "not freed");
}

/* What belongs to an element: known from its corners, in their order. */
static void Belongings(const Mesh *m, int e, double value[2])
{
  const double *x[3];
  for (int i = 0; i < 3; i++) x[i] = &m->x[2 * m->vertex[3 * e + i]];
  value[0] = x[0][0] + 10.0 * x[1][0] + 100.0 * x[2][0];
  value[1] = x[0][1] + 10.0 * x[1][1] + 100.0 * x[2][1];
}

static void Save(const Mesh *m)
{
  double *value = malloc((2 * (size_t)m->ne + 1) * sizeof *value);
  Checkpoint to;
  for (int e = 0; e < m->ne; e++) Belongings(m, e, value + 2 * e);
  CHECK(!CheckpointCreate(m->comm, folder, "mesh", &to), "no checkpoint");
  CHECK(!MeshSave(m, to) && !CheckpointPutDoubles(to, "belongings", m->ne, 2, value), "not saved");
  CHECK(!CheckpointClose(&to), "not closed");
  free(value);
}

/* Every row is on one rank, with what belongs to it. */
static void CheckRows(const Mesh *m, const PetscInt row[], Checkpoint from)
{
  double *value = malloc((2 * (size_t)m->ne + 1) * sizeof *value), expected[2];
  int *times = calloc((size_t)m->nglobal, sizeof *times);
  CHECK(!MeshLoadDoubles(m, row, from, "belongings", 2, value), "not loaded");
  for (int e = 0; e < m->ne; e++) {
    Belongings(m, e, expected);
    CHECK(!memcmp(expected, value + 2 * e, sizeof expected), "element %d has what belongs to another", e);
    CHECK(row[e] >= 0 && row[e] < m->nglobal, "row %d", (int)row[e]);
    times[row[e]]++;
  }
  MPI_Allreduce(MPI_IN_PLACE, times, (int)m->nglobal, MPI_INT, MPI_SUM, m->comm);
  for (int k = 0; k < m->nglobal; k++) CHECK(times[k] == 1, "row %d came %d times", k, times[k]);
  free(value);
  free(times);
}

#define CHECK_ARRAY(name, n)                                                                                 \
  CHECK(!memcmp(a->name, b->name, (size_t)(n) * sizeof *a->name), "%s of rank %d changed", #name, rank)

static void CheckSame(const Mesh *a, const Mesh *b)
{
  CHECK(a->nv == b->nv && a->ne == b->ne && a->ng == b->ng, "numbers of rank %d changed", rank);
  CHECK(a->nv_owned == b->nv_owned && a->vstart == b->vstart && a->nedge == b->nedge, "vertices changed");
  CHECK(a->estart == b->estart && a->ntags == b->ntags, "elements or names changed");
  CHECK_ARRAY(x, 2 * a->nv);
  CHECK_ARRAY(vertex, 3 * (a->ne + a->ng));
  CHECK_ARRAY(egid, a->ne + a->ng);
  CHECK_ARRAY(neighbor, 3 * a->ne);
  CHECK_ARRAY(neighbor_face, 3 * a->ne);
  CHECK_ARRAY(tag, 3 * a->ne);
  CHECK_ARRAY(vgid, a->nv);
  CHECK_ARRAY(edge, 3 * a->ne);
  for (int k = 0; k < a->ntags; k++) CHECK(!strcmp(a->tag_name[k], b->tag_name[k]), "%s", b->tag_name[k]);
}

/* `saved` on the ranks of its communicator, and loaded on those of comm. */
static void CheckLoaded(MPI_Comm comm, const BoxCase *box, const Mesh *saved, int vertices)
{
  Checkpoint from;
  PetscInt *row;
  Mesh *m;
  CHECK(!CheckpointOpen(comm, folder, "mesh", &from), "no checkpoint");
  CHECK(!MeshLoad(comm, from, &m, &row), "not loaded");
  CheckDistributed(m, box, vertices);
  CheckRows(m, row, from);
  if (saved) CheckSame(saved, m);
  CHECK(!PetscFree(row) && !MeshDestroy(&m) && !CheckpointClose(&from), "not freed");
}

/* Saved on the ranks of `writers`, loaded on those of `readers`: MPI_COMM_NULL where a rank is in neither. */
static void Check(MPI_Comm writers, MPI_Comm readers, const BoxCase *box)
{
  Mesh *m = NULL;
  int vertices = 0;
  if (writers != MPI_COMM_NULL) {
    Distribute(writers, box, &m);
    Save(m);
    vertices = (int)m->nv_global;
  }
  MPI_Bcast(&vertices, 1, MPI_INT, 0, PETSC_COMM_WORLD);
  if (readers != MPI_COMM_NULL) CheckLoaded(readers, box, readers == writers ? m : NULL, vertices);
  CHECK(!MeshDestroy(&m), "not freed");
  MPI_Barrier(PETSC_COMM_WORLD);
}

int main(int argc, char **argv)
{
  char path[512];
  MPI_Comm some;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  snprintf(folder, sizeof folder, "/tmp/coracle_mesh_%d", (int)getpid());
  MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, PETSC_COMM_WORLD);
  if (rank == 0) CHECK(!PetscMkdir(folder), "%s", folder);
  MPI_Barrier(PETSC_COMM_WORLD);
  MPI_Comm_split(PETSC_COMM_WORLD, rank < (size + 1) / 2 ? 0 : MPI_UNDEFINED, rank, &some);
  Check(PETSC_COMM_WORLD, PETSC_COMM_WORLD, &GRADED);
  Check(PETSC_COMM_WORLD, PETSC_COMM_WORLD, &FEW);
  Check(PETSC_COMM_WORLD, some, &GRADED);
  Check(some, PETSC_COMM_WORLD, &GRADED);
  Check(some, PETSC_COMM_WORLD, &FEW);
  if (some != MPI_COMM_NULL) MPI_Comm_free(&some);
  snprintf(path, sizeof path, "%s/mesh.h5", folder);
  if (rank == 0) remove(path), remove(folder);
  return PetscFinalize();
}
