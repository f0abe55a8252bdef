/* Faces between the pieces: who has an open face, or a vertex of one, says so where all that have it meet. */
#include "common/mesh/mesh_impl.h"
#include <string.h>

static PetscErrorCode FindRim(const MeshSerial *s, const char on_rim[], PartFaces *f)
{
  PetscFunctionBeginUser;
  for (int v = 0; v < s->nv; v++) f->nrim += on_rim[v];
  PetscCall(PetscMalloc2(f->nrim, &f->rim, f->nrim, &f->owners));
  f->nrim = 0;
  for (int v = 0; v < s->nv; v++) {
    if (on_rim[v]) f->rim[f->nrim++] = v;
  }
  PetscCall(PetscMalloc1(3 * s->ne, &f->closed));
  for (int ef = 0; ef < 3 * s->ne; ef++) {
    int a, b;
    MeshFaceEnds(s, ef, &a, &b);
    if (on_rim[a] && on_rim[b] && f->local.neighbor[ef] > ef / 3) f->closed[f->nclosed++] = ef;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode FindOpen(const MeshSerial *s, PartFaces *f)
{
  char *on_rim;
  PetscFunctionBeginUser;
  for (int ef = 0; ef < 3 * s->ne; ef++) f->nopen += f->local.neighbor[ef] < 0;
  PetscCall(PetscMalloc3(f->nopen, &f->open, f->nopen, &f->across, f->nopen, &f->across_rank));
  PetscCall(PetscCalloc1(s->nv, &on_rim));
  f->nopen = 0;
  for (int ef = 0; ef < 3 * s->ne; ef++) {
    if (f->local.neighbor[ef] >= 0) continue;
    int a, b;
    MeshFaceEnds(s, ef, &a, &b);
    on_rim[a] = on_rim[b] = 1;
    f->open[f->nopen++] = ef;
  }
  PetscCall(FindRim(s, on_rim, f));
  PetscCall(PetscFree(on_rim));
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
static PetscErrorCode Match(const MeshSerial *s, int k, long long value, const MeshMet *met, PartFaces *f)
{
  int a, b;
  PetscFunctionBeginUser;
  MeshFaceEnds(s, f->open[k], &a, &b);
  const double *p = &s->x[2 * a], *q = &s->x[2 * b];
  PetscCheck(met->count <= 2 && met->lowest >= 0, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
             "more than two triangles share the edge from (%g, %g) to (%g, %g)", p[0], p[1], q[0], q[1]);
  f->across[k] = f->across_rank[k] = -1;
  if (met->count == 1) {
    PetscCheck(f->local.tag[f->open[k]] >= 0, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
               "the boundary edge from (%g, %g) to (%g, %g) has no name", p[0], p[1], q[0], q[1]);
    PetscFunctionReturn(0);
  }
  PetscCheck(
      (met->lowest ^ met->highest) & 1, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
      "triangles of two ranks overlap: both lie on the same side of the edge from (%g, %g) to (%g, %g)", p[0],
      p[1], q[0], q[1]);
  f->across[k] = (value == met->lowest ? met->highest : met->lowest) / 2;
  f->across_rank[k] = RankOf(f, f->across[k] / 3);
  f->local.tag[f->open[k]] = -1;
  PetscFunctionReturn(0);
}

static PetscErrorCode MatchAll(const MeshSerial *s, const long long value[], const MeshMet met[],
                               PartFaces *f)
{
  PetscFunctionBeginUser;
  for (int k = 0; k < f->nopen; k++) PetscCall(Match(s, k, value[k], &met[k], f));
  if (f->nrim) memcpy(f->owners, &met[f->nopen], (size_t)f->nrim * sizeof *met);
  PetscFunctionReturn(0);
}

static MeshKey FaceKey(const MeshPart *piece, int ef, int *turn)
{
  int a, b;
  MeshFaceEnds(&piece->serial, ef, &a, &b);
  const long long p = piece->gid[a], q = piece->gid[b];
  *turn = p < q;
  return (MeshKey){PetscMin(p, q), PetscMax(p, q)};
}

/* Open faces and the rim meet those of the other ranks. */
static PetscErrorCode Meet(MPI_Comm comm, const MeshPart *piece, PartFaces *f)
{
  const MeshSerial *s = &piece->serial;
  const int n = f->nopen + f->nrim + f->nclosed;
  MeshKey *key;
  MeshMet *met;
  long long *value;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(n, &key, n, &met, n, &value));
  for (int k = 0; k < f->nopen; k++) {
    int turn;
    key[k] = FaceKey(piece, f->open[k], &turn);
    value[k] = 2 * (3 * f->start[f->rank] + f->open[k]) + turn;
  }
  for (int k = 0; k < f->nrim; k++) {
    key[f->nopen + k] = (MeshKey){piece->gid[f->rim[k]], piece->gid[f->rim[k]]};
    value[f->nopen + k] = f->rank;
  }
  for (int k = 0, turn; k < f->nclosed; k++) {
    key[f->nopen + f->nrim + k] = FaceKey(piece, f->closed[k], &turn);
    value[f->nopen + f->nrim + k] = -1;
  }
  PetscCall(MeshRendezvousCreate(comm, n, key, &f->meet));
  PetscCall(MeshRendezvousMeet(&f->meet, value, met));
  const PetscErrorCode failed = MatchAll(s, value, met, f);
  PetscCall(PetscFree3(key, met, value));
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

PetscErrorCode PartFacesCreate(MPI_Comm comm, const MeshPart *piece, PartFaces *faces)
{
  PetscErrorCode failed;
  PetscFunctionBeginUser;
  memset(faces, 0, sizeof *faces);
  failed = Number(comm, piece->serial.ne, faces);
  if (!failed) failed = CollectiveError(comm, MeshFacesCreate(&piece->serial, &faces->local));
  if (!failed) PetscCall(FindOpen(&piece->serial, faces));
  if (!failed) failed = CollectiveError(comm, Meet(comm, piece, faces));
  if (failed) PetscCall(PartFacesDestroy(faces));
  PetscFunctionReturn(failed);
}

PetscErrorCode PartFacesDestroy(PartFaces *f)
{
  PetscFunctionBeginUser;
  PetscCall(MeshFacesDestroy(&f->local));
  PetscCall(PetscFree(f->start));
  PetscCall(PetscFree3(f->open, f->across, f->across_rank));
  PetscCall(PetscFree2(f->rim, f->owners));
  PetscCall(PetscFree(f->closed));
  PetscCall(MeshRendezvousDestroy(&f->meet));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshPartShared(MPI_Comm comm, const MeshPart *piece, char faces[], char vertices[])
{
  PartFaces f;
  PetscFunctionBeginUser;
  const PetscErrorCode failed = PartFacesCreate(comm, piece, &f);
  if (failed) PetscFunctionReturn(failed);
  PetscCall(PetscArrayzero(faces, 3 * piece->serial.ne));
  PetscCall(PetscArrayzero(vertices, piece->serial.nv));
  for (int k = 0; k < f.nopen; k++) faces[f.open[k]] = f.across[k] >= 0;
  for (int k = 0; k < f.nrim; k++) vertices[f.rim[k]] = f.owners[k].lowest < f.owners[k].highest;
  PetscCall(PartFacesDestroy(&f));
  PetscFunctionReturn(0);
}
