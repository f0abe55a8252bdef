/* Numbers of a Gmsh file, text or binary. */
#include "common/mesh/mesh_gmsh_impl.h"
#include <stdlib.h>
#include <string.h>

static PetscErrorCode Truncated(const GmshFile *f)
{
  const size_t at = f->binary ? f->at : f->at + strspn(f->data + f->at, " \t\r\n");
  long line = 1;
  if (at >= f->size) return GmshRefuse(f, "the file ends too early");
  for (size_t i = 0; i < at; i++) line += f->data[i] == '\n';
  if (f->binary) return GmshRefuse(f, "byte %zu: not what belongs there", f->at);
  return GmshRefuse(f, "line %ld: a number is expected", line);
}

static PetscErrorCode Bytes(GmshFile *f, void *to, size_t n)
{
  if (n > f->size - f->at) {
    f->at = f->size;
    return Truncated(f);
  }
  memcpy(to, f->data + f->at, n);
  f->at += n;
  return 0;
}

static PetscErrorCode TextInteger(GmshFile *f, long long *value)
{
  char *end;
  *value = strtoll(f->data + f->at, &end, 10);
  if (end == f->data + f->at) return Truncated(f);
  f->at = (size_t)(end - f->data);
  return 0;
}

PetscErrorCode GmshInteger(GmshFile *f, int *value)
{
  long long wide;
  if (f->binary) return Bytes(f, value, sizeof *value);
  GMSH_TRY(TextInteger(f, &wide));
  if (wide != (int)wide) return GmshRefuse(f, "the number %lld is too large", wide);
  *value = (int)wide;
  return 0;
}

PetscErrorCode GmshSize(GmshFile *f, size_t *value)
{
  long long wide;
  if (f->binary) return Bytes(f, value, sizeof *value);
  GMSH_TRY(TextInteger(f, &wide));
  if (wide < 0) return GmshRefuse(f, "the number %lld should not be negative", wide);
  *value = (size_t)wide;
  return 0;
}

PetscErrorCode GmshCount(GmshFile *f, size_t bytes, size_t *count)
{
  GMSH_TRY(GmshSize(f, count));
  if (*count > (f->size - f->at) / bytes)
    return GmshRefuse(f, "%zu things are announced, but the file ends earlier", *count);
  return 0;
}

PetscErrorCode GmshTag(GmshFile *f, int *tag)
{
  size_t wide;
  GMSH_TRY(GmshSize(f, &wide));
  if (wide > INT32_MAX) return GmshRefuse(f, "the number %zu is too large", wide);
  *tag = (int)wide;
  return 0;
}

PetscErrorCode GmshDoubles(GmshFile *f, int n, double *value)
{
  if (f->binary) return Bytes(f, value, (size_t)n * sizeof *value);
  for (int k = 0; k < n; k++) {
    char *end;
    value[k] = strtod(f->data + f->at, &end);
    if (end == f->data + f->at) return Truncated(f);
    f->at = (size_t)(end - f->data);
  }
  return 0;
}

PetscErrorCode GmshTextCount(GmshFile *f, size_t *count)
{
  const int binary = f->binary;
  f->binary = 0;
  GMSH_TRY(GmshCount(f, 2, count));
  f->binary = binary;
  if (binary) f->at += f->data[f->at] == '\r';
  if (binary) f->at += f->data[f->at] == '\n';
  return 0;
}
