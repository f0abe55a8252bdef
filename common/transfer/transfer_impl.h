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

/* A P2 node of the new mesh in a piece. */
typedef struct {
  int node, piece;
  double n[3]; /* barycentric */
} TransferNode;

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
  Scatter copy_route; /* elements of `from` -> copies */
  int ncopies;
  TransferCopy *copy; /* [ncopies] in order of arrival */
  /* changed elements */
  TransferElements changed; /* of `to` */
  Scatter piece_route;      /* elements of `from` -> pieces */
  int npieces;
  double (*piece)[3][2]; /* [npieces] */
  Search search;         /* of the pieces */
  Projection projection; /* pieces -> changed */
  /* P2 nodes of changed elements that this rank owns, and those of its elements that it does not own */
  int nnodes;
  TransferNode *node;
  Scatter ask_route; /* P2 nodes of `to` that others own -> their owners */
  int *asked;        /* [arriving] owned nodes */
};

/* Unchanged elements: copy_route and copy; the changed ones of both meshes are left. */
PetscErrorCode TransferMatch(Transfer transfer, TransferElements *old);
/* Sends changed old elements where changed new ones may touch them: piece_route, piece and search. */
PetscErrorCode TransferTravel(Transfer transfer, const TransferElements *old);
/* Where the P2 nodes lie and who owns them. */
PetscErrorCode TransferNodesCreate(Transfer transfer);

PetscErrorCode TransferElementsOf(const Mesh *mesh, TransferElements *elements);
PetscErrorCode TransferElementsDestroy(TransferElements *elements);
#endif
