#include "common/transfer/transfer_parts.h"
#include "common/transfer/transfer_impl.h"

PetscErrorCode TransferGetParts(Transfer t, TransferParts *parts)
{
  PetscFunctionBeginUser;
  *parts = (TransferParts){.ncopies = t->ncopies,
                           .nparts = t->nmoved,
                           .nchanged = t->changed.n,
                           .part = (const double(*)[3][2])t->moved,
                           .search = t->search,
                           .changed = t->changed.element,
                           .element = (const double(*)[3][2])t->changed.x};
  PetscFunctionReturn(0);
}

PetscErrorCode TransferSendParts(Transfer t, size_t bytes, const void *source, void *copies, void *parts)
{
  PetscFunctionBeginUser;
  PetscCall(ScatterForward(t->copy_scatter, bytes, source, copies));
  PetscCall(ScatterForward(t->moved_scatter, bytes, source, parts));
  PetscFunctionReturn(0);
}

int TransferCopyTarget(Transfer t, int k)
{
  return t->copy[k].target;
}
