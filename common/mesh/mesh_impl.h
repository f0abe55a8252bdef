/* Private to the mesh room: what rank 0 works out about the whole mesh before it hands out the parts. */
#ifndef CORACLE_MESH_IMPL_H
#define CORACLE_MESH_IMPL_H
#include "mesh.h"

/* Faces of a MeshSerial; arrays are [ne][3], face i opposite to vertex i. */
typedef struct {
  int nedge;
  int *edge;     /* number of the edge that is face i */
  int *neighbor; /* element across, -1 on the boundary */
  int *face;     /* which face of the neighbour it is, -1 on the boundary */
  int *tag;      /* boundary name, -1 inside */
} MeshFaces;

/* Errors: an edge of more than two triangles, two neighbours that turn opposite ways, a boundary edge without
 * a name. */
PetscErrorCode MeshFacesCreate(const MeshSerial *serial, MeshFaces *faces);
PetscErrorCode MeshFacesDestroy(MeshFaces *faces);

/* Reverse Cuthill-McKee order of each part's elements (George and Liu, 1981): order[start[r] .. start[r + 1]
 * - 1] lists the elements of part r, neighbours close to each other, which keeps ILU factors accurate and
 * caches warm. */
PetscErrorCode MeshOrder(int ne, const int neighbor[], int nparts, const int part[], int start[],
                         int order[]);
#endif
