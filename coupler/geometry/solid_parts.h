/* The connected parts of the solid: bodies, or what cracks have made of them. */
#ifndef CORACLE_SOLID_PARTS_H
#define CORACLE_SOLID_PARTS_H
#include "common/exchange/copies.h"
#include "coupler/geometry/solid_state.h"

/* Collective.  On all ranks: the solid's nodes as copies of the part that they belong to.  nodes: the solid's own copies. */
PetscErrorCode SolidPartsCreate(MPI_Comm comm, const SolidState *solid, Copies nodes, Copies *parts);
/* Collective.  area[nnodes]: of the part that a node belongs to, m2. */
PetscErrorCode SolidPartsAreas(const SolidState *solid, Copies parts, double area[]);
#endif
