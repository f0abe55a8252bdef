/* Private to the mesh room: a Mesh in the making. */
#ifndef CORACLE_MESH_BUILD_H
#define CORACLE_MESH_BUILD_H
#include "common/mesh/mesh_impl.h"

typedef struct {
  const MeshSerial *part; /* borrowed */
  PartFaces faces;
  int *order;     /* [ne] element of the part that has this number in the Mesh */
  int *number;    /* [ne] and the other way */
  int *vertex;    /* [nv] local vertex of the Mesh, -1 for one of no element */
  char *foreign;  /* [nv] nonzero if a lower rank owns it */
  PetscInt *vgid; /* [nv] global number in the Mesh */
} Build;

/* What the other side of a face tells of its element, for element `target` / 3 at face `target` % 3. */
typedef struct {
  long long target, egid, vgid; /* vgid: of the vertex opposite to the face */
  int face, element;            /* element: local number here, given on arrival */
  double x[2];                  /* of that vertex */
} Ghost;

typedef struct {
  int n;        /* faces to other ranks */
  Ghost *ghost; /* [n] by ascending egid */
} Ghosts;

/* Collective: asks across all faces to other ranks, once the vertices have their numbers; sets mesh->ng. */
PetscErrorCode GhostsCreate(const Build *b, Mesh *mesh, Ghosts *ghosts);
PetscErrorCode GhostsDestroy(Ghosts *ghosts);
/* Not collective: ghost elements, their vertices, and the neighbours of faces to other ranks. */
PetscErrorCode GhostsFill(const Build *b, const Ghosts *ghosts, Mesh *mesh);
#endif
