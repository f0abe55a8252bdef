/* Which rank gets which element.  Not collective: one process computes it.
 *
 * METIS cuts a graph of elements into parts of equal work with as little between them as it finds.  Links:
 * elements that share an edge, and hold together (8); edges near an element of another body (4, computed by
 * one rank for both); and each element with the next one along a Hilbert curve through all (1), so that
 * bodies which do not touch are dealt out by where they are. */
#ifndef SOLID_PARTITION_H
#define SOLID_PARTITION_H
#include "solid/bodies/model.h"

enum { LINK_CURVE = 1, LINK_PARTED = 2, LINK_NEAR = 4, LINK_INTACT = 8 };
enum { WORK_ELEMENT = 2, WORK_CANDIDATE = 6 }; /* of an element's forces, and of a candidate of contact */

typedef struct {
  int a, b, weight; /* two elements; weights of equal pairs add up */
} PartitionLink;

typedef struct {
  int nlinks, capacity;
  PartitionLink *link;
  int *work;       /* [nelements] */
  double (*at)[2]; /* [nelements] centre now, m */
} PartitionGraph;

/* Every element with WORK_ELEMENT of work; at is not set; links of elements that share an edge. */
PetscErrorCode PartitionGraphCreate(const Model *a, PartitionGraph *g);
PetscErrorCode PartitionGraphLink(PartitionGraph *g, int a, int b, int weight);
/* Contact as the model lies: links, work and centres. */
PetscErrorCode PartitionGraphNear(PartitionGraph *g, const Model *a);
/* part[elements of the model] of `parts` parts, some empty if there are fewer elements; a six-node triangle stays in one piece.
 * Destroys the graph. */
PetscErrorCode PartitionGraphCut(PartitionGraph *g, const Model *a, int parts, int part[]);
/* Renumbers the parts so that as much as possible of the work stays where it was. */
PetscErrorCode PartitionKeep(int nelements, int parts, const int before[], int part[]);
#endif
