// ranks: 1 2 3 5
/* Between random, graded, partly identical and identical meshes, each with its own partition: integrals are
 * conserved, P1 and P2 fields come out as they went in, unchanged elements are copied, energy does not grow,
 * any number of ranks gives the same answer. */
#include "common/transfer/transfer.h"
#include "tests/transfer/shaken.h"

enum { COMPS = 3 };
typedef double Values[COMPS][3];

static double Linear(const double x[2])
{
  return 3.0 - 2.0 * x[0] + 7.0 * x[1];
}

static double Quadratic(const double x[2])
{
  return 1.0 + x[0] - 2.0 * x[1] + 3.0 * x[0] * x[0] - 4.0 * x[0] * x[1] + 0.5 * x[1] * x[1];
}

/* A number in [-1, 1) that a corner of an element has in every partition: from the bits of its position and
 * of the element's centre. */
static double Noise(const Mesh *m, int e, int i)
{
  double sum = 0.0;
  uint64_t bits;
  for (int k = 0; k < 3; k++) {
    const double *x = Corner(m, e, k);
    sum += (k == i ? 0.37 : 0.11) * (x[0] + 1.7 * x[1]);
  }
  memcpy(&bits, &sum, sizeof bits);
  return 2.0 * Chance((unsigned)(bits >> 32) ^ (unsigned)bits, 0, 0) - 1.0;
}

/* Component 0 is linear, 1 noise, 2 smooth. */
static Values *MakeSource(const Mesh *m)
{
  Values *u = malloc((size_t)(m->ne + 1) * sizeof *u);
  for (int e = 0; e < m->ne; e++) {
    for (int i = 0; i < 3; i++) {
      const double *x = Corner(m, e, i);
      u[e][0][i] = Linear(x);
      u[e][1][i] = Noise(m, e, i);
      u[e][2][i] = sin(6.0 * x[0]) * cos(5.0 * x[1]);
    }
  }
  return u;
}

/* Of a component: integral, integral of the modulus, integral of the square; on all ranks. */
static void Integrals(const Mesh *m, const Values u[], int c, double sum[3])
{
  sum[0] = sum[1] = sum[2] = 0.0;
  for (int e = 0; e < m->ne; e++) {
    const double *q = u[e][c], s = q[0] + q[1] + q[2], area = ElementArea(m, e);
    sum[0] += area / 3.0 * s;
    sum[1] += area / 3.0 * (fabs(q[0]) + fabs(q[1]) + fabs(q[2]));
    sum[2] += area / 12.0 * (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + s * s);
  }
  MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, m->comm);
}

static void CheckP1DG(const Mesh *from, const Mesh *to, const Values source[], const Values target[])
{
  for (int c = 0; c < COMPS; c++) {
    double before[3], after[3];
    Integrals(from, source, c, before);
    Integrals(to, target, c, after);
    CHECK(fabs(after[0] - before[0]) < 1e-13 * before[1], "component %d: integral %.17g becomes %.17g", c,
          before[0], after[0]);
    CHECK(after[2] < before[2] * (1.0 + 1e-14), "component %d: energy %.17g becomes %.17g", c, before[2],
          after[2]);
  }
  for (int e = 0; e < to->ne; e++) {
    for (int i = 0; i < 3; i++) {
      CHECK(fabs(target[e][0][i] - Linear(Corner(to, e, i))) < 1e-12, "P1 field is off by %g",
            target[e][0][i] - Linear(Corner(to, e, i)));
    }
  }
}

/* Nodes of several ranks have the same bits on all. */
static void CheckShared(MPI_Comm comm, const P2Space *s, const double p[])
{
  double *least = malloc((size_t)s->nglobal * sizeof *least), *most;
  most = malloc((size_t)s->nglobal * sizeof *most);
  for (PetscInt k = 0; k < s->nglobal; k++) {
    least[k] = HUGE_VAL;
    most[k] = -HUGE_VAL;
  }
  for (int k = 0; k < s->n; k++) least[s->gid[k]] = most[s->gid[k]] = p[k];
  MPI_Allreduce(MPI_IN_PLACE, least, (int)s->nglobal, MPI_DOUBLE, MPI_MIN, comm);
  MPI_Allreduce(MPI_IN_PLACE, most, (int)s->nglobal, MPI_DOUBLE, MPI_MAX, comm);
  for (PetscInt k = 0; k < s->nglobal; k++) CHECK(least[k] == most[k], "ranks differ on node %d", (int)k);
  free(least);
  free(most);
}

static void CheckP2(Transfer transfer, const Mesh *from, const Mesh *to)
{
  P2Space *old, *new;
  CHECK(!P2SpaceCreate(from, &old) && !P2SpaceCreate(to, &new), "no space");
  double *source = malloc((size_t)(old->n + 1) * sizeof *source), *target, x[2];
  target = malloc((size_t)(new->n + 1) * sizeof *target);
  for (int k = 0; k < new->n; k++) target[k] = NAN;
  for (int k = 0; k < 6 * from->ne; k++) {
    NodePosition(from, k / 6, k % 6, x);
    source[old->node[k]] = Quadratic(x);
  }
  CHECK(!TransferP2(transfer, old, new, source, target), "TransferP2");
  for (int k = 0; k < 6 * to->ne; k++) {
    NodePosition(to, k / 6, k % 6, x);
    CHECK(fabs(target[new->node[k]] - Quadratic(x)) < 1e-12, "P2 field is %g at (%g, %g), not %g",
          target[new->node[k]], x[0], x[1], Quadratic(x));
  }
  /* any field, not just quadratics */
  for (int k = 0; k < 6 * from->ne; k++) {
    NodePosition(from, k / 6, k % 6, x);
    source[old->node[k]] = sin(40.0 * x[0] + 30.0 * x[1]);
  }
  CHECK(!TransferP2(transfer, old, new, source, target), "TransferP2");
  CheckShared(to->comm, new, target);
  free(source);
  free(target);
  CHECK(!P2SpaceDestroy(&old) && !P2SpaceDestroy(&new), "not freed");
}

/* Elements of both meshes, found by comparing all with all, have the same data bit for bit. */
static int CheckCopied(const Mesh *from, const Mesh *to, const Values source[], const Values target[])
{
  int n = 0;
  for (int t = 0; t < to->ne; t++) {
    for (int k = 0; k < 3 * from->ne; k++) {
      int same = 0;
      for (int i = 0; i < 3; i++)
        same += !memcmp(Corner(to, t, i), Corner(from, k / 3, (i + k) % 3), 2 * sizeof(double));
      if (same < 3) continue;
      n++;
      for (int i = 0; i < 3 * COMPS; i++) {
        CHECK(target[t][i / 3][i % 3] == source[k / 3][i / 3][(i + k) % 3], "element %d was not copied", t);
      }
    }
  }
  return n;
}

/* The same transfer by this rank alone agrees with what the ranks did together. */
static void CheckAlone(const Mesh *to, const Values target[], const Mesh *whole, const Values alone[])
{
  for (int t = 0; t < to->ne; t++) {
    int found = 0;
    for (int k = 0; k < 3 * whole->ne && !found; k++) {
      for (int i = 0; i < 3; i++)
        found += !memcmp(Corner(to, t, i), Corner(whole, k / 3, (i + k) % 3), 2 * sizeof(double));
      found = found == 3;
      if (!found) continue;
      for (int i = 0; i < 3 * COMPS; i++) {
        const double difference = target[t][i / 3][i % 3] - alone[k / 3][i / 3][(i + k) % 3];
        CHECK(fabs(difference) < 1e-12, "ranks change the result by %g", difference);
      }
    }
    CHECK(found, "element %d is missing", t);
  }
}

typedef PetscErrorCode (*Maker)(MPI_Comm comm, const void *what, Mesh **mesh);

static PetscErrorCode MakeShaken(MPI_Comm comm, const void *what, Mesh **mesh)
{
  return ShakenMesh(comm, what, mesh);
}

static double Size(void *context, const double x[2])
{
  const double *p = context;
  return p[2] + 0.3 * hypot(x[0] - p[0], x[1] - p[1]);
}

/* what: where a graded box mesh is fine, and how fine. */
static PetscErrorCode MakeGraded(MPI_Comm comm, const void *what, Mesh **mesh)
{
  static const double LOWER[2] = {0.0, 0.0}, UPPER[2] = {1.0, 1.0};
  double point[3];
  MeshSerial serial = {0};
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  memcpy(point, what, sizeof point);
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (rank == 0) PetscCall(MeshBox(LOWER, UPPER, 0.125, Size, point, &serial));
  PetscCall(MeshDistribute(comm, &serial, mesh));
  PetscCall(MeshSerialDestroy(&serial));
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(MPI_Comm comm, Maker maker, const void *what[2], Mesh *mesh[2], Values *u[2],
                          Transfer *transfer)
{
  PetscFunctionBeginUser;
  for (int m = 0; m < 2; m++) PetscCall(maker(comm, what[m], &mesh[m]));
  u[0] = MakeSource(mesh[0]);
  u[1] = malloc((size_t)(mesh[1]->ne + 1) * sizeof *u[1]);
  PetscCall(TransferCreate(mesh[0], mesh[1], transfer));
  PetscCall(TransferP1DG(*transfer, COMPS, &u[0][0][0][0], &u[1][0][0][0]));
  PetscFunctionReturn(0);
}

static PetscErrorCode Clean(Mesh *mesh[2], Values *u[2], Transfer *transfer)
{
  PetscFunctionBeginUser;
  PetscCall(TransferDestroy(transfer));
  CHECK(!*transfer, "the handle is nulled");
  for (int m = 0; m < 2; m++) {
    free(u[m]);
    PetscCall(MeshDestroy(&mesh[m]));
  }
  PetscFunctionReturn(0);
}

/* copied: how many elements of the new mesh are in the old one, within [least, most]. */
static PetscErrorCode Check(Maker maker, const void *a, const void *b, int least, int most)
{
  const void *what[2] = {a, b};
  Mesh *mesh[2], *whole[2];
  Values *u[2], *v[2];
  Transfer transfer, alone;
  TransferStats stats;
  PetscFunctionBeginUser;
  PetscCall(Run(PETSC_COMM_WORLD, maker, what, mesh, u, &transfer));
  PetscCall(Run(PETSC_COMM_SELF, maker, what, whole, v, &alone));
  CheckP1DG(mesh[0], mesh[1], u[0], u[1]);
  CheckP2(transfer, mesh[0], mesh[1]);
  CheckAlone(mesh[1], u[1], whole[1], v[1]);
  const int copied = CheckCopied(whole[0], whole[1], v[0], v[1]);
  PetscCall(TransferGetStats(transfer, &stats));
  CHECK(stats.copied == copied && stats.copied + stats.projected == mesh[1]->nglobal,
        "%d copied, %d projected; %d are in both meshes", (int)stats.copied, (int)stats.projected, copied);
  PetscCall(TransferGetStats(alone, &stats));
  CHECK(stats.migrated == whole[0]->nglobal - copied, "%d old elements migrate", (int)stats.migrated);
  CHECK(least <= copied && copied <= most, "%d elements in both meshes", copied);
  PetscCall(Clean(mesh, u, &transfer));
  PetscCall(Clean(whole, v, &alone));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const Shaken random[2] = {{17, 1, 1.0, {0}}, {23, 2, 1.0, {0}}};
  const Shaken part[2] = {{20, 3, 0.3, {0}}, {20, 4, 0.3, {0}}};
  const Shaken few[2] = {{1, 1, 1.0, {0}}, {2, 2, 1.0, {0}}};
  const Shaken thin[2] = {{16, 1, 1.0, {3.0, 0.0}}, {18, 2, 1.0, {0.0, 3.0}}}; /* 1 : 300, crossing */
  const double graded[3][3] = {{0.3, 0.4, 0.008}, {0.34, 0.43, 0.016}, {0.6, 0.7, 0.009}};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Check(MakeShaken, &random[0], &random[1], 0, 0));
  PetscCall(Check(MakeShaken, &random[1], &random[0], 0, 0));
  PetscCall(Check(MakeShaken, &part[0], &part[1], 400, 700));
  PetscCall(Check(MakeShaken, &part[0], &part[0], 800, 800));
  PetscCall(Check(MakeShaken, &few[0], &few[1], 0, 0)); /* some ranks have nothing */
  PetscCall(Check(MakeShaken, &few[1], &random[0], 0, 0));
  PetscCall(Check(MakeShaken, &thin[0], &thin[1], 0, 0));
  PetscCall(Check(MakeGraded, graded[0], graded[1], 50, 2000));
  PetscCall(Check(MakeGraded, graded[1], graded[2], 0, 0));
  return PetscFinalize();
}
