/* Copies of one thing on several ranks: sums and other reductions over them, so that all copies get the same
 * bits. A thing is known by a key; a node on the border between ranks has a copy on each, a rank may also
 * hold several.
 *
 *     rank 0    a --- b          b and c have two copies each.  Every rank sends its value to the others
 *                     |          that hold the thing, and each of them reduces all values itself:
 *     rank 1          b --- d
 *                     c          b <- ((0 + b of rank 0) + b of rank 1) on both ranks
 *     rank 2          c --- e
 *
 * Values are taken in the order of the ranks, copies on one rank in the order of their items. */
#ifndef CORACLE_COPIES_H
#define CORACLE_COPIES_H
#include "common/exchange/scatter.h"

typedef struct Copies_s *Copies;

/* A thing: a vertex by its number (v, v), an edge by those of its ends. */
typedef struct {
  long long a, b;
} CopiesKey;

/* Collective: item i of n on this rank is a copy of key[i].  Copies find each other where a hash of the key
 * says. */
PetscErrorCode CopiesCreate(MPI_Comm comm, int n, const CopiesKey key[], Copies *copies);
/* The same with the key (number[i], number[i]). */
PetscErrorCode CopiesCreateByNumber(MPI_Comm comm, int n, const long long number[], Copies *copies);
/* An item of this rank has a copy on another; number: of the thing, on all ranks the same. */
typedef struct {
  int rank, item;
  long long number;
} CopiesMatch;

/* Not collective: who holds what of nitems is known.  match[*n], in any order and also repeated, becomes sorted, each once.  One copy of a
 * thing a rank. */
PetscErrorCode CopiesCreateMatched(MPI_Comm comm, int nitems, int *n, CopiesMatch match[], Copies *copies);
PetscErrorCode CopiesDestroy(Copies *copies);

/* Not collective: the lowest rank that has a copy of item i. */
int CopiesOwner(Copies copies, int item);
/* Not collective: whether item i is the first one of its owner's copies; of one thing a single copy is, whether or not a rank has several. */
PetscBool CopiesIsFirst(Copies copies, int item);

/* Collective over ranks that hold copies of the same thing.  value[n][ncomp] becomes the sum, or the least,
 * over all copies.  Items of a single copy stay as they are. */
PetscErrorCode CopiesSum(Copies copies, int ncomp, double value[]);
PetscErrorCode CopiesMin(Copies copies, int ncomp, double value[]);
/* The same for value[n] of so many bytes: fold(into, next) for the second copy and those after it. */
typedef void (*CopiesFold)(void *into, const void *next);
PetscErrorCode CopiesReduce(Copies copies, size_t bytes, CopiesFold fold, void *value);
#endif
