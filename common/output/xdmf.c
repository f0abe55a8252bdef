#include "common/output/xdmf.h"
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_COLLECTIONS 32

/* The snapshots of one grid so far. */
typedef struct {
  char grid[64], *text;
  size_t length, capacity;
} Collection;

struct Xdmf_s {
  char name[256], path[PETSC_MAX_PATH_LEN], temporary[PETSC_MAX_PATH_LEN + 8];
  double t; /* s, of the snapshot that is being made */
  int ncollections;
  Collection collection[MAX_COLLECTIONS], *open; /* open: that of the grid that is being made, or NULL */
};

#define HEAD "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
#define FOOT "</Domain>\n</Xdmf>\n"
#define COLLECTION "<Grid Name=\"%s\" GridType=\"Collection\" CollectionType=\"Temporal\">\n"

static PetscErrorCode Append(Collection *c, const char *text, size_t n)
{
  PetscFunctionBeginUser;
  if (c->length + n + 1 > c->capacity) {
    c->capacity = 2 * (c->length + n + 1);
    PetscCall(PetscRealloc(c->capacity, &c->text));
  }
  memcpy(c->text + c->length, text, n);
  c->length += n;
  c->text[c->length] = 0;
  PetscFunctionReturn(0);
}

/* Appends a line to the grid that is being made. */
static PetscErrorCode Line(Xdmf x, const char *format, ...) PETSC_ATTRIBUTE_FORMAT(2, 3);
static PetscErrorCode Line(Xdmf x, const char *format, ...)
{
  va_list arguments;
  char line[2048];
  PetscFunctionBeginUser;
  va_start(arguments, format);
  const int n = vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  PetscCheck(n < (int)sizeof line, PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ, "a name in '%s' is too long", x->path);
  PetscCall(Append(x->open, line, (size_t)n));
  PetscFunctionReturn(0);
}

static PetscErrorCode FindCollection(Xdmf x, const char *grid, Collection **found)
{
  int k = 0;
  PetscFunctionBeginUser;
  while (k < x->ncollections && strcmp(x->collection[k].grid, grid)) k++;
  PetscCheck(k < MAX_COLLECTIONS, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "more than %d grids in a file",
             MAX_COLLECTIONS);
  *found = &x->collection[k];
  if (k == x->ncollections) {
    snprintf((*found)->grid, sizeof(*found)->grid, "%s", grid);
    x->ncollections++;
  }
  PetscFunctionReturn(0);
}

/* The file of n collections at path: to the temporary name, then renamed. */
static PetscErrorCode PublishFile(const char *path, const char *temporary, int n, const Collection c[])
{
  PetscFunctionBeginUser;
  FILE *f = fopen(temporary, "w");
  PetscCheck(f, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", temporary, strerror(errno));
  fputs(HEAD, f);
  for (int k = 0; k < n; k++) {
    fprintf(f, COLLECTION, c[k].grid);
    if (c[k].length) fwrite(c[k].text, 1, c[k].length, f);
    fputs("</Grid>\n", f);
  }
  fputs(FOOT, f);
  const int wrong = ferror(f);
  PetscCheck(!fclose(f) && !wrong, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", temporary,
             strerror(errno));
  PetscCheck(!rename(temporary, path), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", path,
             strerror(errno));
  PetscFunctionReturn(0);
}

/* The index of all grids and, where there are several, one of each. */
static PetscErrorCode Publish(Xdmf x)
{
  char path[PETSC_MAX_PATH_LEN + 80];
  const int stem = (int)(strlen(x->path) - strlen(".xdmf"));
  PetscFunctionBeginUser;
  for (int k = 0; k < x->ncollections && x->ncollections > 1; k++) {
    snprintf(path, sizeof path, "%.*s.%s.xdmf", stem, x->path, x->collection[k].grid);
    PetscCall(PublishFile(path, x->temporary, 1, &x->collection[k]));
  }
  PetscCall(PublishFile(x->path, x->temporary, x->ncollections, x->collection));
  PetscFunctionReturn(0);
}

/* --- an index that is there already --------------------------------------------------------------------- */

/* One snapshot of a grid, from " <Grid" to " </Grid>": kept if it is of the first nsnapshot. */
static PetscErrorCode KeepSnapshot(Collection *c, const char *entry, size_t n, long long nsnapshot,
                                   long long *last)
{
  const char *path = strstr(entry, ".h5:/snapshot/");
  PetscFunctionBeginUser;
  if (!path || path > entry + n) PetscFunctionReturn(0);
  const long long k = strtoll(path + strlen(".h5:/snapshot/"), NULL, 10);
  if (k >= nsnapshot) PetscFunctionReturn(0);
  *last = PetscMax(*last, k);
  PetscCall(Append(c, entry, n));
  PetscFunctionReturn(0);
}

static PetscErrorCode KeepSnapshots(Xdmf x, const char *text, long long nsnapshot)
{
  static const char GRID[] = "\n <Grid ", END[] = "\n </Grid>\n", NEXT[] = "\n<Grid Name=\"";
  long long last = -1;
  Collection *c = NULL;
  PetscFunctionBeginUser;
  for (const char *at = strstr(text, NEXT); at;) {
    char grid[64] = "";
    const char *next = strstr(at + 1, NEXT);
    sscanf(at + sizeof NEXT - 1, "%63[^\"]", grid);
    PetscCall(FindCollection(x, grid, &c));
    for (const char *entry = strstr(at, GRID); entry && (!next || entry < next);
         entry = strstr(entry, GRID)) {
      const char *end = strstr(entry, END);
      if (!end) break;
      end += sizeof END - 1;
      PetscCall(KeepSnapshot(c, entry + 1, (size_t)(end - entry) - 1, nsnapshot, &last));
      entry = end - 1;
    }
    at = next;
  }
  /* a whole index without grids is of snapshots without cells */
  const PetscBool empty = (PetscBool)(!x->ncollections && strstr(text, "</Xdmf>"));
  PetscCheck(last == nsnapshot - 1 || empty, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
             "%s has not the %lld snapshots that it had when it was checkpointed", x->path, nsnapshot);
  PetscFunctionReturn(0);
}

static PetscErrorCode Continue(Xdmf x, long long nsnapshot)
{
  char *text;
  PetscFunctionBeginUser;
  FILE *f = fopen(x->path, "r");
  PetscCheck(f, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", x->path, strerror(errno));
  PetscCheck(!fseek(f, 0, SEEK_END), PETSC_COMM_SELF, PETSC_ERR_FILE_READ, "%s: %s", x->path,
             strerror(errno));
  const size_t length = (size_t)ftell(f);
  PetscCall(PetscCalloc1(length + 1, &text));
  rewind(f);
  const size_t got = fread(text, 1, length, f);
  fclose(f);
  PetscCheck(got == length, PETSC_COMM_SELF, PETSC_ERR_FILE_READ, "%s: %s", x->path, strerror(errno));
  PetscCall(KeepSnapshots(x, text, nsnapshot));
  PetscCall(PetscFree(text));
  PetscFunctionReturn(0);
}

PetscErrorCode XdmfCreate(const char *folder, const char *name, long long nsnapshot, Xdmf *xdmf)
{
  Xdmf x;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&x));
  snprintf(x->name, sizeof x->name, "%s", name);
  snprintf(x->path, sizeof x->path, "%s/%s.xdmf", folder, name);
  snprintf(x->temporary, sizeof x->temporary, "%s.part", x->path);
  PetscCall(nsnapshot ? Continue(x, nsnapshot) : Publish(x));
  *xdmf = x;
  PetscFunctionReturn(0);
}

/* --- a snapshot ----------------------------------------------------------------------------------------- */

PetscErrorCode XdmfBegin(Xdmf x, double t)
{
  PetscFunctionBeginUser;
  x->t = t;
  PetscFunctionReturn(0);
}

static PetscErrorCode CloseGrid(Xdmf x)
{
  PetscFunctionBeginUser;
  if (x->open) PetscCall(Line(x, " </Grid>\n"));
  x->open = NULL;
  PetscFunctionReturn(0);
}

PetscErrorCode XdmfGrid(Xdmf x, const char *grid, const char *points, long long n, const char *cells,
                        long long ne, int nodes_per_cell, int index_bytes)
{
  const char *type = nodes_per_cell == 1   ? "Polyvertex\" NodesPerElement=\"1"
                     : nodes_per_cell == 2 ? "Polyline\" NodesPerElement=\"2"
                     : nodes_per_cell == 3 ? "Triangle"
                                           : "Triangle_6";
  PetscFunctionBeginUser;
  PetscCall(CloseGrid(x));
  PetscCall(FindCollection(x, grid, &x->open));
  PetscCall(Line(x, " <Grid Name=\"%s\" GridType=\"Uniform\">\n", grid));
  PetscCall(Line(x, "  <Time Value=\"%.10g\"/>\n",
                 x->t)); /* not the round-off of sums of steps: one time in all files */
  PetscCall(Line(x, "  <Topology TopologyType=\"%s\" NumberOfElements=\"%lld\">\n", type, ne));
  PetscCall(Line(x,
                 "   <DataItem Dimensions=\"%lld %d\" NumberType=\"Int\" Precision=\"%d\" "
                 "Format=\"HDF\">%s.h5:%s</DataItem>\n",
                 ne, nodes_per_cell, index_bytes, x->name, cells));
  PetscCall(Line(x, "  </Topology>\n  <Geometry GeometryType=\"XY\">\n"));
  PetscCall(Line(x,
                 "   <DataItem Dimensions=\"%lld 2\" NumberType=\"Float\" Precision=\"8\" "
                 "Format=\"HDF\">%s.h5:%s</DataItem>\n",
                 n, x->name, points));
  PetscCall(Line(x, "  </Geometry>\n"));
  PetscFunctionReturn(0);
}

PetscErrorCode XdmfAttribute(Xdmf x, const char *field, const char *centre, const char *path, long long n,
                             int ncol)
{
  const char *type = ncol == 1 ? "Scalar" : ncol == 3 ? "Vector" : "Tensor6";
  char columns[16] = "";
  PetscFunctionBeginUser;
  if (ncol > 1) snprintf(columns, sizeof columns, " %d", ncol);
  PetscCall(Line(x, "  <Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"%s\">\n", field, type, centre));
  PetscCall(Line(x,
                 "   <DataItem Dimensions=\"%lld%s\" NumberType=\"Float\" Precision=\"8\" "
                 "Format=\"HDF\">%s.h5:%s</DataItem>\n",
                 n, columns, x->name, path));
  PetscCall(Line(x, "  </Attribute>\n"));
  PetscFunctionReturn(0);
}

PetscErrorCode XdmfEnd(Xdmf x)
{
  PetscFunctionBeginUser;
  PetscCall(CloseGrid(x));
  PetscCall(Publish(x));
  PetscFunctionReturn(0);
}

PetscErrorCode XdmfDestroy(Xdmf *x)
{
  PetscFunctionBeginUser;
  if (!*x) PetscFunctionReturn(0);
  for (int k = 0; k < (*x)->ncollections; k++) PetscCall(PetscFree((*x)->collection[k].text));
  PetscCall(PetscFree(*x));
  PetscFunctionReturn(0);
}
