/* Which of a set of boxes does a box overlap?  A tree of bounding boxes over the set, sorted along a Morton
 * curve: built in linear time, answered in time logarithmic in the set plus linear in the answer, whatever
 * the boxes' sizes (a mesh graded by a factor of 1000 costs the same as a uniform one).  Serial, no MPI. */
#ifndef CORACLE_SEARCH_H
#define CORACLE_SEARCH_H
#include "common/supermesh/geometry.h"

typedef struct Search_s *Search;

/* box[n], copied.  Returns 0, or 1 when there is no memory. */
int SearchCreate(int n, const GeometryBox box[], Search *search);
/* The same over the bounding boxes of triangles x[n][3][2]. */
int SearchCreateTriangles(int n, const double x[][3][2], Search *search);
/* The number of boxes that overlap or touch `box`; their indices in *hit, borrowed until the next query; -1
 * when there is no memory. */
int SearchQuery(Search search, const GeometryBox *box, const int **hit);
/* At most max >= 4 boxes that cover the set, each around neighbours on the curve; their number. */
int SearchCover(Search search, int max, GeometryBox cover[]);
void SearchDestroy(Search *search);
#endif
