// ranks: 1 2 3 5
/* Scatters bring rows where they belong and back; reductions over copies are those of a plain sum in the
 * order of the ranks, with the same bits on all ranks. */
#include "common/exchange/box_scatter.h"
#include "common/exchange/copies.h"
#include "tests/check.h"
#include <math.h>
#include <stdlib.h>

enum { ROWS = 50, ITEMS = 200, THINGS = 40, COPIES = 30, MANY = 40000 };

static PetscMPIInt rank, size;

/* The same on all ranks, whatever was asked before. */
static int Hash(int a, int b, int c)
{
  unsigned h =
      (unsigned)a * 2654435761u ^ ((unsigned)b + 77u) * 2246822519u ^ ((unsigned)c + 5u) * 3266489917u;
  h = (h ^ h >> 15) * 2654435761u;
  return (int)((h ^ h >> 13) & 0x7fffffff);
}

static int To(int of, int item)
{
  return Hash(of, item, 1) % size;
}

static int Row(int of, int item)
{
  return Hash(of, item, 2) % ROWS;
}

static double Value(int of, int row)
{
  return 1.0 + 1e-3 * Hash(of, row, 3);
}

static PetscErrorCode Make(Scatter *e)
{
  int to[ITEMS], row[ITEMS];
  PetscFunctionBeginUser;
  for (int k = 0; k < ITEMS; k++) {
    to[k] = To(rank, k);
    row[k] = Row(rank, k);
  }
  PetscCall(ScatterCreate(PETSC_COMM_WORLD, rank % 2 ? ITEMS : ITEMS / 2, to, row, e));
  PetscFunctionReturn(0);
}

/* What arrives is what the items say, in their order; kept[]: but those that were dropped. */
static void CheckArrivals(Scatter e, const double arrived[], int (*kept)(int from, int item))
{
  int n = 0;
  for (int r = 0; r < size; r++) {
    for (int k = 0; k < (r % 2 ? ITEMS : ITEMS / 2); k++) {
      if (To(r, k) != rank || !kept(r, k)) continue;
      CHECK(n < ScatterArriving(e) && arrived[n] == Value(r, Row(r, k)), "arrival %d: %.17g", n, arrived[n]);
      n++;
    }
  }
  CHECK(n == ScatterArriving(e), "%d arrivals, not %d", ScatterArriving(e), n);
}

static int All(int from, int item)
{
  return 1;
}

static int Third(int from, int item)
{
  return Hash(from, item, 4) % 3 == 0;
}

/* Every arrival is doubled and added where it came from, item by item in the order of the ranks. */
static void CheckReverse(Scatter e, double arrived[], int (*kept)(int from, int item))
{
  double back[ROWS] = {0.0}, expected[ROWS] = {0.0}, copy[ROWS];
  for (int k = 0; k < ScatterArriving(e); k++) arrived[k] *= 2.0;
  CHECK(!ScatterReverseAdd(e, 1, arrived, back), "not added");
  for (int r = 0; r < size; r++)
    for (int k = 0; k < (rank % 2 ? ITEMS : ITEMS / 2); k++)
      if (To(rank, k) == r && kept(rank, k)) expected[Row(rank, k)] += 2.0 * Value(rank, Row(rank, k));
  for (int i = 0; i < ROWS; i++) copy[i] = -1.0;
  CHECK(!ScatterReverse(e, sizeof *copy, arrived, copy), "not returned");
  for (int i = 0; i < ROWS; i++) {
    CHECK(back[i] == expected[i], "row %d: %.17g, not %.17g", i, back[i], expected[i]);
    CHECK(copy[i] == (expected[i] > 0.0 ? 2.0 * Value(rank, i) : -1.0), "row %d: %.17g", i, copy[i]);
  }
}

static void CheckScatter(void)
{
  Scatter e;
  double local[ROWS], *arrived;
  char *keep;
  int n = 0;
  for (int i = 0; i < ROWS; i++) local[i] = Value(rank, i);
  CHECK(!Make(&e), "not made");
  arrived = malloc((size_t)ScatterArriving(e) * sizeof *arrived + 1);
  keep = malloc((size_t)ScatterArriving(e) + 1);
  CHECK(!ScatterForward(e, sizeof *local, local, arrived), "not sent");
  CheckArrivals(e, arrived, All);
  CheckReverse(e, arrived, All);
  for (int r = 0; r < size; r++)
    for (int k = 0; k < (r % 2 ? ITEMS : ITEMS / 2); k++)
      if (To(r, k) == rank) keep[n++] = (char)Third(r, k);
  CHECK(!ScatterKeep(e, keep), "not reduced");
  CHECK(!ScatterForward(e, sizeof *local, local, arrived), "not sent");
  CheckArrivals(e, arrived, Third);
  CheckReverse(e, arrived, Third);
  CHECK(!ScatterDestroy(&e) && !e, "not destroyed");
  free(arrived);
  free(keep);
}

static PetscErrorCode Answer(void *context, long long key, void *record)
{
  double *two = record;
  two[0] = (double)(key * key);
  two[1] = *(const PetscMPIInt *)context;
  return 0;
}

static void CheckRequest(void)
{
  int of[ITEMS], n, *in;
  long long key[ITEMS];
  double record[ITEMS][2];
  void *arrived;
  for (int k = 0; k < ITEMS; k++) {
    of[k] = To(rank, k);
    key[k] = k;
  }
  CHECK(!ScatterRequest(PETSC_COMM_WORLD, ITEMS, of, key, sizeof *record, Answer, &rank, record),
        "not asked");
  for (int k = 0; k < ITEMS; k++)
    CHECK(record[k][0] == k * k && record[k][1] == of[k], "answer %d is wrong", k);
  CHECK(!ScatterRecords(PETSC_COMM_WORLD, rank == 0 ? size : 0, (int[]){0, 1, 2, 3, 4}, sizeof(int),
                        (int[]){10, 11, 12, 13, 14}, &n, &arrived),
        "not sent");
  in = arrived;
  CHECK(n == 1 && in[0] == 10 + rank, "%d records, the first is %d", n, in[0]);
  CHECK(!PetscFree(arrived), "not freed");
}

/* Rank r has r records; all ranks get all of them in the order of the ranks. */
static void CheckGather(void)
{
  int mine[5][2], total, n = 0;
  void *all;
  for (int k = 0; k < rank; k++) mine[k][0] = rank, mine[k][1] = k;
  CHECK(!GatherRecords(PETSC_COMM_WORLD, rank, sizeof *mine, mine, &total, &all), "not gathered");
  CHECK(total == size * (size - 1) / 2, "%d records", total);
  const int(*record)[2] = all;
  for (int r = 0; r < size; r++)
    for (int k = 0; k < r; k++, n++)
      CHECK(record[n][0] == r && record[n][1] == k, "record %d: %d of rank %d", n, record[n][1],
            record[n][0]);
  CHECK(!PetscFree(all), "not freed");
}

/* Item k of rank r is a point at x = k; a rank sees those from its own number on up to one more. */
static void CheckBoxes(void)
{
  const GeometryBox bounds = {{rank, 0.0}, {rank + 1.0, 0.0}};
  GeometryBox box[6];
  int mine[6][2], n;
  void *arrived;
  for (int k = 0; k <= size; k++) {
    box[k] = (GeometryBox){{k, 0.0}, {k, 0.0}};
    mine[k][0] = rank, mine[k][1] = k;
  }
  CHECK(!BoxScatterRecords(PETSC_COMM_WORLD, size + 1, box, &bounds, sizeof *mine, mine, &n, &arrived),
        "not sent");
  const int(*record)[2] = arrived;
  CHECK(n == 2 * size, "%d records", n);
  for (int k = 0; k < n; k++)
    CHECK(record[k][0] == k / 2 && record[k][1] == rank + k % 2, "record %d: %d of rank %d", k, record[k][1],
          record[k][0]);
  CHECK(!PetscFree(arrived), "not freed");
}

/* Thing of copy k on a rank: a rank may have several copies of one, an even number is an edge. */
static int Thing(int of, int k)
{
  return Hash(of, k, 6) % THINGS;
}

static void Add(void *into, const void *next)
{
  *(double *)into += *(const double *)next;
}

static void CheckCopies(void)
{
  CopiesKey key[COPIES];
  Copies c;
  double sum[COPIES][2], folded[COPIES], least[COPIES];
  for (int k = 0; k < COPIES; k++) {
    const int t = Thing(rank, k);
    key[k] = t % 2 ? (CopiesKey){t, t} : (CopiesKey){t - 1000, (long long)t << 40};
    sum[k][0] = folded[k] = least[k] = 1.0 / Value(rank, k);
    sum[k][1] = 1.0;
  }
  CHECK(!CopiesCreate(PETSC_COMM_WORLD, COPIES, key, &c), "not made");
  CHECK(!CopiesSum(c, 2, &sum[0][0]) && !CopiesReduce(c, sizeof *folded, Add, folded) &&
            !CopiesMin(c, 1, least),
        "not reduced");
  for (int k = 0; k < COPIES; k++) {
    double expected = 0.0, smallest = INFINITY;
    int count = 0, owner = -1, first = -1;
    for (int r = 0; r < size; r++) {
      for (int j = 0; j < COPIES; j++) {
        if (Thing(r, j) != Thing(rank, k)) continue;
        expected += 1.0 / Value(r, j);
        smallest = fmin(smallest, 1.0 / Value(r, j));
        count++;
        if (owner < 0) owner = r, first = j;
      }
    }
    CHECK(sum[k][0] == expected && sum[k][1] == count, "copy %d: %.17g, not %.17g", k, sum[k][0], expected);
    CHECK(folded[k] == expected && least[k] == smallest && CopiesOwner(c, k) == owner, "copy %d is wrong", k);
    CHECK(CopiesIsFirst(c, k) == (owner == rank && first == k), "copy %d is first, or not", k);
  }
  CHECK(!CopiesDestroy(&c) && !c, "not destroyed");
}

/* A thing with very many copies on each rank (the nodes of one body) takes records in proportion to them, not to their square. */
static void CheckMany(void)
{
  const double all = 0.5 * MANY * size * (size + 1);
  long long *number = malloc(MANY * sizeof *number);
  double *value = malloc(MANY * sizeof *value);
  Copies c;
  for (int k = 0; k < MANY; k++) {
    number[k] = 7;
    value[k] = 1.0 + rank;
  }
  CHECK(!CopiesCreateByNumber(PETSC_COMM_WORLD, MANY, number, &c), "not made");
  CHECK(!CopiesSum(c, 1, value), "not summed");
  for (int k = 0; k < MANY; k++) {
    CHECK(value[k] == all, "copy %d: %.17g, not %.17g", k, value[k], all);
    CHECK(CopiesOwner(c, k) == 0 && CopiesIsFirst(c, k) == (rank == 0 && k == 0), "copy %d is wrong", k);
  }
  CHECK(!CopiesDestroy(&c), "not destroyed");
  free(number);
  free(value);
}

/* A ring: item 0 is shared with the rank below, item 2 with the one above, item 1 with all and said twice, item 3 with none. */
static void CheckMatched(void)
{
  int n = 0;
  CopiesMatch match[16];
  double value[4] = {1.0 + rank, 0.1 * (rank + 1), 2.0 + rank, 7.0}, all = 0.0;
  Copies c;
  for (int r = 0; r < size; r++) {
    all += 0.1 * (r + 1);
    if (r == rank) continue;
    match[n++] = (CopiesMatch){r, 1, 9};
    if (r == rank - 1) match[n++] = (CopiesMatch){r, 0, rank};
    if (r == rank + 1) match[n++] = (CopiesMatch){r, 2, r};
    match[n++] = (CopiesMatch){r, 1, 9};
  }
  CHECK(!CopiesCreateMatched(PETSC_COMM_WORLD, 4, &n, match, &c), "not made");
  CHECK(n == size - 1 + (rank > 0) + (rank < size - 1), "%d matches", n);
  CHECK(!CopiesSum(c, 1, value), "not summed");
  CHECK(value[0] == (rank > 0 ? 2.0 * (1.0 + rank) : 1.0), "below: %g", value[0]);
  CHECK(value[2] == (rank < size - 1 ? 2.0 * (2.0 + rank) : 2.0 + rank), "above: %g", value[2]);
  CHECK(size == 1 || value[1] == all, "all: %.17g, not %.17g", value[1], all);
  CHECK(value[3] == 7.0 && CopiesOwner(c, 3) == rank && CopiesOwner(c, 1) == 0, "alone");
  CHECK(CopiesIsFirst(c, 3) && CopiesIsFirst(c, 1) == (rank == 0), "first");
  CHECK(!CopiesDestroy(&c), "not destroyed");
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  CheckScatter();
  CheckRequest();
  CheckGather();
  CheckBoxes();
  CheckCopies();
  CheckMany();
  CheckMatched();
  return PetscFinalize();
}
