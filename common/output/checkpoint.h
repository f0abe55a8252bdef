/* A participant's part of a checkpoint, <folder>/<name>.h5: numbers, and tables whose rows are spread over
 * the ranks.  Any number of ranks may read what any other has written.  Everything is collective; what is
 * missing or of another shape is an error that names file and entry.
 *
 * All files of a checkpoint carry its identity (run, step, time), which <folder>/identity says: a file of another
 * checkpoint is refused.  Tables and the file's own structure have checksums: damage is an error.  A file is on the
 * disk when it has been closed. */
#ifndef CORACLE_CHECKPOINT_H
#define CORACLE_CHECKPOINT_H
#include <petscsys.h>

typedef struct Checkpoint_s *Checkpoint;

/* Not collective: says in the folder which checkpoint it is, before files are created there; below 128 characters. */
PetscErrorCode CheckpointIdentify(const char *folder, const char *identity);
PetscErrorCode CheckpointCreate(MPI_Comm comm, const char *folder, const char *name, Checkpoint *c);
PetscErrorCode CheckpointOpen(MPI_Comm comm, const char *folder, const char *name, Checkpoint *c);
PetscErrorCode CheckpointClose(Checkpoint *c);
const char *CheckpointFolder(Checkpoint c); /* borrowed; not collective */
PetscBool CheckpointHasNumber(Checkpoint c, const char *name);

/* The same on all ranks; kept to the last bit. */
PetscErrorCode CheckpointPutNumber(Checkpoint c, const char *name, double value);
PetscErrorCode CheckpointGetNumber(Checkpoint c, const char *name, double *value);

/* Tables value[n][ncol]; the ranks' rows follow each other. */
PetscErrorCode CheckpointPutDoubles(Checkpoint c, const char *name, int n, int ncol, const double value[]);
PetscErrorCode CheckpointPutIndices(Checkpoint c, const char *name, int n, int ncol, const long long value[]);
/* Rows of all ranks. */
PetscErrorCode CheckpointRows(Checkpoint c, const char *name, long long *total);
/* This rank's choice: rows start .. start + n - 1; ranks may choose the same, or none. */
PetscErrorCode CheckpointGetDoubles(Checkpoint c, const char *name, long long start, int n, int ncol,
                                    double value[]);
PetscErrorCode CheckpointGetIndices(Checkpoint c, const char *name, long long start, int n, int ncol,
                                    long long value[]);
#endif
