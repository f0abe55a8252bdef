/* Private to the transfer room. */
#ifndef CORACLE_TRANSFER_IMPL_H
#define CORACLE_TRANSFER_IMPL_H
#include "common/exchange/scatter.h"
#include "common/supermesh/projection.h"
#include "common/transfer/transfer.h"

/* An unchanged element, where it has arrived: vertex i of new element `target` is vertex (i + turn) % 3 of
 * the arriving one. */
typedef struct {
  int target, turn;
} TransferCopy;

/* The triangles of a mesh. */
typedef struct {
  int n;
  int *element;      /* [n] of the mesh */
  double (*x)[3][2]; /* [n] m */
} TransferElements;

struct Transfer_s {
  MPI_Comm comm;
  const Mesh *from, *to;
  /* unchanged elements */
  Scatter copy_scatter; /* elements of `from` -> copies */
  int ncopies;
  TransferCopy *copy; /* [ncopies] in order of arrival */
  /* changed elements */
  TransferElements changed; /* of `to` */
  Scatter moved_scatter;    /* elements of `from` -> migrated elements */
  int nmoved;
  double (*moved)[3][2]; /* [nmoved] */
  Search search;         /* of the migrated elements */
  Projection projection; /* migrated elements -> changed */
};

/* Unchanged elements: copy_scatter and copy; the changed ones of both meshes are left. */
PetscErrorCode TransferMatch(Transfer transfer, TransferElements *old);
/* Sends changed old elements where changed new ones may touch them: moved_scatter, moved and search. */
PetscErrorCode TransferMigrate(Transfer transfer, const TransferElements *old);

PetscErrorCode TransferElementsOf(const Mesh *mesh, TransferElements *elements);
PetscErrorCode TransferElementsDestroy(TransferElements *elements);
#endif
