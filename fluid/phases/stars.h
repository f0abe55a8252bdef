/* Stars: all elements around each vertex of a distributed mesh.  A Mesh has ghosts across faces only; here
 * every element within two rings of vertices around the owned ones is present.
 *
 *        .---.---.---.---.      o  owned element
 *        | 2 | 2 | 2 | 2 |      1  shares a vertex with an owned element
 *        .---.---.---.---.      2  shares a vertex with a 1
 *        | 2 | 1 | 1 | 1 |
 *        .---.---.---.---.      Local elements: owned ones in the Mesh's order, then the others by
 *        | 2 | 1 | o | o |      ascending global number.  Stars of the first nwhole vertices are whole:
 *        .---.---.---.---.      those of owned elements and of the first ring.
 *
 * The star of a vertex is sorted by global element number, so that all ranks that have a vertex add the same
 * numbers in the same order and get the same bits. */
#ifndef CORACLE_PHASES_STARS_H
#define CORACLE_PHASES_STARS_H
#include "common/exchange/scatter.h"
#include "common/mesh/mesh.h"

typedef struct {
  PetscInt egid, vertex[3]; /* global numbers */
  int tag[3];               /* boundary name of a face, else -1 */
  int rank, local;          /* owner and its number there */
  int ring;                 /* 0: owned, 1, 2 */
  double x[3][2];           /* m, counter-clockwise */
} StarElement;

typedef struct {
  const Mesh *mesh;     /* borrowed */
  int ne, nl;           /* owned elements; all local ones */
  StarElement *element; /* [nl] */
  int (*vertex)[3];     /* [nl] local vertices */
  int (*neighbor)[3];   /* [nl] local element across face i, -1 on the boundary or beyond the second ring */
  int nv, nwhole;       /* vertices; the first nwhole have whole stars, owned elements' vertices come first */
  int nowned;           /* vertices of owned elements */
  PetscInt *gid;        /* [nv] global number */
  double (*point)[2];   /* [nv] m */
  int *start, *around;  /* star of v: around[start[v]] .. around[start[v + 1] - 1] = 3 element + corner */
  Scatter route;        /* owned elements -> the same elsewhere */
} Stars;

/* Collective.  The mesh is borrowed until StarsDestroy. */
PetscErrorCode StarsCreate(const Mesh *mesh, Stars **stars);
PetscErrorCode StarsDestroy(Stars **stars);
/* Collective: data[nl][bytes] of owned elements are copied to those that other ranks have. */
PetscErrorCode StarsExchange(const Stars *stars, size_t bytes, void *data);

/* Twice the area of local element e, m2. */
static inline double StarsTwiceArea(const Stars *s, int e)
{
  const double(*x)[2] = (const double(*)[2])s->element[e].x;
  return (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[1][1] - x[0][1]) * (x[2][0] - x[0][0]);
}
/* Of element e, m2. */
static inline double StarsArea(const Stars *s, int e)
{
  return 0.5 * StarsTwiceArea(s, e);
}
/* The face of local element o at which its neighbour e lies. */
static inline int StarsFaceTo(const Stars *s, int o, int e)
{
  return s->neighbor[o][0] == e ? 0 : s->neighbor[o][1] == e ? 1 : 2;
}
/* Adds the elements around vertex v that are not among list[n], up to `most` of all; returns their number. */
static inline int StarsAddAround(const Stars *s, int v, int n, int most, int list[])
{
  for (int k = s->start[v]; k < s->start[v + 1] && n < most; k++) {
    int known = 0;
    for (int j = 0; j < n && !known; j++) known = list[j] == s->around[k] / 3;
    if (!known) list[n++] = s->around[k] / 3;
  }
  return n;
}
#endif
