/* Six-node triangles: linear strain. */
#ifndef SOLID_SIX_NODE_H
#define SOLID_SIX_NODE_H
#include "common/mesh/mesh.h"

/* What an element of the model is of a six-node triangle; its own corners are
 *
 *        c              corner e:      vertex e, the node after it, the node before it   (counter-clockwise)
 *       / \             middle:        the nodes on ab, bc, ca
 *     ca---bc
 *     / \ / \           Four elements one after the other: the corners at a, b, c, the middle.
 *    a---ab--b */
typedef enum { NOT_SIX_NODE, SIX_NODE_A, SIX_NODE_B, SIX_NODE_C, SIX_NODE_MIDDLE } SixNodePart;

/* It has a third of the triangle's stiffness; the middle has none. */
static inline PetscBool SixNodeIsCorner(int part)
{
  return part >= SIX_NODE_A && part <= SIX_NODE_C ? PETSC_TRUE : PETSC_FALSE;
}

/* Each triangle becomes the four of a six-node triangle, with nodes halfway along its sides; boundaries and regions go along,
 * and position[nv][2], if there is any; mesh->order is 2 then.  Not collective. */
PetscErrorCode SixNodeSplit(MeshSerial *mesh, double **position);
#endif
