/* Private to scatter.c and scatter_create.c. */
#ifndef CORACLE_SCATTER_IMPL_H
#define CORACLE_SCATTER_IMPL_H
#include "common/exchange/scatter.h"

struct Scatter_s {
  MPI_Comm comm; /* borrowed */
  PetscMPIInt me;
  int nout, nin;
  ScatterRanks out, in;
  int *row;         /* [nout] in the order of the ranks that the items go to */
  PetscBool packed; /* row[k] = k: items leave from the caller's array */
  char *buffer;     /* of items that leave or have come back */
  size_t capacity;
  MPI_Request *request; /* [out.n + in.n] */
  MPI_Datatype record;  /* of record_bytes */
  size_t record_bytes;
};

/* Not collective: whether items leave from the caller's array, once `row` is made. */
void ScatterFindPacked(Scatter e);
#endif
