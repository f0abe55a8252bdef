#include "solid/check_domain.h"
#include "common/program/gauge_case.h"
#include "common/program/outline_case.h"
#include "common/supermesh/geometry.h"
#include "solid/bodies/case_body.h"
#include <stdio.h>

/* Elements of the fluid through a wall that holds water. */
#define THICK 1.99

static void Bound(int n, const double x[][2], double lower[2], double upper[2])
{
  GeometryBox box = GeometryBoxEmpty();
  for (int k = 0; k < n; k++) GeometryBoxGrow(&box, x[k]);
  memcpy(lower, box.lower, sizeof box.lower);
  memcpy(upper, box.upper, sizeof box.upper);
}

/* The fluid's domain, as far as the case says it: the bounds of the box, the polygon, or the mesh in a file.  What is wrong with these the fluid tells. */
static PetscErrorCode FluidDomain(CoracleCase c, double lower[2], double upper[2], PetscBool *known)
{
  const char *why;
  MeshSerial mesh;
  PetscFunctionBeginUser;
  *known = PETSC_TRUE;
  if (CoracleCaseHas(c, "fluid.mesh.corners")) {
    int n;
    double(*corner)[2];
    PetscCall(CaseReadOutline(c, "fluid.mesh.corners", &n, &corner));
    Bound(n, (const double(*)[2])corner, lower, upper);
    PetscCall(PetscFree(corner));
  } else if (!CoracleCaseHas(c, "fluid.mesh.file")) {
    *known = (PetscBool)(CoracleCaseVectorOptional(c, "fluid.mesh.lower", 2, lower) &&
                         CoracleCaseVectorOptional(c, "fluid.mesh.upper", 2, upper));
  } else if (MeshReadGmsh(CoracleCaseFile(c, "fluid.mesh.file"), &mesh, &why)) {
    *known = PETSC_FALSE;
  } else {
    Bound(mesh.nv, (const double(*)[2])mesh.x, lower, upper);
    PetscCall(MeshSerialDestroy(&mesh));
  }
  PetscFunctionReturn(0);
}

/* As the coupler at the start of a run (run_checks.c): no node may be outside. */
PetscErrorCode CheckDomain(CoracleCase c, Solid s)
{
  double lower[2], upper[2];
  PetscBool known;
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  PetscCall(FluidDomain(c, lower, upper, &known));
  for (int n = 0; n < s->nnodes && known; n++) {
    const double *x = s->x + 2 * n;
    if (x[0] >= lower[0] && x[0] <= upper[0] && x[1] >= lower[1] && x[1] <= upper[1]) continue;
    CoracleCaseRefuse(
        c, BodyKey(key, s->body[s->node_body[n]].entry, ""),
        "the solid's node %lld at (%g, %g) lies outside of the fluid domain [%g, %g] x [%g, %g]", s->gid[n],
        x[0], x[1], lower[0], upper[0], lower[1], upper[1]);
  }
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

/* The entry of a body that nothing holds, prescribes in both components until the end or ties to a spring; -1: there is none. */
static int LooseBody(Solid s, double end)
{
  for (int b = 0; b < s->nbodies; b++) {
    int held = 0, prescribed[2] = {0, 0};
    for (int n = 0; n < s->nnodes; n++) held |= s->node_body[n] == b && s->inverse_mass[n] == 0.0;
    for (int k = 0; k < s->nprescribed; k++) {
      const PrescribedMotion *motion = &s->motion[s->prescribed[k].motion];
      const int acts = motion->release <= 0.0 || motion->release >= end;
      for (int c = 0; c < 2 && s->node_body[s->prescribed[k].node] == b; c++)
        prescribed[c] |= acts && motion->prescribed[c];
    }
    held |= prescribed[0] && prescribed[1];
    for (int k = 0; k < s->setup.nsprings; k++)
      for (int i = 0; i < 2; i++) {
        const int e = s->spring_element[k][i];
        held |= e >= 0 && s->elements.body[e] == b;
      }
    if (!held) return s->body[b].entry;
  }
  return -1;
}

void NoteWalls(CoracleCase c, Solid s, double end)
{
  const int loose = LooseBody(s, end);
  if (s->setup.walls || loose < 0 || GravityLargest(s->setup.gravity, &s->setup.gravity_table) == 0.0) return;
  if (CoracleCaseHas(c, "fluid.boundaries"))
    printf("note: there are no solid.walls: solid.bodies[%d] may leave through the sides of the fluid's "
           "domain, closed ones too, which hold the fluid alone\n",
           loose);
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
