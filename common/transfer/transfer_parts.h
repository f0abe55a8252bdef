/* What a transfer knows, for those who intersect old and new elements themselves, because their data are not
 * P1 or P2 functions:
 *
 *     an unchanged new element      the data of the same old element: `copies`
 *     a changed one                 old elements that may touch it: `parts`, with their data, to clip */
#ifndef CORACLE_TRANSFER_PARTS_H
#define CORACLE_TRANSFER_PARTS_H
#include "common/supermesh/search.h"
#include "common/transfer/transfer.h"

/* Borrowed from the transfer. */
typedef struct {
  int ncopies, nparts, nchanged;
  const double (*part)[3][2];    /* [nparts] old elements, vertices in the order of the old mesh, m */
  Search search;                 /* of the parts */
  const int *changed;            /* [nchanged] elements of the new mesh */
  const double (*element)[3][2]; /* [nchanged] m */
} TransferParts;

/* Not collective. */
PetscErrorCode TransferGetParts(Transfer transfer, TransferParts *parts);
/* Collective.  source[from->ne][bytes] -> copies[ncopies][bytes], parts[nparts][bytes]. */
PetscErrorCode TransferSendParts(Transfer transfer, size_t bytes, const void *source, void *copies,
                                 void *parts);
/* Not collective.  The element of the new mesh that copy k is. */
int TransferCopyTarget(Transfer transfer, int k);
#endif
