/* A distributed mesh of triangles, what the fluid computes on.  Made on rank 0 (box mesher or Gmsh file),
 * partitioned with METIS, or built from parts that are on all ranks already (part.h); one layer of
 * face-neighbour ghosts, elements renumbered for locality on each rank.
 *
 *            2
 *           / \
 *        1 /   \ 0
 *         /     \
 *        0---2---1
 *
 * Local vertex i; face i lies opposite to vertex i, from vertex (i+1)%3 to (i+2)%3, so that the outward
 * normal is the right-hand side of that direction (elements are counter-clockwise); edge i lies there, too.
 * Functions on a mesh are in common/space. */
#ifndef CORACLE_MESH_H
#define CORACLE_MESH_H
#include <petscsys.h>

typedef struct {
  MPI_Comm comm;   /* borrowed */
  int dim;         /* 2 */
  int nv;          /* local vertices: of owned elements, then those of ghosts alone */
  double *x;       /* [nv][2], m */
  int nv_owned;    /* vertices of owned elements belong to the lowest rank that has such an element */
  PetscInt vstart; /* owned vertices: global numbers vstart .. vstart + nv_owned - 1, as elements meet them */
  PetscInt nv_global; /* vertices on all ranks */
  PetscInt *vgid;     /* [nv] global vertex numbers */
  int ne, ng;  /* owned elements; ghosts follow: share a face with an owned element, owned by another rank */
  int *vertex; /* [ne + ng][3] local vertices, counter-clockwise */
  PetscInt estart;           /* owned elements have global numbers estart .. estart + ne - 1 */
  PetscInt nglobal;          /* elements on all ranks */
  PetscInt *egid;            /* [ne + ng] global element numbers */
  int *neighbor;             /* [ne][3] local element across face i, or -1 on the boundary */
  int *neighbor_face;        /* [ne][3] which face of the neighbour it is, or -1 */
  int *tag;                  /* [ne][3] index of the boundary's name for boundary faces, else -1 */
  int ntags;                 /* boundary names, the same on all ranks */
  char (*tag_name)[64];      /* [ntags] */
  int nedge;                 /* edges of owned elements */
  int *edge;                 /* [ne][3] local edges */
  double lower[2], upper[2]; /* bounds of the whole domain */
} Mesh;

/* An undistributed mesh (rank 0 only; empty elsewhere). */
typedef struct {
  int nv, ne, nb;
  double *x;      /* [nv][2] */
  int *vertex;    /* [ne][3] counter-clockwise */
  int *facet;     /* [nb][2] boundary edges */
  int *facet_tag; /* [nb] */
  int ntags;
  char (*tag_name)[64];
  int *region; /* [ne] or NULL: physical surface of each element */
  int nregions;
  char (*region_name)[64];
  int *curve; /* [ne][3] or NULL: physical curve of each side between two triangles, -1 without one */
  int ncurves;
  char (*curve_name)[64];
  int order; /* 2: a mesh of second order; four elements are one of its triangles, those at its vertices (vertex, node after
                it, node before it), counter-clockwise, then the middle one; else 0 */
} MeshSerial;

/* A graded mesh of [lower, upper]: a balanced quadtree of cells cut into triangles without hanging nodes.
 * size(context, x) is the wanted cell edge, m, at a point; cells are halved until their edge is at most the
 * smallest size in them and at most size_max (a diagonal is sqrt 2 longer).  A cell looks at 3 x 3 points:
 * what is narrower than half of size_max is found if the size grows gently around it.  Boundaries are named
 * left, right, bottom, top.  Not collective. */
PetscErrorCode MeshBox(const double lower[2], const double upper[2], double size_max,
                       double (*size)(void *context, const double x[2]), void *context, MeshSerial *mesh);
/* A mesh of edges of about size, m, of a polygon that does not meet itself: corners in either sense; name[n]: of the sides, side k from corner k to the
 * next one, those of one name a boundary.  Sides have edges not longer than size; beside features that are smaller than it, down to a hundredth,
 * edges are, too.  It repeats itself to the last bit.  Not collective. */
PetscErrorCode MeshPolygon(int n, const double corner[][2], const char *const name[], double size,
                           MeshSerial *mesh);
/* Not collective: about how many triangles it has, beside small features more. */
double MeshPolygonCount(int n, const double corner[][2], double size);
/* Gmsh .msh, ASCII or binary, formats 2.2 and 4.1: triangles, of first order or all of second, boundary edges from physical curves (their
 * names; a boundary edge without one is called "boundary"), and those between triangles.  Triangles given clockwise are turned; a
 * degenerate or repeated one, or one with a vertex that does not exist, is an error that names file and
 * element.  On failure *error (a static buffer) says why and a PETSc error code is returned without a
 * trace-back. */
PetscErrorCode MeshReadGmsh(const char *path, MeshSerial *mesh, const char **error);
/* Not collective: the number of connected components, which share no vertex. */
PetscErrorCode MeshSerialComponents(const MeshSerial *mesh, int *components);
PetscErrorCode MeshSerialDestroy(MeshSerial *mesh);

/* Collective: partitions and distributes what rank 0 holds.  Same global mesh for any number of ranks. */
PetscErrorCode MeshDistribute(MPI_Comm comm, const MeshSerial *serial, Mesh **mesh);
PetscErrorCode MeshDestroy(Mesh **mesh);
/* Not collective: the index of a boundary's name in tag_name, -1 if the mesh has none of that name. */
int MeshTagIndex(const Mesh *mesh, const char *name);
/* Not collective: the vertices of element e, m. */
static inline void MeshCorners(const Mesh *mesh, PetscInt e, double x[3][2])
{
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 2; c++) x[i][c] = mesh->x[2 * mesh->vertex[3 * e + i] + c];
}
#endif
