#include "common/transfer/transfer_parts.h"
#include "transfer_impl.h"

PetscErrorCode TransferGetParts(Transfer t, TransferParts *parts)
{
  PetscFunctionBeginUser;
  *parts = (TransferParts){.ncopies = t->ncopies,
                           .nparts = t->npieces,
                           .nchanged = t->changed.n,
                           .part = (const double(*)[3][2])t->piece,
                           .search = t->search,
                           .changed = t->changed.element,
                           .element = (const double(*)[3][2])t->changed.x};
  PetscFunctionReturn(0);
}

PetscErrorCode TransferSendParts(Transfer t, size_t bytes, const void *source, void *copies, void *parts)
{
  PetscFunctionBeginUser;
  PetscCall(ScatterForward(t->copy_route, bytes, source, copies));
  PetscCall(ScatterForward(t->piece_route, bytes, source, parts));
  PetscFunctionReturn(0);
}

int TransferCopyTarget(Transfer t, int k)
{
  return t->copy[k].target;
}
