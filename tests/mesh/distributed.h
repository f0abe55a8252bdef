/* What a distributed mesh of a graded box must be: its triangles, neighbours that agree, ghosts as their
 * owners hold them, vertices numbered without gaps, edges. */
#ifndef TESTS_MESH_DISTRIBUTED_H
#define TESTS_MESH_DISTRIBUTED_H
#include "tests/mesh/strip.h"
#include <limits.h>

typedef struct {
  double upper[2], size_max;
  Strip strip;
} BoxCase;

static const double LOWER[2] = {0.0, 0.0};

/* Owned elements of all ranks fill estart .. nglobal, and their area is the box's. */
static inline void CheckOwned(const Mesh *m, const BoxCase *box)
{
  double area = 0.0;
  PetscInt ne = m->ne, before = 0;
  PetscMPIInt rank;
  MPI_Comm_rank(m->comm, &rank);
  for (int e = 0; e < m->ne; e++) {
    const double a = TriangleArea(m->x, &m->vertex[3 * e]);
    CHECK(a > 0.0 && m->egid[e] == m->estart + e, "element %d", e);
    area += a;
  }
  MPI_Exscan(&ne, &before, 1, MPIU_INT, MPI_SUM, m->comm);
  CHECK(rank == 0 || before == m->estart, "estart %d, %d elements before", (int)m->estart, (int)before);
  MPI_Allreduce(MPI_IN_PLACE, &ne, 1, MPIU_INT, MPI_SUM, m->comm);
  MPI_Allreduce(MPI_IN_PLACE, &area, 1, MPI_DOUBLE, MPI_SUM, m->comm);
  CHECK(ne == m->nglobal && fabs(area - box->upper[0] * box->upper[1]) < 1e-11,
        "%d of %d elements, area %.15g", (int)ne, (int)m->nglobal, area);
  for (int d = 0; d < 2; d++) CHECK(m->lower[d] == LOWER[d] && m->upper[d] == box->upper[d], "bounds");
}

/* Seen from here, face k of m leads to a neighbour with the same two vertices, turned round. */
static inline void CheckFace(const Mesh *m, int k, int touched[])
{
  const int *v = &m->vertex[3 * (k / 3)], other = m->neighbor[k], face = m->neighbor_face[k], i = k % 3;
  if (other < 0) {
    CHECK(face == -1 && m->tag[k] >= 0 && m->tag[k] < m->ntags, "boundary face %d", k);
    return;
  }
  const int *w = &m->vertex[3 * other];
  CHECK(m->tag[k] == -1 && other < m->ne + m->ng, "inner face %d", k);
  CHECK(v[(i + 1) % 3] == w[(face + 2) % 3] && v[(i + 2) % 3] == w[(face + 1) % 3],
        "face %d and its neighbour", k);
  if (other < m->ne)
    CHECK(m->neighbor[3 * other + face] == k / 3, "face %d: the neighbour has another one", k);
  else
    touched[other - m->ne]++;
}

static inline void CheckFaces(const Mesh *m, const BoxCase *box)
{
  int *touched = calloc((size_t)m->ng + 1, sizeof *touched);
  double length[4] = {0.0};
  for (int k = 0; k < 3 * m->ne; k++) {
    CheckFace(m, k, touched);
    if (m->tag[k] < 0) continue;
    const int *v = &m->vertex[3 * (k / 3)];
    const double *a = &m->x[2 * v[(k + 1) % 3]], *b = &m->x[2 * v[(k + 2) % 3]];
    length[m->tag[k]] += hypot(b[0] - a[0], b[1] - a[1]);
  }
  for (int g = 0; g < m->ng; g++) CHECK(touched[g] > 0, "ghost %d touches nothing", g);
  free(touched);
  MPI_Allreduce(MPI_IN_PLACE, length, 4, MPI_DOUBLE, MPI_SUM, m->comm);
  CHECK(fabs(length[MeshTagIndex(m, "left")] - box->upper[1]) < 1e-11, "left is %g long", length[0]);
  CHECK(fabs(length[MeshTagIndex(m, "top")] - box->upper[0]) < 1e-11, "top is %g long", length[3]);
  CHECK(MeshTagIndex(m, "nowhere") == -1, "a name that is not there");
}

/* Ghosts are the same triangles as their owners hold: corners compared through a table of the whole mesh. */
static inline void CheckGhosts(const Mesh *m)
{
  double(*corner)[6] = calloc((size_t)m->nglobal, sizeof *corner);
  for (int e = 0; e < m->ne; e++) {
    for (int i = 0; i < 6; i++) corner[m->egid[e]][i] = m->x[2 * m->vertex[3 * e + i / 2] + i % 2];
  }
  MPI_Allreduce(MPI_IN_PLACE, corner, (int)(6 * m->nglobal), MPI_DOUBLE, MPI_SUM, m->comm);
  for (int e = m->ne; e < m->ne + m->ng; e++) {
    CHECK(m->egid[e] < m->estart || m->egid[e] >= m->estart + m->ne, "ghost %d is owned", e);
    for (int i = 0; i < 6; i++) {
      CHECK(corner[m->egid[e]][i] == m->x[2 * m->vertex[3 * e + i / 2] + i % 2],
            "ghost %d differs from its owner's", e);
    }
  }
  free(corner);
}

/* Positions, written by owners under the global number, are what every rank has at its own vertices and at those
 * of ghosts; numbers have no gaps, the lowest rank around a vertex owns it. */
static inline void CheckVertices(const Mesh *m, int vertices)
{
  const size_t n = (size_t)m->nv_global;
  double(*x)[2] = calloc(n, sizeof *x);
  int *lowest = malloc(n * sizeof *lowest);
  PetscMPIInt rank;
  CHECK(m->nv_global == vertices, "%d vertices, not %d", (int)m->nv_global, vertices);
  MPI_Comm_rank(m->comm, &rank);
  for (size_t g = 0; g < n; g++) lowest[g] = INT_MAX;
  for (int k = 0; k < 3 * m->ne; k++) lowest[m->vgid[m->vertex[k]]] = rank;
  MPI_Allreduce(MPI_IN_PLACE, lowest, (int)n, MPI_INT, MPI_MIN, m->comm);
  for (int v = 0; v < m->nv; v++) {
    const PetscInt g = m->vgid[v];
    CHECK(g >= 0 && g < m->nv_global, "vertex %d has number %d", v, (int)g);
    const int own = g >= m->vstart && g < m->vstart + m->nv_owned;
    CHECK(own == (lowest[g] == rank), "rank %d and vertex %d of rank %d", rank, (int)g, lowest[g]);
    for (int d = 0; d < 2 && own; d++) x[g][d] = m->x[2 * v + d];
  }
  MPI_Allreduce(MPI_IN_PLACE, x, (int)(2 * n), MPI_DOUBLE, MPI_SUM, m->comm);
  for (int k = 0; k < 2 * m->nv; k++)
    CHECK(x[m->vgid[k / 2]][k % 2] == m->x[k], "vertex %d is not its owner's", k / 2);
  free(x);
  free(lowest);
}

/* An edge is the same in both of its elements: half as many as faces, but for the open ones. */
static inline void CheckEdges(const Mesh *m)
{
  int *ends = malloc((2 * (size_t)m->nedge + 1) * sizeof *ends), sides = 0;
  for (int k = 0; k < 2 * m->nedge; k++) ends[k] = -1;
  for (int k = 0; k < 3 * m->ne; k++) {
    const int *v = &m->vertex[k - k % 3], a = v[(k + 1) % 3], b = v[(k + 2) % 3];
    CHECK(m->edge[k] >= 0 && m->edge[k] < m->nedge, "edge %d", m->edge[k]);
    int *e = &ends[2 * m->edge[k]];
    CHECK(e[0] < 0 || (e[0] == b && e[1] == a), "edge %d stands for two", m->edge[k]);
    e[0] = a;
    e[1] = b;
    sides += m->neighbor[k] >= 0 && m->neighbor[k] < m->ne ? 1 : 2;
  }
  CHECK(sides == 2 * m->nedge, "%d edges with %d sides", m->nedge, sides);
  free(ends);
}

static inline void CheckDistributed(const Mesh *m, const BoxCase *box, int vertices)
{
  CheckOwned(m, box);
  CheckFaces(m, box);
  CheckGhosts(m);
  CheckVertices(m, vertices);
  CheckEdges(m);
}
#endif
