/* What a distributed mesh of a graded box must be: its triangles, neighbours that agree, ghosts as their
 * owners hold them, P2 numbers without gaps. */
#ifndef TESTS_MESH_DISTRIBUTED_H
#define TESTS_MESH_DISTRIBUTED_H
#include "tests/mesh/strip.h"

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

/* A field of the position, written by owners under the global number, is what every rank expects at its own
 * nodes; numbers have no gaps, there are as many as vertices + edges = V + (V + F - 1) by Euler's formula. */
static inline void CheckNodes(const Mesh *m, int vertices)
{
  double *field = calloc((size_t)m->np2_global, sizeof *field),
         *mine = calloc((size_t)m->np2 + 1, sizeof *mine);
  PetscInt owned = m->np2_owned;
  for (int e = 0; e < m->ne; e++) {
    for (int i = 0; i < 6; i++) {
      const double *a = &m->x[2 * m->vertex[3 * e + (i < 3 ? i : (i + 1) % 3)]];
      const double *b = &m->x[2 * m->vertex[3 * e + (i < 3 ? i : (i + 2) % 3)]];
      const double value = 1.0 + 0.5 * (a[0] + b[0]) + 10.0 * (a[1] + b[1]);
      double *node = &mine[m->p2[6 * e + i]];
      CHECK(*node == 0.0 || fabs(*node - value) < 1e-12, "node %d of element %d stands for two points", i, e);
      *node = value;
    }
  }
  for (int k = 0; k < m->np2; k++) {
    const PetscInt g = m->p2gid[k];
    CHECK(mine[k] > 0.0 && g >= 0 && g < m->np2_global, "node %d", k);
    CHECK((k < m->np2_owned) == (g >= m->p2start && g < m->p2start + m->np2_owned), "ownership of node %d",
          k);
    if (k < m->np2_owned) {
      CHECK(g == m->p2start + k, "owned node %d has number %d", k, (int)g);
      field[g] = mine[k];
    } else {
      CHECK(g < m->p2start, "node %d should belong to the lowest rank around it", k);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &owned, 1, MPIU_INT, MPI_SUM, m->comm);
  CHECK(owned == m->np2_global && owned == 2 * vertices + m->nglobal - 1, "%d P2 nodes", (int)owned);
  MPI_Allreduce(MPI_IN_PLACE, field, (int)m->np2_global, MPI_DOUBLE, MPI_SUM, m->comm);
  for (int k = 0; k < m->np2; k++) {
    CHECK(fabs(field[m->p2gid[k]] - mine[k]) < 1e-12, "node %d: %g here, %g at its owner", k, mine[k],
          field[m->p2gid[k]]);
  }
  free(field);
  free(mine);
}

static inline void CheckDistributed(const Mesh *m, const BoxCase *box, int vertices)
{
  CheckOwned(m, box);
  CheckFaces(m, box);
  CheckGhosts(m);
  CheckNodes(m, vertices);
}
#endif
