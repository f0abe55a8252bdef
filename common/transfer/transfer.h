/* Fields from one distributed mesh to another of the same domain, after adaptation: two meshes, two
 * partitions, one communicator.
 *
 *     old elements                                             new elements
 *       unchanged  ----------- copies ----------------------> copied bit for bit
 *       changed    ----------- migrated --> elements --clip----> projected / interpolated
 *
 * Unchanged is an element that has the same three vertices, bit for bit, in both meshes, whatever the ranks.
 * Changed old elements migrate to every rank with changed new ones that they may touch; as both sets cover
 * the same part of the domain, the supermesh of the rest needs no unchanged element.
 *
 * All functions are collective over the meshes' communicator. */
#ifndef CORACLE_TRANSFER_H
#define CORACLE_TRANSFER_H
#include "common/mesh/mesh.h"
#include "common/space/p2_space.h"

typedef struct Transfer_s *Transfer;

typedef struct {
  PetscInt copied, projected; /* elements of the new mesh on all ranks */
  PetscInt pairs;             /* of changed elements that share an area, on all ranks */
  PetscInt migrated;          /* old elements sent, one for each rank it went to */
} TransferStats;

/* Both meshes are borrowed until TransferDestroy.  PETSC_ERR_ARG_INCOMP when their areas differ by more than
 * 1e-10 of the whole: they do not cover the same domain. */
PetscErrorCode TransferCreate(const Mesh *from, const Mesh *to, Transfer *transfer);
/* source[from->ne][ncomp][3] -> target[to->ne][ncomp][3]: Galerkin projection (projection.h).  Integrals and
 * the first moments of every new element are kept to round-off, P1 fields are reproduced to round-off, int
 * q^2 never grows. */
PetscErrorCode TransferP1DG(Transfer transfer, int ncomp, const double source[], double target[]);
/* source[from->n] -> target[to->n] of the spaces on the two meshes: the continuous P2 field at the new P2 nodes,
 * from the old element with the largest smallest barycentric coordinate there.  Reproduces P2 fields to round-off; all ranks get
 * the same bits for a node that they share.  Not conservative: p is defined by the equations anyway. */
PetscErrorCode TransferP2(Transfer transfer, const P2Space *from, const P2Space *to, const double source[],
                          double target[]);
PetscErrorCode TransferGetStats(Transfer transfer, TransferStats *stats);
PetscErrorCode TransferDestroy(Transfer *transfer);
#endif
