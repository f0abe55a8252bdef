// ranks: 1 2 3 5
/* Parts: triangles and what their vertices carry survive any journey, ranks without triangles included; the
 * Mesh built at the end is a good one; weights keep cuts away; what does not conform across ranks is refused.
 */
#include "common/mesh/part_partition.h"
#include "tests/mesh/distributed.h"
#include "tests/mesh/touching.h"

static const BoxCase BOX = {{1.0, 2.0}, 0.2, {0.04, {0.3, 0.3}, {0.4, 1.0}, 0.3}};
static int rank, size;

/* Rank 0 has the box, the others nothing; gids are scattered and larger than an int. */
static int WholePart(MeshPart *part)
{
  Strip strip = BOX.strip;
  memset(part, 0, sizeof *part);
  if (rank == 0) CHECK(!MeshBox(LOWER, BOX.upper, BOX.size_max, StripSize, &strip, &part->serial), "no box");
  int nv = part->serial.nv;
  CHECK(!PetscMalloc1(nv, &part->gid), "no memory");
  for (int v = 0; v < nv; v++) part->gid[v] = 7000000000LL + 3LL * (nv - v);
  MPI_Bcast(&nv, 1, MPI_INT, 0, PETSC_COMM_WORLD);
  return nv;
}

/* Two numbers that only this vertex has. */
static void Carried(const double x[2], long long gid, double data[2])
{
  data[0] = x[0] + 1e3 * x[1];
  data[1] = (double)gid;
}

/* Sums over all triangles and facets that do not depend on where these are, but on everything that they are.
 */
static void Fingerprint(const MeshPart *p, unsigned long long sum[3])
{
  const MeshSerial *s = &p->serial;
  memset(sum, 0, 3 * sizeof *sum);
  for (int e = 0; e < s->ne; e++) {
    unsigned long long h = 1, first = 0;
    for (int i = 1; i < 3; i++) {
      if (p->gid[s->vertex[3 * e + i]] < p->gid[s->vertex[3 * e + (int)first]]) first = (unsigned long long)i;
    }
    for (int i = 0; i < 3; i++) { /* from the smallest on, so that only a turn counts */
      const int v = s->vertex[3 * e + ((int)first + i) % 3];
      unsigned long long x[2];
      memcpy(x, &s->x[2 * v], sizeof x);
      h = (h * 1000003ULL + (unsigned long long)p->gid[v]) * 1000003ULL + x[0] + 31 * x[1];
    }
    sum[0] += h * h;
  }
  for (int k = 0; k < s->nb; k++) {
    const unsigned long long a = (unsigned long long)p->gid[s->facet[2 * k]];
    const unsigned long long b = (unsigned long long)p->gid[s->facet[2 * k + 1]];
    const unsigned long long h =
        (a * b + a + b) * 1000003ULL + (unsigned long long)s->tag_name[s->facet_tag[k]][0];
    sum[1] += h * h;
  }
  sum[2] = (unsigned long long)s->ne;
  MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_UNSIGNED_LONG_LONG, MPI_SUM, PETSC_COMM_WORLD);
}

/* Where triangle k goes on journey `way`: anywhere, blocks with empty ranks between, all to the last rank. */
static int Destination(int way, int k, unsigned *seed)
{
  *seed = *seed * 1664525u + 1013904223u;
  if (way == 0) return (int)(*seed >> 16) % size;
  if (way == 1) return 2 * (k / 50 % ((size + 1) / 2));
  return way == 2 ? size - 1 : (int)(*seed >> 16) % PetscMax(1, size - 1);
}

static void Journey(int way, MeshPart *part)
{
  MeshPart moved;
  double *data = malloc((2 * (size_t)part->serial.nv + 1) * sizeof *data), *arrived, expected[2];
  int *target = malloc(((size_t)part->serial.ne + 1) * sizeof *target);
  unsigned seed = (unsigned)(1 + rank + 100 * way);
  for (int v = 0; v < part->serial.nv; v++) Carried(&part->serial.x[2 * v], part->gid[v], &data[2 * v]);
  for (int e = 0; e < part->serial.ne; e++) target[e] = Destination(way, e, &seed);
  CHECK(!MeshPartMigrate(PETSC_COMM_WORLD, part, target, 2, data, &moved, &arrived), "not moved");
  for (int v = 0; v < moved.serial.nv; v++) {
    Carried(&moved.serial.x[2 * v], moved.gid[v], expected);
    CHECK(!memcmp(expected, &arrived[2 * v], sizeof expected), "vertex %d carries what is not its own", v);
    for (int w = 0; w < v && v < 300; w++)
      CHECK(moved.gid[v] != moved.gid[w], "vertices %d, %d are one", v, w);
  }
  CHECK(way != 2 || (moved.serial.ne > 0) == (rank == size - 1), "%d triangles", moved.serial.ne);
  CHECK(way != 1 || rank % 2 == 0 || moved.serial.ne == 0, "%d triangles", moved.serial.ne);
  free(data);
  free(target);
  CHECK(!PetscFree(arrived) && !MeshPartDestroy(part), "not freed");
  *part = moved;
}

/* The Mesh of a part, and the part of that Mesh, have the same triangles, and shared faces are those to
 * ghosts. */
static void CheckBuilt(const MeshPart *part, int vertices)
{
  Mesh *mesh;
  MeshPart own;
  CHECK(!MeshBuild(PETSC_COMM_WORLD, part, &mesh), "not built");
  CHECK(mesh->ne == part->serial.ne, "%d triangles, not %d", mesh->ne, part->serial.ne);
  CheckDistributed(mesh, &BOX, vertices);
  CHECK(!MeshPartOf(mesh, &own), "no part");
  char *face = calloc(3 * (size_t)own.serial.ne + 1, 1), *vertex = calloc((size_t)own.serial.nv + 1, 1);
  CHECK(!MeshPartShared(PETSC_COMM_WORLD, &own, face, vertex), "what is shared is not known");
  for (int k = 0; k < 3 * mesh->ne; k++) {
    const int v = mesh->vertex[k];
    CHECK(own.serial.vertex[k] == v && !memcmp(&own.serial.x[2 * v], &mesh->x[2 * v], 2 * sizeof(double)),
          "the order changed");
    CHECK(face[k] == (mesh->neighbor[k] >= mesh->ne), "face %d", k);
    CHECK(!face[k] || (vertex[mesh->vertex[k - k % 3 + (k + 1) % 3]] &&
                       vertex[mesh->vertex[k - k % 3 + (k + 2) % 3]]),
          "ends of face %d", k);
    CHECK(mesh->vgid[v] >= mesh->vstart || vertex[v], "vertex %d is another rank's", v);
  }
  free(face);
  free(vertex);
  CHECK(!MeshPartDestroy(&own) && !MeshDestroy(&mesh), "not freed");
}

static void CheckJourneys(void)
{
  MeshPart part;
  unsigned long long before[3], after[3];
  const int vertices = WholePart(&part);
  Fingerprint(&part, before);
  for (int way = 0; way < 5; way++) {
    Journey(way % 4, &part);
    Fingerprint(&part, after);
    CHECK(!memcmp(before, after, sizeof before), "triangles or facets changed on journey %d", way);
    CheckBuilt(&part, vertices);
  }
  CHECK(!MeshPartDestroy(&part), "not freed");
}

static int InBand(const MeshSerial *s, int k)
{
  const double *a = &s->x[2 * s->vertex[k - k % 3 + (k + 1) % 3]];
  const double *b = &s->x[2 * s->vertex[k - k % 3 + (k + 2) % 3]];
  return fabs(a[1] - 0.65) < 0.05 || fabs(b[1] - 0.65) < 0.05;
}

/* To all ranks, in equal parts. */
static void Spread(MeshPart *part)
{
  MeshPart moved;
  int *target = malloc(((size_t)part->serial.ne + 1) * sizeof *target);
  CHECK(!MeshPartPartition(PETSC_COMM_WORLD, part, size, NULL, target), "not cut");
  CHECK(!MeshPartMigrate(PETSC_COMM_WORLD, part, target, 0, NULL, &moved, NULL), "not moved");
  CHECK(!MeshPartDestroy(part), "not freed");
  free(target);
  *part = moved;
}

/* How many faces that touch the band 0.6 < y < 0.7 are cut if they have this weight; parts are equal all
 * the same. */
static int CutInBand(int heavy, int clusters)
{
  MeshPart part, moved;
  WholePart(&part);
  if (clusters) Spread(&part);
  const MeshSerial *s = &part.serial, *m = &moved.serial;
  int *weight = malloc((3 * (size_t)s->ne + 1) * sizeof *weight);
  int *target = malloc(((size_t)s->ne + 1) * sizeof *target);
  for (int k = 0; k < 3 * s->ne; k++) weight[k] = InBand(s, k) ? heavy : 1;
  CHECK(!PartPartition(PETSC_COMM_WORLD, &part, size, weight, (PetscBool)clusters, target), "not cut");
  CHECK(!MeshPartMigrate(PETSC_COMM_WORLD, &part, target, 0, NULL, &moved, NULL), "not moved");
  char *face = calloc(3 * (size_t)m->ne + 1, 1), *vertex = calloc((size_t)m->nv + 1, 1);
  CHECK(!MeshPartShared(PETSC_COMM_WORLD, &moved, face, vertex), "what is shared is not known");
  int all[2] = {m->ne, 0};
  for (int k = 0; k < 3 * m->ne; k++) all[1] += face[k] && InBand(m, k);
  MPI_Allreduce(MPI_IN_PLACE, all, 2, MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
  CHECK((double)m->ne * size < (clusters ? 1.15 : 1.05) * all[0], "%d of %d triangles on one of %d ranks",
        m->ne, all[0], size);
  free(weight);
  free(target);
  free(face);
  free(vertex);
  CHECK(!MeshPartDestroy(&part) && !MeshPartDestroy(&moved), "not freed");
  return all[1] / 2;
}

/* Heavy faces are not cut, whether the graph is of triangles or, as it is of large meshes, of clusters of some ten. */
static void CheckWeights(void)
{
  for (int clusters = 0; clusters < 2; clusters++) {
    const int plain = CutInBand(1, clusters), heavy = CutInBand(1000, clusters);
    CHECK(size == 1 || heavy < plain, "%d heavy faces are cut, %d without their weight", heavy, plain);
    CHECK(size > 3 || heavy == 0, "%d heavy faces are cut", heavy);
  }
}

/* Triangles of given corners among (0, 0), (1, 0), (1, 1), (0, 1), (2, 2); on rank `where` mod size. */
typedef struct {
  int corner[3], where;
} Given;

static PetscErrorCode Build(int n, const Given given[], int named)
{
  static const double X[] = {0, 0, 1, 0, 1, 1, 0, 1, 2, 2};
  long long gid[] = {5, 1, 2, 9, 4};
  char name[1][64] = {"side"};
  int vertex[9], facet[18], tag[9] = {0}, ne = 0;
  double x[10];
  Mesh *mesh = NULL;
  memcpy(x, X, sizeof x);
  for (int k = 0; k < n; k++) {
    if (given[k].where % size != rank) continue;
    for (int i = 0; i < 3; i++) {
      vertex[3 * ne + i] = given[k].corner[i];
      facet[6 * ne + 2 * i] = given[k].corner[i];
      facet[6 * ne + 2 * i + 1] = given[k].corner[(i + 1) % 3];
    }
    ne++;
  }
  const MeshPart part = {{.nv = 5,
                          .ne = ne,
                          .nb = named ? 3 * ne : 0,
                          .x = x,
                          .vertex = vertex,
                          .facet = facet,
                          .facet_tag = tag,
                          .ntags = 1,
                          .tag_name = name},
                         gid};
  const PetscErrorCode failed = MeshBuild(PETSC_COMM_WORLD, &part, &mesh);
  if (!failed) CHECK(!MeshDestroy(&mesh), "not freed");
  return failed;
}

static void CheckRefused(void)
{
  const Given good[] = {{{0, 1, 2}, 0}, {{0, 2, 3}, 1}}, same_side[] = {{{0, 1, 2}, 0}, {{0, 1, 3}, 1}};
  const Given three[] = {{{0, 1, 2}, 0}, {{0, 2, 3}, 1}, {{0, 2, 4}, 2}};
  CHECK(!Build(2, good, 1), "two triangles are refused");
  PetscPushErrorHandler(PetscReturnErrorHandler, NULL);
  CHECK(Build(0, good, 1) == PETSC_ERR_ARG_WRONG, "no triangles are taken");
  CHECK(Build(2, good, 0) == PETSC_ERR_ARG_WRONG, "a boundary without a name is taken");
  CHECK(Build(2, same_side, 1) == PETSC_ERR_ARG_WRONG, "overlapping triangles are taken");
  CHECK(Build(3, three, 1) == PETSC_ERR_ARG_WRONG, "three triangles on an edge are taken");
  PetscPopErrorHandler();
}

/* The vertex in which two squares touch is one all the same. */
static void CheckTouching(void)
{
  Mesh *mesh = TouchingSquares(rank, size);
  CheckVertices(mesh, 7);
  CheckEdges(mesh);
  CHECK(!MeshDestroy(&mesh), "not freed");
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  CheckJourneys();
  CheckWeights();
  CheckRefused();
  CheckTouching();
  return PetscFinalize();
}
