/* Distributed meshes of the unit square that differ: n x n cells, each cut along a random diagonal, inner
 * vertices shaken.  The seed decides inside of a disc; outside all meshes of the same n are the same. */
#ifndef TESTS_TRANSFER_SHAKEN_H
#define TESTS_TRANSFER_SHAKEN_H
#include "common/mesh/mesh.h"
#include "common/supermesh/geometry.h"
#include "tests/check.h"
#include <stdint.h>

typedef struct {
  int n;
  unsigned seed;
  double radius;   /* of the disc; 1: everywhere */
  double power[2]; /* column i is at (i / n)^power[0], rows likewise; 0: even */
} Shaken;

/* In [0, 1), a function of the arguments; splitmix64. */
static inline double Chance(unsigned seed, int k, int which)
{
  uint64_t v = ((uint64_t)seed << 32) + 4 * (uint64_t)k + (uint64_t)which;
  for (int round = 0; round < 2; round++) {
    v += UINT64_C(0x9e3779b97f4a7c15);
    v = (v ^ v >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    v = (v ^ v >> 27) * UINT64_C(0x94d049bb133111eb);
    v ^= v >> 31;
  }
  return (double)(v >> 11) * 0x1p-53;
}

static inline unsigned ShakenSeed(const Shaken *s, int i, int j)
{
  const double x = (double)i / s->n - 0.5, y = (double)j / s->n - 0.5;
  return x * x + y * y < s->radius * s->radius ? s->seed : 12345u;
}

static inline double ShakenLine(const Shaken *s, int axis, int i)
{
  return s->power[axis] > 0.0 ? pow((double)i / s->n, s->power[axis]) : (double)i / s->n;
}

/* Corner (i, j) of the cells moves by up to a fifth of the smaller cell beside it, which cannot turn a
 * triangle over; the rim stays. */
static inline void ShakenCorner(const Shaken *s, int i, int j, double x[2])
{
  const int k = i + (s->n + 1) * j, at[2] = {i, j}, inner = i > 0 && i < s->n && j > 0 && j < s->n;
  for (int axis = 0; axis < 2; axis++) {
    x[axis] = ShakenLine(s, axis, at[axis]);
    if (!inner) continue;
    const double below = x[axis] - ShakenLine(s, axis, at[axis] - 1);
    const double above = ShakenLine(s, axis, at[axis] + 1) - x[axis];
    x[axis] += fmin(below, above) * (0.4 * Chance(ShakenSeed(s, i, j), k, axis) - 0.2);
  }
}

static inline void ShakenFacets(int n, MeshSerial *m)
{
  static const char *const NAME[4] = {"left", "right", "bottom", "top"};
  m->ntags = 4;
  for (int k = 0; k < 4; k++) strcpy(m->tag_name[k], NAME[k]);
  for (int i = 0; i < n; i++) {
    const int corner[4][2] = {{(i + 1) * (n + 1), i * (n + 1)},
                              {i * (n + 1) + n, (i + 1) * (n + 1) + n},
                              {i, i + 1},
                              {n * (n + 1) + i + 1, n * (n + 1) + i}};
    for (int k = 0; k < 4; k++) {
      m->facet[2 * m->nb] = corner[k][0];
      m->facet[2 * m->nb + 1] = corner[k][1];
      m->facet_tag[m->nb++] = k;
    }
  }
}

static inline PetscErrorCode ShakenSerial(const Shaken *s, MeshSerial *m)
{
  const int n = s->n;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(2 * (n + 1) * (n + 1), &m->x));
  PetscCall(PetscCalloc1(6 * n * n, &m->vertex));
  PetscCall(PetscCalloc1(8 * n, &m->facet));
  PetscCall(PetscCalloc1(4 * n, &m->facet_tag));
  PetscCall(PetscCalloc1(4, &m->tag_name));
  for (int j = 0; j <= n; j++) {
    for (int i = 0; i <= n; i++) ShakenCorner(s, i, j, &m->x[2 * m->nv++]);
  }
  for (int j = 0; j < n; j++) {
    for (int i = 0; i < n; i++) {
      const int corner[4] = {i + j * (n + 1), i + 1 + j * (n + 1), i + 1 + (j + 1) * (n + 1),
                             i + (j + 1) * (n + 1)};
      const int turn = Chance(ShakenSeed(s, i, j), i + (n + 1) * j, 2) < 0.5;
      for (int v = 0; v < 6; v++) m->vertex[3 * m->ne + v] = corner[(turn + 2 * (v / 3) + v % 3) % 4];
      m->ne += 2;
    }
  }
  ShakenFacets(n, m);
  PetscFunctionReturn(0);
}

/* Collective; free with MeshDestroy. */
static inline PetscErrorCode ShakenMesh(MPI_Comm comm, const Shaken *s, Mesh **mesh)
{
  MeshSerial serial = {0};
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) PetscCall(ShakenSerial(s, &serial));
  PetscCall(MeshDistribute(comm, &serial, mesh));
  PetscCall(MeshSerialDestroy(&serial));
  PetscFunctionReturn(0);
}

/* Corner i of owned element e. */
static inline const double *Corner(const Mesh *m, int e, int i)
{
  return &m->x[2 * m->vertex[3 * e + i]];
}

/* Local P2 node's position. */
static inline void NodePosition(const Mesh *m, int e, int i, double x[2])
{
  const double *p = Corner(m, e, i < 3 ? i : (i + 1) % 3), *q = Corner(m, e, i < 3 ? i : (i + 2) % 3);
  for (int c = 0; c < 2; c++) x[c] = 0.5 * (p[c] + q[c]);
}

static inline double ElementArea(const Mesh *m, int e)
{
  return 0.5 * GeometryTurn(Corner(m, e, 0), Corner(m, e, 1), Corner(m, e, 2));
}
#endif
