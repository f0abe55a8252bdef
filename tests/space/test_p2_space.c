// ranks: 1 2 3 5
/* Numbers of P2 nodes: one a vertex and one an edge, without gaps, those of lower ranks where several have one;
 * ranks without elements, parts in many pieces, parts that touch in a vertex alone. */
#include "common/mesh/part.h"
#include "common/space/p2_space.h"
#include "tests/mesh/touching.h"
#include <math.h>
#include <string.h>

/* Unlike at any two nodes of the meshes here. */
static double ValueAt(const Mesh *m, int e, int i)
{
  const double *a = &m->x[2 * m->vertex[3 * e + (i < 3 ? i : (i + 1) % 3)]];
  const double *b = &m->x[2 * m->vertex[3 * e + (i < 3 ? i : (i + 2) % 3)]];
  return 1.0 + 0.5 * (a[0] + b[0]) + 10.0 * (a[1] + b[1]);
}

/* Which node of this rank is where, from all of its elements. */
static void CheckLocal(const Mesh *m, const P2Space *s, double mine[])
{
  for (int e = 0; e < m->ne; e++) {
    for (int i = 0; i < 6; i++) {
      double *node = &mine[s->node[6 * e + i]];
      CHECK(*node == 0.0 || *node == ValueAt(m, e, i), "node %d of element %d stands for two points", i, e);
      *node = ValueAt(m, e, i);
    }
  }
  for (int k = 0; k < s->n; k++) {
    CHECK(mine[k] > 0.0, "node %d is no element's", k);
    if (k < s->nowned)
      CHECK(s->gid[k] == s->start + k, "owned node %d has number %d", k, (int)s->gid[k]);
    else
      CHECK(s->gid[k] >= 0 && s->gid[k] < s->start, "node %d should belong to the lowest rank around it", k);
  }
}

/* A field of the position, written by owners under the global number, is what every rank expects at its nodes. */
static void Check(const Mesh *m, int nodes)
{
  P2Space *s;
  CHECK(!P2SpaceCreate(m, &s), "no space");
  double *field = calloc((size_t)s->nglobal, sizeof *field), *mine = calloc((size_t)s->n + 1, sizeof *mine);
  PetscInt owned = s->nowned;
  CheckLocal(m, s, mine);
  MPI_Allreduce(MPI_IN_PLACE, &owned, 1, MPIU_INT, MPI_SUM, m->comm);
  CHECK(owned == s->nglobal && owned == nodes, "%d of %d P2 nodes, not %d", (int)owned, (int)s->nglobal,
        nodes);
  for (int k = 0; k < s->nowned; k++) field[s->gid[k]] = mine[k];
  MPI_Allreduce(MPI_IN_PLACE, field, (int)s->nglobal, MPI_DOUBLE, MPI_SUM, m->comm);
  for (int k = 0; k < s->n; k++) {
    CHECK(field[s->gid[k]] == mine[k], "node %d: %g here, %g at its owner", k, mine[k], field[s->gid[k]]);
  }
  free(field);
  free(mine);
  CHECK(!P2SpaceDestroy(&s) && !s, "not freed");
}

static double Size(void *context, const double x[2])
{
  return 0.03 + 0.2 * hypot(x[0] - 0.3, x[1] - 0.4);
}

/* Elements to ranks at random, rank `none` getting none; Euler: as many edges as vertices + triangles - 1. */
static void CheckScattered(const Mesh *mesh, int none)
{
  MeshPart part, moved;
  Mesh *m;
  PetscMPIInt rank, size;
  MPI_Comm_rank(mesh->comm, &rank);
  MPI_Comm_size(mesh->comm, &size);
  CHECK(!MeshPartOf(mesh, &part), "no part");
  int *target = malloc((size_t)part.serial.ne * sizeof *target + 1);
  for (int e = 0; e < part.serial.ne; e++) {
    target[e] = rand() % size;
    if (target[e] == none) target[e] = (none + 1) % size;
  }
  CHECK(!MeshPartMigrate(mesh->comm, &part, target, 0, NULL, &moved, NULL), "not migrated");
  CHECK(!MeshBuild(mesh->comm, &moved, &m), "not built");
  Check(m, (int)(2 * m->nv_global + m->nglobal - 1));
  CHECK(!MeshPartDestroy(&part) && !MeshPartDestroy(&moved) && !MeshDestroy(&m), "not freed");
  free(target);
}

static void CheckTouching(int rank, int size)
{
  Mesh *mesh = TouchingSquares(rank, size);
  Check(mesh, 7 + 10);
  CHECK(!MeshDestroy(&mesh), "not freed");
}

int main(int argc, char **argv)
{
  static const double LOWER[2] = {0.0, 0.0}, UPPER[2] = {1.0, 2.0};
  MeshSerial serial = {0};
  Mesh *mesh;
  PetscMPIInt rank, size;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  if (rank == 0) PetscCall(MeshBox(LOWER, UPPER, 0.25, Size, NULL, &serial));
  PetscCall(MeshDistribute(PETSC_COMM_WORLD, &serial, &mesh));
  Check(mesh, (int)(2 * mesh->nv_global + mesh->nglobal - 1));
  CheckScattered(mesh, -1);
  if (size > 1) CheckScattered(mesh, size / 2);
  CheckTouching(rank, size);
  PetscCall(MeshSerialDestroy(&serial));
  PetscCall(MeshDestroy(&mesh));
  return PetscFinalize();
}
