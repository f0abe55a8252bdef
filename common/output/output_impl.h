/* Private to output.c and output_grid.c. */
#ifndef CORACLE_OUTPUT_IMPL_H
#define CORACLE_OUTPUT_IMPL_H
#include "common/output/hdf5_file.h"
#include "common/output/output.h"
#include "common/output/xdmf.h"

#define PATH 512
#define GRIDS_MAX 32

/* What was last written of a grid. */
typedef struct {
  char name[64];
  int revision, nodes_per_cell;
  long long snapshot; /* that holds the points and cells */
  Hdf5Rows node, cell;
} Grid;

struct Output_s {
  MPI_Comm comm; /* duplicated: HDF5's messages do not meet others */
  PetscMPIInt rank;
  hid_t file;
  char path[PETSC_MAX_PATH_LEN];
  Xdmf xdmf; /* rank 0 only */
  long long nsnapshot;
  double every, last, next, end; /* s; last: when the last snapshot was made; next: when one is due */
  PetscBool open;                /* between Begin and End */
  PetscBool later;               /* there are snapshots from after the checkpoint */
  int ngrid, current;
  Grid grid[GRIDS_MAX];
};
#endif
