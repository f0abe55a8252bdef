/* Private to the mesh room: the constrained Delaunay triangulation of a polygon, to which points are added.  Its sides stay; any other edge
 * has the Delaunay property (Lawson 1977).  On one rank. */
#ifndef CORACLE_MESH_DELAUNAY_H
#define CORACLE_MESH_DELAUNAY_H
#include <petscsys.h>

typedef struct {
  int nv, ne, vertices, triangles; /* the last two: room for so many */
  double (*x)[2];                  /* [nv], m */
  int (*vertex)[3];                /* [ne] counter-clockwise */
  int (*across)[3];        /* [ne] the triangle across the edge opposite to corner i; of side s: -1 - s */
  int *edge, nedge, edges; /* edges to be looked at, 3 triangle + i; how many; room */
} Delaunay;

/* Of a simple polygon, corners in either sense; they are its first vertices.  Destroy it on failure, too. */
PetscErrorCode DelaunayCreate(int n, const double corner[][2], Delaunay *d);
PetscErrorCode DelaunayDestroy(Delaunay *d);
/* A vertex more, in triangle t or at a place of the polygon's side that is face i of it. */
PetscErrorCode DelaunaySplitTriangle(Delaunay *d, int t, const double at[2]);
PetscErrorCode DelaunaySplitSide(Delaunay *d, int t, int i, const double at[2]);
/* After vertices have moved, no triangle having turned over. */
PetscErrorCode DelaunayRestore(Delaunay *d);
/* From triangle t towards a point: the triangle that holds it and *face -1; or where the way ends at a side of the polygon, that face. */
int DelaunayWalk(const Delaunay *d, int t, const double to[2], int *face);

static inline const double *DelaunayCorner(const Delaunay *d, int t, int i)
{
  return d->x[d->vertex[t][i % 3]];
}
#endif
