/* The two file formats, as described in Gmsh's reference manual, chapters "MSH file format" and "(Legacy)
 * version 2".
 *
 *   2.2: $Nodes N, then number x y z;   $Elements N, then number type ntags physical geometry ... nodes;
 *        binary elements come in runs (type, count, ntags) without the header on each
 *   4.1: $Entities (physical groups of points, curves, surfaces), then $Nodes and $Elements in blocks of one
 * entity
 *
 * Text and binary differ in how a number is read only (mesh_gmsh_scan.c), so one routine serves both. */
#include "common/mesh/mesh_gmsh_impl.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE = 1, TRIANGLE = 2, POINT = 15 }; /* Gmsh's element types */

static PetscErrorCode Append(size_t *n, size_t *capacity, size_t bytes, void *list)
{
  if (*n == *capacity) {
    *capacity = *capacity ? 2 * *capacity : 1024;
    GMSH_TRY(PetscRealloc(*capacity * bytes, (void **)list));
  }
  ++*n;
  return 0;
}

/* A physical group's tag is negative where the geometry is turned round in the group. */
static int Group(int tag)
{
  return tag >= 0 ? tag : tag == INT32_MIN ? 0 : -tag;
}

static PetscErrorCode AddElement(GmshFile *f, int type, const GmshElement *e)
{
  if (type == TRIANGLE) {
    GMSH_TRY(Append(&f->ntriangle, &f->triangle_capacity, sizeof *e, &f->triangle));
    f->triangle[f->ntriangle - 1] = *e;
  } else if (type == LINE) {
    GMSH_TRY(Append(&f->nline, &f->line_capacity, sizeof *e, &f->line));
    f->line[f->nline - 1] = *e;
  }
  return 0;
}

/* How many nodes an element of a type has; other types than points, lines and triangles are refused. */
static PetscErrorCode NodesOfType(const GmshFile *f, long number, int type, int *n)
{
  *n = type == POINT ? 1 : type + 1;
  if (type == POINT || type == LINE || type == TRIANGLE) return 0;
  if (type == 8 || type == 9) {
    return GmshRefuse(f, "element %ld is of second order: write the mesh with Mesh.ElementOrder = 1", number);
  }
  if (type == 3) return GmshRefuse(f, "element %ld is a quadrangle: only triangles are understood", number);
  return GmshRefuse(f, "element %ld is of Gmsh's type %d: only triangles are understood", number, type);
}

/* --- format 2.2 ------------------------------------------------------------------------------------------ */

static PetscErrorCode Nodes22(GmshFile *f)
{
  size_t n = 0;
  GMSH_TRY(GmshTextCount(f, &n));
  GMSH_TRY(PetscRealloc(n * sizeof *f->node, &f->node));
  for (f->nnode = 0; f->nnode < n; f->nnode++) {
    GMSH_TRY(GmshInteger(f, &f->node[f->nnode].tag));
    GMSH_TRY(GmshDoubles(f, 3, f->node[f->nnode].x));
  }
  return 0;
}

/* Tags and nodes of one element; of the tags the first is the physical group. */
static PetscErrorCode Element22(GmshFile *f, int number, int type, int ntags)
{
  GmshElement e = {.number = number};
  int n;
  GMSH_TRY(NodesOfType(f, number, type, &n));
  for (int k = 0, tag; k < ntags; k++) {
    GMSH_TRY(GmshInteger(f, &tag));
    if (k == 0) e.physical = Group(tag);
  }
  for (int k = 0; k < n; k++) GMSH_TRY(GmshInteger(f, &e.node[k]));
  return AddElement(f, type, &e);
}

static PetscErrorCode Elements22(GmshFile *f)
{
  size_t n = 0;
  GMSH_TRY(GmshTextCount(f, &n));
  for (size_t k = 0; k < n;) {
    int number = 0, type, run = 1, ntags;
    if (!f->binary) GMSH_TRY(GmshInteger(f, &number));
    GMSH_TRY(GmshInteger(f, &type));
    if (f->binary) GMSH_TRY(GmshInteger(f, &run));
    GMSH_TRY(GmshInteger(f, &ntags));
    if (run < 1 || (size_t)run > n - k || ntags < 0)
      return GmshRefuse(f, "byte %zu: a damaged run of elements", f->at);
    for (int i = 0; i < run; i++, k++) {
      if (f->binary) GMSH_TRY(GmshInteger(f, &number));
      GMSH_TRY(Element22(f, number, type, ntags));
    }
  }
  return 0;
}

/* --- format 4.1 ------------------------------------------------------------------------------------------ */

static PetscErrorCode Entity41(GmshFile *f, int dim)
{
  GmshEntity e = {.dim = dim};
  double box[6];
  size_t n = 0;
  int tag;
  GMSH_TRY(GmshInteger(f, &e.tag));
  GMSH_TRY(GmshDoubles(f, dim == 0 ? 3 : 6, box));
  GMSH_TRY(GmshCount(f, 2, &n));
  for (size_t k = 0; k < n; k++) {
    GMSH_TRY(GmshInteger(f, &tag));
    if (k == 0) e.physical = Group(tag);
  }
  if (dim > 0) { /* what bounds it */
    GMSH_TRY(GmshCount(f, 2, &n));
    for (size_t k = 0; k < n; k++) GMSH_TRY(GmshInteger(f, &tag));
  }
  if (!e.physical) return 0;
  GMSH_TRY(Append(&f->nentity, &f->entity_capacity, sizeof e, &f->entity));
  f->entity[f->nentity - 1] = e;
  return 0;
}

static PetscErrorCode Entities41(GmshFile *f)
{
  size_t n[4] = {0};
  for (int dim = 0; dim < 4; dim++) GMSH_TRY(GmshCount(f, 2, &n[dim]));
  for (int dim = 0; dim < 4; dim++) {
    for (size_t k = 0; k < n[dim]; k++) GMSH_TRY(Entity41(f, dim));
  }
  return 0;
}

/* Blocks and things in all of them; the smallest and largest number, of no use, are passed over. */
static PetscErrorCode Head41(GmshFile *f, size_t *blocks, size_t *n)
{
  size_t unused;
  GMSH_TRY(GmshCount(f, 2, blocks));
  GMSH_TRY(GmshCount(f, 2, n));
  GMSH_TRY(GmshSize(f, &unused));
  return GmshSize(f, &unused);
}

static PetscErrorCode Nodes41(GmshFile *f)
{
  size_t blocks = 0, n = 0, count = 0;
  int dim, tag, parametric;
  double unused[3];
  GMSH_TRY(Head41(f, &blocks, &n));
  GMSH_TRY(PetscRealloc(n * sizeof *f->node, &f->node));
  f->nnode = 0;
  for (size_t b = 0; b < blocks; b++) {
    GMSH_TRY(GmshInteger(f, &dim));
    GMSH_TRY(GmshInteger(f, &tag));
    GMSH_TRY(GmshInteger(f, &parametric));
    GMSH_TRY(GmshSize(f, &count));
    if (count > n - f->nnode || dim < 0 || dim > 3)
      return GmshRefuse(f, "block %zu of the nodes is damaged", b + 1);
    GmshNode *node = &f->node[f->nnode];
    for (size_t k = 0; k < count; k++) GMSH_TRY(GmshTag(f, &node[k].tag));
    for (size_t k = 0; k < count; k++) {
      GMSH_TRY(GmshDoubles(f, 3, node[k].x));
      if (parametric) GMSH_TRY(GmshDoubles(f, dim, unused));
    }
    f->nnode += count;
  }
  return 0;
}

static int PhysicalOf(const GmshFile *f, int dim, int tag)
{
  for (size_t k = 0; k < f->nentity; k++) {
    if (f->entity[k].dim == dim && f->entity[k].tag == tag) return f->entity[k].physical;
  }
  return 0;
}

static PetscErrorCode Elements41(GmshFile *f)
{
  size_t blocks = 0, n = 0, count = 0, number = 0;
  int dim, tag, type, nodes;
  GMSH_TRY(Head41(f, &blocks, &n));
  for (size_t b = 0; b < blocks; b++) {
    GMSH_TRY(GmshInteger(f, &dim));
    GMSH_TRY(GmshInteger(f, &tag));
    GMSH_TRY(GmshInteger(f, &type));
    GMSH_TRY(GmshCount(f, 4, &count));
    const int physical = PhysicalOf(f, dim, tag);
    for (size_t k = 0; k < count; k++) {
      GMSH_TRY(GmshSize(f, &number));
      GmshElement e = {.number = (long)number, .physical = physical};
      GMSH_TRY(NodesOfType(f, e.number, type, &nodes));
      for (int i = 0; i < nodes; i++) GMSH_TRY(GmshTag(f, &e.node[i]));
      GMSH_TRY(AddElement(f, type, &e));
    }
  }
  return 0;
}

/* ---- both
 * --------------------------------------------------------------------------------------------------------------
 */

static PetscErrorCode PhysicalNames(GmshFile *f)
{
  const int binary = f->binary;
  size_t n = 0;
  f->binary = 0; /* names are text always */
  GMSH_TRY(GmshCount(f, 2, &n));
  GMSH_TRY(PetscRealloc(n * sizeof *f->name, &f->name));
  for (f->nname = 0; f->nname < n; f->nname++) {
    GmshName *name = &f->name[f->nname];
    GMSH_TRY(GmshInteger(f, &name->dim));
    GMSH_TRY(GmshInteger(f, &name->tag));
    const char *from = f->data + f->at + strspn(f->data + f->at, " \t");
    const char *to = *from == '"' ? strpbrk(from + 1, "\"\n") : NULL;
    if (!to || *to != '"')
      return GmshRefuse(f, "the name of physical group %d is not in quotation marks", name->tag);
    const size_t length = (size_t)(to - from - 1);
    if (!length || length >= sizeof name->name) {
      return GmshRefuse(f, "the name of physical group %d has %zu characters: 1 to 63 are allowed", name->tag,
                        length);
    }
    memcpy(name->name, from + 1, length);
    name->name[length] = 0;
    f->at = (size_t)(to + 1 - f->data);
  }
  f->binary = binary;
  return 0;
}

static PetscErrorCode Format(GmshFile *f)
{
  double version;
  int kind, bytes, one;
  GMSH_TRY(GmshDoubles(f, 1, &version));
  GMSH_TRY(GmshInteger(f, &kind));
  GMSH_TRY(GmshInteger(f, &bytes));
  if (version != 2.2 && version != 4.1)
    return GmshRefuse(f, "format %g: 2.2 and 4.1 are understood (gmsh -format msh41)", version);
  if (bytes != 8) return GmshRefuse(f, "numbers of %d bytes: 8 are expected", bytes);
  f->version = version == 2.2 ? 22 : 41;
  if (kind == 0) return 0;
  f->binary = 1;
  f->at += strcspn(f->data + f->at, "\n");
  if (f->at < f->size) f->at++;
  GMSH_TRY(GmshInteger(f, &one));
  if (one != 1) return GmshRefuse(f, "binary file of the other byte order");
  return 0;
}

/* Moves behind "$End<name>"; what lies before it is passed over. */
static PetscErrorCode EndOf(GmshFile *f, const char *name)
{
  char end[80];
  const size_t n = (size_t)snprintf(end, sizeof end, "$End%s", name);
  const char *found = memmem(f->data + f->at, f->size - f->at, end, n);
  if (!found) return GmshRefuse(f, "%s is missing", end);
  f->at = (size_t)(found - f->data) + n;
  return 0;
}

static PetscErrorCode Section(GmshFile *f, const char *name)
{
  if (!strcmp(name, "MeshFormat")) return Format(f);
  if (!f->version) return GmshRefuse(f, "$%s comes before $MeshFormat", name);
  if (!strcmp(name, "PhysicalNames")) return PhysicalNames(f);
  if (!strcmp(name, "Entities") && f->version == 41) return Entities41(f);
  if (!strcmp(name, "ParametricNodes"))
    return GmshRefuse(f, "$ParametricNodes: write the mesh with Mesh.SaveParametric = 0");
  if (!strcmp(name, "Nodes")) return f->version == 41 ? Nodes41(f) : Nodes22(f);
  if (!strcmp(name, "Elements")) return f->version == 41 ? Elements41(f) : Elements22(f);
  return 0;
}

static PetscErrorCode Load(GmshFile *f)
{
  FILE *stream = fopen(f->path, "rb");
  if (!stream) return GmshRefuse(f, "cannot be opened");
  const int seekable = !fseek(stream, 0, SEEK_END);
  const long size = seekable ? ftell(stream) : -1;
  if (size < 0 || size == INT64_MAX || PetscMalloc((size_t)size + 1, &f->data)) {
    fclose(stream);
    return GmshRefuse(f, "cannot be read");
  }
  rewind(stream);
  f->size = fread(f->data, 1, (size_t)size, stream);
  f->data[f->size] = 0;
  fclose(stream);
  return f->size == (size_t)size ? 0 : GmshRefuse(f, "cannot be read to its end");
}

PetscErrorCode GmshParse(GmshFile *f)
{
  char name[64];
  GMSH_TRY(Load(f));
  for (;;) {
    f->at += strspn(f->data + f->at, " \t\r\n");
    if (f->at >= f->size) break;
    const size_t n = strcspn(f->data + f->at, " \t\r\n");
    if (f->data[f->at] != '$' || n >= sizeof name)
      return GmshRefuse(f, "no Gmsh file: a line \"$...\" is expected at byte %zu", f->at);
    memcpy(name, f->data + f->at + 1, n - 1);
    name[n - 1] = 0;
    f->at += n;
    f->at += f->data[f->at] == '\r';
    f->at += f->data[f->at] == '\n';
    GMSH_TRY(Section(f, name));
    GMSH_TRY(EndOf(f, name));
  }
  return f->version ? 0 : GmshRefuse(f, "no Gmsh file: $MeshFormat is missing");
}
