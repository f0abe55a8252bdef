#include "common/output/hdf5_impl.h"
#include <string.h>

enum { CHUNK_ROWS = 16384, DEFLATE = 1 }; /* rows; level */

/* Bytes of a dataset from which it is compressed, by one rank and by several: a collective write of compressed chunks
 * exchanges some twenty messages more than a plain one. */
enum { COMPRESSED_FROM = 8192, COMPRESSED_FROM_SHARED = 1 << 20 };

/* The innermost message of HDF5's error stack. */
static herr_t Innermost(unsigned depth, const H5E_error2_t *error, void *text)
{
  if (error->desc) snprintf(text, 256, "%s", error->desc);
  return 0;
}

const char *Hdf5Reason(void)
{
  static char text[256];
  text[0] = 0;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, Innermost, text);
  for (char *c = text; *c; c++)
    if (*c == '\n') *c = ' '; /* MPICH's */
  return text;
}

/* Metadata stays in the cache until it is flushed: no evictions, and no resizing, which would evict. */
static PetscErrorCode HoldMetadata(hid_t access, const char *path)
{
  H5AC_cache_config_t config = {.version = H5AC__CURR_CACHE_CONFIG_VERSION};
  PetscFunctionBeginUser;
  H5(H5Pget_mdc_config(access, &config), "set up", path);
  config.evictions_enabled = 0;
  config.incr_mode = H5C_incr__off;
  config.flash_incr_mode = H5C_flash_incr__off;
  config.decr_mode = H5C_decr__off;
  H5(H5Pset_mdc_config(access, &config), "set up", path);
  PetscFunctionReturn(0);
}

/* The list is the caller's to close. */
static PetscErrorCode Access(MPI_Comm comm, const char *path, hid_t *access)
{
  PetscFunctionBeginUser;
  H5(H5Eset_auto2(H5E_DEFAULT, NULL, NULL), "keep its messages about", path); /* they come in ours */
  H5(*access = H5Pcreate(H5P_FILE_ACCESS), "set up", path);
  H5(H5Pset_fapl_mpio(*access, comm, MPI_INFO_NULL), "use MPI for", path);
  H5(H5Pset_coll_metadata_write(*access, 1), "set up", path);
  PetscCall(HoldMetadata(*access, path));
  PetscFunctionReturn(0);
}

/* Of the formats that keep checksums of metadata: for checkpoints, which are never left open, the newest one; for
 * snapshots one that does not mark a file whose writer was killed as still open. */
static PetscErrorCode ChooseFormat(hid_t access, const char *path, Hdf5Kind kind)
{
  PetscFunctionBeginUser;
  H5(H5Pset_libver_bounds(access, H5F_LIBVER_V18, kind == HDF5_CHECKPOINT ? H5F_LIBVER_V110 : H5F_LIBVER_V18),
     "set up", path);
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5Create(MPI_Comm comm, const char *path, Hdf5Kind kind, hid_t *file)
{
  hid_t access;
  PetscFunctionBeginUser;
  PetscCall(Access(comm, path, &access));
  PetscCall(ChooseFormat(access, path, kind));
  H5(*file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, access), "create", path);
  H5(H5Pclose(access), "set up", path);
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5Open(MPI_Comm comm, const char *path, PetscBool change, hid_t *file)
{
  hid_t access;
  PetscFunctionBeginUser;
  PetscCall(Access(comm, path, &access));
  PetscCall(ChooseFormat(access, path, HDF5_SNAPSHOTS));
  H5(*file = H5Fopen(path, change ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access),
     change ? "open" : "go on (resume) from", path);
  H5(H5Pclose(access), "set up", path);
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5Group(hid_t file, const char *path)
{
  hid_t group;
  PetscFunctionBeginUser;
  H5(group = H5Gcreate2(file, path, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "create group", path);
  H5(H5Gclose(group), "close group", path);
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5Place(MPI_Comm comm, int n, int ncol, Hdf5Rows *rows)
{
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  *rows = (Hdf5Rows){.n = n, .total = n, .ncol = ncol};
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &rows->nranks));
  PetscCallMPI(MPI_Exscan(&rows->n, &rows->start, 1, MPI_LONG_LONG, MPI_SUM, comm));
  if (rank == 0) rows->start = 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &rows->total, 1, MPI_LONG_LONG, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

/* This rank's rows, selected in memory and in the file. */
static PetscErrorCode Select(const char *path, const Hdf5Rows *rows, hid_t space, hid_t *memory)
{
  const hsize_t from[2] = {(hsize_t)rows->start, 0}, count[2] = {(hsize_t)rows->n, (hsize_t)rows->ncol};
  PetscFunctionBeginUser;
  /* of the dataset's rank: HDF5 else maps chunks to memory number by number */
  H5(*memory = H5Screate_simple(rows->ncol == 1 ? 1 : 2, count, NULL), "describe", path);
  if (rows->n) {
    H5(H5Sselect_hyperslab(space, H5S_SELECT_SET, from, NULL, count, NULL), "select", path);
  } else {
    H5(H5Sselect_none(space), "select", path);
    H5(H5Sselect_none(*memory), "select", path);
  }
  PetscFunctionReturn(0);
}

/* For messages: a dataset of this path, in its file. */
static const char *DatasetName(hid_t set, const char *path)
{
  static char text[512];
  const ssize_t n = H5Fget_name(set, text, sizeof text);
  if (n > 0 && (size_t)n < sizeof text) snprintf(text + n, sizeof text - (size_t)n, ": %s", path);
  return n > 0 ? text : path;
}

/* This rank's rows between memory and an open dataset, out to it or in from it; closes both. */
static PetscErrorCode Move(hid_t set, hid_t space, const char *path, const Hdf5Rows *rows, hid_t in_memory,
                           const void *out, void *in)
{
  double nothing = 0.0;                      /* HDF5 wants an address from ranks without rows, too */
  const char *name = DatasetName(set, path); /* asked for later it would clear HDF5's messages */
  hid_t memory, transfer;
  PetscFunctionBeginUser;
  H5(transfer = H5Pcreate(H5P_DATASET_XFER), "set up", path);
  H5(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), "set up", path);
  PetscCall(Select(path, rows, space, &memory));
  if (rows->total && in)
    H5(H5Dread(set, in_memory, memory, space, transfer, in), "read", name);
  else if (rows->total)
    H5(H5Dwrite(set, in_memory, memory, space, transfer, rows->n ? out : &nothing), "write", name);
  H5(H5Pclose(transfer), "close", path);
  H5(H5Sclose(memory), "close", path);
  H5(H5Sclose(space), "close", path);
  H5(H5Dclose(set), "close", path);
  PetscFunctionReturn(0);
}

/* The layout of a dataset: in chunks where it is checked or compressed, each of one column so that a column of zeros
 * takes no room; small ones as they are. */
static PetscErrorCode Layout(const char *path, const Hdf5Rows *rows, hid_t *layout)
{
  const long long bytes = rows->total * rows->ncol * (long long)sizeof(double);
  const long long from = rows->nranks > 1 ? COMPRESSED_FROM_SHARED : COMPRESSED_FROM;
  const hsize_t chunk[2] = {(hsize_t)PetscMin(rows->total, CHUNK_ROWS),
                            rows->store == HDF5_CHECKED ? (hsize_t)rows->ncol : 1};
  PetscFunctionBeginUser;
  H5(*layout = H5Pcreate(H5P_DATASET_CREATE), "set up", path);
  if (rows->store == HDF5_PLAIN || !rows->total || (rows->store == HDF5_COMPRESSED && bytes < from))
    PetscFunctionReturn(0);
  H5(H5Pset_chunk(*layout, rows->ncol == 1 ? 1 : 2, chunk), "set up", path);
  /* all of it will be written: HDF5 else compresses and writes chunks of zeros first */
  H5(H5Pset_fill_time(*layout, H5D_FILL_TIME_NEVER), "set up", path);
  if (rows->store == HDF5_CHECKED) {
    H5(H5Pset_fletcher32(*layout), "check", path);
  } else {
    H5(H5Pset_shuffle(*layout), "compress", path);
    H5(H5Pset_deflate(*layout, DEFLATE), "compress", path);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Write(hid_t file, const char *path, const Hdf5Rows *rows, hid_t in_memory,
                            hid_t in_file, const void *value)
{
  const hsize_t total[2] = {(hsize_t)rows->total, (hsize_t)rows->ncol};
  hid_t space, set, layout;
  PetscFunctionBeginUser;
  PetscCall(Layout(path, rows, &layout));
  H5(space = H5Screate_simple(rows->ncol == 1 ? 1 : 2, total, NULL), "describe", path);
  H5(set = H5Dcreate2(file, path, in_file, space, H5P_DEFAULT, layout, H5P_DEFAULT), "create", path);
  H5(H5Pclose(layout), "close", path);
  PetscCall(Move(set, space, path, rows, in_memory, value, NULL));
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5WriteDoubles(hid_t file, const char *path, const Hdf5Rows *rows, const double value[])
{
  return Write(file, path, rows, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, value);
}

int Hdf5IndexBytes(long long limit)
{
  return limit <= INT32_MAX ? 4 : 8;
}

/* Converted here: HDF5 itself cannot while it writes compressed data collectively. */
static PetscErrorCode WriteShort(hid_t file, const char *path, const Hdf5Rows *rows, const long long value[])
{
  const size_t n = (size_t)rows->n * (size_t)rows->ncol;
  int32_t *copy;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &copy));
  for (size_t k = 0; k < n; k++) copy[k] = (int32_t)value[k];
  PetscCall(Write(file, path, rows, H5T_NATIVE_INT32, H5T_STD_I32LE, copy));
  PetscCall(PetscFree(copy));
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5WriteIndices(hid_t file, const char *path, const Hdf5Rows *rows, long long limit,
                                const long long value[])
{
  PetscFunctionBeginUser;
  if (Hdf5IndexBytes(limit) == 4)
    PetscCall(WriteShort(file, path, rows, value));
  else
    PetscCall(Write(file, path, rows, H5T_NATIVE_LLONG, H5T_STD_I64LE, value));
  PetscFunctionReturn(0);
}

static PetscErrorCode Read(hid_t file, const char *path, const Hdf5Rows *rows, hid_t in_memory, void *value)
{
  double nothing;
  hid_t space, set;
  PetscFunctionBeginUser;
  H5(set = H5Dopen2(file, path, H5P_DEFAULT), "open", path);
  H5(space = H5Dget_space(set), "describe", path);
  PetscCall(Move(set, space, path, rows, in_memory, NULL, rows->n ? value : &nothing));
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5ReadDoubles(hid_t file, const char *path, const Hdf5Rows *rows, double value[])
{
  return Read(file, path, rows, H5T_NATIVE_DOUBLE, value);
}

PetscErrorCode Hdf5ReadIndices(hid_t file, const char *path, const Hdf5Rows *rows, long long value[])
{
  return Read(file, path, rows, H5T_NATIVE_LLONG, value);
}

PetscErrorCode Hdf5Shape(hid_t file, const char *path, long long *rows, int *ncol)
{
  hsize_t dims[2] = {0, 1};
  hid_t set, space;
  PetscFunctionBeginUser;
  H5(set = H5Dopen2(file, path, H5P_DEFAULT), "open", path);
  H5(space = H5Dget_space(set), "describe", path);
  PetscCheck(H5Sget_simple_extent_ndims(space) <= 2, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
             "%s has more than two dimensions", path);
  H5(H5Sget_simple_extent_dims(space, dims, NULL), "describe", path);
  H5(H5Sclose(space), "close", path);
  H5(H5Dclose(set), "close", path);
  *rows = (long long)dims[0];
  *ncol = (int)dims[1];
  PetscFunctionReturn(0);
}

PetscBool Hdf5Has(hid_t file, const char *path)
{
  return H5Lexists(file, path, H5P_DEFAULT) > 0 ? PETSC_TRUE : PETSC_FALSE;
}

PetscErrorCode Hdf5Remove(hid_t file, const char *path)
{
  PetscFunctionBeginUser;
  H5(H5Ldelete(file, path, H5P_DEFAULT), "remove", path);
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5Link(hid_t file, const char *existing, const char *path)
{
  PetscFunctionBeginUser;
  H5(H5Lcreate_hard(file, existing, file, path, H5P_DEFAULT, H5P_DEFAULT), "link", path);
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5Flush(hid_t file)
{
  PetscFunctionBeginUser;
  H5(H5Fflush(file, H5F_SCOPE_GLOBAL), "flush", "the file");
  PetscFunctionReturn(0);
}

PetscErrorCode Hdf5Close(hid_t *file)
{
  PetscFunctionBeginUser;
  H5(H5Fclose(*file), "close", "the file");
  *file = H5I_INVALID_HID;
  PetscFunctionReturn(0);
}
