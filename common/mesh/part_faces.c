/* Faces between the parts: who has an open face, or a vertex of one, tells all ranks that have it. */
#include "common/mesh/mesh_impl.h"
#include <string.h>

static PetscErrorCode FindOpenVertices(const MeshSerial *s, const char is_open[], PartFaces *f)
{
  PetscFunctionBeginUser;
  for (int v = 0; v < s->nv; v++) f->nopen_vertices += is_open[v];
  PetscCall(PetscMalloc2(f->nopen_vertices, &f->open_vertex, f->nopen_vertices, &f->owners));
  f->nopen_vertices = 0;
  for (int v = 0; v < s->nv; v++) {
    if (is_open[v]) f->open_vertex[f->nopen_vertices++] = v;
  }
  PetscCall(PetscMalloc1(3 * s->ne, &f->closed));
  for (int ef = 0; ef < 3 * s->ne; ef++) {
    int a, b;
    MeshFaceEnds(s, ef, &a, &b);
    if (is_open[a] && is_open[b] && f->local.neighbor[ef] > ef / 3) f->closed[f->nclosed++] = ef;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode FindOpen(const MeshSerial *s, PartFaces *f)
{
  char *is_open;
  PetscFunctionBeginUser;
  for (int ef = 0; ef < 3 * s->ne; ef++) f->nopen += f->local.neighbor[ef] < 0;
  PetscCall(PetscMalloc3(f->nopen, &f->open, f->nopen, &f->across, f->nopen, &f->across_rank));
  PetscCall(PetscCalloc1(s->nv, &is_open));
  f->nopen = 0;
  for (int ef = 0; ef < 3 * s->ne; ef++) {
    if (f->local.neighbor[ef] >= 0) continue;
    int a, b;
    MeshFaceEnds(s, ef, &a, &b);
    is_open[a] = is_open[b] = 1;
    f->open[f->nopen++] = ef;
  }
  PetscCall(FindOpenVertices(s, is_open, f));
  PetscCall(PetscFree(is_open));
  PetscFunctionReturn(0);
}

static int RankOf(const PartFaces *f, long long element)
{
  int low = 0, high = f->size;
  while (high - low > 1) { /* the last rank that starts at or before the element */
    const int mid = (low + high) / 2;
    if (f->start[mid] <= element)
      low = mid;
    else
      high = mid;
  }
  return low;
}

/* Open face k is met by `met`, of values 2 face + turn, or -1 from a closed one: two turn opposite ways, one
 * has a name. */
static PetscErrorCode Match(const MeshSerial *s, int k, long long value, const RendezvousReply *reply,
                            PartFaces *f)
{
  int a, b;
  PetscFunctionBeginUser;
  MeshFaceEnds(s, f->open[k], &a, &b);
  const double *p = &s->x[2 * a], *q = &s->x[2 * b];
  PetscCheck(reply->count <= 2 && reply->lowest >= 0, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
             "more than two triangles share the edge from (%g, %g) to (%g, %g)", p[0], p[1], q[0], q[1]);
  f->across[k] = f->across_rank[k] = -1;
  if (reply->count == 1) {
    PetscCheck(f->local.tag[f->open[k]] >= 0, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
               "the boundary edge from (%g, %g) to (%g, %g) has no name", p[0], p[1], q[0], q[1]);
    PetscFunctionReturn(0);
  }
  PetscCheck(
      (reply->lowest ^ reply->highest) & 1, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
      "triangles of two ranks overlap: both lie on the same side of the edge from (%g, %g) to (%g, %g)", p[0],
      p[1], q[0], q[1]);
  f->across[k] = (value == reply->lowest ? reply->highest : reply->lowest) / 2;
  f->across_rank[k] = RankOf(f, f->across[k] / 3);
  f->local.tag[f->open[k]] = -1;
  PetscFunctionReturn(0);
}

static PetscErrorCode MatchAll(const MeshSerial *s, const long long value[], const RendezvousReply reply[],
                               PartFaces *f)
{
  PetscFunctionBeginUser;
  for (int k = 0; k < f->nopen; k++) PetscCall(Match(s, k, value[k], &reply[k], f));
  if (f->nopen_vertices) memcpy(f->owners, &reply[f->nopen], (size_t)f->nopen_vertices * sizeof *reply);
  PetscFunctionReturn(0);
}

static CopiesKey FaceKey(const MeshPart *part, int ef, int *turn)
{
  int a, b;
  MeshFaceEnds(&part->serial, ef, &a, &b);
  const long long p = part->gid[a], q = part->gid[b];
  *turn = p < q;
  return (CopiesKey){PetscMin(p, q), PetscMax(p, q)};
}

static void FoldReply(void *into, const void *next)
{
  RendezvousReply *all = into;
  const RendezvousReply *one = next;
  all->lowest = PetscMin(all->lowest, one->lowest);
  all->highest = PetscMax(all->highest, one->highest);
  all->count += one->count;
}

PetscErrorCode MeshRendezvous(Copies copies, int n, const long long value[], RendezvousReply reply[])
{
  PetscFunctionBeginUser;
  for (int i = 0; i < n; i++) reply[i] = (RendezvousReply){value[i], value[i], 1};
  PetscCall(CopiesReduce(copies, sizeof *reply, FoldReply, reply));
  PetscFunctionReturn(0);
}

/* Finds the copies of open faces and open vertices on other ranks. */
static PetscErrorCode Rendezvous(MPI_Comm comm, const MeshPart *part, PartFaces *f)
{
  const MeshSerial *s = &part->serial;
  const int n = f->nopen + f->nopen_vertices + f->nclosed;
  CopiesKey *key;
  RendezvousReply *reply;
  long long *value;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(n, &key, n, &reply, n, &value));
  for (int k = 0; k < f->nopen; k++) {
    int turn;
    key[k] = FaceKey(part, f->open[k], &turn);
    value[k] = 2 * (3 * f->start[f->rank] + f->open[k]) + turn;
  }
  for (int k = 0; k < f->nopen_vertices; k++) {
    key[f->nopen + k] = (CopiesKey){part->gid[f->open_vertex[k]], part->gid[f->open_vertex[k]]};
    value[f->nopen + k] = f->rank;
  }
  for (int k = 0, turn; k < f->nclosed; k++) {
    key[f->nopen + f->nopen_vertices + k] = FaceKey(part, f->closed[k], &turn);
    value[f->nopen + f->nopen_vertices + k] = -1;
  }
  PetscCall(CopiesCreate(comm, n, key, &f->copies));
  PetscCall(MeshRendezvous(f->copies, n, value, reply));
  const PetscErrorCode failed = MatchAll(s, value, reply, f);
  PetscCall(PetscFree3(key, reply, value));
  PetscFunctionReturn(failed);
}

static PetscErrorCode Number(MPI_Comm comm, long long ne, PartFaces *f)
{
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &f->size));
  PetscCallMPI(MPI_Comm_rank(comm, &f->rank));
  PetscCall(PetscMalloc1(f->size + 1, &f->start));
  PetscCallMPI(MPI_Allgather(&ne, 1, MPI_LONG_LONG, &f->start[1], 1, MPI_LONG_LONG, comm));
  f->start[0] = 0;
  for (int r = 0; r < f->size; r++) f->start[r + 1] += f->start[r];
  PetscCheck(f->start[f->size] > 0, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG, "the mesh has no triangles");
  PetscFunctionReturn(0);
}

PetscErrorCode PartFacesCreate(MPI_Comm comm, const MeshPart *part, PartFaces *faces)
{
  PetscErrorCode failed;
  PetscFunctionBeginUser;
  memset(faces, 0, sizeof *faces);
  failed = Number(comm, part->serial.ne, faces);
  if (!failed) failed = CollectiveError(comm, MeshFacesCreate(&part->serial, &faces->local));
  if (!failed) PetscCall(FindOpen(&part->serial, faces));
  if (!failed) failed = CollectiveError(comm, Rendezvous(comm, part, faces));
  if (failed) PetscCall(PartFacesDestroy(faces));
  PetscFunctionReturn(failed);
}

PetscErrorCode PartFacesDestroy(PartFaces *f)
{
  PetscFunctionBeginUser;
  PetscCall(MeshFacesDestroy(&f->local));
  PetscCall(PetscFree(f->start));
  PetscCall(PetscFree3(f->open, f->across, f->across_rank));
  PetscCall(PetscFree2(f->open_vertex, f->owners));
  PetscCall(PetscFree(f->closed));
  PetscCall(CopiesDestroy(&f->copies));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshPartShared(MPI_Comm comm, const MeshPart *part, char faces[], char vertices[])
{
  PartFaces f;
  PetscFunctionBeginUser;
  const PetscErrorCode failed = PartFacesCreate(comm, part, &f);
  if (failed) PetscFunctionReturn(failed);
  PetscCall(PetscArrayzero(faces, 3 * part->serial.ne));
  PetscCall(PetscArrayzero(vertices, part->serial.nv));
  for (int k = 0; k < f.nopen; k++) faces[f.open[k]] = f.across[k] >= 0;
  for (int k = 0; k < f.nopen_vertices; k++)
    vertices[f.open_vertex[k]] = f.owners[k].lowest < f.owners[k].highest;
  PetscCall(PartFacesDestroy(&f));
  PetscFunctionReturn(0);
}
