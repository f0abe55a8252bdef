/* A Mesh from parts: elements in reverse Cuthill-McKee order, vertices and edges as these meet them, then the
 * ghosts (mesh_ghosts.c). */
#include "common/mesh/mesh_build.h"
#include <string.h>

static PetscErrorCode Allocate(const Build *b, Mesh *m)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * (b->part->nv + m->ng), &m->x)); /* at most */
  PetscCall(PetscMalloc1(b->part->nv + m->ng, &m->vgid));    /* at most */
  PetscCall(PetscMalloc1(3 * (m->ne + m->ng), &m->vertex));
  PetscCall(PetscMalloc1(m->ne + m->ng, &m->egid));
  PetscCall(PetscMalloc1(3 * m->ne, &m->neighbor));
  PetscCall(PetscMalloc1(3 * m->ne, &m->neighbor_face));
  PetscCall(PetscMalloc1(3 * m->ne, &m->tag));
  PetscCall(PetscMalloc1(3 * m->ne, &m->edge));
  PetscCall(PetscMalloc1(m->ntags, &m->tag_name));
  PetscFunctionReturn(0);
}

/* Local vertices as the elements meet them. */
static void OwnVertices(Build *b, Mesh *m)
{
  for (int v = 0; v < b->part->nv; v++) b->vertex[v] = -1;
  for (int k = 0; k < 3 * m->ne; k++) {
    const int v = b->part->vertex[3 * b->order[k / 3] + k % 3];
    if (b->vertex[v] < 0) {
      b->vertex[v] = m->nv;
      m->vgid[m->nv] = b->vgid[v];
      memcpy(&m->x[2 * m->nv++], &b->part->x[2 * v], 2 * sizeof *m->x);
    }
    m->vertex[k] = b->vertex[v];
  }
}

/* Local edges as the elements meet them. */
static PetscErrorCode OwnEdges(const Build *b, Mesh *m)
{
  int *number;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(b->faces.local.nedge, &number));
  for (int k = 0; k < b->faces.local.nedge; k++) number[k] = -1;
  for (int k = 0; k < 3 * m->ne; k++) {
    int *edge = &number[b->faces.local.edge[3 * b->order[k / 3] + k % 3]];
    if (*edge < 0) *edge = m->nedge++;
    m->edge[k] = *edge;
  }
  PetscCall(PetscFree(number));
  PetscFunctionReturn(0);
}

/* Neighbours on this rank; those of open faces come with the ghosts. */
static void OwnFaces(const Build *b, Mesh *m)
{
  const MeshFaces *f = &b->faces.local;
  for (int k = 0; k < 3 * m->ne; k++) {
    const int ef = 3 * b->order[k / 3] + k % 3, o = f->neighbor[ef];
    m->neighbor[k] = o < 0 ? -1 : b->number[o];
    m->neighbor_face[k] = f->face[ef];
    m->tag[k] = f->tag[ef];
  }
}

/* Global numbers of own vertices, as the elements meet them; one that lower ranks have too belongs to the
 * lowest of these. */
static PetscErrorCode NumberVertices(Build *b, Mesh *m)
{
  const PartFaces *f = &b->faces;
  PetscInt next = 0, start = 0;
  PetscFunctionBeginUser;
  for (int v = 0; v < b->part->nv; v++) {
    b->foreign[v] = 0;
    b->vgid[v] = -1;
  }
  for (int k = 0; k < f->nopen_vertices; k++) b->foreign[f->open_vertex[k]] = f->owners[k].lowest < f->rank;
  for (int k = 0; k < 3 * m->ne; k++) {
    const int v = b->part->vertex[3 * b->order[k / 3] + k % 3];
    if (!b->foreign[v] && b->vgid[v] < 0) b->vgid[v] = next++;
  }
  m->nv_owned = (int)next;
  PetscCallMPI(MPI_Exscan(&next, &start, 1, MPIU_INT, MPI_SUM, m->comm));
  m->vstart = f->rank ? start : 0;
  PetscCallMPI(MPI_Allreduce(&next, &m->nv_global, 1, MPIU_INT, MPI_SUM, m->comm));
  for (int v = 0; v < b->part->nv; v++) {
    if (b->vgid[v] >= 0) b->vgid[v] += m->vstart;
  }
  PetscFunctionReturn(0);
}

/* Those that have a vertex meet: its owner knows the number, the others say -1. */
static PetscErrorCode LearnNumbers(Build *b)
{
  const PartFaces *f = &b->faces;
  const int n = f->nopen + f->nopen_vertices + f->nclosed;
  long long *value;
  RendezvousReply *reply;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n, &value, n, &reply));
  for (int k = 0; k < n; k++) value[k] = -1;
  for (int k = 0; k < f->nopen_vertices; k++) value[f->nopen + k] = b->vgid[f->open_vertex[k]];
  PetscCall(MeshRendezvous(f->copies, n, value, reply));
  for (int k = 0; k < f->nopen_vertices; k++)
    b->vgid[f->open_vertex[k]] = (PetscInt)reply[f->nopen + k].highest;
  PetscCall(PetscFree2(value, reply));
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

static PetscErrorCode BuildCreate(MPI_Comm comm, const MeshPart *part, PetscBool keep, Build *b)
{
  PetscFunctionBeginUser;
  b->part = &part->serial;
  const PetscErrorCode failed = PartFacesCreate(comm, part, &b->faces);
  if (failed) PetscFunctionReturn(failed);
  PetscCall(PetscMalloc2(part->serial.ne, &b->order, part->serial.ne, &b->number));
  PetscCall(
      PetscMalloc3(part->serial.nv, &b->vertex, part->serial.nv, &b->foreign, part->serial.nv, &b->vgid));
  for (int e = 0; e < part->serial.ne; e++) b->order[e] = e;
  if (!keep) PetscCall(MeshOrder(part->serial.ne, b->faces.local.neighbor, b->order));
  for (int e = 0; e < part->serial.ne; e++) b->number[b->order[e]] = e;
  PetscFunctionReturn(0);
}

static PetscErrorCode BuildDestroy(Build *b)
{
  PetscFunctionBeginUser;
  PetscCall(PartFacesDestroy(&b->faces));
  PetscCall(PetscFree2(b->order, b->number));
  PetscCall(PetscFree3(b->vertex, b->foreign, b->vgid));
  PetscFunctionReturn(0);
}

static PetscErrorCode Fill(Build *b, Mesh *m)
{
  Ghosts ghosts;
  PetscFunctionBeginUser;
  PetscCall(NumberVertices(b, m));
  PetscCall(LearnNumbers(b));
  PetscCall(GhostsCreate(b, m, &ghosts));
  PetscCall(Allocate(b, m));
  for (int e = 0; e < m->ne; e++) m->egid[e] = m->estart + e;
  OwnVertices(b, m);
  OwnFaces(b, m);
  PetscCall(OwnEdges(b, m));
  PetscCall(GhostsFill(b, &ghosts, m));
  PetscCall(GhostsDestroy(&ghosts));
  PetscCall(SetBounds(m));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshBuildOrdered(MPI_Comm comm, const MeshPart *part, PetscBool keep, int order[], Mesh **mesh)
{
  Build b;
  Mesh *m;
  PetscFunctionBeginUser;
  const PetscErrorCode failed = BuildCreate(comm, part, keep, &b);
  if (failed) PetscFunctionReturn(failed);
  PetscCall(PetscNew(mesh));
  m = *mesh;
  m->comm = comm;
  m->dim = 2;
  m->ne = part->serial.ne;
  m->estart = (PetscInt)b.faces.start[b.faces.rank];
  m->nglobal = (PetscInt)b.faces.start[b.faces.size];
  m->ntags = part->serial.ntags;
  PetscCall(Fill(&b, m));
  if (m->ntags) memcpy(m->tag_name, part->serial.tag_name, (size_t)m->ntags * sizeof *m->tag_name);
  if (order) PetscCall(PetscArraycpy(order, b.order, m->ne));
  PetscCall(BuildDestroy(&b));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshBuild(MPI_Comm comm, const MeshPart *part, Mesh **mesh)
{
  return MeshBuildOrdered(comm, part, PETSC_FALSE, NULL, mesh);
}
