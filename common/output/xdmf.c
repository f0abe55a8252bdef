#include "common/output/xdmf.h"
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

struct Xdmf_s {
  char name[256], path[PETSC_MAX_PATH_LEN], temporary[PETSC_MAX_PATH_LEN + 8];
  char *text; /* snapshots so far */
  size_t length, capacity;
  PetscBool in_grid;
};

/* Appends to the text. */
static PetscErrorCode WriteLine(Xdmf x, const char *format, ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
static PetscErrorCode WriteLine(Xdmf x, const char *format, ...)
{
  va_list arguments;
  char line[2048];
  PetscFunctionBeginUser;
  va_start(arguments, format);
  const int n = vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  PetscCheck(n < (int)sizeof line, PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ, "a name in '%s' is too long", x->path);
  if (x->length + (size_t)n + 1 > x->capacity) {
    x->capacity = 2 * (x->length + (size_t)n + 1);
    PetscCall(PetscRealloc(x->capacity, &x->text));
  }
  memcpy(x->text + x->length, line, (size_t)n + 1);
  x->length += (size_t)n;
  PetscFunctionReturn(0);
}

#define HEAD                                                                                                 \
  "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"%s\" GridType=\"Collection\" "    \
  "CollectionType=\"Temporal\">\n"

/* The whole file: to a temporary name, then renamed. */
static PetscErrorCode Publish(Xdmf x)
{
  PetscFunctionBeginUser;
  FILE *f = fopen(x->temporary, "w");
  PetscCheck(f, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", x->temporary, strerror(errno));
  fprintf(f, HEAD, x->name);
  if (x->length) fwrite(x->text, 1, x->length, f);
  fprintf(f, "</Grid>\n</Domain>\n</Xdmf>\n");
  const int wrong = ferror(f);
  PetscCheck(!fclose(f) && !wrong, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", x->temporary,
             strerror(errno));
  PetscCheck(!rename(x->temporary, x->path), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", x->path,
             strerror(errno));
  PetscFunctionReturn(0);
}

/* The snapshots of an index that is there already. */
static PetscErrorCode Continue(Xdmf x, size_t length)
{
  char head[512];
  const int skip = snprintf(head, sizeof head, HEAD, x->name);
  PetscFunctionBeginUser;
  x->length = length;
  x->capacity = length + 1;
  PetscCall(PetscCalloc1(x->capacity, &x->text));
  FILE *f = fopen(x->path, "r");
  PetscCheck(f, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", x->path, strerror(errno));
  const int whole = !fseek(f, skip, SEEK_SET) && fread(x->text, 1, length, f) == length;
  fclose(f);
  PetscCheck(whole, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED, "%s is shorter than when it was checkpointed",
             x->path);
  PetscFunctionReturn(0);
}

PetscErrorCode XdmfCreate(const char *folder, const char *name, size_t length, Xdmf *xdmf)
{
  Xdmf x;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&x));
  snprintf(x->name, sizeof x->name, "%s", name);
  snprintf(x->path, sizeof x->path, "%s/%s.xdmf", folder, name);
  snprintf(x->temporary, sizeof x->temporary, "%s.part", x->path);
  PetscCall(length ? Continue(x, length) : Publish(x));
  *xdmf = x;
  PetscFunctionReturn(0);
}

size_t XdmfLength(Xdmf x)
{
  return x->length;
}

PetscErrorCode XdmfBegin(Xdmf x, double t)
{
  PetscFunctionBeginUser;
  PetscCall(WriteLine(x, "<Grid Name=\"%s\" GridType=\"Collection\" CollectionType=\"Spatial\">\n", x->name));
  PetscCall(WriteLine(x, " <Time Value=\"%.17g\"/>\n", t));
  PetscFunctionReturn(0);
}

static PetscErrorCode CloseGrid(Xdmf x)
{
  PetscFunctionBeginUser;
  if (x->in_grid) PetscCall(WriteLine(x, " </Grid>\n"));
  x->in_grid = PETSC_FALSE;
  PetscFunctionReturn(0);
}

PetscErrorCode XdmfGrid(Xdmf x, const char *grid, const char *points, long long n, const char *cells,
                        long long ne, int nodes_per_cell, int index_bytes)
{
  const char *type = nodes_per_cell == 2   ? "Polyline\" NodesPerElement=\"2"
                     : nodes_per_cell == 3 ? "Triangle"
                                           : "Triangle_6";
  PetscFunctionBeginUser;
  PetscCall(CloseGrid(x));
  x->in_grid = PETSC_TRUE;
  PetscCall(WriteLine(x, " <Grid Name=\"%s\" GridType=\"Uniform\">\n", grid));
  PetscCall(WriteLine(x, "  <Topology TopologyType=\"%s\" NumberOfElements=\"%lld\">\n", type, ne));
  PetscCall(WriteLine(x,
                      "   <DataItem Dimensions=\"%lld %d\" NumberType=\"Int\" Precision=\"%d\" "
                      "Format=\"HDF\">%s.h5:%s</DataItem>\n",
                      ne, nodes_per_cell, index_bytes, x->name, cells));
  PetscCall(WriteLine(x, "  </Topology>\n  <Geometry GeometryType=\"XY\">\n"));
  PetscCall(WriteLine(x,
                      "   <DataItem Dimensions=\"%lld 2\" NumberType=\"Float\" Precision=\"8\" "
                      "Format=\"HDF\">%s.h5:%s</DataItem>\n",
                      n, x->name, points));
  PetscCall(WriteLine(x, "  </Geometry>\n"));
  PetscFunctionReturn(0);
}

PetscErrorCode XdmfAttribute(Xdmf x, const char *field, const char *centre, const char *path, long long n,
                             int ncol)
{
  const char *type = ncol == 1 ? "Scalar" : ncol == 3 ? "Vector" : "Tensor6";
  char columns[16] = "";
  PetscFunctionBeginUser;
  if (ncol > 1) snprintf(columns, sizeof columns, " %d", ncol);
  PetscCall(
      WriteLine(x, "  <Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"%s\">\n", field, type, centre));
  PetscCall(WriteLine(x,
                      "   <DataItem Dimensions=\"%lld%s\" NumberType=\"Float\" Precision=\"8\" "
                      "Format=\"HDF\">%s.h5:%s</DataItem>\n",
                      n, columns, x->name, path));
  PetscCall(WriteLine(x, "  </Attribute>\n"));
  PetscFunctionReturn(0);
}

PetscErrorCode XdmfEnd(Xdmf x)
{
  PetscFunctionBeginUser;
  PetscCall(CloseGrid(x));
  PetscCall(WriteLine(x, "</Grid>\n"));
  PetscCall(Publish(x));
  PetscFunctionReturn(0);
}

PetscErrorCode XdmfDestroy(Xdmf *x)
{
  PetscFunctionBeginUser;
  if (!*x) PetscFunctionReturn(0);
  PetscCall(PetscFree((*x)->text));
  PetscCall(PetscFree(*x));
  PetscFunctionReturn(0);
}
