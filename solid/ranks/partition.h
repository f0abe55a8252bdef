/* Which rank gets which element.  Not collective: one process computes it.
 *
 * METIS cuts a graph of elements into parts of equal work with as little between them as it finds.  Links:
 * elements that share an edge, and hold together (8); edges near an element of another body (4, computed by
 * one rank for both); and each element with the next one along a Hilbert curve through all (1), so that
 * bodies which do not touch are dealt out by where they are.
 *
 * A body that is cut costs the step's response, whose preconditioner is a rank's own (step_response.h), many iterations.  So
 * pieces no larger than a part are one vertex of the graph each, if that way no part has more than WHOLE_EXCESS of work above
 * the mean; else all are cut by elements. */
#ifndef SOLID_PARTITION_H
#define SOLID_PARTITION_H
#include "solid/bodies/model.h"

enum { LINK_CURVE = 1, LINK_PARTED = 2, LINK_NEAR = 4, LINK_INTACT = 8 };
enum { WORK_ELEMENT = 2, WORK_CANDIDATE = 6 }; /* of an element's forces, and of a candidate of contact */
#define WHOLE_EXCESS 0.1

typedef struct {
  int a, b, weight; /* two elements; weights of equal pairs add up */
} PartitionLink;

typedef struct {
  int nlinks, capacity;
  PartitionLink *link;
  int *work;       /* [nelements] */
  int *piece;      /* [nelements] of the same number: what holds together, >= 0 and below nelements */
  double (*at)[2]; /* [nelements] centre now, m */
} PartitionGraph;

/* Every element with WORK_ELEMENT of work; bodies are the pieces; at is not set; links of elements that share an edge. */
PetscErrorCode PartitionGraphCreate(const Model *a, PartitionGraph *g);
PetscErrorCode PartitionGraphLink(PartitionGraph *g, int a, int b, int weight);
/* Contact as the model lies: links, work and centres. */
PetscErrorCode PartitionGraphNear(PartitionGraph *g, const Model *a);
/* The links along the curve; at is set. */
PetscErrorCode PartitionGraphCurve(PartitionGraph *g, int nelements);
/* part[elements of the model] of `parts` parts, some empty if there are fewer elements; a six-node triangle stays in one piece.
 * Destroys the graph. */
PetscErrorCode PartitionGraphCut(PartitionGraph *g, const Model *a, int parts, int part[]);
/* Renumbers the parts so that as much as possible of the work stays where it was. */
PetscErrorCode PartitionKeep(int nelements, int parts, const int before[], int part[]);
#endif
