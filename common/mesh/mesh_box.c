/* The box mesher: a balanced quadtree (mesh_quadtree.h), of which every leaf is cut:
 *
 *   +-------+  no neighbour is finer: two triangles,    +-------+  a neighbour is finer: a fan about the
 *   |\      |  the diagonal alternates like a chess     |\     /|  centre; each hanging node (o) splits
 *   |  \    |  board (union jack), so that no           |  \ /  |  one of its triangles in two
 *   |    \  |  direction is preferred                   |  /|\  |
 *   |      \|                                           |/  |  \|
 *   +-------+                                           +---o---+
 *
 * Square cells give angles of 45 and 90 degrees only.  Cells are stretched to fit the box, at most 2:1, which
 * leaves atan(1/2) = 26.6 degrees in the worst case. */
#include "common/mesh/mesh.h"
#include "common/mesh/mesh_quadtree.h"
#include "common/mesh/mesh_table.h"
#include <string.h>

enum { LEFT, RIGHT, BOTTOM, TOP, SIDES };
static const char *const SIDE_NAME[SIDES] = {"left", "right", "bottom", "top"};

/* What cutting adds to the mesh. */
typedef struct {
  MeshSerial *mesh;
  MeshTable vertex; /* of a position in the tree */
} Cutting;

static int AddVertex(const Quadtree *t, MeshSerial *m, int x, int y)
{
  m->x[2 * m->nv] = QuadtreeCoordinate(t, 0, x);
  m->x[2 * m->nv + 1] = QuadtreeCoordinate(t, 1, y);
  return m->nv++;
}

static int VertexAt(const Quadtree *t, Cutting *cut, int x, int y)
{
  int *v = MeshTableAt(&cut->vertex, x, y);
  if (*v < 0) *v = AddVertex(t, cut->mesh, x, y);
  return *v;
}

static void AddTriangle(MeshSerial *m, int a, int b, int c)
{
  int *v = &m->vertex[3 * m->ne++];
  v[0] = a;
  v[1] = b;
  v[2] = c;
}

static void AddFacet(MeshSerial *m, int a, int b, int tag)
{
  m->facet[2 * m->nb] = a;
  m->facet[2 * m->nb + 1] = b;
  m->facet_tag[m->nb++] = tag;
}

static void CutLeaf(const Quadtree *t, Cutting *cut, int c)
{
  static const int DIRECTION[4][2] = {
      {0, -1}, {1, 0}, {0, 1}, {-1, 0}}; /* across side k: from corner k to k + 1 */
  static const int TAG[4] = {BOTTOM, RIGHT, TOP, LEFT};
  const QuadtreeCell *cell = &t->cell[c];
  const int w = QuadtreeWidth(t, cell->level), half = w / 2, ring_x[4] = {0, w, w, 0},
            ring_y[4] = {0, 0, w, w};
  int corner[4], middle[4], hanging = 0;
  for (int k = 0; k < 4; k++) corner[k] = VertexAt(t, cut, cell->x + ring_x[k], cell->y + ring_y[k]);
  for (int k = 0; k < 4; k++) {
    const int beside = QuadtreeBeside(t, c, DIRECTION[k][0], DIRECTION[k][1]), next = (k + 1) % 4;
    middle[k] = -1;
    if (beside < 0) AddFacet(cut->mesh, corner[k], corner[next], TAG[k]);
    if (beside < 0 || t->cell[beside].level <= cell->level) continue;
    middle[k] =
        VertexAt(t, cut, cell->x + (ring_x[k] + ring_x[next]) / 2, cell->y + (ring_y[k] + ring_y[next]) / 2);
    hanging++;
  }
  if (!hanging) {
    const int first = (cell->x / w + cell->y / w) & 1; /* where the diagonal starts */
    AddTriangle(cut->mesh, corner[first], corner[first + 1], corner[first + 2]);
    AddTriangle(cut->mesh, corner[first], corner[first + 2], corner[(first + 3) % 4]);
    return;
  }
  const int centre = AddVertex(t, cut->mesh, cell->x + half, cell->y + half);
  for (int k = 0; k < 4; k++) {
    const int next = corner[(k + 1) % 4];
    if (middle[k] >= 0) AddTriangle(cut->mesh, corner[k], middle[k], centre);
    AddTriangle(cut->mesh, middle[k] >= 0 ? middle[k] : corner[k], next, centre);
  }
}

/* Counts are bounded by what every leaf can add: 4 corners and a centre, 8 triangles, 4 boundary edges. */
static PetscErrorCode Cut(const Quadtree *t, MeshSerial *m)
{
  const size_t n = (size_t)t->nleaf;
  Cutting cut = {.mesh = m};
  PetscFunctionBeginUser;
  PetscCall(MeshTableCreate(&cut.vertex, 4 * n));
  PetscCall(PetscMalloc1(2 * 5 * n, &m->x));
  PetscCall(PetscMalloc1(3 * 8 * n, &m->vertex));
  PetscCall(PetscMalloc1(2 * 4 * n, &m->facet));
  PetscCall(PetscMalloc1(4 * n, &m->facet_tag));
  for (int c = 0; c < t->ncell; c++) {
    if (!t->cell[c].child) CutLeaf(t, &cut, c);
  }
  PetscCall(PetscRealloc(2 * (size_t)m->nv * sizeof *m->x, &m->x));
  PetscCall(PetscRealloc(3 * (size_t)m->ne * sizeof *m->vertex, &m->vertex));
  PetscCall(PetscRealloc(2 * (size_t)m->nb * sizeof *m->facet, &m->facet));
  PetscCall(PetscRealloc((size_t)m->nb * sizeof *m->facet_tag, &m->facet_tag));
  PetscCall(MeshTableDestroy(&cut.vertex));
  m->ntags = SIDES;
  PetscCall(PetscCalloc1(SIDES, &m->tag_name));
  for (int k = 0; k < SIDES; k++) strcpy(m->tag_name[k], SIDE_NAME[k]);
  PetscFunctionReturn(0);
}

PetscErrorCode MeshBox(const double lower[2], const double upper[2], double size_max,
                       double (*size)(void *context, const double x[2]), void *context, MeshSerial *mesh)
{
  Quadtree t = {.lower = {lower[0], lower[1]},
                .upper = {upper[0], upper[1]},
                .size_max = size_max,
                .size = size,
                .context = context};
  PetscFunctionBeginUser;
  memset(mesh, 0, sizeof *mesh);
  PetscCall(QuadtreeBuild(&t));
  PetscCall(Cut(&t, mesh));
  PetscCall(PetscFree(t.cell));
  PetscFunctionReturn(0);
}
