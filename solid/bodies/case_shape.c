#include "solid/bodies/case_shape.h"
#include "common/program/outline_case.h"
#include "common/supermesh/geometry.h"
#include "common/supermesh/outline.h"
#include "solid/bodies/shape.h"

BodyRepeat CaseReadRepeat(CoracleCase c, int body)
{
  BodyRepeat r = {.n = {1, 1}};
  double n[2];
  char key[CASE_KEY];
  if (!CoracleCaseVectorOptional(c, BodyKey(key, body, "repeat.n"), 2, n)) return r;
  for (int k = 0; k < 2; k++) {
    if (!(n[k] >= 1.0 && n[k] <= 1e6 && n[k] == floor(n[k])))
      CoracleCaseRefuse(c, key, "expected two integers >= 1");
    r.n[k] = (int)n[k];
  }
  CoracleCaseVector(c, BodyKey(key, body, "repeat.step"), 2, r.step);
  return r;
}

/* More than any computer that this is meant for holds: a slip in a size. */
#define ELEMENTS_MAX 1e7

/* Before the body is made: elements, counted as a double, times how often it is there. */
static void CheckCount(CoracleCase c, int body, const char *name, double elements)
{
  const BodyRepeat r = CaseReadRepeat(c, body);
  const double bodies = (double)r.n[0] * r.n[1];
  char key[CASE_KEY];
  if (elements * bodies <= ELEMENTS_MAX) return;
  CoracleCaseRefuse(c, BodyKey(key, body, elements > ELEMENTS_MAX ? name : "repeat.n"),
                    "%.3g bodies of about %.3g elements each are more than %g elements", bodies, elements,
                    ELEMENTS_MAX);
}

static PetscErrorCode ReadMeshFile(CoracleCase c, int body, MeshSerial *mesh)
{
  char key[CASE_KEY];
  const char *path, *why = NULL;
  static const char *const SHAPED[] = {"shape", "centre", "size", "angle", "corners", NULL};
  double translate[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  CoracleCaseNotBeside(c, BodyKey(key, body, ""), "mesh", SHAPED);
  path = CoracleCaseFile(c, BodyKey(key, body, "mesh"));
  if (MeshReadGmsh(path, mesh, &why)) CoracleCaseRefuse(c, key, "%s", why);
  CheckCount(c, body, "mesh", mesh->ne);
  (void)CoracleCaseVectorOptional(c, BodyKey(key, body, "translate"), 2, translate);
  const double scale = CoracleCaseHas(c, BodyKey(key, body, "scale")) ? CoracleCasePositive(c, key) : 1.0;
  for (int k = 0; k < 2 * mesh->nv; k++) mesh->x[k] = scale * mesh->x[k] + translate[k % 2];
  PetscFunctionReturn(0);
}

static PetscErrorCode ReadRing(CoracleCase c, int body, const double centre[2], double size, MeshSerial *mesh)
{
  static const char *const RADII[] = {"outer_radius", "inner_radius", NULL};
  double inner, outer;
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  CoracleCaseNotBeside(c, BodyKey(key, body, ""), "radius", RADII);
  if (CoracleCaseHas(c, BodyKey(key, body, "radius"))) { /* of the wall's middle */
    const double radius = CoracleCasePositive(c, key),
                 thickness = CoracleCasePositive(c, BodyKey(key, body, "thickness"));
    inner = radius - 0.5 * thickness;
    outer = radius + 0.5 * thickness;
  } else {
    outer = CoracleCasePositive(c, BodyKey(key, body, "outer_radius"));
    inner = CoracleCasePositive(c, BodyKey(key, body, "inner_radius"));
  }
  if (!(inner > 0.0 && inner < outer)) CoracleCaseRefuse(c, key, "the ring has no hole or no wall");
  CheckCount(c, body, "size", 4.0 * M_PI * outer / size);
  const double through = PetscMin(1000.0, ceil((outer - inner) / size - 1e-9));
  const int layers =
      CoracleCaseIntegerOr(c, BodyKey(key, body, "layers"), PetscMax(1, (int)through), 1, 1000);
  CheckCount(c, body, "size", 4.0 * M_PI * outer / size * layers);
  PetscCall(ShapeRing(centre, inner, outer, layers, size, mesh));
  PetscFunctionReturn(0);
}

static double ReadAngle(CoracleCase c, int body)
{
  char key[CASE_KEY];
  return CoracleCaseNumberOr(c, BodyKey(key, body, "angle"), 0.0, -2.0 * M_PI, 2.0 * M_PI);
}

/* Turns a polygon about its centre of area. */
static void TurnAboutCentre(int n, double x[][2], double angle)
{
  const double area = OutlineArea(n, (const double(*)[2])x);
  double centre[2] = {x[0][0], x[0][1]};
  if (angle == 0.0) return;
  for (int k = 1; k + 1 < n; k++) {
    const double *a = x[k], *b = x[k + 1], part = 0.5 * GeometryTurn(x[0], a, b) / area;
    for (int c = 0; c < 2; c++) centre[c] += part * (a[c] - x[0][c] + b[c] - x[0][c]) / 3.0;
  }
  for (int k = 0; k < n; k++) {
    const double dx = x[k][0] - centre[0], dy = x[k][1] - centre[1];
    x[k][0] = centre[0] + cos(angle) * dx - sin(angle) * dy;
    x[k][1] = centre[1] + sin(angle) * dx + cos(angle) * dy;
  }
}

static PetscErrorCode ReadPolygon(CoracleCase c, int body, double size, MeshSerial *mesh)
{
  int n;
  double(*corner)[2];
  const char **side;
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  PetscCall(CaseReadOutline(c, BodyKey(key, body, "corners"), &n, &corner));
  PetscCall(CaseReadSides(c, BodyKey(key, body, "sides"), n, &side));
  TurnAboutCentre(n, corner, ReadAngle(c, body));
  CheckCount(c, body, "size", MeshPolygonCount(n, (const double(*)[2])corner, size));
  PetscCall(MeshPolygon(n, (const double(*)[2])corner, side, size, mesh));
  PetscCall(PetscFree(side));
  PetscCall(PetscFree(corner));
  PetscFunctionReturn(0);
}

typedef enum { SHAPE_DISC, SHAPE_ELLIPSE, SHAPE_RECTANGLE, SHAPE_RING, SHAPE_POLYGON, SHAPE_FILE } Shape;

static Shape ReadShapeName(CoracleCase c, int body)
{
  static const char *const SHAPES[] = {"disc", "ellipse", "rectangle", "ring", "polygon", NULL};
  char key[CASE_KEY];
  return CoracleCaseHas(c, BodyKey(key, body, "mesh"))
             ? SHAPE_FILE
             : (Shape)CoracleCaseWord(c, BodyKey(key, body, "shape"), -1, SHAPES);
}

/* 6 rings^2 triangles fill a disc, or an ellipse with that larger radius. */
static void CheckRings(CoracleCase c, int body, double radius, double size)
{
  const double rings = M_PI * radius / (3.0 * size);
  CheckCount(c, body, "size", 6.0 * rings * rings);
}

static PetscErrorCode ReadSides(CoracleCase c, int body, Shape shape, const double centre[2], double size,
                                MeshSerial *mesh)
{
  char key[CASE_KEY];
  const double width = CoracleCasePositive(c, BodyKey(key, body, "width")),
               height = CoracleCasePositive(c, BodyKey(key, body, "height")), angle = ReadAngle(c, body),
               radii[2] = {0.5 * width, 0.5 * height};
  PetscFunctionBeginUser;
  if (shape == SHAPE_ELLIPSE) {
    CheckRings(c, body, PetscMax(radii[0], radii[1]), size);
    PetscCall(ShapeEllipse(centre, radii, angle, size, mesh));
  } else {
    CheckCount(c, body, "size", 2.0 * (width / size + 1.0) * (height / size + 1.0));
    PetscCall(ShapeRectangle(centre, width, height, angle, size, mesh));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode CaseReadShape(CoracleCase c, int body, MeshSerial *mesh, double *circle)
{
  const Shape shape = ReadShapeName(c, body);
  double centre[2];
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  *circle = 0.0;
  if (shape == SHAPE_FILE) {
    PetscCall(ReadMeshFile(c, body, mesh));
    PetscFunctionReturn(0);
  }
  const double size = CoracleCasePositive(c, BodyKey(key, body, "size"));
  if (shape == SHAPE_POLYGON) {
    PetscCall(ReadPolygon(c, body, size, mesh));
    PetscFunctionReturn(0);
  }
  CoracleCaseVector(c, BodyKey(key, body, "centre"), 2, centre);
  if (shape == SHAPE_DISC) {
    *circle = CoracleCasePositive(c, BodyKey(key, body, "radius"));
    CheckRings(c, body, *circle, size);
    PetscCall(ShapeDisc(centre, *circle, size, mesh));
  } else if (shape == SHAPE_RING) {
    PetscCall(ReadRing(c, body, centre, size, mesh));
  } else {
    PetscCall(ReadSides(c, body, shape, centre, size, mesh));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode CaseReadStretch(CoracleCase c, int body, const MeshSerial *mesh, BodySetup *setup,
                               double **position)
{
  double centre[2];
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  *position = NULL;
  (void)CoracleCaseVectorOptional(c, BodyKey(key, body, "stretch"), 2, setup->stretch);
  if (!(setup->stretch[0] > 0.0 && setup->stretch[1] > 0.0))
    CoracleCaseRefuse(c, key, "expected two numbers > 0");
  if (!CoracleCaseHas(c, key) || ReadShapeName(c, body) != SHAPE_RING) PetscFunctionReturn(0);
  CoracleCaseVector(c, BodyKey(key, body, "centre"), 2, centre);
  PetscCall(PetscMalloc1(2 * (size_t)mesh->nv, position));
  ShapeRingStretched(centre, setup->stretch, MaterialLaw(&setup->material), mesh, *position);
  setup->position = *position;
  PetscFunctionReturn(0);
}
