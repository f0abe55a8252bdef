#include "common/mesh/mesh_impl.h"
#include <string.h>

/* A triangle on its way: corners by their place among the vertices that the same rank sends to the same rank.
 */
typedef struct {
  int vertex[3], tag[3], region;
} Parcel;

/* What leaves here, in the order of the ranks that it goes to. */
typedef struct {
  MeshRoute elements, vertices;
  Parcel *parcel; /* [elements.out_start[size]] */
  int *vertex;    /* [vertices.out_start[size]] of the piece; one may go to several ranks */
} Cargo;

/* Packs the parcels and lists the vertices that go with them; *nv of these, to ranks to[]. */
static PetscErrorCode Pack(const MeshPart *piece, const MeshFaces *faces, const int leaving[], Cargo *c,
                           int to[], int *nv)
{
  const MeshSerial *s = &piece->serial;
  int *place, begin = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->nv, &place)); /* in the list; before `begin`: not for this rank */
  for (int v = 0; v < s->nv; v++) place[v] = -1;
  *nv = 0;
  for (int r = 0; r < c->elements.size; r++) {
    for (int k = c->elements.out_start[r]; k < c->elements.out_start[r + 1]; k++) {
      const int e = leaving[k];
      for (int i = 0; i < 3; i++) {
        const int v = s->vertex[3 * e + i];
        if (place[v] < begin) {
          place[v] = *nv;
          to[*nv] = r;
          c->vertex[(*nv)++] = v;
        }
        c->parcel[k].vertex[i] = place[v] - begin;
        c->parcel[k].tag[i] = faces->tag[3 * e + i];
      }
      c->parcel[k].region = s->region ? s->region[e] : 0;
    }
    begin = *nv;
  }
  PetscCall(PetscFree(place));
  PetscFunctionReturn(0);
}

static PetscErrorCode CargoCreate(MPI_Comm comm, const MeshPart *piece, const MeshFaces *faces,
                                  const int part[], Cargo *c)
{
  const int ne = piece->serial.ne;
  int *slot, *leaving, *to, nv = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(ne, &slot, ne, &leaving, 3 * ne, &to));
  PetscCall(PetscMalloc2(ne, &c->parcel, 3 * ne, &c->vertex));
  PetscCall(MeshRouteCreate(comm, ne, part, slot, &c->elements));
  for (int e = 0; e < ne; e++) leaving[slot[e]] = e;
  PetscCall(Pack(piece, faces, leaving, c, to, &nv));
  PetscCall(MeshRouteCreate(comm, nv, to, NULL, &c->vertices));
  PetscCall(PetscFree3(slot, leaving, to));
  PetscFunctionReturn(0);
}

static PetscErrorCode CargoDestroy(Cargo *c)
{
  PetscFunctionBeginUser;
  PetscCall(MeshRouteDestroy(&c->elements));
  PetscCall(MeshRouteDestroy(&c->vertices));
  PetscCall(PetscFree2(c->parcel, c->vertex));
  PetscFunctionReturn(0);
}

/* Vertices travel as a gid and as `ncomp` numbers, of which the first two are the coordinates. */
static PetscErrorCode ReceiveVertices(const MeshPart *from, const Cargo *c, int ncomp, const double data[],
                                      int local[], MeshPart *to, double **to_data)
{
  const MeshRoute *route = &c->vertices;
  const int n = route->out_start[route->size], m = route->in_start[route->size], w = 2 + ncomp;
  long long *gid, *gid_in;
  double *value, *in;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(n, &gid, m, &gid_in, w * n, &value, w * m, &in));
  for (int k = 0; k < n; k++) {
    gid[k] = from->gid[c->vertex[k]];
    for (int d = 0; d < 2; d++) value[w * k + d] = from->serial.x[2 * c->vertex[k] + d];
    for (int d = 0; d < ncomp; d++) value[w * k + 2 + d] = data[ncomp * c->vertex[k] + d];
  }
  PetscCall(MeshRouteSend(route, sizeof *gid, gid, gid_in));
  PetscCall(MeshRouteSend(route, (size_t)w * sizeof *in, value, in));
  PetscCall(PartMerge(m, gid_in, local, to));
  PetscCall(PetscMalloc1(2 * to->serial.nv, &to->serial.x));
  if (ncomp) PetscCall(PetscMalloc1(ncomp * to->serial.nv, to_data));
  for (int k = 0; k < m; k++) {
    for (int d = 0; d < 2; d++) to->serial.x[2 * local[k] + d] = in[w * k + d];
    for (int d = 0; d < ncomp; d++) (*to_data)[ncomp * local[k] + d] = in[w * k + 2 + d];
  }
  PetscCall(PetscFree4(gid, gid_in, value, in));
  PetscFunctionReturn(0);
}

/* local[k] is the vertex that the k-th arrival became. */
static PetscErrorCode ReceiveElements(const Cargo *c, const int local[], MeshSerial *s)
{
  const MeshRoute *route = &c->elements;
  Parcel *in;
  int *tag;
  PetscFunctionBeginUser;
  s->ne = route->in_start[route->size];
  PetscCall(PetscMalloc2(s->ne, &in, 3 * s->ne, &tag));
  PetscCall(MeshRouteSend(route, sizeof *in, c->parcel, in));
  PetscCall(PetscMalloc1(3 * s->ne, &s->vertex));
  if (s->nregions) PetscCall(PetscMalloc1(s->ne, &s->region));
  for (int r = 0; r < route->size; r++) {
    const int *vertex = &local[c->vertices.in_start[r]];
    for (int e = route->in_start[r]; e < route->in_start[r + 1]; e++) {
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

PetscErrorCode MeshPartMigrate(MPI_Comm comm, const MeshPart *piece, const int part[], int ncomp,
                               const double data[], MeshPart *moved, double **moved_data)
{
  MeshFaces faces;
  Cargo cargo;
  int *local;
  PetscFunctionBeginUser;
  memset(moved, 0, sizeof *moved);
  PetscErrorCode failed = CollectiveError(comm, MeshFacesCreate(&piece->serial, &faces));
  if (!failed) {
    PetscCall(ShareNames(comm, &piece->serial, &moved->serial));
    PetscCall(CargoCreate(comm, piece, &faces, part, &cargo));
    PetscCall(PetscMalloc1(cargo.vertices.in_start[cargo.vertices.size], &local));
    PetscCall(ReceiveVertices(piece, &cargo, ncomp, data, local, moved, moved_data));
    PetscCall(ReceiveElements(&cargo, local, &moved->serial));
    PetscCall(PetscFree(local));
    PetscCall(CargoDestroy(&cargo));
  }
  PetscCall(MeshFacesDestroy(&faces));
  PetscFunctionReturn(failed);
}
