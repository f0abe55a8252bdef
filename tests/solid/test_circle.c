/* Contact of rigid discs as circles (circle_kernel.h): nothing depends on what a disc has turned by, forces are -d(energy)/dx, and what a disc's
 * sectors make of a line is what the expected circle does. */
#include "solid/contact/circle_kernel.h"
#include "tests/check.h"
#include <math.h>

enum { EDGES = 12 };
static const double RADIUS = 0.1, HEIGHT = 0.02;

static Sector SectorAt(Point centre, double radius, double turned, int k)
{
  const double a = turned + 2.0 * M_PI * k / EDGES, b = turned + 2.0 * M_PI * (k + 1) / EDGES;
  return (Sector){centre,
                  {centre.x + radius * cos(a), centre.y + radius * sin(a)},
                  {centre.x + radius * cos(b), centre.y + radius * sin(b)},
                  radius,
                  HEIGHT};
}

/* --- an edge of another body --------------------------------------------------------------------------- */

typedef struct {
  double part[2]; /* of the edge's ends, over its length */
  double moment;  /* of the force about the centre */
} OnEdge;

static OnEdge Edge(Point p, Point q, Point centre, double turned)
{
  OnEdge sum = {{0.0, 0.0}, 0.0};
  for (int k = 0; k < EDGES; k++) {
    const Sector sector = SectorAt(centre, RADIUS, turned, k);
    ContactIntegrals c;
    if (!ContactEdgeSector(p, q, &sector, &c)) continue;
    const Point n = {-(q.y - p.y), q.x - p.x};
    sum.part[0] += c.edge[0];
    sum.part[1] += c.edge[1];
    sum.moment +=
        c.edge[0] * PointCross(PointMinus(p, centre), n) + c.edge[1] * PointCross(PointMinus(q, centre), n);
  }
  return sum;
}

/* int phi over a polygon in the disc: by Green, along the part of each edge inside, of (R^2 - r^2)^2/4 times the angle's rate. */
static double Energy(int n, const Point corner[], Point centre)
{
  enum { PIECES = 4000 };
  double sum = 0.0;
  for (int k = 0; k < n; k++) {
    const Point p = PointMinus(corner[k], centre), d = PointMinus(corner[(k + 1) % n], corner[k]);
    for (int i = 0; i < PIECES; i++) {
      const double s = (i + 0.5) / PIECES;
      const Point x = {p.x + s * d.x, p.y + s * d.y};
      const double r2 = x.x * x.x + x.y * x.y, inner = Greater(0.0, RADIUS * RADIUS - r2);
      const double fourth = RADIUS * RADIUS * RADIUS * RADIUS;
      sum += (fourth - inner * inner) / (4.0 * r2) * PointCross(x, d) / PIECES;
    }
  }
  return 1.5 / (RADIUS * HEIGHT) * sum;
}

/* Corners of a polygon that reaches into the disc but does not contain its centre. */
static void TestEdges(void)
{
  const Point corner[4] = {{0.06, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {0.08, 0.03}};
  const double step = 1e-5;
  Point force = {0.0, 0.0};
  double moment = 0.0;
  for (int k = 0; k < 4; k++) {
    const Point p = corner[k], q = corner[(k + 1) % 4], centre = {0.0, 0.0};
    const OnEdge one = Edge(p, q, centre, 0.0), other = Edge(p, q, centre, 0.2);
    const double sum = one.part[0] + one.part[1];
    for (int i = 0; i < 2; i++)
      CHECK(fabs(one.part[i] - other.part[i]) < 1e-13, "edge %d, end %d: %g, of the disc turned %g", k, i,
            one.part[i], other.part[i]);
    force.x -= sum * (q.y - p.y);
    force.y += sum * (q.x - p.x);
    moment += one.moment;
  }
  const double slope[2] = {
      (Energy(4, corner, (Point){step, 0.0}) - Energy(4, corner, (Point){-step, 0.0})) / (2.0 * step),
      (Energy(4, corner, (Point){0.0, step}) - Energy(4, corner, (Point){0.0, -step})) / (2.0 * step)};
  CHECK(fabs(force.x - slope[0]) < 1e-4 * fabs(slope[0]) && fabs(force.y - slope[1]) < 1e-4 * fabs(slope[0]),
        "force (%g, %g) on the polygon, slope of the energy (%g, %g)", force.x, force.y, slope[0], slope[1]);
  CHECK(fabs(moment) < 1e-12 * fabs(force.x) * RADIUS, "moment %g about the centre", moment);
}

/* --- chords -------------------------------------------------------------------------------------------- */

/* The sum over all sectors of one disc, and of the other. */
static double ChordForce(double distance, double direction, double turned, double *moment)
{
  const Point centre = {0.3, -0.2}, e = {cos(direction), sin(direction)},
              other = {centre.x + distance * e.x, centre.y + distance * e.y};
  const Chord chord = ChordOfDiscs(centre, RADIUS, other, 2.0 * RADIUS);
  double sum = 0.0;
  *moment = 0.0;
  for (int k = 0; k < EDGES * EDGES; k++) {
    const Sector one = SectorAt(centre, RADIUS, turned, k / EDGES),
                 two = SectorAt(other, 2.0 * RADIUS, -3.0 * turned, k % EDGES);
    ContactIntegrals c;
    Point at;
    double integral;
    if (!ContactChord(&chord, &one, &two, HEIGHT, 1.0, &at, &integral, &c)) continue;
    sum += integral;
    *moment += integral * PointCross(PointMinus(at, centre), e);
  }
  return sum;
}

/* Also where corners of both lie on the line of the centres, as in a column of discs. */
static void TestChords(void)
{
  const double depth = 0.001, reduced = RADIUS * 2.0 / 3.0, distance = 3.0 * RADIUS - depth;
  const Chord chord = ChordOfDiscs((Point){0.0, 0.0}, RADIUS, (Point){distance, 0.0}, 2.0 * RADIUS);
  const double expected = 2.0 * pow(chord.squared, 1.5) / (reduced * HEIGHT);
  CHECK(fabs(expected / (4.0 * depth * sqrt(2.0 * reduced * depth) / HEIGHT) - 1.0) < 0.02, "force %g",
        expected);
  for (int k = 0; k < 50; k++) {
    double moment;
    const double direction = k < 12 ? k * M_PI / 6.0 : 0.1 * k, turned = k < 12 ? 0.0 : 0.07 * k,
                 sum = ChordForce(distance, direction, turned, &moment);
    CHECK(fabs(sum / expected - 1.0) < 1e-10, "direction %g, turned %g: %.15g of %.15g", direction, turned,
          sum, expected);
    CHECK(fabs(moment) < 1e-12 * expected, "direction %g, turned %g: moment %g", direction, turned, moment);
  }
}

int main(void)
{
  TestEdges();
  TestChords();
  return 0;
}
