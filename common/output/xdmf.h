/* Private to the output room: the XDMF 3 index of an HDF5 file, rank 0 only.
 *
 *   temporal collection <grid>, one each grid
 *     uniform grids, one a snapshot, each with its time and attributes
 *
 * Where there are several grids, <name>.<grid>.xdmf has one of them alone: filters of ParaView (StreamTracer,
 * PlotOverLine) want one grid, of one kind of cells, with the same fields everywhere.
 * Text of whole snapshots is kept; the file is written anew under a temporary name and renamed, so that a
 * reader never sees half of it.  See www.xdmf.org/index.php/XDMF_Model_and_Format. */
#ifndef CORACLE_XDMF_H
#define CORACLE_XDMF_H
#include <petscsys.h>

typedef struct Xdmf_s *Xdmf;

/* nsnapshot: continues an index that is there, with its first so many snapshots; 0: a new one. */
PetscErrorCode XdmfCreate(const char *folder, const char *name, long long nsnapshot, Xdmf *xdmf);
PetscErrorCode XdmfBegin(Xdmf x, double t);
/* n points, ne cells; paths are of datasets in <name>.h5. */
PetscErrorCode XdmfGrid(Xdmf x, const char *grid, const char *points, long long n, const char *cells,
                        long long ne, int nodes_per_cell, int index_bytes);
/* ncol 1 scalar, 3 vector, 6 symmetric tensor. */
PetscErrorCode XdmfAttribute(Xdmf x, const char *field, const char *centre, const char *path, long long n,
                             int ncol);
/* Ends the snapshot and writes the file. */
PetscErrorCode XdmfEnd(Xdmf x);
PetscErrorCode XdmfDestroy(Xdmf *x);
#endif
