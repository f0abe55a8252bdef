/* What a run leaves behind: HDF5 with XDMF for ParaView, CSV series.  Everything written is readable at any
 * moment: the HDF5 file is flushed after each snapshot and the XDMF index rewritten (to a temporary name,
 * then renamed). */
#ifndef CORACLE_OUTPUT_H
#define CORACLE_OUTPUT_H
#include "common/output/checkpoint.h"

typedef struct Output_s *Output;
typedef enum { OUTPUT_NODE, OUTPUT_CELL } OutputCentre;

/* Collective: <folder>/<name>.h5 and .xdmf, truncated; a snapshot is due `every` s and at
 * `end`, s.  The folder is made if missing.  With a checkpoint (else NULL) of a run in this folder: goes on with
 * its files as they were at OutputSave; what came later is cut off by the first snapshot, when the run is sure
 * to go on.  With another's it begins new ones. */
PetscErrorCode OutputCreate(MPI_Comm comm, const char *folder, const char *name, double every, double end,
                            Checkpoint from, Output *out);
/* Collective: a text about the whole file (case, version), as an attribute; ignored where there is one of that name. */
PetscErrorCode OutputText(Output out, const char *name, const char *text);
/* Collective: between snapshots. */
PetscErrorCode OutputSave(Output out, Checkpoint to);
/* Not collective: at the start, whenever a multiple of `every` has come since the last snapshot, and at the end. */
PetscBool OutputDue(Output out, double t);
/* Collective: starts the snapshot of time t, s, due or not. */
PetscErrorCode OutputBegin(Output out, double t);
/* Collective: a grid of this snapshot: nodes x[n][2], cells connectivity[ne][nodes_per_cell] in this rank's
 * node indices.  nodes_per_cell: 1 Polyvertex/point, 2 Polyline/edge, 3 Triangle, 6 Triangle_6 (VTK order: midpoints of 01, 12,
 * 20). revision: while the same number is given for a grid name, topology and points are not written again
 * but refer to the first. */
PetscErrorCode OutputGrid(Output out, const char *grid, int revision, int n, const double x[], int ne,
                          int nodes_per_cell, const int connectivity[]);
/* Not collective: whether a field can have this name: of 1 to 63 letters, digits, '_', '-' and blanks. */
PetscBool OutputCanName(const char *name);
/* Collective: a field on the grid last given: value[n or ne][ncomp]; ncomp 1 scalar, 2 vector (a third 0 is
 * added), 3 symmetric tensor (xx, yy, xy).  Cells or nodes of a rank may be none. */
PetscErrorCode OutputField(Output out, const char *field, OutputCentre centre, int ncomp,
                           const double value[]);
PetscErrorCode OutputEnd(Output out);
PetscErrorCode OutputDestroy(Output *out);

/* A time series, rank 0's numbers: <folder>/<name>.csv; the header is `columns` (comma-separated, with units:
 * "t [s],U [m/s]"), the first of which is the time.  A row is written at the first time and whenever a multiple of `every`, s, has come since
 * the last one, with 0 at each, and the last one when the series is destroyed.  Collective; `from` and SeriesSave as above. */
typedef struct Series_s *Series;
enum { SERIES_NAME_MAX = 40 };
/* Not collective: whether a name, of a probe say, can lead the names of columns: neither empty nor longer than that, without
 * commas, quotes and line ends. */
PetscBool SeriesCanName(const char *name);
/* A file to go on with must have these columns. */
PetscErrorCode SeriesCreate(MPI_Comm comm, const char *folder, const char *name, const char *columns,
                            double every, Checkpoint from, Series *s);
PetscErrorCode SeriesSave(Series s, Checkpoint to);
/* Not collective: a row of as many numbers as columns, rank 0's, which appends it if it is due; others return at once. */
PetscErrorCode SeriesRow(Series s, const double value[]);
PetscErrorCode SeriesDestroy(Series *s);
#endif
