/* Private to the phases room: where the vertices come from. */
#ifndef CORACLE_PHASES_TRACE_H
#define CORACLE_PHASES_TRACE_H
#include "fluid/phases/stars.h"

/* What moves the vertices, of all local elements. */
typedef struct {
  const Stars *stars;
  double dt;                      /* s */
  const double (*flux)[3];        /* [nl] outward, m2/s; 0 on walls */
  const double (*velocity)[3][2]; /* [nl] at the vertices, continuous, m/s */
} TraceFlow;

/* shift = (place where vertex v was dt ago) - (its place), m, by the midpoint rule along the velocity, linear
 * in each element around v.  v < nowned.  Vertices of straight walls slide, those at corners of walls stay.
 * */
void TraceVertex(const TraceFlow *flow, int v, double shift[2]);
#endif
