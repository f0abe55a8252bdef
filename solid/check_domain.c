#include "solid/check_domain.h"
#include "common/program/gauge_case.h"
#include "common/program/outline_case.h"
#include "common/supermesh/geometry.h"
#include "solid/bodies/case_body.h"
#include <stdio.h>

/* Elements of the fluid through a wall that holds water. */
#define THICK 1.99

/* Of the domain's smaller extent: a node is at a side within that, and farther outside it is meant to be there, or a mistake. */
#define AT_SIDE 1e-3

typedef struct {
  PetscBool known;
  double lower[2], upper[2];
  int nsides;
  double (*side)[2][2]; /* [nsides] from, to; in any order */
} Domain;

static void AddSide(Domain *d, const double from[2], const double to[2])
{
  for (int c = 0; c < 2; c++) {
    d->side[d->nsides][0][c] = from[c];
    d->side[d->nsides][1][c] = to[c];
    d->lower[c] = fmin(d->lower[c], from[c]);
    d->upper[c] = fmax(d->upper[c], from[c]);
  }
  d->nsides++;
}

static PetscErrorCode AddOutline(Domain *d, int n, const double corner[][2])
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &d->side));
  for (int k = 0; k < n; k++) AddSide(d, corner[k], corner[(k + 1) % n]);
  PetscFunctionReturn(0);
}

/* The fluid's domain, as far as the case says it: the box, the polygon, or the mesh in a file.  What is wrong with these the fluid tells. */
static PetscErrorCode FluidDomain(CoracleCase c, Domain *d)
{
  const char *why;
  double box[2][2];
  MeshSerial mesh;
  PetscFunctionBeginUser;
  *d = (Domain){PETSC_TRUE, {HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}, 0, NULL};
  if (CoracleCaseHas(c, "fluid.mesh.corners")) {
    int n;
    double(*corner)[2];
    PetscCall(CaseReadOutline(c, "fluid.mesh.corners", &n, &corner));
    PetscCall(AddOutline(d, n, (const double(*)[2])corner));
    PetscCall(PetscFree(corner));
  } else if (!CoracleCaseHas(c, "fluid.mesh.file")) {
    d->known = (PetscBool)(CoracleCaseVectorOptional(c, "fluid.mesh.lower", 2, box[0]) &&
                           CoracleCaseVectorOptional(c, "fluid.mesh.upper", 2, box[1]));
    if (d->known)
      PetscCall(AddOutline(d, 4,
                           (const double[4][2]){{box[0][0], box[0][1]},
                                                {box[1][0], box[0][1]},
                                                {box[1][0], box[1][1]},
                                                {box[0][0], box[1][1]}}));
  } else if (MeshReadGmsh(CoracleCaseFile(c, "fluid.mesh.file"), &mesh, &why)) {
    d->known = PETSC_FALSE;
  } else {
    PetscCall(PetscMalloc1(mesh.nb, &d->side));
    for (int k = 0; k < mesh.nb; k++)
      AddSide(d, mesh.x + 2 * mesh.facet[2 * k], mesh.x + 2 * mesh.facet[2 * k + 1]);
    PetscCall(MeshSerialDestroy(&mesh));
  }
  PetscFunctionReturn(0);
}

static double AtSide(const Domain *d)
{
  return AT_SIDE * fmin(d->upper[0] - d->lower[0], d->upper[1] - d->lower[1]);
}

/* How far x is from the sides, m; below 0 inside. */
static double Outside(const Domain *d, const double x[2])
{
  PetscBool inside = PETSC_FALSE;
  double distance = HUGE_VAL;
  for (int k = 0; k < d->nsides; k++) {
    const double *a = d->side[k][0], *b = d->side[k][1];
    distance = fmin(distance, GeometryDistanceAt(a, b, GeometrySegmentPlace(a, b, x), x));
    if ((a[1] > x[1]) == (b[1] > x[1])) continue;
    if (x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = (PetscBool)!inside;
  }
  return inside ? -distance : distance;
}

/* The node that is farthest out of the domain, within its bounds: a run takes it, and what is outside is not in the fluid. */
static void NoteOutside(const Domain *d, Solid s)
{
  double farthest = AtSide(d);
  int node = -1;
  for (int n = 0; n < s->nnodes; n++) {
    const double outside = Outside(d, s->x + 2 * n);
    if (outside <= farthest) continue;
    farthest = outside;
    node = n;
  }
  if (node >= 0)
    printf(
        "note: solid.bodies[%d] reaches out of the fluid's domain, at (%g, %g) by %.3g m: there is no fluid "
        "there\n",
        s->body[s->node_body[node]].entry, s->x[2 * node], s->x[2 * node + 1], farthest);
}

/* As the coupler at the start of a run (run_checks.c): no node may be outside of the domain's bounds. */
PetscErrorCode CheckDomain(CoracleCase c, Solid s)
{
  Domain d;
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  PetscCall(FluidDomain(c, &d));
  for (int n = 0; n < s->nnodes && d.known; n++) {
    const double *x = s->x + 2 * n;
    if (x[0] >= d.lower[0] && x[0] <= d.upper[0] && x[1] >= d.lower[1] && x[1] <= d.upper[1]) continue;
    CoracleCaseRefuse(
        c, BodyKey(key, s->body[s->node_body[n]].entry, ""),
        "the solid's node %lld at (%g, %g) lies outside of the fluid domain [%g, %g] x [%g, %g]", s->gid[n],
        x[0], x[1], d.lower[0], d.upper[0], d.lower[1], d.upper[1]);
  }
  if (d.known && CoracleCaseFaultless(c)) NoteOutside(&d, s);
  PetscCall(PetscFree(d.side));
  PetscFunctionReturn(0);
}

/* Whether the nearest facet is within half of its length. */
static PetscBool IsAtSurface(const SolidView *v, const double point[2], double *distance)
{
  PetscBool at = PETSC_FALSE;
  *distance = HUGE_VAL;
  for (int k = 0; k < v->nfacets; k++) {
    const double *a = v->x + 2 * v->facet[2 * k], *b = v->x + 2 * v->facet[2 * k + 1];
    const double d = GeometryDistanceAt(a, b, GeometrySegmentPlace(a, b, point), point);
    if (d >= *distance) continue;
    *distance = d;
    at = (PetscBool)(d <= 0.5 * hypot(b[0] - a[0], b[1] - a[1]));
  }
  return at;
}

/* As the coupler at the start of a run (geometry/gauges.c). */
void CheckGauges(CoracleCase c, Solid s)
{
  SolidView v;
  double point[CASE_GAUGES_MAX][2], distance;
  SolidGetView(s, &v);
  for (int k = 0; k < CoracleCaseCount(c, "fluid.probes"); k++) {
    const int n = CaseGauges(c, k, point);
    for (int i = 0; i < n; i++)
      if (!IsAtSurface(&v, point[i], &distance))
        CoracleCaseRefuse(c, CaseGaugeKey(c, k),
                          v.nfacets
                              ? "expected a point of the solid's surface, (%g, %g) is %.3g m away from it"
                              : "there are no bodies",
                          point[i][0], point[i][1], distance);
  }
}

/* --- whether a body may leave --------------------------------------------------------------------------- */

/* Nothing holds the body, prescribes both components of its motion until the end or ties it to a spring. */
static PetscBool IsLoose(Solid s, int b, double end)
{
  int held = 0, prescribed[2] = {0, 0};
  for (int n = 0; n < s->nnodes; n++) held |= s->node_body[n] == b && s->inverse_mass[n] == 0.0;
  for (int k = 0; k < s->nprescribed; k++) {
    const PrescribedMotion *motion = &s->motion[s->prescribed[k].motion];
    const int acts = motion->release <= 0.0 || motion->release >= end;
    for (int c = 0; c < 2 && s->node_body[s->prescribed[k].node] == b; c++)
      prescribed[c] |= acts && motion->prescribed[c];
  }
  for (int k = 0; k < s->setup.nsprings; k++)
    for (int i = 0; i < 2; i++) {
      const int e = s->spring_element[k][i];
      held |= e >= 0 && s->elements.body[e] == b;
    }
  return (PetscBool) !(held || (prescribed[0] && prescribed[1]));
}

/* The first loose body; -1: there is none. */
static int LooseBody(Solid s, double end)
{
  for (int b = 0; b < s->nbodies; b++)
    if (IsLoose(s, b, end)) return b;
  return -1;
}

/* The first node of a loose body at a side of the domain where there is no wall; -1: there is none. */
static int NodeWithoutWall(Solid s, double end, const Domain *d)
{
  const double *lower = s->setup.lower, *upper = s->setup.upper, near = AtSide(d);
  int held = -1; /* the last body that is not loose */
  for (int n = 0; n < s->nnodes; n++) {
    const double *x = s->x + 2 * n;
    const int b = s->node_body[n];
    if (b == held || fabs(Outside(d, x)) > near || fabs(x[0] - lower[0]) <= near ||
        fabs(x[0] - upper[0]) <= near || fabs(x[1] - lower[1]) <= near || fabs(x[1] - upper[1]) <= near)
      continue;
    if (IsLoose(s, b, end)) return n;
    held = b;
  }
  return -1;
}

PetscErrorCode NoteWalls(CoracleCase c, Solid s, double end)
{
  Domain d;
  PetscFunctionBeginUser;
  if (GravityLargest(s->setup.gravity, &s->setup.gravity_table) == 0.0) PetscFunctionReturn(0);
  if (!CoracleCaseHas(c, "fluid.boundaries")) PetscFunctionReturn(0);
  PetscCall(FluidDomain(c, &d));
  const int body = s->setup.walls ? -1 : LooseBody(s, end);
  const int node = s->setup.walls && d.known ? NodeWithoutWall(s, end, &d) : -1;
  if (body >= 0)
    printf("note: there are no solid.walls: solid.bodies[%d] may leave through the sides of the fluid's "
           "domain, closed ones too, which hold the fluid alone\n",
           s->body[body].entry);
  if (node >= 0)
    printf("note: solid.bodies[%d] begins at a side of the fluid's domain, at (%g, %g), where there are no "
           "solid.walls: it may leave through that, a closed one too, which holds the fluid alone\n",
           s->body[s->node_body[node]].entry, s->x[2 * node], s->x[2 * node + 1]);
  PetscCall(PetscFree(d.side));
  PetscFunctionReturn(0);
}

/* Coordinates over the shortest edge.  A stiff body (E 5e10 Pa, edges of 2 cm) at 4e6 m has 0.006 J/m of vibration after 0.2 s, which goes on growing. */
#define FAR 1e7

void NoteFar(Solid s)
{
  double farthest = 0.0, shortest = HUGE_VAL;
  for (int k = 0; k < 2 * s->nnodes; k++) farthest = fmax(farthest, fabs(s->x[k]));
  for (int e = 0; e < s->elements.n; e++)
    for (int i = 0; i < 3 && s->body[s->elements.body[e]].rigid.mass == 0.0; i++) {
      const double *a = s->x + 2 * s->element[3 * e + i], *b = s->x + 2 * s->element[3 * e + (i + 1) % 3];
      shortest = fmin(shortest, hypot(a[0] - b[0], a[1] - b[1]));
    }
  if (farthest > FAR * shortest)
    printf("note: bodies are up to %.3g m from the origin, with edges of %.3g m: positions are rounded by so "
           "much that they "
           "begin to vibrate; move the case to the origin\n",
           farthest, shortest);
}

/* --- whether it holds water ----------------------------------------------------------------------------- */

/* The shorter side of the rectangle with a body's area and perimeter; of a compact one about that of a square. */
static double Thickness(double area, double perimeter)
{
  const double mean = 0.25 * perimeter, square = mean * mean - area;
  return mean - sqrt(fmax(square, 0.0));
}

/* A held gate of a fifth of an element lets an eighth of 0.3 m of water through within 0.5 s, one of an element a tenth of that, one of two nothing. */
PetscErrorCode NoteThin(CoracleCase c, Solid s)
{
  SolidView v;
  double *area, *perimeter;
  PetscFunctionBeginUser;
  if (!CoracleCaseHas(c, "fluid.phases") || !CoracleCaseHas(c, "fluid.adapt.size_min"))
    PetscFunctionReturn(0);
  const double size = CoracleCasePositive(c, "fluid.adapt.size_min");
  SolidGetView(s, &v);
  PetscCall(PetscCalloc2(v.nbodies, &area, v.nbodies, &perimeter));
  for (int e = 0; e < v.nelements; e++) {
    const int *n = v.element + 3 * e;
    const double x[3][2] = {{v.x[2 * n[0]], v.x[2 * n[0] + 1]},
                            {v.x[2 * n[1]], v.x[2 * n[1] + 1]},
                            {v.x[2 * n[2]], v.x[2 * n[2] + 1]}};
    area[v.body[e]] += GeometryArea(x);
  }
  for (int k = 0; k < v.nfacets; k++) {
    const double *a = v.x + 2 * v.facet[2 * k], *b = v.x + 2 * v.facet[2 * k + 1];
    perimeter[s->node_body[v.facet[2 * k]]] += hypot(a[0] - b[0], a[1] - b[1]);
  }
  for (int b = 0; b < v.nbodies; b++) {
    const double thickness = Thickness(area[b], perimeter[b]);
    if (thickness >= THICK * size) continue;
    printf("note: solid.bodies[%d] is about %.2g m thick, fluid.adapt.size_min is %g m: water passes through "
           "walls of less than two elements, and a body needs some ten\n",
           s->body[b].entry, thickness, size);
    break;
  }
  PetscCall(PetscFree2(area, perimeter));
  PetscFunctionReturn(0);
}
