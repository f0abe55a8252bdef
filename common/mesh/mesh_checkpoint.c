#include "common/mesh/mesh_checkpoint.h"
#include "common/mesh/mesh_impl.h"
#include <string.h>

#define NAME ((int)sizeof(((Mesh *)NULL)->tag_name[0]))

static PetscErrorCode SaveNames(const Mesh *m, PetscMPIInt rank, Checkpoint to)
{
  const int n = rank == 0 ? m->ntags : 0;
  long long *code;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(NAME * n, &code));
  for (int k = 0; k < NAME * n; k++) code[k] = m->tag_name[k / NAME][k % NAME];
  PetscCall(CheckpointPutIndices(to, "mesh names", n, NAME, code));
  PetscCall(PetscFree(code));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshSave(const Mesh *m, Checkpoint to)
{
  const long long count = m->ne;
  long long *vertex, *tag;
  double *corner;
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(m->comm, &rank));
  PetscCall(PetscMalloc3(3 * m->ne, &vertex, 3 * m->ne, &tag, 6 * m->ne, &corner));
  for (int k = 0; k < 3 * m->ne; k++) {
    vertex[k] = m->vgid[m->vertex[k]];
    tag[k] = m->tag[k];
    for (int c = 0; c < 2; c++) corner[2 * k + c] = m->x[2 * m->vertex[k] + c];
  }
  PetscCall(CheckpointPutDoubles(to, "mesh corners", m->ne, 6, corner));
  PetscCall(CheckpointPutIndices(to, "mesh vertices", m->ne, 3, vertex));
  PetscCall(CheckpointPutIndices(to, "mesh tags", m->ne, 3, tag));
  PetscCall(CheckpointPutIndices(to, "mesh parts", 1, 1, &count));
  PetscCall(SaveNames(m, rank, to));
  PetscCall(PetscFree3(vertex, tag, corner));
  PetscFunctionReturn(0);
}

/* Rows that a rank reads when they are dealt out evenly: start .. start + n - 1; row r is read by rank
 * r / block. */
static void Slab(long long total, int size, int rank, long long *block, long long *start, int *n)
{
  *block = (total + size - 1) / size;
  *start = PetscMin(rank * *block, total);
  *n = (int)(PetscMin(*start + *block, total) - *start);
}

/* This rank's rows: those that the same rank has saved, if there were as many, else a slab. */
static PetscErrorCode OwnRows(MPI_Comm comm, Checkpoint from, PetscBool *same, long long *start, int *n)
{
  long long parts, total, block, *count;
  PetscMPIInt rank, size;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(CheckpointRows(from, "mesh parts", &parts));
  PetscCall(CheckpointRows(from, "mesh vertices", &total));
  *same = (PetscBool)(parts == size);
  Slab(total, size, rank, &block, start, n);
  if (!*same) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(size, &count));
  PetscCall(CheckpointGetIndices(from, "mesh parts", 0, size, 1, count));
  *start = 0;
  for (int r = 0; r < rank; r++) *start += count[r];
  *n = (int)count[rank];
  PetscCall(PetscFree(count));
  PetscFunctionReturn(0);
}

static PetscErrorCode LoadNames(Checkpoint from, MeshSerial *s)
{
  long long n, *code;
  PetscFunctionBeginUser;
  PetscCall(CheckpointRows(from, "mesh names", &n));
  s->ntags = (int)n;
  PetscCall(PetscMalloc1(NAME * n, &code));
  PetscCall(PetscMalloc1(n, &s->tag_name));
  PetscCall(CheckpointGetIndices(from, "mesh names", 0, s->ntags, NAME, code));
  for (int k = 0; k < NAME * s->ntags; k++) s->tag_name[k / NAME][k % NAME] = (char)code[k];
  PetscCall(PetscFree(code));
  PetscFunctionReturn(0);
}

/* The triangles of n rows; the row is each one's region, which goes where it goes. */
static PetscErrorCode LoadPart(Checkpoint from, long long start, int n, MeshPart *part)
{
  MeshSerial *s = &part->serial;
  long long *vertex, *tag;
  double *corner;
  int *local_tag;
  PetscFunctionBeginUser;
  memset(part, 0, sizeof *part);
  s->ne = n;
  s->nregions = 1;
  PetscCall(PetscMalloc4(3 * n, &vertex, 3 * n, &tag, 6 * n, &corner, 3 * n, &local_tag));
  PetscCall(CheckpointGetDoubles(from, "mesh corners", start, n, 6, corner));
  PetscCall(CheckpointGetIndices(from, "mesh vertices", start, n, 3, vertex));
  PetscCall(CheckpointGetIndices(from, "mesh tags", start, n, 3, tag));
  PetscCall(PetscMalloc1(n, &s->region));
  PetscCall(PetscMalloc1(3 * n, &s->vertex));
  PetscCall(PartMerge(3 * n, vertex, s->vertex, part));
  PetscCall(PetscMalloc1(2 * s->nv, &s->x));
  for (int e = 0; e < n; e++) s->region[e] = (int)start + e;
  for (int k = 0; k < 3 * n; k++) {
    local_tag[k] = (int)tag[k];
    for (int c = 0; c < 2; c++) s->x[2 * s->vertex[k] + c] = corner[2 * k + c];
  }
  PetscCall(PartFacets(local_tag, s));
  PetscCall(PetscFree4(vertex, tag, corner, local_tag));
  PetscCall(LoadNames(from, s));
  PetscFunctionReturn(0);
}

static PetscErrorCode Repartition(MPI_Comm comm, MeshPart *part)
{
  MeshPart moved;
  PetscMPIInt size;
  int *target;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc1(part->serial.ne, &target));
  PetscCall(MeshPartPartition(comm, part, size, NULL, target));
  PetscCall(MeshPartMigrate(comm, part, target, 0, NULL, &moved, NULL));
  PetscCall(PetscFree(target));
  PetscCall(MeshPartDestroy(part));
  *part = moved;
  PetscFunctionReturn(0);
}

PetscErrorCode MeshLoad(MPI_Comm comm, Checkpoint from, Mesh **mesh, PetscInt **row)
{
  MeshPart part;
  PetscBool same = PETSC_FALSE;
  long long start = 0;
  int n = 0, *order;
  PetscFunctionBeginUser;
  PetscCall(OwnRows(comm, from, &same, &start, &n));
  PetscCall(LoadPart(from, start, n, &part));
  if (!same) PetscCall(Repartition(comm, &part));
  PetscCall(PetscMalloc1(part.serial.ne, &order));
  PetscCall(PetscMalloc1(part.serial.ne, row));
  PetscCall(MeshBuildOrdered(comm, &part, same, order, mesh));
  for (int e = 0; e < part.serial.ne; e++) (*row)[e] = part.serial.region[order[e]];
  PetscCall(PetscFree(order));
  PetscCall(MeshPartDestroy(&part));
  PetscFunctionReturn(0);
}

/* What a rank has read for the others to ask for. */
typedef struct {
  long long start;
  size_t bytes; /* a row */
  const double *row;
} RowSlab;

static PetscErrorCode GetRow(void *context, long long row, void *value)
{
  const RowSlab *s = context;
  PetscFunctionBeginUser;
  PetscCall(PetscMemcpy(value, (const char *)s->row + s->bytes * (size_t)(row - s->start), s->bytes));
  PetscFunctionReturn(0);
}

/* Ranks read slabs and ask each other for rows. */
PetscErrorCode MeshLoadDoubles(const Mesh *m, const PetscInt row[], Checkpoint from, const char *name,
                               int ncol, double value[])
{
  RowSlab slab = {.bytes = (size_t)ncol * sizeof *value};
  long long block, *wanted;
  int n, *of;
  double *rows;
  PetscMPIInt rank, size;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(m->comm, &rank));
  PetscCallMPI(MPI_Comm_size(m->comm, &size));
  Slab(m->nglobal, size, rank, &block, &slab.start, &n);
  PetscCall(PetscMalloc3(m->ne, &of, m->ne, &wanted, ncol * n, &rows));
  PetscCall(CheckpointGetDoubles(from, name, slab.start, n, ncol, rows));
  slab.row = rows;
  for (int e = 0; e < m->ne; e++) {
    of[e] = (int)(row[e] / block);
    wanted[e] = row[e];
  }
  PetscCall(ScatterRequest(m->comm, m->ne, of, wanted, slab.bytes, GetRow, &slab, value));
  PetscCall(PetscFree3(of, wanted, rows));
  PetscFunctionReturn(0);
}
