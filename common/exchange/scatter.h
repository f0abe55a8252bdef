/* A scatter, that is a sparse exchange: rows of a local array copied to other ranks, and values brought back
 * the same way, summed or not.  Which rank talks to which is known from the items alone; ranks without items
 * in common exchange no message.
 *
 *      rank 0: local[nrows]            rank 1: arrived[4]
 *        row 0 ---- item 0 ----------->  [0] from rank 0
 *        row 2 ---- item 1 ----------->  [1] from rank 0
 *        row 2 ---- item 2 --> rank 2    [2] from rank 1
 *                     self ----------->  [3] from rank 2
 *
 * Arrivals lie in the order of the ranks that they come from, those of one rank in the order of its items.  A
 * row may be in several items; a rank may send to itself (copied, no message).
 *
 *      ScatterForward      arrived[k] = local[row]
 *      ScatterReverse      local[row] = arrived[k]
 *      ScatterReverseAdd   local[row] += arrived[k], item by item in the order of the ranks
 *
 * All sums are taken in the order of the ranks and of the items, so that results repeat their bits on as many
 * ranks.  (PetscSFReduce adds what is local first; ranks that share a node would then differ by round-off.)
 * Buffers are kept from one call to the next.  copies.h stands on this for things that several ranks hold. */
#ifndef CORACLE_SCATTER_H
#define CORACLE_SCATTER_H
#include <petscsys.h>

typedef struct Scatter_s *Scatter;

/* Items by rank: those of rank[j] are start[j] .. start[j + 1] - 1. */
typedef struct {
  int n;      /* ranks with items */
  int *rank;  /* [n] ascending */
  int *start; /* [n + 1] */
} ScatterRanks;

/* Collective over comm, which is borrowed.  Item k of n is row[k] (NULL: row k) and goes to rank to[k]. */
PetscErrorCode ScatterCreate(MPI_Comm comm, int n, const int to[], const int row[], Scatter *scatter);
/* Not collective: the ranks know already what comes.  nout items of row[] go to to[], nin come from from[];
 * `to` and `from` ascend, and both ends list the items between them in the same order. */
PetscErrorCode ScatterCreateMatched(MPI_Comm comm, int nout, const int to[], const int row[], int nin,
                                    const int from[], Scatter *scatter);
PetscErrorCode ScatterDestroy(Scatter *scatter);

/* Not collective: the number of arrivals; where they come from; the items that leave, in the order of the
 * ranks they go to, and the row of each, row[].  Borrowed until the scatter is destroyed or changed. */
int ScatterArriving(Scatter scatter);
PetscErrorCode ScatterGetSources(Scatter scatter, const ScatterRanks **sources);
PetscErrorCode ScatterGetLeaving(Scatter scatter, const ScatterRanks **targets, const int **row);

/* Collective over ranks with items in common.  Rows and arrivals are records of so many bytes. */
PetscErrorCode ScatterForward(Scatter scatter, size_t bytes, const void *local, void *arrived);
PetscErrorCode ScatterReverse(Scatter scatter, size_t bytes, const void *arrived, void *local);
/* local[][ncomp] += arrived[][ncomp] */
PetscErrorCode ScatterReverseAdd(Scatter scatter, int ncomp, const double arrived[], double local[]);
/* Collective over ranks with items in common: drops the arrivals with keep[k] = 0 on both ends. */
PetscErrorCode ScatterKeep(Scatter scatter, const char keep[]);

/* Collective: record k of n goes to rank to[k], once.  *arrived[*narrived], to be PetscFree'd, as above. */
PetscErrorCode ScatterRecords(MPI_Comm comm, int n, const int to[], size_t bytes, const void *record,
                              int *narrived, void **arrived);
/* Collective: the records of all ranks on every rank, in the order of the ranks.  *all[*total], to be PetscFree'd. */
PetscErrorCode GatherRecords(MPI_Comm comm, int n, size_t bytes, const void *record, int *total, void **all);
/* Fills the record of a key that this rank has. */
typedef PetscErrorCode (*ScatterAnswer)(void *context, long long key, void *record);
/* Collective: record[n] of so many bytes is what rank of[k] answers to key[k]. */
PetscErrorCode ScatterRequest(MPI_Comm comm, int n, const int of[], const long long key[], size_t bytes,
                              ScatterAnswer answer, void *context, void *record);

/* Collective: the same error on all ranks, what failed here or, if nothing did, elsewhere. */
PetscErrorCode CollectiveError(MPI_Comm comm, PetscErrorCode here);
#endif
