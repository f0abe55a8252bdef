/* The two file formats, as described in Gmsh's reference manual, chapters "MSH file format" and "(Legacy)
 * version 2".
 *
 *   2.2: $Nodes N, then number x y z;   $Elements N, then number type ntags physical geometry ... nodes;
 *        binary elements come in runs (type, count, ntags) without the header on each
 *   4.1: $Entities (physical groups of points, curves, surfaces), then $Nodes and $Elements in blocks of one entity
 *
 * Text and binary differ in how a number is read only (mesh_gmsh_scan.c), so one routine serves both. */
#include "common/mesh/mesh_gmsh_impl.h"
#include <stdlib.h>
#include <string.h>

enum { LINE = 1, TRIANGLE = 2, LINE_3 = 8, TRIANGLE_6 = 9, POINT = 15 }; /* Gmsh's element types */

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

/* A part of e: its nodes number a, b and, of a triangle, c. */
static PetscErrorCode AddPart(GmshFile *f, const GmshElement *e, int a, int b, int c)
{
  GmshElement part = {.number = e->number, .physical = e->physical, .node = {e->node[a], e->node[b]}};
  if (c < 0) {
    GMSH_TRY(Append(&f->nline, &f->line_capacity, sizeof part, &f->line));
    f->line[f->nline - 1] = part;
    return 0;
  }
  part.node[2] = e->node[c];
  GMSH_TRY(Append(&f->ntriangle, &f->triangle_capacity, sizeof part, &f->triangle));
  f->triangle[f->ntriangle - 1] = part;
  return 0;
}

static PetscErrorCode AddElement(GmshFile *f, int type, const GmshElement *e)
{
  const int order = type == TRIANGLE ? 1 : type == TRIANGLE_6 ? 2 : 0;
  if (order) {
    if (f->order && f->order != order)
      return GmshRefuse(f, "triangle %ld is of order %d, those before it of order %d", e->number, order,
                        f->order);
    f->order = order;
  }
  if (type == TRIANGLE) return AddPart(f, e, 0, 1, 2);
  if (type == LINE) return AddPart(f, e, 0, 1, -1);
  if (type == LINE_3) { /* ends, then the node between */
    GMSH_TRY(AddPart(f, e, 0, 2, -1));
    return AddPart(f, e, 2, 1, -1);
  }
  if (type != TRIANGLE_6) return 0;
  /* vertices 0, 1, 2, then the nodes after them: as MeshSerial has them */
  for (int i = 0; i < 3; i++) GMSH_TRY(AddPart(f, e, i, 3 + i, 3 + (i + 2) % 3));
  return AddPart(f, e, 3, 4, 5);
}

/* How many nodes an element of a type has; other types than points, lines and triangles are refused. */
static PetscErrorCode NodesOfType(const GmshFile *f, long number, int type, int *n)
{
  *n = type == POINT ? 1 : type == LINE_3 ? 3 : type == TRIANGLE_6 ? 6 : type + 1;
  if (type == POINT || type == LINE || type == TRIANGLE || type == LINE_3 || type == TRIANGLE_6) return 0;
  if (type == 3) return GmshRefuse(f, "element %ld is a quadrangle: only triangles are understood", number);
  return GmshRefuse(f, "element %ld is of Gmsh's type %d: only triangles are understood", number, type);
}

/* --- format 2.2 ------------------------------------------------------------------------------------------ */

PetscErrorCode GmshNodes22(GmshFile *f)
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

PetscErrorCode GmshElements22(GmshFile *f)
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

PetscErrorCode GmshEntities41(GmshFile *f)
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

PetscErrorCode GmshNodes41(GmshFile *f)
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

PetscErrorCode GmshElements41(GmshFile *f)
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
