/* The continuous quadratic functions (P2) on a distributed mesh: the numbers of their nodes.
 *
 *            2            node i: vertex i of the element; node 3 + i: midpoint of its edge i, opposite to vertex i
 *           / \           (kernels: p2.h).
 *          4   3
 *         /     \         A node belongs to the lowest rank that has an element with it.  Local numbers: nodes that
 *        0---5---1        this rank owns, then those of its elements that lower ranks own. */
#ifndef CORACLE_P2_SPACE_H
#define CORACLE_P2_SPACE_H
#include "common/mesh/mesh.h"

typedef struct {
  int n, nowned;  /* nodes of the owned elements on this rank: owned nodes come first */
  PetscInt start; /* owned nodes have global numbers start .. start + nowned - 1, as the elements meet them */
  PetscInt nglobal; /* nodes on all ranks */
  PetscInt *gid;    /* [n] global numbers */
  int *node;        /* [mesh->ne][6] local nodes */
} P2Space;

/* Collective over mesh->comm, on any number of ranks.  The mesh is not kept. */
PetscErrorCode P2SpaceCreate(const Mesh *mesh, P2Space **space);
PetscErrorCode P2SpaceDestroy(P2Space **space);
#endif
