/* Private to the output room: the part of HDF5 that is used, with its errors turned into PETSc's.  All
 * functions are collective over the communicator of the file.
 *
 * The file on disk is whole after each Hdf5Flush and stays so while the next snapshot is written: arrays go
 * to new places at its end, and the metadata (which places belong to the file) is held back in memory until
 * the next flush. */
#ifndef CORACLE_HDF5_FILE_H
#define CORACLE_HDF5_FILE_H
#include <hdf5.h>
#include <petscsys.h>

/* What a file is for, and how a dataset lies in it: as it is, in chunks with Fletcher-32 checksums, or compressed. */
typedef enum { HDF5_SNAPSHOTS, HDF5_CHECKPOINT } Hdf5Kind;
typedef enum { HDF5_PLAIN, HDF5_CHECKED, HDF5_COMPRESSED } Hdf5Store;

/* A distributed array: this rank's rows of a [total][ncol] dataset. */
typedef struct {
  long long start, n, total; /* rows */
  int ncol;                  /* 1: the dataset has one dimension */
  PetscMPIInt nranks;        /* that write it */
  Hdf5Store store;           /* of writing */
} Hdf5Rows;

PetscErrorCode Hdf5Create(MPI_Comm comm, const char *path, Hdf5Kind kind, hid_t *file);
/* An existing file; `change`: also to write into. */
PetscErrorCode Hdf5Open(MPI_Comm comm, const char *path, PetscBool change, hid_t *file);
PetscErrorCode Hdf5Group(hid_t file, const char *path);
/* The rows of n on each rank that follow each other by rank. */
PetscErrorCode Hdf5Place(MPI_Comm comm, int n, int ncol, Hdf5Rows *rows);
/* A new dataset of doubles or of long long (kept as 4-byte integers in the file where values are below
 * `limit` <= 2^31). */
PetscErrorCode Hdf5WriteDoubles(hid_t file, const char *path, const Hdf5Rows *rows, const double value[]);
PetscErrorCode Hdf5WriteIndices(hid_t file, const char *path, const Hdf5Rows *rows, long long limit,
                                const long long value[]);
/* This rank's rows of a dataset, whose shape must be that. */
PetscErrorCode Hdf5ReadDoubles(hid_t file, const char *path, const Hdf5Rows *rows, double value[]);
PetscErrorCode Hdf5ReadIndices(hid_t file, const char *path, const Hdf5Rows *rows, long long value[]);
PetscErrorCode Hdf5Shape(hid_t file, const char *path, long long *rows, int *ncol);
/* Whether there is something of that name directly under a group that exists. */
PetscBool Hdf5Has(hid_t file, const char *path);
/* Takes a name out of the file. */
PetscErrorCode Hdf5Remove(hid_t file, const char *path);
/* A second name for a dataset. */
PetscErrorCode Hdf5Link(hid_t file, const char *existing, const char *path);
/* A number on a group, the same on all ranks. */
PetscErrorCode Hdf5Attribute(hid_t file, const char *path, const char *name, double value);
PetscErrorCode Hdf5ReadAttribute(hid_t file, const char *path, const char *name, double *value);
PetscBool Hdf5HasAttribute(hid_t file, const char *path, const char *name);
/* A text on a group or dataset. */
PetscErrorCode Hdf5Text(hid_t file, const char *path, const char *name, const char *text);
PetscErrorCode Hdf5ReadText(hid_t file, const char *path, const char *name, size_t size, char text[]);
PetscErrorCode Hdf5Flush(hid_t file);
PetscErrorCode Hdf5Close(hid_t *file);
/* Bytes that an index takes in the file. */
int Hdf5IndexBytes(long long limit);
#endif
