/* What the fluid leaves behind: fluid.h5/.xdmf snapshots and the series fluid.csv. */
#ifndef FLUID_RECORD_H
#define FLUID_RECORD_H
#include "case_file.h"
#include "fluid.h"

typedef struct Record_s *Record;

/* Collective.  Reads output.folder and output.every of the case and writes the snapshot of the initial state;
 * with a checkpoint (else NULL) goes on with the files as they were at RecordSave. */
PetscErrorCode RecordCreate(Case c, Fluid fluid, Checkpoint from, Record *r);
/* Collective, between two steps. */
PetscErrorCode RecordSave(Record r, Checkpoint to);
/* Collective, after every step: one row of the series, and a snapshot when it is due. */
PetscErrorCode RecordStep(Record r, Fluid fluid);
/* The mesh has changed: the next snapshot writes it. */
void RecordNewMesh(Record r);
PetscErrorCode RecordDestroy(Record *r);
#endif
