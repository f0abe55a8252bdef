#include "common/mesh/mesh_impl.h"
#include <string.h>

/* A triangle in a message: corners by their place among the vertices that the same rank sends to the same
 * one. */
typedef struct {
  int vertex[3], tag[3], region;
} Buffer;

/* What leaves here, in the order of the ranks that it goes to. */
typedef struct {
  Scatter elements, vertices;
  Buffer *element; /* of those that leave */
  int *vertex;     /* of the part; one may go to several ranks */
  int nvertex;
} Migration;

/* Packs the triangles and lists the vertices that go with them, to ranks to[]. */
static PetscErrorCode Pack(const MeshPart *part, const MeshFaces *faces, Migration *c, int to[])
{
  const MeshSerial *s = &part->serial;
  const ScatterRanks *targets;
  const int *leaving;
  int *place, begin = 0;
  PetscFunctionBeginUser;
  PetscCall(ScatterGetLeaving(c->elements, &targets, &leaving));
  PetscCall(PetscMalloc1(s->nv, &place)); /* in the list; before `begin`: not for this rank */
  for (int v = 0; v < s->nv; v++) place[v] = -1;
  c->nvertex = 0;
  for (int j = 0; j < targets->n; j++) {
    for (int k = targets->start[j]; k < targets->start[j + 1]; k++) {
      const int e = leaving[k];
      for (int i = 0; i < 3; i++) {
        const int v = s->vertex[3 * e + i];
        if (place[v] < begin) {
          place[v] = c->nvertex;
          to[c->nvertex] = targets->rank[j];
          c->vertex[c->nvertex++] = v;
        }
        c->element[e].vertex[i] = place[v] - begin;
        c->element[e].tag[i] = faces->tag[3 * e + i];
      }
      c->element[e].region = s->region ? s->region[e] : 0;
    }
    begin = c->nvertex;
  }
  PetscCall(PetscFree(place));
  PetscFunctionReturn(0);
}

static PetscErrorCode MigrationCreate(MPI_Comm comm, const MeshPart *part, const MeshFaces *faces,
                                      const int rank[], Migration *c)
{
  const int ne = part->serial.ne;
  int *to;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(3 * ne, &to));
  PetscCall(PetscMalloc2(ne, &c->element, 3 * ne, &c->vertex));
  PetscCall(ScatterCreate(comm, ne, rank, NULL, &c->elements));
  PetscCall(Pack(part, faces, c, to));
  PetscCall(ScatterCreate(comm, c->nvertex, to, c->vertex, &c->vertices));
  PetscCall(PetscFree(to));
  PetscFunctionReturn(0);
}

static PetscErrorCode MigrationDestroy(Migration *c)
{
  PetscFunctionBeginUser;
  PetscCall(ScatterDestroy(&c->elements));
  PetscCall(ScatterDestroy(&c->vertices));
  PetscCall(PetscFree2(c->element, c->vertex));
  PetscFunctionReturn(0);
}

/* Vertices migrate as a gid and as `ncomp` numbers, of which the first two are the coordinates. */
static PetscErrorCode ReceiveVertices(const MeshPart *from, const Migration *c, int ncomp,
                                      const double data[], int local[], MeshPart *to, double **to_data)
{
  const int nv = from->serial.nv, m = ScatterArriving(c->vertices), w = 2 + ncomp;
  long long *gid;
  double *value, *in;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(m, &gid, w * nv, &value, w * m, &in));
  for (int v = 0; v < nv; v++) {
    for (int d = 0; d < 2; d++) value[w * v + d] = from->serial.x[2 * v + d];
    for (int d = 0; d < ncomp; d++) value[w * v + 2 + d] = data[ncomp * v + d];
  }
  PetscCall(ScatterForward(c->vertices, sizeof *gid, from->gid, gid));
  PetscCall(ScatterForward(c->vertices, (size_t)w * sizeof *in, value, in));
  PetscCall(PartMerge(m, gid, local, to));
  PetscCall(PetscMalloc1(2 * to->serial.nv, &to->serial.x));
  if (ncomp) PetscCall(PetscMalloc1(ncomp * to->serial.nv, to_data));
  for (int k = 0; k < m; k++) {
    for (int d = 0; d < 2; d++) to->serial.x[2 * local[k] + d] = in[w * k + d];
    for (int d = 0; d < ncomp; d++) (*to_data)[ncomp * local[k] + d] = in[w * k + 2 + d];
  }
  PetscCall(PetscFree3(gid, value, in));
  PetscFunctionReturn(0);
}

/* local[k] is the vertex that the k-th arrival became.  Who sends triangles sends vertices too. */
static PetscErrorCode ReceiveElements(const Migration *c, const int local[], MeshSerial *s)
{
  const ScatterRanks *elements, *vertices;
  Buffer *in;
  int *tag;
  PetscFunctionBeginUser;
  PetscCall(ScatterGetSources(c->elements, &elements));
  PetscCall(ScatterGetSources(c->vertices, &vertices));
  s->ne = ScatterArriving(c->elements);
  PetscCall(PetscMalloc2(s->ne, &in, 3 * s->ne, &tag));
  PetscCall(ScatterForward(c->elements, sizeof *in, c->element, in));
  PetscCall(PetscMalloc1(3 * s->ne, &s->vertex));
  if (s->nregions) PetscCall(PetscMalloc1(s->ne, &s->region));
  for (int j = 0; j < elements->n; j++) {
    const int *vertex = &local[vertices->start[j]];
    for (int e = elements->start[j]; e < elements->start[j + 1]; e++) {
      for (int i = 0; i < 3; i++) {
        s->vertex[3 * e + i] = vertex[in[e].vertex[i]];
        tag[3 * e + i] = in[e].tag[i];
      }
      if (s->region) s->region[e] = in[e].region;
    }
  }
  PetscCall(PartFacets(tag, s));
  PetscCall(PetscFree2(in, tag));
  PetscFunctionReturn(0);
}

/* Names come from the first rank that has triangles. */
static PetscErrorCode ShareNames(MPI_Comm comm, const MeshSerial *from, MeshSerial *to)
{
  int rank, size, root, count[2] = {from->ntags, from->region ? from->nregions : 0};
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  root = from->ne ? rank : size - 1;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &root, 1, MPI_INT, MPI_MIN, comm));
  PetscCallMPI(MPI_Bcast(count, 2, MPI_INT, root, comm));
  to->ntags = count[0];
  to->nregions = count[1];
  PetscCall(PetscCalloc1(to->ntags, &to->tag_name));
  PetscCall(PetscCalloc1(to->nregions, &to->region_name));
  if (rank == root && to->ntags)
    memcpy(to->tag_name, from->tag_name, (size_t)to->ntags * sizeof *to->tag_name);
  if (rank == root && to->nregions && from->region_name)
    memcpy(to->region_name, from->region_name, (size_t)to->nregions * sizeof *to->region_name);
  PetscCallMPI(MPI_Bcast(to->tag_name, 64 * to->ntags, MPI_CHAR, root, comm));
  PetscCallMPI(MPI_Bcast(to->region_name, 64 * to->nregions, MPI_CHAR, root, comm));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshPartMigrate(MPI_Comm comm, const MeshPart *part, const int target[], int ncomp,
                               const double data[], MeshPart *moved, double **moved_data)
{
  MeshFaces faces;
  Migration migration;
  int *local;
  PetscFunctionBeginUser;
  memset(moved, 0, sizeof *moved);
  PetscErrorCode failed = CollectiveError(comm, MeshFacesCreate(&part->serial, &faces));
  if (!failed) {
    PetscCall(ShareNames(comm, &part->serial, &moved->serial));
    PetscCall(MigrationCreate(comm, part, &faces, target, &migration));
    PetscCall(PetscMalloc1(ScatterArriving(migration.vertices), &local));
    PetscCall(ReceiveVertices(part, &migration, ncomp, data, local, moved, moved_data));
    PetscCall(ReceiveElements(&migration, local, &moved->serial));
    PetscCall(PetscFree(local));
    PetscCall(MigrationDestroy(&migration));
  }
  PetscCall(MeshFacesDestroy(&faces));
  PetscFunctionReturn(failed);
}
