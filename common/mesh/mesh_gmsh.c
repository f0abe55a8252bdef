/* From what a Gmsh file says to a mesh: every triangle is judged, the boundary found and named. */
#include "common/mesh/mesh_gmsh_impl.h"
#include "common/mesh/mesh_table.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define FLAT 1e-12 /* area over squared longest edge below which a triangle is degenerate */

static char why[512];

PetscErrorCode GmshRefuse(const GmshFile *file, const char *format, ...)
{
  const int n = snprintf(why, sizeof why, "%s: ", file->path);
  va_list arguments;
  va_start(arguments, format);
  if (n < (int)sizeof why) vsnprintf(why + n, sizeof why - (size_t)n, format, arguments);
  va_end(arguments);
  return PETSC_ERR_FILE_UNEXPECTED;
}

/* The vertices of a line or triangle in the file's list of nodes. */
static PetscErrorCode Vertices(const GmshFile *f, MeshTable *index, const char *what, const GmshElement *e,
                               int n, int v[])
{
  for (int k = 0; k < n; k++) {
    v[k] = *MeshTableAt(index, 0, e->node[k]);
    if (v[k] < 0)
      return GmshRefuse(f, "%s %ld has vertex %d, which does not exist", what, e->number, e->node[k]);
  }
  return 0;
}

/* Counter-clockwise, or refused where there is no area. */
static PetscErrorCode Turn(const GmshFile *f, const GmshElement *e, int v[3])
{
  double longest = 0.0;
  const double *a = f->node[v[0]].x, *b = f->node[v[1]].x, *c = f->node[v[2]].x;
  const double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  for (int i = 0; i < 3; i++) {
    const double *p = f->node[v[i]].x, *q = f->node[v[(i + 1) % 3]].x;
    longest = fmax(longest, (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]));
  }
  if (!(fabs(area) > FLAT * longest)) {
    return GmshRefuse(f, "triangle %ld (vertices %d %d %d) is degenerate: its area is %g", e->number,
                      e->node[0], e->node[1], e->node[2], area);
  }
  if (area < 0.0) {
    const int swap = v[1];
    v[1] = v[2];
    v[2] = swap;
  }
  return 0;
}

/* Numbers of nodes, and that all lie in one plane z = constant. */
static PetscErrorCode IndexNodes(const GmshFile *f, MeshTable *index)
{
  double largest = 0.0;
  for (size_t k = 0; k < f->nnode; k++) {
    const GmshNode *node = &f->node[k];
    int *at = MeshTableAt(index, 0, node->tag);
    if (*at >= 0) return GmshRefuse(f, "node %d comes twice", node->tag);
    *at = (int)k;
    for (int c = 0; c < 3; c++) {
      if (!isfinite(node->x[c])) return GmshRefuse(f, "node %d: its position is no number", node->tag);
    }
    largest = fmax(largest, fmax(fabs(node->x[0]), fabs(node->x[1])));
    if (fabs(node->x[2] - f->node[0].x[2]) > 1e-9 * largest) {
      return GmshRefuse(f, "node %d has z = %g: the mesh is not flat", node->tag, node->x[2]);
    }
  }
  return 0;
}

/* Triangles in the file's nodes; sides: the triangle on the left of each directed edge, which may be one
 * only. */
static PetscErrorCode Triangles(const GmshFile *f, MeshTable *index, MeshTable *sides, MeshSerial *m)
{
  m->ne = (int)f->ntriangle;
  GMSH_TRY(PetscMalloc1(3 * f->ntriangle, &m->vertex));
  for (int e = 0; e < m->ne; e++) {
    const GmshElement *triangle = &f->triangle[e];
    int *v = &m->vertex[3 * e];
    GMSH_TRY(Vertices(f, index, "triangle", triangle, 3, v));
    GMSH_TRY(Turn(f, triangle, v));
    for (int i = 0; i < 3; i++) {
      int *side = MeshTableAt(sides, v[i], v[(i + 1) % 3]);
      if (*side >= 0 && f->triangle[*side].number == triangle->number) /* of its own parts */
        return GmshRefuse(f,
                          "triangle %ld is folded: its nodes between the vertices are too far from the sides",
                          triangle->number);
      if (*side >= 0) {
        return GmshRefuse(f, "triangle %ld repeats or overlaps triangle %ld", triangle->number,
                          f->triangle[*side].number);
      }
      *side = e;
    }
  }
  return 0;
}

static void SwapTriangles(int *a, int *b)
{
  for (int i = 0; i < 3; i++) {
    const int vertex = a[i];
    a[i] = b[i];
    b[i] = vertex;
  }
}

/* The parts of triangles of second order as MeshSerial has them: a triangle given clockwise, whose parts have been turned, changes the
 * order of its vertices. */
static void OrderParts(MeshSerial *m)
{
  m->order = 2;
  for (int e = 0; e < m->ne; e += 4) {
    int *a = m->vertex + 3 * e, *b = a + 3, *c = b + 3, *middle = c + 3;
    if (a[1] != b[2]) SwapTriangles(b, c);
    middle[0] = a[1];
    middle[1] = b[1];
    middle[2] = c[1];
  }
}

/* The name of a physical group; its number where it has none. */
static void NameOf(const GmshFile *f, int dim, int physical, char name[64])
{
  snprintf(name, 64, "%d", physical);
  for (size_t k = 0; k < f->nname; k++) {
    if (f->name[k].dim == dim && f->name[k].tag == physical) strcpy(name, f->name[k].name);
  }
}

/* The place of a name in a list that grows. */
static PetscErrorCode PlaceOf(const char *name, int *n, char (**list)[64], int *place)
{
  for (*place = 0; *place < *n; ++*place) {
    if (!strcmp((*list)[*place], name)) return 0;
  }
  GMSH_TRY(PetscRealloc((size_t)(*n + 1) * sizeof **list, list));
  strcpy((*list)[(*n)++], name);
  return 0;
}

/* The named lines: the physical group of each edge, the first where there are several. */
static PetscErrorCode Lines(const GmshFile *f, MeshTable *index, MeshTable *named)
{
  for (size_t k = 0; k < f->nline; k++) {
    int v[2];
    GMSH_TRY(Vertices(f, index, "line", &f->line[k], 2, v));
    int *physical = MeshTableEdge(named, v[0], v[1]);
    if (f->line[k].physical && *physical < 0) *physical = f->line[k].physical;
  }
  return 0;
}

/* Boundary edges: those with no triangle on their right. */
static PetscErrorCode Boundary(const GmshFile *f, MeshTable *sides, MeshTable *named, MeshSerial *m)
{
  GMSH_TRY(PetscMalloc1(6 * (size_t)m->ne, &m->facet));
  GMSH_TRY(PetscMalloc1(3 * (size_t)m->ne, &m->facet_tag));
  for (int k = 0; k < 3 * m->ne; k++) {
    const int a = m->vertex[k], b = m->vertex[k - k % 3 + (k + 1) % 3];
    char name[64] = "boundary";
    if (*MeshTableAt(sides, b, a) >= 0) continue;
    const int physical = *MeshTableEdge(named, a, b);
    if (physical > 0) NameOf(f, 1, physical, name);
    GMSH_TRY(PlaceOf(name, &m->ntags, &m->tag_name, &m->facet_tag[m->nb]));
    m->facet[2 * m->nb] = a;
    m->facet[2 * m->nb + 1] = b;
    m->nb++;
  }
  return 0;
}

/* Physical curves between triangles, if the file has any. */
static PetscErrorCode Curves(const GmshFile *f, MeshTable *sides, MeshTable *named, MeshSerial *m)
{
  for (int k = 0; k < 3 * m->ne; k++) {
    const int a = m->vertex[k], b = m->vertex[k - k % 3 + (k + 1) % 3],
              physical = *MeshTableEdge(named, a, b);
    char name[64];
    if (physical <= 0 || *MeshTableAt(sides, b, a) < 0) continue;
    if (!m->curve) {
      GMSH_TRY(PetscMalloc1(3 * (size_t)m->ne, &m->curve));
      for (int i = 0; i < 3 * m->ne; i++) m->curve[i] = -1;
    }
    NameOf(f, 1, physical, name);
    GMSH_TRY(PlaceOf(name, &m->ncurves, &m->curve_name, &m->curve[k]));
  }
  return 0;
}

/* Physical surfaces, if the file has any; triangles in none of them are of the region "none". */
static PetscErrorCode Regions(const GmshFile *f, MeshSerial *m)
{
  int any = 0, last = -1;
  for (int e = 0; e < m->ne; e++) any |= f->triangle[e].physical;
  if (!any) return 0;
  GMSH_TRY(PetscMalloc1((size_t)m->ne, &m->region));
  for (int e = 0; e < m->ne; e++) {
    const int physical = f->triangle[e].physical;
    char name[64] = "none";
    if (physical == last) { /* the usual case, without a search */
      m->region[e] = m->region[e - 1];
      continue;
    }
    if (physical) NameOf(f, 2, physical, name);
    GMSH_TRY(PlaceOf(name, &m->nregions, &m->region_name, &m->region[e]));
    last = physical;
  }
  return 0;
}

/* Keeps the nodes that triangles use, in the order of the file. */
static PetscErrorCode Compress(const GmshFile *f, MeshSerial *m)
{
  int *place;
  GMSH_TRY(PetscCalloc1(f->nnode, &place));
  GMSH_TRY(PetscMalloc1(2 * f->nnode, &m->x));
  for (int k = 0; k < 3 * m->ne; k++) place[m->vertex[k]] = 1;
  for (size_t k = 0; k < f->nnode; k++) {
    if (!place[k]) continue;
    place[k] = m->nv;
    for (int c = 0; c < 2; c++) m->x[2 * m->nv + c] = f->node[k].x[c];
    m->nv++;
  }
  for (int k = 0; k < 3 * m->ne; k++) m->vertex[k] = place[m->vertex[k]];
  for (int k = 0; k < 2 * m->nb; k++) m->facet[k] = place[m->facet[k]];
  return PetscFree(place);
}

static PetscErrorCode Convert(const GmshFile *f, MeshTable *index, MeshTable *sides, MeshTable *named,
                              MeshSerial *m)
{
  GMSH_TRY(IndexNodes(f, index));
  GMSH_TRY(Triangles(f, index, sides, m));
  if (f->order == 2) OrderParts(m);
  GMSH_TRY(Lines(f, index, named));
  GMSH_TRY(Boundary(f, sides, named, m));
  GMSH_TRY(Curves(f, sides, named, m));
  GMSH_TRY(Regions(f, m));
  return Compress(f, m);
}

static PetscErrorCode Judge(const GmshFile *f, MeshSerial *m)
{
  MeshTable index, sides, named;
  if (!f->ntriangle)
    return GmshRefuse(
        f, "no triangles: where there are physical curves Gmsh writes those of physical surfaces alone");
  if (f->ntriangle > INT32_MAX / 6 || f->nnode > INT32_MAX / 2) return GmshRefuse(f, "too large a mesh");
  GMSH_TRY(MeshTableCreate(&index, f->nnode));
  GMSH_TRY(MeshTableCreate(&sides, 3 * f->ntriangle));
  GMSH_TRY(MeshTableCreate(&named, f->nline));
  const PetscErrorCode refused = Convert(f, &index, &sides, &named, m);
  GMSH_TRY(MeshTableDestroy(&index));
  GMSH_TRY(MeshTableDestroy(&sides));
  GMSH_TRY(MeshTableDestroy(&named));
  return refused;
}

PetscErrorCode MeshReadGmsh(const char *path, MeshSerial *mesh, const char **error)
{
  GmshFile file = {.path = path};
  PetscFunctionBeginUser;
  memset(mesh, 0, sizeof *mesh);
  snprintf(why, sizeof why, "%s: out of memory", path);
  PetscErrorCode refused = GmshParse(&file);
  if (!refused) refused = Judge(&file, mesh);
  PetscCall(PetscFree(file.data));
  PetscCall(PetscFree(file.node));
  PetscCall(PetscFree(file.line));
  PetscCall(PetscFree(file.triangle));
  PetscCall(PetscFree(file.name));
  PetscCall(PetscFree(file.entity));
  *error = refused ? why : NULL;
  if (refused) PetscCall(MeshSerialDestroy(mesh));
  PetscFunctionReturn(refused);
}
