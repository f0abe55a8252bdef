/* What the solid leaves behind: solid.h5/.xdmf snapshots and the series solid.csv. */
#ifndef SOLID_RECORD_H
#define SOLID_RECORD_H
#include "case_file.h"
#include "solid.h"

typedef struct Record_s *Record;

/* Collective.  Reads output.folder and output.every of the case.  Writes the snapshot of the initial state,
 * or, with a checkpoint (else NULL), goes on as at RecordSave. */
PetscErrorCode RecordCreate(Case c, MPI_Comm comm, Solid solid, Checkpoint from, Record *r);
/* Collective, after every step: one row of the series (of the first 8 bodies), and a snapshot when it is due;
 * waited: seconds within the link so far on this rank.  A step that is redone writes its row when it is
 * final, so call this before the next step begins and only when that is CORACLE_RUN or CORACLE_STOP. */
PetscErrorCode RecordStep(Record r, Solid solid, double waited);
/* Collective, after RecordStep. */
PetscErrorCode RecordSave(Record r, double waited, Checkpoint to);
PetscErrorCode RecordDestroy(Record *r);
#endif
