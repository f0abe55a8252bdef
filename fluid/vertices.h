/* The vertices of the mesh as nodes of P1, numbered over all ranks: the owner of a P2 node that is a vertex owns
 * it here, too, and keeps its order. */
#ifndef FLUID_VERTICES_H
#define FLUID_VERTICES_H
#include "common/mesh/mesh.h"

/* number[np2]: global number of the P2 node as a vertex, -1 if it is none; *owned: how many this rank owns.
 * Collective. */
PetscErrorCode VerticesNumber(const Mesh *mesh, PetscInt *owned, double number[]);
#endif
