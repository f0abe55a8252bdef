#include "common/mesh/mesh_delaunay.h"
#include "common/supermesh/geometry.h"
#include "common/supermesh/outline.h"

/* An edge is swapped where the angles that see it exceed half a turn by more than round-off. */
#define SWAP 1e-10

/* Room for one vertex and two triangles more. */
static PetscErrorCode Reserve(Delaunay *d)
{
  PetscFunctionBeginUser;
  if (d->nv == d->vertices) {
    d->vertices = 2 * d->vertices + 64;
    PetscCall(PetscRealloc((size_t)d->vertices * sizeof *d->x, &d->x));
  }
  if (d->ne + 2 > d->triangles) {
    d->triangles = 2 * d->triangles + 64;
    PetscCall(PetscRealloc((size_t)d->triangles * sizeof *d->vertex, &d->vertex));
    PetscCall(PetscRealloc((size_t)d->triangles * sizeof *d->across, &d->across));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Push(Delaunay *d, int t, int i)
{
  PetscFunctionBeginUser;
  if (d->nedge == d->edges) {
    d->edges = 2 * d->edges + 64;
    PetscCall(PetscRealloc((size_t)d->edges * sizeof *d->edge, &d->edge));
  }
  d->edge[d->nedge++] = 3 * t + i;
  PetscFunctionReturn(0);
}

static void Set(Delaunay *d, int t, int a, int b, int c, int across_a, int across_b, int across_c)
{
  d->vertex[t][0] = a, d->vertex[t][1] = b, d->vertex[t][2] = c;
  d->across[t][0] = across_a, d->across[t][1] = across_b, d->across[t][2] = across_c;
}

static int FaceTo(const Delaunay *d, int t, int other)
{
  int i = 0;
  while (i < 2 && d->across[t][i] != other) i++;
  return i;
}

/* Triangle t, or a side, has another neighbour. */
static void Reconnect(Delaunay *d, int t, int old, int new)
{
  if (t >= 0) d->across[t][FaceTo(d, t, old)] = new;
}

/* Cosine and sine, times the lengths, of the angle at p between a and b. */
static void AngleAt(const double p[2], const double a[2], const double b[2], double angle[2])
{
  angle[0] = (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]);
  angle[1] = GeometryTurn(p, a, b);
}

/* Whether the edge opposite to corner i of t and corner j of u violates the Delaunay property. */
static int IsWrong(const Delaunay *d, int t, int i, int u, int j)
{
  const double *a = DelaunayCorner(d, t, i), *b = DelaunayCorner(d, t, i + 1),
               *c = DelaunayCorner(d, t, i + 2), *e = DelaunayCorner(d, u, j);
  double one[2], other[2];
  AngleAt(a, b, c, one);
  AngleAt(e, c, b, other);
  const double sine = one[1] * other[0] + one[0] * other[1];
  return sine < -SWAP * hypot(one[0], one[1]) * hypot(other[0], other[1]) && GeometryTurn(a, b, e) > 0.0 &&
         GeometryTurn(a, e, c) > 0.0;
}

/* Until no edge of the list is wrong.
 *
 *         a                a
 *        /t\              /|\         t = (a, b, e), u = (a, e, c)
 *       b---c    ->      b | c
 *        \u/              \|/
 *         e                e                                                                                */
static PetscErrorCode Swap(Delaunay *d)
{
  PetscFunctionBeginUser;
  while (d->nedge) {
    const int edge = d->edge[--d->nedge], t = edge / 3, i = edge % 3, u = d->across[t][i];
    if (u < 0) continue;
    const int j = FaceTo(d, u, t);
    if (!IsWrong(d, t, i, u, j)) continue;
    const int a = d->vertex[t][i], b = d->vertex[t][(i + 1) % 3], c = d->vertex[t][(i + 2) % 3],
              e = d->vertex[u][j];
    const int ca = d->across[t][(i + 1) % 3], ab = d->across[t][(i + 2) % 3], be = d->across[u][(j + 1) % 3],
              ec = d->across[u][(j + 2) % 3];
    Set(d, t, a, b, e, be, u, ab);
    Set(d, u, a, e, c, ec, ca, t);
    Reconnect(d, be, u, t);
    Reconnect(d, ca, t, u);
    PetscCall(Push(d, t, 0));
    PetscCall(Push(d, t, 2));
    PetscCall(Push(d, u, 0));
    PetscCall(Push(d, u, 1));
  }
  PetscFunctionReturn(0);
}

static int AddVertex(Delaunay *d, const double at[2])
{
  d->x[d->nv][0] = at[0];
  d->x[d->nv][1] = at[1];
  return d->nv++;
}

PetscErrorCode DelaunaySplitTriangle(Delaunay *d, int t, const double at[2])
{
  PetscFunctionBeginUser;
  PetscCall(Reserve(d));
  const int p = AddVertex(d, at), u = d->ne++, w = d->ne++;
  const int a = d->vertex[t][0], b = d->vertex[t][1], c = d->vertex[t][2];
  const int bc = d->across[t][0], ca = d->across[t][1], ab = d->across[t][2];
  Set(d, t, p, b, c, bc, u, w);
  Set(d, u, p, c, a, ca, w, t);
  Set(d, w, p, a, b, ab, t, u);
  Reconnect(d, ca, t, u);
  Reconnect(d, ab, t, w);
  PetscCall(Push(d, t, 0));
  PetscCall(Push(d, u, 0));
  PetscCall(Push(d, w, 0));
  PetscCall(Swap(d));
  PetscFunctionReturn(0);
}

PetscErrorCode DelaunaySplitSide(Delaunay *d, int t, int i, const double at[2])
{
  PetscFunctionBeginUser;
  PetscCall(Reserve(d));
  const int p = AddVertex(d, at), u = d->ne++;
  const int a = d->vertex[t][i], b = d->vertex[t][(i + 1) % 3], c = d->vertex[t][(i + 2) % 3];
  const int side = d->across[t][i], ca = d->across[t][(i + 1) % 3], ab = d->across[t][(i + 2) % 3];
  Set(d, t, p, a, b, ab, side, u);
  Set(d, u, p, c, a, ca, t, side);
  Reconnect(d, ca, t, u);
  PetscCall(Push(d, t, 0));
  PetscCall(Push(d, u, 0));
  PetscCall(Swap(d));
  PetscFunctionReturn(0);
}

PetscErrorCode DelaunayRestore(Delaunay *d)
{
  PetscFunctionBeginUser;
  for (int t = 0; t < d->ne; t++) {
    for (int i = 0; i < 3; i++) PetscCall(Push(d, t, i));
  }
  PetscCall(Swap(d));
  PetscFunctionReturn(0);
}

/* The triangle across the edge from corner a to b, or the polygon's side. */
static int FindAcross(const Delaunay *d, int n, int a, int b)
{
  if ((a + 1) % n == b) return -1 - a;
  if ((b + 1) % n == a) return -1 - b;
  for (int t = 0; t < d->ne; t++)
    for (int i = 0; i < 3; i++)
      if (d->vertex[t][i] == b && d->vertex[t][(i + 1) % 3] == a) return t;
  return -1;
}

PetscErrorCode DelaunayCreate(int n, const double corner[][2], Delaunay *d)
{
  PetscFunctionBeginUser;
  *d = (Delaunay){.vertices = n, .triangles = n};
  PetscCall(PetscMalloc1(n, &d->x));
  PetscCall(PetscMalloc1(n, &d->vertex));
  PetscCall(PetscMalloc1(n, &d->across));
  for (int k = 0; k < n; k++) AddVertex(d, corner[k]);
  d->ne = OutlineTriangles(n, corner, d->vertex);
  PetscCheck(d->ne == n - 2, PETSC_COMM_SELF, PETSC_ERR_ARG_INCOMP, "a polygon that meets itself");
  for (int t = 0; t < d->ne; t++)
    for (int i = 0; i < 3; i++)
      d->across[t][i] = FindAcross(d, n, d->vertex[t][(i + 1) % 3], d->vertex[t][(i + 2) % 3]);
  PetscCall(DelaunayRestore(d));
  PetscFunctionReturn(0);
}

PetscErrorCode DelaunayDestroy(Delaunay *d)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(d->x));
  PetscCall(PetscFree(d->vertex));
  PetscCall(PetscFree(d->across));
  PetscCall(PetscFree(d->edge));
  PetscFunctionReturn(0);
}

int DelaunayWalk(const Delaunay *d, int t, const double to[2], int *face)
{
  *face = -1;
  for (int step = 0; step < d->ne; step++) {
    int i = 0;
    while (i < 3 && GeometryTurn(DelaunayCorner(d, t, i + 1), DelaunayCorner(d, t, i + 2), to) >= 0.0) i++;
    if (i == 3) return t;
    if (d->across[t][i] < 0) {
      *face = i;
      return t;
    }
    t = d->across[t][i];
  }
  return -1; /* it went in a circle */
}
