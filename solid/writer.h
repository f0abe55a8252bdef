/* What the solid leaves behind: solid.h5/.xdmf snapshots and the series solid.csv. */
#ifndef SOLID_WRITER_H
#define SOLID_WRITER_H
#include "common/link/case_file.h"
#include "solid/solid.h"

typedef struct Writer_s *Writer;

/* Collective.  Reads output.folder, output.every and time.end of the case.  Writes the snapshot of the initial state,
 * or, with a checkpoint (else NULL), continues as at WriterSave. */
PetscErrorCode WriterCreate(CoracleCase c, MPI_Comm comm, Solid solid, Checkpoint from, Writer *r);
/* Collective, after every step: one row of the series (of the first 1000 bodies), and a snapshot when it is due;
 * waited: seconds within the link so far on this rank.  A step that is redone writes its row when it is
 * final, so call this before the next step begins and only when that is CORACLE_RUN or CORACLE_STOP. */
PetscErrorCode WriterStep(Writer r, Solid solid, double waited);
/* Collective, after WriterStep. */
PetscErrorCode WriterSave(Writer r, double waited, Checkpoint to);
PetscErrorCode WriterDestroy(Writer *r);
#endif
