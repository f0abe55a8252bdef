/* The output of the fluid: fluid.h5/.xdmf snapshots and the series fluid.csv and fluid_forces.csv. */
#ifndef FLUID_WRITER_H
#define FLUID_WRITER_H
#include "common/link/case_file.h"
#include "fluid/flow/fluid.h"

typedef struct Writer_s *Writer;

/* Collective.  Reads output.folder, output.every and time.end of the case and writes the snapshot of the initial state;
 * with a checkpoint (else NULL) resumes the files as they were at WriterSave. */
PetscErrorCode WriterCreate(CoracleCase c, Fluid fluid, Checkpoint from, Writer *r);
/* Collective, between two steps. */
PetscErrorCode WriterSave(Writer r, Checkpoint to);
/* Collective, after every step: one row of the series, and a snapshot when it is due. */
PetscErrorCode WriterStep(Writer r, Fluid fluid);
/* The mesh has changed: the next snapshot writes it. */
void WriterNewMesh(Writer r);
PetscErrorCode WriterDestroy(Writer *r);
#endif
