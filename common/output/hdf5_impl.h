/* Private to hdf5_file.c and hdf5_attribute.c. */
#ifndef CORACLE_HDF5_IMPL_H
#define CORACLE_HDF5_IMPL_H
#include "common/output/hdf5_file.h"

/* Of the last failure; a static buffer. */
const char *Hdf5Reason(void);

/* HDF5 says failure by a negative value, of whatever type. */
#define H5(call, what, path)                                                                                 \
  PetscCheck((call) >= 0, PETSC_COMM_SELF, PETSC_ERR_LIB, "HDF5 cannot %s %s: %s", what, path, Hdf5Reason())
#endif
