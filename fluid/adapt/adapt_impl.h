/* Private to the adapt room: a mesh that can be changed in place.
 *
 * A corner is 3 triangle + i and also names the face opposite to it, from vertex[Next(c)] to vertex[Prev(c)].
 * across[c] is the corner of the neighbour that looks at the same face.  Dead slots are chained and used
 * again. */
#ifndef CORACLE_ADAPT_IMPL_H
#define CORACLE_ADAPT_IMPL_H
#include "fluid/adapt/adapt.h"
#include "fluid/adapt/metric_tensor.h"
#include <stdbool.h>

enum { NONE = -1, MAX_STAR = 64 };
typedef enum { FREE, ON_LINE, FIXED } VertexKind;

/* Round-off must not decide.  Lengths and qualities that differ by less than this share are equal, and the
 * first in the order of the numbers is taken; thresholds lie that far from the values that structured meshes
 * have (the diagonal of a unit cell, half of it).  Far above what differences of 1e-14 in the input become
 * with edges 1000 times as long as high. */
#define TIE 1e-6
/* Edges in this range are unit ones, sqrt 2 and 1/sqrt 2 too. */
#define LONG_EDGE (1.4142135623730951 * (1.0 + TIE))
#define SHORT_EDGE (0.7071067811865476 * (1.0 - TIE))

/* The input, on which the metric is a function. */
typedef struct {
  const MeshSerial *mesh; /* borrowed */
  int *across;            /* [ne][3] */
  double *log_metric;     /* [nv][3] */
} Background;

typedef struct {
  int nv, ne;         /* slots in use, dead ones included */
  int max_v, max_e;   /* room */
  int dead_v, dead_e; /* first of the chain of dead slots, NONE */
  double *x;          /* [nv][2] */
  double *metric;     /* [nv][3] */
  int *corner;        /* [nv] one of the vertex's corners; NONE if dead (then home is the next dead one) */
  int *home;          /* [nv] the background triangle that the vertex lies in */
  int *origin;        /* [nv] number in the input or NONE */
  int *stamp;         /* [nv] tick at which a triangle around it changed last */
  char *kind;         /* [nv] VertexKind */
  int *vertex;        /* [ne][3]; vertex[3e] is NONE if dead (then vertex[3e + 1] is the next dead one) */
  int *across;        /* [ne][3], NONE on the boundary */
  int *mark;         /* [ne][3] NONE or the line that the face lies on: a tag or ntags for one without name */
  int *region;       /* [ne] */
  char *frozen_mark; /* [ntags + 1] */
  double scale;      /* largest coordinate, which bounds round-off */
  int tick;
  Background background;
  AdaptReport report;
} Adapt;

/* The triangles around a vertex, counter-clockwise, by the corner that lies at the vertex. */
typedef struct {
  int n;
  bool closed; /* false at the boundary: the first and the last triangle do not meet */
  int corner[MAX_STAR];
} Star;

static inline int Next(int c)
{
  return c % 3 == 2 ? c - 2 : c + 1;
}
static inline int Prev(int c)
{
  return c % 3 == 0 ? c + 2 : c - 1;
}

/* Smallest height of a triangle over its longest edge, and over the largest coordinate: three points on a
 * line are flat whatever round-off has made of them. */
#define FLAT 1e-10
#define FLAT_ROUND_OFF 1e-12

/* Quality of a triangle with these vertices, at most 0 if it is flat or clockwise; *square as MetricQuality.
 */
static inline double AdaptQuality(const Adapt *a, int p, int q, int r, double *square)
{
  const double *const x[3] = {&a->x[2 * p], &a->x[2 * q], &a->x[2 * r]};
  const double *const m[3] = {&a->metric[3 * p], &a->metric[3 * q], &a->metric[3 * r]};
  const double ux = x[1][0] - x[0][0], uy = x[1][1] - x[0][1];
  const double wx = x[2][0] - x[0][0], wy = x[2][1] - x[0][1];
  const double vx = wx - ux, vy = wy - uy, u2 = ux * ux + uy * uy, w2 = wx * wx + wy * wy,
               v2 = vx * vx + vy * vy;
  const double longest = PetscMax(PetscMax(u2, w2), v2);
  if (!(ux * wy - uy * wx > FLAT * longest + FLAT_ROUND_OFF * a->scale * sqrt(longest))) return -1.0;
  return MetricQuality(x, m, square);
}

static inline double AdaptLength(const Adapt *a, int p, int q)
{
  return MetricLength(&a->x[2 * p], &a->x[2 * q], &a->metric[3 * p], &a->metric[3 * q]);
}

/* Squares of an edge's length in the metrics of its ends: the length lies between their roots. */
static inline void AdaptSquares(const Adapt *a, int p, int q, double *smaller, double *larger)
{
  const double x = a->x[2 * q] - a->x[2 * p], y = a->x[2 * q + 1] - a->x[2 * p + 1];
  const double s = MetricSquare(&a->metric[3 * p], x, y), t = MetricSquare(&a->metric[3 * q], x, y);
  *smaller = PetscMin(s, t);
  *larger = PetscMax(s, t);
}

static inline bool AdaptIsLong(const Adapt *a, int p, int q)
{
  double smaller, larger;
  AdaptSquares(a, p, q, &smaller, &larger);
  if (larger <= LONG_EDGE * LONG_EDGE || smaller > LONG_EDGE * LONG_EDGE)
    return smaller > LONG_EDGE * LONG_EDGE;
  return AdaptLength(a, p, q) > LONG_EDGE;
}

static inline bool AdaptIsShort(const Adapt *a, int p, int q)
{
  double smaller, larger;
  AdaptSquares(a, p, q, &smaller, &larger);
  if (smaller >= SHORT_EDGE * SHORT_EDGE || larger < SHORT_EDGE * SHORT_EDGE)
    return larger < SHORT_EDGE * SHORT_EDGE;
  return AdaptLength(a, p, q) < SHORT_EDGE;
}

/* Of an edge and a triangle of a mesh with metric[nv][3]. */
static inline double AdaptMeshLength(const MeshSerial *m, const double metric[], int p, int q)
{
  return MetricLength(&m->x[2 * p], &m->x[2 * q], &metric[3 * p], &metric[3 * q]);
}

static inline double AdaptMeshQuality(const MeshSerial *m, const double metric[], int e)
{
  const int *v = &m->vertex[3 * e];
  const double *const x[3] = {&m->x[2 * v[0]], &m->x[2 * v[1]], &m->x[2 * v[2]]};
  const double *const t[3] = {&metric[3 * v[0]], &metric[3 * v[1]], &metric[3 * v[2]]};
  double square;
  return MetricQuality(x, t, &square);
}

static inline bool AdaptIsUnit(double length)
{
  return length >= SHORT_EDGE && length <= LONG_EDGE;
}

/* adapt_build.c: from and to a MeshSerial. */
PetscErrorCode AdaptCreate(const MeshSerial *mesh, const double metric[], const AdaptOptions *options,
                           Adapt *a);
PetscErrorCode AdaptDestroy(Adapt *a);
PetscErrorCode AdaptExtract(const Adapt *a, AdaptResult *result); /* adapt_extract.c */
/* adapt_faces.c: the corner across each face, NONE on the boundary, and the tag of its facet, NONE without.
 */
PetscErrorCode AdaptFaces(const MeshSerial *mesh, int across[], int mark[]);

/* adapt_mesh.c: slots, stars, measures. */
PetscErrorCode AdaptReserve(Adapt *a); /* room for one more vertex and two triangles */
int AdaptNewVertex(Adapt *a);
int AdaptNewTriangle(Adapt *a);
void AdaptKillVertex(Adapt *a, int v);
void AdaptKillTriangle(Adapt *a, int e);
void AdaptSetTriangle(Adapt *a, int e, int p, int q, int r); /* also their corners and stamps */
void AdaptJoin(Adapt *a, int c, int d, int mark);            /* two faces become neighbours; d may be NONE */
bool AdaptStar(const Adapt *a, int v, Star *star);           /* false if it is larger than MAX_STAR */

/* adapt_background.c: metric at a point near background triangle *home, which is updated. */
void BackgroundMetric(const Background *b, const double x[2], int *home, double metric[3]);

/* One sweep each over what changed after tick `since`; they return how much they did. */
PetscErrorCode AdaptSplit(Adapt *a, int since, int *done); /* adapt_split.c */
int AdaptCollapse(Adapt *a, int since);                    /* adapt_collapse.c */
int AdaptSwap(Adapt *a, int since);                        /* adapt_swap.c */
int AdaptSmooth(Adapt *a, int since);                      /* adapt_smooth.c */
#endif
