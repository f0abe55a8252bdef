/* Contact forces: against a brute-force energy, dF = -dU/dx, U = p sum over (C, T) of the integral of
 * phi_T/J_T over the common part of contactor C and target T; equal and opposite; the same through the cell
 * grid as over all pairs, whatever the sizes of the boxes.  A fast body is found in time, and costs others nothing. */
#include "common/supermesh/geometry.h"
#include "solid/contact/cell_grid.h"
#include "solid/contact/contact_impl.h"
#include "tests/quadrature.h"
#include "tests/solid/build.h"

/* int phi over the triangle part: phi is linear on the target's three thirds between its centre and its
 * edges. */
static double PotentialIntegral(const double c[3][2], const double t[3][2])
{
  double sum = 0.0, centre[2];
  for (int k = 0; k < 2; k++) centre[k] = (t[0][k] + t[1][k] + t[2][k]) / 3.0;
  for (int i = 0; i < 3; i++) {
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    const double third[3][2] = {{t[a][0], t[a][1]}, {t[b][0], t[b][1]}, {centre[0], centre[1]}};
    double polygon[GEOMETRY_CLIP_MAX][2];
    const int n = GeometryClip(c, third, polygon);
    for (int k = 0; k + 2 < n; k++) {
      double x[3][2], mean = 0.0, lambda[3];
      PolygonFan((const double(*)[2])polygon, k, x);
      for (int v = 0; v < 3; v++) {
        GeometryBarycentric(t, x[v], lambda);
        mean += lambda[i];
      }
      sum += GeometryArea((const double(*)[2])x) * mean;
    }
  }
  return sum; /* 3 lambda_i, mean of three vertices */
}

static void Corners(const SolidView *v, const double at[], int e, double x[3][2])
{
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 2; c++) x[i][c] = at[2 * v->element[3 * e + i] + c];
}

static double ContactEnergy(const SolidView *v, double penalty)
{
  double sum = 0.0, c[3][2], t[3][2], rest[3][2];
  for (int i = 0; i < v->nelements; i++)
    for (int j = 0; j < v->nelements; j++) {
      if (v->body[i] == v->body[j]) continue;
      Corners(v, v->x, i, c);
      Corners(v, v->x, j, t);
      Corners(v, v->rest, j, rest);
      const double jacobian = GeometryArea((const double(*)[2])t) / GeometryArea((const double(*)[2])rest);
      sum += PotentialIntegral((const double(*)[2])c, (const double(*)[2])t) / jacobian;
    }
  return penalty * sum;
}

/* Two discs pushed into each other and shaken: total force by SolidForces, elastic part by the strain energy.
 */
static PetscErrorCode EnergyGradient(void)
{
  const double penalty = 7.0e4, young = 1.0e5;
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, young, 0.3, 0.0));
  const SolidSetup options = {.courant = 0.5};
  Model a = {0};
  Solid s;
  const double *f;
  double *x, force[600], sum[2] = {0.0, 0.0};
  setup.material.penalty = penalty;
  AddDisc(&a, -0.098, 0.003, 0.1, 0.05, &setup);
  setup.material.penalty = 2.0 * penalty;
  AddDisc(&a, 0.098, 0.011, 0.1, 0.04, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  SolidView v = ViewOf(s, &x, NULL);
  CHECK(2 * v.nnodes <= 600, "%d nodes", v.nnodes);
  for (int k = 0; k < 2 * v.nnodes; k++) x[k] += 1e-3 * sin(12.9898 * k + 4.1);
  PetscCall(SolidStart(s, 1e-9, NULL)); /* candidates of the shaken places */
  PetscCall(SolidForces(s, &f));
  PetscCall(PetscArraycpy(force, f, 2 * (size_t)v.nnodes));
  for (int k = 0; k < 2 * v.nnodes; k++) {
    const double h = 1e-7, kept = x[k];
    double energy[2];
    BodyState b[2];
    for (int side = 0; side < 2; side++) {
      x[k] = kept + (side ? -h : h);
      PetscCall(SolidBodies(s, 2, b));
      energy[side] = b[0].strain + b[1].strain + ContactEnergy(&v, penalty);
    }
    x[k] = kept;
    const double expected = -(energy[0] - energy[1]) / (2.0 * h);
    CHECK(fabs(force[k] - expected) < 1e-6 * young * 0.01, "node %d: force %.9g, -dU/dx %.9g", k / 2,
          force[k], expected);
    sum[k % 2] += force[k];
  }
  CHECK(ContactEnergy(&v, penalty) > 0.0, "the discs do not touch");
  CHECK(fabs(sum[0]) + fabs(sum[1]) < 1e-13 * young, "the forces sum up to %g %g", sum[0], sum[1]);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* --- the cell grid ------------------------------------------------------------------------------------ */

enum { NBOXES = 400 };
static int hits[NBOXES][NBOXES];

static PetscErrorCode Count(void *context, int i, int j)
{
  (void)context;
  hits[i][j]++;
  return 0;
}

static double Random(unsigned *state)
{
  *state = *state * 1664525u + 1013904223u;
  return (double)(*state >> 8) / 16777216.0;
}

/* Boxes of very different sizes, negative coordinates too: every overlapping pair is reported once, no other. */
static PetscErrorCode Grid(void)
{
  static GeometryBox a[NBOXES], b[NBOXES];
  unsigned state = 7;
  int pairs = 0;
  for (int k = 0; k < 2 * NBOXES; k++) {
    GeometryBox *box = k < NBOXES ? &a[k] : &b[k - NBOXES];
    const double size = pow(10.0, -3.0 + 3.3 * Random(&state));
    for (int c = 0; c < 2; c++) {
      box->lower[c] = 4.0 * Random(&state) - 2.0;
      box->upper[c] = box->lower[c] + size * Random(&state);
    }
  }
  PetscCall(CellGridPairs(NBOXES, a, NBOXES, b, Count, NULL));
  for (int i = 0; i < NBOXES; i++)
    for (int j = 0; j < NBOXES; j++) {
      const int expected = GeometryBoxOverlap(&a[i], &b[j]);
      CHECK(hits[i][j] == expected, "pair %d %d reported %d times, expected %d", i, j, hits[i][j], expected);
      pairs += expected;
    }
  CHECK(pairs > 500, "only %d pairs", pairs);
  return 0;
}

static int large_pairs, other_pairs;

static PetscErrorCode CountLarge(void *context, int i, int j)
{
  const int *nlarge = context;
  if (i < *nlarge || j < *nlarge)
    large_pairs++;
  else
    other_pairs += i != j;
  return 0;
}

/* A few boxes of 1000 over very many of 0.001, which lie apart: cells of the mean size are 2e8 in one. */
static PetscErrorCode GridOfAllSizes(void)
{
  const int nsmall = 40000, nlarge = 3, n = nlarge + nsmall, side = 200;
  GeometryBox *box = malloc((size_t)n * sizeof *box);
  for (int k = 0; k < n; k++) {
    const double size = k < nlarge ? 1000.0 : 0.001;
    const double x = k < nlarge ? -500.0 + k : 0.002 * ((k - nlarge) % side);
    const double y = k < nlarge ? -500.0 : 0.002 * (int)((k - nlarge) / side);
    box[k] = (GeometryBox){{x, y}, {x + size, y + size}};
  }
  PetscCall(CellGridPairs(n, box, n, box, CountLarge, (void *)(size_t)&nlarge));
  CHECK(large_pairs == nlarge * (nlarge + 2 * nsmall) && other_pairs == 0,
        "%d pairs with a large box, %d of two small ones", large_pairs, other_pairs);
  free(box);
  return 0;
}

/* --- overlap at the start ----------------------------------------------------------------------------- */

/* The second mesh's triangles, on nodes of their own, behind those of the first. */
static PetscErrorCode Join(MeshSerial *m, const MeshSerial *other)
{
  const size_t nv = (size_t)m->nv, ne = (size_t)m->ne;
  PetscCall(PetscRealloc(2 * (nv + (size_t)other->nv) * sizeof *m->x, &m->x));
  PetscCall(PetscRealloc(3 * (ne + (size_t)other->ne) * sizeof *m->vertex, &m->vertex));
  PetscCall(PetscArraycpy(m->x + 2 * nv, other->x, 2 * (size_t)other->nv));
  for (int k = 0; k < 3 * other->ne; k++) m->vertex[3 * m->ne + k] = m->nv + other->vertex[k];
  m->nv += other->nv;
  m->ne += other->ne;
  return 0;
}

/* As two bodies, and as two parts of one mesh. */
static PetscErrorCode Overlap(double x, double radius, int expected)
{
  const BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.0));
  const double centre[2][2] = {{0.0, 0.0}, {x, 0.0}};
  Model a = {0}, b = {0};
  MeshSerial part[2];
  ModelPair pair;
  AddRectangle(&a, 0.0, 0.0, 1.0, 1.0, 0.0, 0.125, 0, &setup);
  AddRectangle(&a, x, 0.0, 2.0 * radius, 2.0 * radius, 0.0, 0.125, 0, &setup);
  PetscCall(ModelOverlap(&a, &pair));
  CHECK((pair.element[0] >= 0) == expected, "x = %g, radius %g: elements %d and %d", x, radius,
        pair.element[0], pair.element[1]);
  CHECK(!expected || (a.element_body[pair.element[0]] == 0 && a.element_body[pair.element[1]] == 1),
        "bodies");
  for (int k = 0; k < 2; k++)
    PetscCall(
        ShapeRectangle(centre[k], k ? 2.0 * radius : 1.0, k ? 2.0 * radius : 1.0, 0.0, 0.125, &part[k]));
  PetscCall(Join(&part[0], &part[1]));
  PetscCall(MeshSerialDestroy(&part[1]));
  AddMesh(&b, &part[0], &setup);
  PetscCall(ModelOverlap(&b, &pair));
  CHECK((pair.element[0] >= 0) == expected, "parts, x = %g, radius %g: elements %d and %d", x, radius,
        pair.element[0], pair.element[1]);
  PetscCall(ModelDestroy(&a));
  return ModelDestroy(&b);
}

/* --- substeps ----------------------------------------------------------------------------------------- */

/* The limit of a block on a fixed one, which has this density. */
static PetscErrorCode LimitOnFixed(double density, double *limit)
{
  const SolidSetup options = {.courant = 0.8};
  BodySetup block = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.0)), fixed = block;
  Model a = {0};
  Solid s;
  fixed.material.density = density;
  fixed.fixed = 1;
  AddRectangle(&a, 0.0, 1.001, 1.0, 1.0, 0.0, 0.125, 0, &block);
  AddRectangle(&a, 0.0, 0.0, 2.0, 1.0, 0.0, 0.125, 0, &fixed);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(RunStep(s, 1e-6, NULL));
  PetscCall(SolidLimit(s, limit));
  CHECK(SolidGetStats(s)->searches > 0, "no search");
  PetscCall(SolidDestroy(&s));
  return ModelDestroy(&a);
}

/* Nodes that cannot move ask for no short substeps, however light they are. */
static PetscErrorCode HeldNodes(void)
{
  double light, heavy;
  PetscCall(LimitOnFixed(1.0, &light));
  PetscCall(LimitOnFixed(1e6, &heavy));
  CHECK(fabs(light / heavy - 1.0) < 1e-12, "limit %g s on a light fixed body, %g s on a heavy one", light,
        heavy);
  return 0;
}

/* --- fast bodies -------------------------------------------------------------------------------------- */

enum { SIDE = 5 };

/* Discs in rows and another one, far away: the candidates after a step, and its substeps. */
static PetscErrorCode Flier(double speed, int *candidates, int *substeps)
{
  const SolidSetup options = {.courant = 0.8};
  BodySetup disc = BodyAtRest(MaterialOf(2000.0, 1e6, 0.2, 0.0));
  Model a = {0};
  Solid s;
  for (int k = 0; k < SIDE * SIDE; k++)
    AddDisc(&a, 0.05 * (k % SIDE), 0.05 * (int)(k / SIDE), 0.02, 0.02, &disc);
  disc.velocity[1] = speed;
  AddDisc(&a, 5.0, 0.0, 0.02, 0.02, &disc);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(RunStep(s, 0.002, NULL));
  *candidates = s->contact->ncandidates;
  *substeps = SolidGetStats(s)->substeps;
  PetscCall(SolidDestroy(&s));
  return ModelDestroy(&a);
}

/* A fast body is no reason to look at more pairs of others. */
static PetscErrorCode Fliers(void)
{
  int slow[2], fast[2];
  PetscCall(Flier(0.0, &slow[0], &slow[1]));
  PetscCall(Flier(100.0, &fast[0], &fast[1]));
  CHECK(fast[0] == slow[0] && fast[1] == slow[1],
        "%d candidates and %d substeps beside a fast disc, %d and %d beside a slow one", fast[0], fast[1],
        slow[0], slow[1]);
  return 0;
}

/* A rigid square flies at two that stand side by side, a little apart: the last one leaves with its velocity. */
static PetscErrorCode Strike(double speed)
{
  const SolidSetup options = {.courant = 0.2};
  const double side = 0.02;
  const Material rigid = {.density = 2000.0, .penalty = 1e9, .rigid = 1};
  BodySetup square = BodyAtRest(rigid);
  Model a = {0};
  BodyState b[3];
  Solid s;
  AddRectangle(&a, 0.0, 0.0, side, side, 0.0, side, 0, &square);
  AddRectangle(&a, 1.02 * side, 0.0, side, side, 0.0, side, 0, &square);
  square.velocity[0] = speed;
  AddRectangle(&a, -10.5 * side, 0.0, side, side, 0.0, side, 0, &square);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(Run(s, 20.0 * side / speed, 2.0 * side / speed));
  PetscCall(SolidBodies(s, 3, b));
  if (getenv("VERBOSE"))
    printf("struck with %g m/s: %.4f, %.4f, %.4f m/s\n", speed, b[2].v[0], b[0].v[0], b[1].v[0]);
  CHECK(fabs(b[1].v[0] / speed - 1.0) < 0.05 && fabs(b[0].v[0] / speed) < 0.05 &&
            fabs(b[2].v[0] / speed) < 0.05,
        "after %g m/s the squares have %g, %g and %g m/s", speed, b[2].v[0], b[0].v[0], b[1].v[0]);
  PetscCall(SolidDestroy(&s));
  return ModelDestroy(&a);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(EnergyGradient());
  PetscCall(Grid());
  PetscCall(GridOfAllSizes());
  PetscCall(Overlap(1.2, 0.5, 0));
  PetscCall(Overlap(1.0, 0.5, 0)); /* side by side, touching */
  PetscCall(Overlap(0.99, 0.5, 1));
  PetscCall(Overlap(0.0, 0.1, 1)); /* one within the other */
  PetscCall(Overlap(0.0, 0.5, 1)); /* one exactly over the other */
  PetscCall(HeldNodes());
  PetscCall(Strike(100.0));
  PetscCall(Strike(1.0));
  PetscCall(Fliers());
  return PetscFinalize();
}
