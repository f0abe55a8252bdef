/* Kernels: a line divides a polygon without loss; offsets give the area asked for; the derivative of areas as
 * the line turns is that of finite differences; a line is found again from the area and the mean of what it cuts off. */
#include "fluid/phases/cut_of_moment.h"
#include "fluid/phases/plic.h"
#include "tests/check.h"
#include "tests/transfer/shaken.h"

static double Random(int k, int which)
{
  return 2.0 * Chance(99u, k, which) - 1.0;
}

/* A convex polygon: a triangle cut by a few lines. */
static Polygon RandomPolygon(int k)
{
  Polygon p = {3, {{0}}}, q;
  double x[3][2];
  do {
    for (int i = 0; i < 3; i++) {
      x[i][0] = Random(7 * k + i, 0);
      x[i][1] = Random(7 * k + i, 1);
    }
    k += 100000;
  } while (GeometryArea((const double(*)[2])x) < 0.05);
  const double zero[2] = {0.0, 0.0};
  PolygonTriangle((const double(*)[2])x, zero, &p);
  for (int c = 0; c < k % 3; c++) {
    const double a = M_PI * Random(k + c, 2), d = 0.6;
    const HalfPlane h = {{cos(a), sin(a)}, d};
    PolygonClip(&p, &h, &q);
    if (q.n && PolygonArea(&q) > 0.02) p = q;
  }
  return p;
}

static void CheckDivision(int k)
{
  const Polygon p = RandomPolygon(k);
  const double all = PolygonArea(&p), a = M_PI * Random(k, 3), part = 0.5 + 0.5 * Random(k, 2);
  const double share = k % 5 ? part : k % 2 ? 1e-9 : 1.0 - 1e-9;
  HalfPlane h = {{cos(a), sin(a)}, 0.0};
  Polygon low, high;
  h.d = PolygonFindOffset(&p, h.n, share * all);
  const HalfPlane other = HalfPlaneOther(&h);
  PolygonClip(&p, &h, &low);
  PolygonClip(&p, &other, &high);
  const double below = low.n ? PolygonArea(&low) : 0.0, above = high.n ? PolygonArea(&high) : 0.0;
  CHECK(fabs(below + above - all) < 1e-15 * 10, "polygon %d: %.17g + %.17g of %.17g", k, below, above, all);
  CHECK(fabs(below - share * all) < 3e-15, "polygon %d: share %g: %.17g instead of %.17g", k, share, below,
        share * all);
}

/* Of a triangle: its area times the mean of its corners; of a polygon, that of its parts. */
static void CheckMoment(int k)
{
  const Polygon p = RandomPolygon(k);
  const double zero[2] = {0.0, 0.0}, x[3][2] = {{0.1, 0.2}, {1.3, 0.1 * k / 100.0}, {0.4, 0.9}};
  const HalfPlane h = {{0.6, 0.8}, 0.5}, other = HalfPlaneOther(&h);
  Polygon low, high, triangle;
  double all[2], below[2], above[2], mean[2];
  PolygonClip(&p, &h, &low);
  PolygonClip(&p, &other, &high);
  PolygonTriangle(x, zero, &triangle);
  PolygonMoment(&p, all);
  PolygonMoment(&low, below);
  PolygonMoment(&high, above);
  PolygonMoment(&triangle, mean);
  for (int c = 0; c < 2; c++) {
    CHECK(fabs(below[c] + above[c] - all[c]) < 1e-14, "polygon %d: moments %.17g + %.17g of %.17g", k,
          below[c], above[c], all[c]);
    CHECK(fabs(mean[c] - PolygonArea(&triangle) * (x[0][c] + x[1][c] + x[2][c]) / 3.0) < 1e-15,
          "triangle %d: moment %.17g", k, mean[c]);
  }
}

/* dA_J/dtheta = l_J (t_K - t_J) */
static void CheckDerivative(int k)
{
  PlicCell cell[2] = {{.area = 1.0}, {.area = 1.0}};
  PlicState s;
  const double theta = M_PI * Random(k, 3), eps = 1e-6;
  double area[2];
  cell[0].part = RandomPolygon(k);
  cell[1].part = RandomPolygon(k + 50000);
  for (int i = 0; i < 2; i++) cell[i].rest = PolygonArea(&cell[i].part);
  cell[0].volume = (0.5 + 0.4 * Random(k, 2)) * PolygonArea(&cell[0].part);
  for (int i = 0; i < 2; i++) {
    PlicEvaluate(2, cell, theta + (i ? eps : -eps), &s);
    area[i] = PolygonCutBy(&cell[1].part, cell[1].rest, &s.line).area;
  }
  PlicEvaluate(2, cell, theta, &s);
  const PolygonCut own = PolygonCutBy(&cell[0].part, cell[0].rest, &s.line),
                   cut = PolygonCutBy(&cell[1].part, cell[1].rest, &s.line);
  const double slope = cut.length * (own.middle - cut.middle), difference = (area[1] - area[0]) / (2.0 * eps);
  CHECK(fabs(slope - difference) < 1e-4, "polygon %d: dA/dtheta = %g, by differences %g", k, slope,
        difference);
}

/* The mean fixes the line but for the root of round-off, as the square of its distance does not tell less. */
static void CheckCutOfMoment(int k)
{
  const Polygon p = RandomPolygon(k);
  const double a = M_PI * Random(k, 3), all = PolygonArea(&p), share = 0.5 + 0.45 * Random(k, 2);
  HalfPlane h = {{cos(a), sin(a)}, 0.0};
  Polygon part, both;
  double mean[2];
  h.d = PolygonFindOffset(&p, h.n, share * all);
  PolygonClip(&p, &h, &part);
  PolygonMoment(&part, mean);
  for (int c = 0; c < 2; c++) mean[c] /= share * all;
  const HalfPlane found = CutOfMoment(&p, share * all, mean);
  PolygonClip(&part, &found, &both);
  CHECK(fabs(PolygonArea(&both) - share * all) < 1e-6 * all, "polygon %d: %.9g of %.9g found again", k,
        PolygonArea(&both), share * all);
}

int main(void)
{
  for (int k = 0; k < 500; k++) CheckCutOfMoment(k);
  for (int k = 0; k < 20000; k++) CheckDivision(k);
  for (int k = 0; k < 2000; k++) CheckMoment(k);
  for (int k = 0; k < 5000; k++) CheckDerivative(k);
  return 0;
}
