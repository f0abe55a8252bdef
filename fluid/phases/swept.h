/* The region that passes a face in a step, and the phases in it.
 *
 *      a----------b     Face ab, outward to its right.  a' and b' are where its vertices were dt ago; m'
 *       \        /      moves out of the middle of a'b' until the area a b b' m' a' is flux dt.  The phases
 *        \      /       that lie in this polygon leave through the face.  It is taken as three signed
 *        a'--.b'        triangles at a, so that it may cross itself.
 *          m'
 *
 * Private to the phases room; nothing here is collective. */
#ifndef CORACLE_PHASES_SWEPT_H
#define CORACLE_PHASES_SWEPT_H
#include "fluid/phases/phases_impl.h"

/* Corners relative to the face's first vertex. */
typedef struct {
  double origin[2], corner[5][2]; /* a, b, b', m, a' */
  double low[2], high[2];
} Swept;

/* What is outside of one boundary: half planes n.x <= d, x from the region's origin, in all of which it is, and layers in it: the
 * area in each layer and those before it that no element covers, and at last that of all, m2 (0 where there is one part alone). */
typedef struct {
  int tag, ncuts, nlevels;
  HalfPlane cut[2], level[PHASES_MAX];
  double uncovered[PHASES_MAX + 1];
} SweptPart;

typedef struct {
  int n;
  SweptPart part[4]; /* of two boundaries at each end of a face */
} SweptOutside;

typedef struct {
  Phases f;         /* borrowed */
  int stamp, *mark; /* [nl] */
  int n, *list;     /* elements that a face may sweep, by ascending global number */
} SweptSearch;

PetscErrorCode SweptSearchCreate(Phases phases, SweptSearch *search);
PetscErrorCode SweptSearchDestroy(SweptSearch *search);
/* The region of area `swept` > 0, m2, to the left of a -> b; shift[vertex]: from where it is to where it was, m. */
void SweptMake(const Stars *stars, int a, int b, const double shift[][2], double swept, Swept *region);
/* area[np] += that of each phase in the region, m2, and mass[np] += its mass, kg, if phases have masses, among the elements
 * around a and b, with `wide` also those around their neighbours; outside->part[].uncovered is written.  Returns what these elements
 * do not cover of the region, over the square of the edge. */
double SweptCollect(SweptSearch *search, int a, int b, int wide, const Swept *region, SweptOutside *outside,
                    double area[], double mass[]);
#endif
