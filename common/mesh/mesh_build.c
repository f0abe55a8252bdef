/* A Mesh from parts: elements in reverse Cuthill-McKee order, vertices and P2 nodes as these meet them, then
 * the ghosts (mesh_ghosts.c). */
#include "common/mesh/mesh_build.h"
#include <string.h>

static PetscErrorCode Allocate(const Build *b, Mesh *m)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * (b->part->nv + m->ng), &m->x)); /* at most */
  PetscCall(PetscMalloc1(3 * (m->ne + m->ng), &m->vertex));
  PetscCall(PetscMalloc1(m->ne + m->ng, &m->egid));
  PetscCall(PetscMalloc1(3 * m->ne, &m->neighbor));
  PetscCall(PetscMalloc1(3 * m->ne, &m->neighbor_face));
  PetscCall(PetscMalloc1(3 * m->ne, &m->tag));
  PetscCall(PetscMalloc1(b->nnodes, &m->p2gid)); /* at most */
  PetscCall(PetscMalloc1(6 * m->ne, &m->p2));
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
      memcpy(&m->x[2 * m->nv++], &b->part->x[2 * v], 2 * sizeof *m->x);
    }
    m->vertex[k] = b->vertex[v];
  }
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

/* Nodes of an element of the part: vertices, then nv + edge. */
static void NodesOf(const Build *b, int e, int node[6])
{
  for (int i = 0; i < 3; i++) {
    node[i] = b->part->vertex[3 * e + i];
    node[3 + i] = b->part->nv + b->faces.local.edge[3 * e + i];
  }
}

/* Nodes that lower ranks have too belong to the lowest of these. */
static void MarkForeign(Build *b)
{
  const PartFaces *f = &b->faces;
  for (int k = 0; k < b->nnodes; k++) b->foreign[k] = 0;
  for (int k = 0; k < f->nopen_vertices; k++) b->foreign[f->open_vertex[k]] = f->owners[k].lowest < f->rank;
  for (int k = 0; k < f->nopen; k++)
    b->foreign[b->part->nv + f->local.edge[f->open[k]]] = f->across[k] >= 0 && f->across_rank[k] < f->rank;
}

/* Global numbers of own nodes, as the elements meet them. */
static PetscErrorCode NumberNodes(Build *b, Mesh *m)
{
  PetscInt next = 0, start = 0;
  int node[6];
  PetscFunctionBeginUser;
  for (int k = 0; k < b->nnodes; k++) b->p2gid[k] = -1;
  for (int e = 0; e < m->ne; e++) {
    NodesOf(b, b->order[e], node);
    for (int i = 0; i < 6; i++) {
      if (!b->foreign[node[i]] && b->p2gid[node[i]] < 0) b->p2gid[node[i]] = next++;
    }
  }
  m->np2_owned = (int)next;
  PetscCallMPI(MPI_Exscan(&next, &start, 1, MPIU_INT, MPI_SUM, m->comm));
  m->p2start = b->faces.rank ? start : 0;
  PetscCallMPI(MPI_Allreduce(&next, &m->np2_global, 1, MPIU_INT, MPI_SUM, m->comm));
  for (int k = 0; k < b->nnodes; k++) {
    if (b->p2gid[k] >= 0) b->p2gid[k] += m->p2start;
  }
  PetscFunctionReturn(0);
}

/* Those that have a node meet: its owner knows the number, the others say -1. */
static PetscErrorCode LearnNumbers(Build *b)
{
  const PartFaces *f = &b->faces;
  const int known = f->nopen + f->nopen_vertices, n = known + f->nclosed;
  int *node;
  long long *value;
  RendezvousReply *reply;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(n, &node, n, &value, n, &reply));
  for (int k = 0; k < f->nopen; k++) node[k] = b->part->nv + f->local.edge[f->open[k]];
  for (int k = 0; k < f->nopen_vertices; k++) node[f->nopen + k] = f->open_vertex[k];
  for (int k = 0; k < n; k++) value[k] = k < known ? b->p2gid[node[k]] : -1;
  PetscCall(MeshRendezvous(f->copies, n, value, reply));
  for (int k = 0; k < known; k++) b->p2gid[node[k]] = (PetscInt)reply[k].highest;
  PetscCall(PetscFree3(node, value, reply));
  PetscFunctionReturn(0);
}

/* Owned P2 nodes in the order of their numbers, the others as the elements meet them. */
static PetscErrorCode Nodes(Build *b, Mesh *m)
{
  int node[6], *local;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(b->nnodes, &local));
  for (int k = 0; k < b->nnodes; k++) local[k] = -1;
  m->np2 = m->np2_owned;
  for (int e = 0; e < m->ne; e++) {
    NodesOf(b, b->order[e], node);
    for (int i = 0; i < 6; i++) {
      int *l = &local[node[i]];
      if (*l < 0) {
        *l = b->foreign[node[i]] ? m->np2++ : (int)(b->p2gid[node[i]] - m->p2start);
        m->p2gid[*l] = b->p2gid[node[i]];
      }
      m->p2[6 * e + i] = *l;
    }
  }
  PetscCall(PetscFree(local));
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
  b->gid = part->gid;
  const PetscErrorCode failed = PartFacesCreate(comm, part, &b->faces);
  if (failed) PetscFunctionReturn(failed);
  b->nnodes = part->serial.nv + b->faces.local.nedge;
  PetscCall(PetscMalloc2(part->serial.ne, &b->order, part->serial.ne, &b->number));
  PetscCall(PetscMalloc3(part->serial.nv, &b->vertex, b->nnodes, &b->foreign, b->nnodes, &b->p2gid));
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
  PetscCall(PetscFree3(b->vertex, b->foreign, b->p2gid));
  PetscFunctionReturn(0);
}

static PetscErrorCode Fill(Build *b, Mesh *m)
{
  Ghosts ghosts;
  PetscFunctionBeginUser;
  PetscCall(GhostsCreate(b, m, &ghosts));
  PetscCall(Allocate(b, m));
  for (int e = 0; e < m->ne; e++) m->egid[e] = m->estart + e;
  OwnVertices(b, m);
  OwnFaces(b, m);
  PetscCall(GhostsFill(b, &ghosts, m));
  PetscCall(GhostsDestroy(&ghosts));
  MarkForeign(b);
  PetscCall(NumberNodes(b, m));
  PetscCall(LearnNumbers(b));
  PetscCall(Nodes(b, m));
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
