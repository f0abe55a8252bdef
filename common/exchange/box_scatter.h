/* The scatter of things to the ranks whose bounds their boxes touch. */
#ifndef CORACLE_BOX_SCATTER_H
#define CORACLE_BOX_SCATTER_H
#include "common/exchange/scatter.h"
#include "common/supermesh/geometry.h"

/* Collective.  box[n] of this rank's things, bounds[size] of all ranks, m; row k of the scatter is thing k.  *scatter is replaced. */
PetscErrorCode BoxScatterCreate(MPI_Comm comm, int n, const GeometryBox box[], const GeometryBox bounds[],
                                Scatter *scatter);
/* Collective: the records of all ranks whose boxes touch this rank's bounds, once, in the order of the ranks.  box[n] of this
 * rank's; *arrived[*narrived], to be PetscFree'd. */
PetscErrorCode BoxScatterRecords(MPI_Comm comm, int n, const GeometryBox box[], const GeometryBox *bounds,
                                 size_t bytes, const void *record, int *narrived, void **arrived);
#endif
