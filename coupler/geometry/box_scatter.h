/* The scatter of things to the ranks whose bounds their boxes touch. */
#ifndef CORACLE_COUPLER_BOX_SCATTER_H
#define CORACLE_COUPLER_BOX_SCATTER_H
#include "common/exchange/scatter.h"
#include "common/supermesh/geometry.h"

/* Collective.  box[n] of this rank's things, bounds[size] of all ranks, m; row k of the scatter is thing k.  *scatter is replaced. */
PetscErrorCode BoxScatterCreate(MPI_Comm comm, int n, const GeometryBox box[], const GeometryBox bounds[],
                                Scatter *scatter);
#endif
