/* Reading back with HDF5 alone. */
#ifndef TESTS_OUTPUT_READ_BACK_H
#define TESTS_OUTPUT_READ_BACK_H
#include "common/output/output.h"
#include "tests/check.h"
#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* All of a dataset as doubles; dims [rank 1: n, 0], caller frees. */
static inline double *ReadDataset(hid_t file, const char *path, hsize_t dims[2])
{
  const hid_t set = H5Dopen2(file, path, H5P_DEFAULT);
  CHECK(set >= 0, "%s is missing", path);
  const hid_t space = H5Dget_space(set);
  CHECK(H5Sget_simple_extent_ndims(space) <= 2, "%s has more than two dimensions", path);
  dims[0] = dims[1] = 0;
  H5Sget_simple_extent_dims(space, dims, NULL);
  double *value = malloc(sizeof *value * (size_t)(dims[0] * (dims[1] ? dims[1] : 1) + 1));
  CHECK(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0, "%s cannot be read",
        path);
  H5Sclose(space);
  H5Dclose(set);
  return value;
}

/* A text file; caller frees. */
static inline char *ReadText(const char *path)
{
  FILE *f = fopen(path, "rb");
  CHECK(f, "%s is missing", path);
  char *text = calloc(1 << 20, 1);
  CHECK(fread(text, 1, (1 << 20) - 1, f) > 0, "%s is empty", path);
  fclose(f);
  return text;
}

static inline int Occurrences(const char *text, const char *of)
{
  int n = 0;
  for (const char *c = text; (c = strstr(c, of)); c++) n++;
  return n;
}
#endif
