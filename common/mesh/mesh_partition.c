/* Distribution: rank 0 works out the parts, the new element numbers and the P2 numbers of the whole mesh (the
 * plan), then makes each rank's Mesh and sends it.  Nothing depends on messages between the others, so
 * numbers are the same in every run on as many ranks. */
#include "mesh_impl.h"
#include <metis.h>
#include <string.h>

typedef struct {
  const MeshSerial *serial;
  MeshFaces faces;
  int nparts;
  int *part;    /* [ne] */
  int *start;   /* [nparts + 1] first global element of each part */
  int *order;   /* [ne] element of the serial mesh that has this global number */
  int *number;  /* [ne] global number of each */
  int *p2gid;   /* [nv + nedge] global P2 node of each vertex and edge, -1 for vertices of no element */
  int *p2start; /* [nparts + 1] first P2 node of each part */
  int *local;   /* [nv + nedge] scratch, -1 everywhere between uses */
} Plan;

/* What a rank has to know before it can receive its part. */
enum {
  COUNT_NV,
  COUNT_NE,
  COUNT_NG,
  COUNT_NP2,
  COUNT_NP2_OWNED,
  COUNT_ESTART,
  COUNT_NGLOBAL,
  COUNT_P2START,
  COUNT_P2_GLOBAL,
  COUNT_NTAGS,
  COUNTS
};

/* Parts of the dual graph by METIS; few elements are dealt out one by one, as METIS may fail on graphs
 * smaller than the number of parts. */
static PetscErrorCode Partition(Plan *p)
{
  const int ne = p->serial->ne;
  idx_t n = ne, nparts = p->nparts, ncon = 1, cut, options[METIS_NOPTIONS], *first, *list, *part;
  PetscFunctionBeginUser;
  for (int e = 0; e < ne; e++) p->part[e] = ne > 2 * p->nparts ? 0 : e % p->nparts;
  if (p->nparts == 1 || ne <= 2 * p->nparts) PetscFunctionReturn(0);
  PetscCall(PetscMalloc3(ne + 1, &first, 3 * ne, &list, ne, &part));
  first[0] = 0;
  for (int e = 0; e < ne; e++) {
    first[e + 1] = first[e];
    for (int i = 0; i < 3; i++) {
      const int o = p->faces.neighbor[3 * e + i];
      if (o >= 0) list[first[e + 1]++] = o;
    }
  }
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  const int status = (nparts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway)(
      &n, &ncon, first, list, NULL, NULL, NULL, &nparts, NULL, NULL, options, &cut, part);
  PetscCheck(status == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB,
             "METIS could not cut %d elements in %d parts: status %d", ne, p->nparts, status);
  for (int e = 0; e < ne; e++) p->part[e] = (int)part[e];
  PetscCall(PetscFree3(first, list, part));
  PetscFunctionReturn(0);
}

/* Serial P2 nodes of an element: vertices, then nv + edge. */
static void NodesOf(const Plan *p, int e, int node[6])
{
  for (int i = 0; i < 3; i++) {
    node[i] = p->serial->vertex[3 * e + i];
    node[3 + i] = p->serial->nv + p->faces.edge[3 * e + i];
  }
}

/* A node belongs to the lowest part around it; nodes of a part are numbered as its elements meet them. */
static void NumberNodes(Plan *p)
{
  const int n = p->serial->nv + p->faces.nedge;
  int *owner = p->local, node[6], next = 0;
  for (int k = 0; k < n; k++) {
    owner[k] = p->nparts;
    p->p2gid[k] = -1;
  }
  for (int e = 0; e < p->serial->ne; e++) {
    NodesOf(p, e, node);
    for (int i = 0; i < 6; i++) owner[node[i]] = PetscMin(owner[node[i]], p->part[e]);
  }
  for (int r = 0; r < p->nparts; r++) {
    p->p2start[r] = next;
    for (int g = p->start[r]; g < p->start[r + 1]; g++) {
      NodesOf(p, p->order[g], node);
      for (int i = 0; i < 6; i++) {
        if (owner[node[i]] == r && p->p2gid[node[i]] < 0) p->p2gid[node[i]] = next++;
      }
    }
  }
  p->p2start[p->nparts] = next;
  for (int k = 0; k < n; k++) p->local[k] = -1;
}

static PetscErrorCode PlanCreate(const MeshSerial *serial, int nparts, Plan *p)
{
  const int ne = serial->ne;
  PetscFunctionBeginUser;
  p->serial = serial;
  p->nparts = nparts;
  PetscCheck(ne > 0, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG, "the mesh has no triangles");
  PetscCall(MeshFacesCreate(serial, &p->faces));
  PetscCall(PetscMalloc3(ne, &p->part, ne, &p->order, ne, &p->number));
  PetscCall(PetscMalloc2(nparts + 1, &p->start, nparts + 1, &p->p2start));
  PetscCall(PetscMalloc2(serial->nv + p->faces.nedge, &p->p2gid, serial->nv + p->faces.nedge, &p->local));
  PetscCall(Partition(p));
  PetscCall(MeshOrder(ne, p->faces.neighbor, nparts, p->part, p->start, p->order));
  for (int g = 0; g < ne; g++) p->number[p->order[g]] = g;
  NumberNodes(p);
  PetscFunctionReturn(0);
}

static PetscErrorCode PlanDestroy(Plan *p)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree3(p->part, p->order, p->number));
  PetscCall(PetscFree2(p->start, p->p2start));
  PetscCall(PetscFree2(p->p2gid, p->local));
  PetscCall(MeshFacesDestroy(&p->faces));
  PetscFunctionReturn(0);
}

static int ByNumber(const void *a, const void *b)
{
  return (*(const int *)a > *(const int *)b) - (*(const int *)a < *(const int *)b);
}

/* Global numbers of the part's ghosts, ascending and without repetition. */
static PetscErrorCode Ghosts(const Plan *p, int r, int *ng, int **ghost)
{
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(3 * (p->start[r + 1] - p->start[r]), ghost));
  for (int g = p->start[r]; g < p->start[r + 1]; g++) {
    for (int i = 0; i < 3; i++) {
      const int o = p->faces.neighbor[3 * p->order[g] + i];
      if (o >= 0 && p->part[o] != r) (*ghost)[n++] = p->number[o];
    }
  }
  if (n) qsort(*ghost, (size_t)n, sizeof **ghost, ByNumber);
  *ng = 0;
  for (int k = 0; k < n; k++) {
    if (!k || (*ghost)[k] != (*ghost)[k - 1]) (*ghost)[(*ng)++] = (*ghost)[k];
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode MeshAllocate(Mesh *m)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * m->nv, &m->x));
  PetscCall(PetscMalloc1(3 * (m->ne + m->ng), &m->vertex));
  PetscCall(PetscMalloc1(m->ne + m->ng, &m->egid));
  PetscCall(PetscMalloc1(3 * m->ne, &m->neighbor));
  PetscCall(PetscMalloc1(3 * m->ne, &m->neighbor_face));
  PetscCall(PetscMalloc1(3 * m->ne, &m->tag));
  PetscCall(PetscMalloc1(m->np2, &m->p2gid));
  PetscCall(PetscMalloc1(6 * m->ne, &m->p2));
  PetscCall(PetscMalloc1(m->ntags, &m->tag_name));
  PetscFunctionReturn(0);
}

/* Local vertices as the elements, owned ones first, meet them. */
static PetscErrorCode FillVertices(Plan *p, Mesh *m)
{
  int *met;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(m->nv, &met));
  m->nv = 0;
  for (int k = 0; k < 3 * (m->ne + m->ng); k++) {
    const int v = p->serial->vertex[3 * p->order[m->egid[k / 3]] + k % 3];
    if (p->local[v] < 0) {
      p->local[v] = m->nv;
      met[m->nv] = v;
      memcpy(&m->x[2 * m->nv++], &p->serial->x[2 * v], 2 * sizeof *m->x);
    }
    m->vertex[k] = p->local[v];
  }
  for (int k = 0; k < m->nv; k++) p->local[met[k]] = -1;
  PetscCall(PetscFree(met));
  PetscCall(PetscRealloc(2 * (size_t)m->nv * sizeof *m->x, &m->x));
  PetscFunctionReturn(0);
}

static int LocalElement(const Plan *p, int r, const Mesh *m, int e)
{
  int low = m->ne, high = m->ne + m->ng;
  if (p->part[e] == r) return p->number[e] - p->start[r];
  while (high - low > 1) { /* ghosts are ascending */
    const int mid = (low + high) / 2;
    if (m->egid[mid] <= p->number[e])
      low = mid;
    else
      high = mid;
  }
  return low;
}

static void FillFaces(const Plan *p, int r, Mesh *m)
{
  for (int k = 0; k < 3 * m->ne; k++) {
    const int ef = 3 * p->order[m->egid[k / 3]] + k % 3, other = p->faces.neighbor[ef];
    m->neighbor[k] = other < 0 ? -1 : LocalElement(p, r, m, other);
    m->neighbor_face[k] = p->faces.face[ef];
    m->tag[k] = other < 0 ? p->faces.tag[ef] : -1;
  }
}

/* Owned P2 nodes come in the order of their global numbers, the others as the elements meet them. */
static PetscErrorCode FillNodes(Plan *p, int r, Mesh *m)
{
  int node[6], *met;
  PetscFunctionBeginUser;
  m->p2start = p->p2start[r];
  m->np2_owned = p->p2start[r + 1] - p->p2start[r];
  PetscCall(PetscMalloc1(m->np2, &met));
  m->np2 = m->np2_owned;
  for (int e = 0; e < m->ne; e++) {
    NodesOf(p, p->order[m->egid[e]], node);
    for (int i = 0; i < 6; i++) {
      const int g = p->p2gid[node[i]];
      int *local = &p->local[node[i]];
      if (*local < 0) {
        *local = g >= p->p2start[r] && g < p->p2start[r + 1] ? g - p->p2start[r] : m->np2++;
        met[*local] = node[i];
        m->p2gid[*local] = g;
      }
      m->p2[6 * e + i] = *local;
    }
  }
  for (int k = 0; k < m->np2; k++) p->local[met[k]] = -1;
  PetscCall(PetscFree(met));
  PetscCall(PetscRealloc((size_t)m->np2 * sizeof *m->p2gid, &m->p2gid));
  PetscFunctionReturn(0);
}

static PetscErrorCode PartCreate(Plan *p, int r, Mesh **mesh)
{
  Mesh *m;
  int *ghost;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(mesh));
  m = *mesh;
  m->ne = p->start[r + 1] - p->start[r];
  m->estart = p->start[r];
  m->nglobal = p->serial->ne;
  m->np2_global = p->p2start[p->nparts];
  m->ntags = p->serial->ntags;
  PetscCall(Ghosts(p, r, &m->ng, &ghost));
  m->nv = 3 * (m->ne + m->ng); /* at most: the true counts come with the numbers */
  m->np2 = 6 * m->ne;
  PetscCall(MeshAllocate(m));
  for (int e = 0; e < m->ne; e++) m->egid[e] = m->estart + e;
  for (int k = 0; k < m->ng; k++) m->egid[m->ne + k] = ghost[k];
  PetscCall(PetscFree(ghost));
  PetscCall(FillVertices(p, m));
  FillFaces(p, r, m);
  PetscCall(FillNodes(p, r, m));
  if (m->ntags) memcpy(m->tag_name, p->serial->tag_name, (size_t)m->ntags * sizeof *m->tag_name);
  PetscFunctionReturn(0);
}

/* The arrays of a Mesh as messages. */
typedef struct {
  void *data;
  int count;
  MPI_Datatype type;
} Parcel;

enum { PARCELS = 9 };

static void Parcels(const Mesh *m, Parcel parcel[PARCELS])
{
  const Parcel all[PARCELS] = {
      {m->x, 2 * m->nv, MPI_DOUBLE},          {m->vertex, 3 * (m->ne + m->ng), MPI_INT},
      {m->egid, m->ne + m->ng, MPIU_INT},     {m->neighbor, 3 * m->ne, MPI_INT},
      {m->neighbor_face, 3 * m->ne, MPI_INT}, {m->tag, 3 * m->ne, MPI_INT},
      {m->p2gid, m->np2, MPIU_INT},           {m->p2, 6 * m->ne, MPI_INT},
      {m->tag_name, 64 * m->ntags, MPI_CHAR}};
  memcpy(parcel, all, sizeof all);
}

static PetscErrorCode PartSend(MPI_Comm comm, int to, const Mesh *m)
{
  const PetscInt count[COUNTS] = {m->nv,     m->ne,      m->ng,      m->np2,        m->np2_owned,
                                  m->estart, m->nglobal, m->p2start, m->np2_global, m->ntags};
  Parcel parcel[PARCELS];
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Send(count, COUNTS, MPIU_INT, to, 0, comm));
  Parcels(m, parcel);
  for (int k = 0; k < PARCELS; k++) {
    PetscCallMPI(MPI_Send(parcel[k].data, parcel[k].count, parcel[k].type, to, 1 + k, comm));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode PartReceive(MPI_Comm comm, Mesh **mesh)
{
  PetscInt count[COUNTS];
  Parcel parcel[PARCELS];
  Mesh *m;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Recv(count, COUNTS, MPIU_INT, 0, 0, comm, MPI_STATUS_IGNORE));
  PetscCall(PetscNew(mesh));
  m = *mesh;
  m->nv = (int)count[COUNT_NV];
  m->ne = (int)count[COUNT_NE];
  m->ng = (int)count[COUNT_NG];
  m->np2 = (int)count[COUNT_NP2];
  m->np2_owned = (int)count[COUNT_NP2_OWNED];
  m->estart = count[COUNT_ESTART];
  m->nglobal = count[COUNT_NGLOBAL];
  m->p2start = count[COUNT_P2START];
  m->np2_global = count[COUNT_P2_GLOBAL];
  m->ntags = (int)count[COUNT_NTAGS];
  PetscCall(MeshAllocate(m));
  Parcels(m, parcel);
  for (int k = 0; k < PARCELS; k++) {
    PetscCallMPI(
        MPI_Recv(parcel[k].data, parcel[k].count, parcel[k].type, 0, 1 + k, comm, MPI_STATUS_IGNORE));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SetBounds(Mesh *m)
{
  double low[4] = {PETSC_INFINITY, PETSC_INFINITY, PETSC_INFINITY, PETSC_INFINITY}; /* of x, y, -x, -y */
  PetscFunctionBeginUser;
  for (int v = 0; v < m->nv; v++) {
    for (int d = 0; d < 2; d++) {
      low[d] = PetscMin(low[d], m->x[2 * v + d]);
      low[2 + d] = PetscMin(low[2 + d], -m->x[2 * v + d]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, low, 4, MPI_DOUBLE, MPI_MIN, m->comm));
  for (int d = 0; d < 2; d++) {
    m->lower[d] = low[d];
    m->upper[d] = -low[2 + d];
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshDistribute(MPI_Comm comm, const MeshSerial *serial, Mesh **mesh)
{
  PetscMPIInt rank, size;
  PetscErrorCode failed = 0;
  Plan plan = {0};
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  if (rank == 0) failed = PlanCreate(serial, size, &plan);
  PetscCallMPI(MPI_Bcast(&failed, 1, MPI_INT, 0, comm));
  if (failed) PetscFunctionReturn(failed);
  if (rank == 0) {
    for (int r = size - 1; r >= 0; r--) {
      PetscCall(PartCreate(&plan, r, mesh));
      if (r == 0) break;
      PetscCall(PartSend(comm, r, *mesh));
      PetscCall(MeshDestroy(mesh));
    }
    PetscCall(PlanDestroy(&plan));
  } else {
    PetscCall(PartReceive(comm, mesh));
  }
  (*mesh)->comm = comm;
  (*mesh)->dim = 2;
  PetscCall(SetBounds(*mesh));
  PetscFunctionReturn(0);
}
