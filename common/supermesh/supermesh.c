#include "common/supermesh/supermesh.h"
#include "common/supermesh/vectorize.h"
#include <stdlib.h>

#define SLIVER 1e-13 /* of the smaller area; round-off is 1e-16 times a slenderness of THIN at most */
#define THIN 50.0    /* longest edge squared over twice the area, of triangles that are clipped one by one */

/* Candidates side by side, so that the loop over them is vectorised. */
enum { BATCH = 64 };
typedef struct {
  double x[3][BATCH], y[3][BATCH];                        /* vertices of triangles b */
  double area[BATCH], centre[2][BATCH], second[3][BATCH]; /* of the common polygons */
  double of_b[BATCH], slenderness[BATCH];                 /* b's own area; of the more slender of the two */
} Batch;

/* Of a polygon around an origin: 2 int 1, 6 int (x, y), 12 int (xx, xy, yy). */
typedef struct {
  double one, x, y, xx, xy, yy;
} Moments;

typedef struct {
  double x, y;
} Place;

/* A place from the origin, which is vertex 0 of a triangle with the edges e, f from there, and the triangle's functions N_1, N_2, N_0
 * there times twice its area. */
typedef struct {
  Place at;
  double first, second, third;
} Corner;

#define INLINE static inline __attribute__((always_inline))

INLINE double Least(double a, double b)
{
  return a < b ? a : b;
}

INLINE double Largest(double a, double b)
{
  return a > b ? a : b;
}

INLINE Place Either(int first, Place a, Place b)
{
  return (Place){first ? a.x : b.x, first ? a.y : b.y};
}

INLINE Place Minus(Place a, Place b)
{
  return (Place){a.x - b.x, a.y - b.y};
}

INLINE double Cross(Place a, Place b)
{
  return a.x * b.y - a.y * b.x;
}

INLINE Corner CornerOf(Place p, Place e, Place f, double twice)
{
  const double first = Cross(p, f), second = Cross(e, p);
  return (Corner){p, first, second, twice - (first + second)};
}

INLINE double Square(Place a)
{
  return a.x * a.x + a.y * a.y;
}

INLINE double Slenderness(Place a, Place b, Place c, double twice)
{
  return Largest(Largest(Square(Minus(b, a)), Square(Minus(c, b))), Square(Minus(a, c))) / twice;
}

/* m + `part` times those of the triangle 0, p, q, which are negative where it turns clockwise. */
INLINE Moments WithTriangle(Moments m, double part, Place p, Place q)
{
  const double w = part * Cross(p, Minus(q, p)), x = p.x + q.x, y = p.y + q.y;
  return (Moments){m.one + w,
                   m.x + w * x,
                   m.y + w * y,
                   m.xx + w * (x * x - p.x * q.x),
                   m.xy + 0.5 * w * (x * y + p.x * p.y + q.x * q.y),
                   m.yy + w * (y * y - p.y * q.y)};
}

/* p + t way, or where the way from 0 to there leaves the triangle; `third` is that of the place. */
INLINE Place Within(Place p, double t, Place way, double third, double twice)
{
  const double scale = twice / (twice - Least(third, 0.0));
  return (Place){scale * (p.x + t * way.x), scale * (p.y + t * way.y)};
}

/* m + those of what the triangle shares with 0, p, q: with the edge p -> q cut to N_1, N_2 >= 0, from `low` to `high`, this is
 * all between 0 and the lines from there, Within, to where the edge crosses N_0 = 0 (if at all) and on to the end.  No branches.
 * Where the edge does not cross a line the quotient lies outside of 0 .. 1, or is infinite or no number, and is not taken.
 * Edges that meet in a corner share it to the last bit. */
INLINE Moments WithEdge(Moments m, Corner p, Corner q, double twice)
{
  const double first = p.first / (p.first - q.first), second = p.second / (p.second - q.second),
               way_third = q.third - p.third, third = p.third / -way_third;
  const double after = Largest(p.first < 0.0 ? first : 0.0, p.second < 0.0 ? second : 0.0),
               before = Least(q.first < 0.0 ? first : 1.0, q.second < 0.0 ? second : 1.0);
  const double low = Largest(Least(after, 1.0), 0.0), high = Largest(Least(before, 1.0), low),
               middle = Largest(Least(third, high), low), part = low < high ? 1.0 : 0.0;
  const Place way = Minus(q.at, p.at), from = Within(p.at, low, way, p.third + low * way_third, twice),
              over = Within(p.at, middle, way, p.third + middle * way_third, twice),
              to = Within(q.at, high - 1.0, way, q.third + (high - 1.0) * way_third, twice);
  return WithTriangle(WithTriangle(m, part, from, over), part, over, to);
}

/* Of the polygon with moments m; origin: theirs, from a's vertex 0. */
INLINE void SetCommon(const Moments *m, Place origin, int k, Batch *batch)
{
  const double x = m->x / (3.0 * m->one), y = m->y / (3.0 * m->one);
  batch->area[k] = 0.5 * m->one;
  batch->centre[0][k] = origin.x + x;
  batch->centre[1][k] = origin.y + y;
  batch->second[0][k] = (m->xx - 2.0 * m->x * x) / 12.0;
  batch->second[1][k] = (m->xy - 2.0 * m->x * y) / 12.0;
  batch->second[2][k] = (m->yy - 2.0 * m->y * y) / 12.0;
}

/* Of triangle a and the batch's first n, from vertex 0 of the smaller.  The signed triangles from there to the other's edges add
 * up to the other, wherever that is; each is cut by the smaller alone, so that nothing is to be closed and round-off stays
 * round-off where edges touch. */
static WIDE void Intersect(const double a[3][2], int n, Batch *batch)
{
  const Place a0 = {a[0][0], a[0][1]}, a1 = {a[1][0], a[1][1]}, a2 = {a[2][0], a[2][1]};
  const double twice_a = Cross(Minus(a1, a0), Minus(a2, a0)), slenderness = Slenderness(a0, a1, a2, twice_a);
  VECTORIZE
  for (int k = 0; k < n; k++) {
    const Place b0 = {batch->x[0][k], batch->y[0][k]}, b1 = {batch->x[1][k], batch->y[1][k]},
                b2 = {batch->x[2][k], batch->y[2][k]};
    const double twice_b = Cross(Minus(b1, b0), Minus(b2, b0)), twice = Least(twice_a, twice_b);
    const int least = twice_a < twice_b; /* a is the smaller one */
    const Place origin = Either(least, a0, b0), e = Minus(Either(least, a1, b1), origin),
                f = Minus(Either(least, a2, b2), origin);
    const Corner p = CornerOf(Minus(Either(least, b0, a0), origin), e, f, twice),
                 q = CornerOf(Minus(Either(least, b1, a1), origin), e, f, twice),
                 r = CornerOf(Minus(Either(least, b2, a2), origin), e, f, twice);
    const Moments m =
        WithEdge(WithEdge(WithEdge((Moments){.one = 0.0}, p, q, twice), q, r, twice), r, p, twice);
    batch->of_b[k] = 0.5 * twice_b;
    batch->slenderness[k] = Largest(slenderness, Slenderness(b0, b1, b2, twice_b));
    SetCommon(&m, Minus(origin, a0), k, batch);
  }
}

static int Reserve(SupermeshPairs *pairs, int n)
{
  if (n <= pairs->capacity) return 0;
  const int capacity = n + n / 2 + 64;
  SupermeshPair *pair = realloc(pairs->pair, (size_t)capacity * sizeof *pair);
  if (!pair) return 1;
  pairs->pair = pair;
  pairs->capacity = capacity;
  return 0;
}

static void Gather(int n, const int hit[], const double b[][3][2], Batch *batch)
{
  for (int k = 0; k < n; k++)
    for (int i = 0; i < 3; i++) {
      batch->x[i][k] = b[hit[k]][i][0];
      batch->y[i][k] = b[hit[k]][i][1];
    }
}

/* Of slender triangles, whose signed parts would cancel: the moments of their polygon from its own first vertex, to place k. */
static void Clip(const double a[3][2], const double b[3][2], int k, Batch *batch)
{
  double polygon[GEOMETRY_CLIP_MAX][2];
  const int n = GeometryClip(a, b, polygon);
  Moments m = {.one = 0.0};
  batch->area[k] = 0.0;
  for (int i = 1; i + 1 < n; i++) {
    const Place p = {polygon[i][0] - polygon[0][0], polygon[i][1] - polygon[0][1]},
                q = {polygon[i + 1][0] - polygon[0][0], polygon[i + 1][1] - polygon[0][1]};
    m = WithTriangle(m, 1.0, p, q);
  }
  if (n) SetCommon(&m, (Place){polygon[0][0] - a[0][0], polygon[0][1] - a[0][1]}, k, batch);
}

/* There is room for all of them.  Each is written, and the next one over it where it is none: which are is random to the
 * processor. */
static void AddPairs(int a, double area, int n, const int hit[], const Batch *batch, SupermeshPairs *pairs)
{
  SupermeshPair *next = pairs->pair + pairs->n;
  for (int k = 0; k < n; k++) {
    const double of_b = batch->of_b[k], least = area < of_b ? area : of_b;
    *next = (SupermeshPair){a,
                            hit[k],
                            batch->area[k],
                            {batch->centre[0][k], batch->centre[1][k]},
                            {batch->second[0][k], batch->second[1][k], batch->second[2][k]}};
    next += (of_b > 0.0) & (batch->area[k] > SLIVER * least);
  }
  pairs->n = (int)(next - pairs->pair);
}

int SupermeshIntersect(int na, const double a[][3][2], Search search, const double b[][3][2],
                       SupermeshPairs *pairs)
{
  Batch batch;
  pairs->n = 0;
  for (int i = 0; i < na; i++) {
    const double area = GeometryArea(a[i]);
    const GeometryBox box = GeometryBoxOf(a[i]);
    const int *hit, nhit = area > 0.0 ? SearchQuery(search, &box, &hit) : 0;
    if (nhit < 0 || Reserve(pairs, pairs->n + nhit)) return 1;
    for (int first = 0; first < nhit; first += BATCH) {
      const int n = nhit - first < BATCH ? nhit - first : BATCH;
      Gather(n, hit + first, b, &batch);
      Intersect(a[i], n, &batch);
      for (int k = 0; k < n; k++)
        if (batch.slenderness[k] > THIN) Clip(a[i], b[hit[first + k]], k, &batch);
      AddPairs(i, area, n, hit + first, &batch, pairs);
    }
  }
  return 0;
}

void SupermeshPairsDestroy(SupermeshPairs *pairs)
{
  free(pairs->pair);
  *pairs = (SupermeshPairs){0};
}
