/* Records that go to the ranks which need them, and answers to questions. */
#ifndef SOLID_SPARSE_EXCHANGE_H
#define SOLID_SPARSE_EXCHANGE_H
#include <petscsys.h>

/* Collective: record k of n, `bytes` long each, goes to rank to[k].  *in, allocated: the *nin that have come,
 * by rank of the sender and then in its order. */
PetscErrorCode SparseExchange(MPI_Comm comm, int n, const int to[], size_t bytes, const void *record,
                              int *nin, void **in);
/* Fills the record of a key that this rank has. */
typedef PetscErrorCode (*SparseExchangeAnswer)(void *context, long long key, void *record);
/* Collective: record[n], `bytes` long each, is what rank of[k] answers to key[k]. */
PetscErrorCode SparseExchangeRequest(MPI_Comm comm, int n, const int of[], const long long key[],
                                     size_t bytes, SparseExchangeAnswer answer, void *context, void *record);
#endif
