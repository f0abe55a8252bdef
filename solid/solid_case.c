#include "solid_case.h"
#include "shape.h"
#include <stdarg.h>
#include <stdio.h>

enum { KEY = 192 };

/* "solid.bodies[i].name" */
static const char *BodyKey(char key[KEY], int body, const char *name)
{
  (void)snprintf(key, KEY, "solid.bodies[%d]%s%s", body, name[0] ? "." : "", name);
  return key;
}

/* --- materials
 * ---------------------------------------------------------------------------------------------- */

static double Property(Case c, const char *material, const char *name, double lower, double upper)
{
  char key[KEY];
  (void)snprintf(key, sizeof key, "solid.materials.%s.%s", material, name);
  return lower < upper ? CaseNumber(c, key, lower, upper) : CasePositive(c, key);
}

static Material ReadMaterial(Case c, const char *name)
{
  Material m = {0};
  char key[KEY];
  m.density = Property(c, name, "density", 0.0, 0.0);
  m.youngs_modulus = Property(c, name, "youngs_modulus", 0.0, 0.0);
  m.poisson_ratio = Property(c, name, "poisson_ratio", 0.0, 0.499);
  (void)snprintf(key, sizeof key, "solid.materials.%s.damping", name);
  m.damping = CaseNumberOr(c, key, 0.0, 0.0, 0.999);
  (void)snprintf(key, sizeof key, "solid.materials.%s.penalty", name);
  m.penalty = CaseHas(c, key) ? CasePositive(c, key) : m.youngs_modulus;
  return m;
}

/* Every material is read, also those that no body has. */
static void CheckMaterial(void *context, const char *name)
{
  (void)ReadMaterial(context, name);
}

static Material BodyMaterial(Case c, int body)
{
  char key[KEY], material[KEY];
  const char *name = CaseString(c, BodyKey(key, body, "material"));
  (void)snprintf(material, sizeof material, "solid.materials.%.100s", name);
  if (!CaseHas(c, material)) CaseRefuse(c, key, "there is no material '%s' in solid.materials", name);
  return ReadMaterial(c, name);
}

/* --- bodies
 * ------------------------------------------------------------------------------------------------- */

static PetscErrorCode ReadMeshFile(Case c, int body, MeshSerial *mesh)
{
  char key[KEY];
  const char *path = CaseFile(c, BodyKey(key, body, "mesh")), *why = NULL;
  double translate[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  if (MeshReadGmsh(path, mesh, &why)) CaseRefuse(c, key, "%s", why);
  (void)CaseVectorOptional(c, BodyKey(key, body, "translate"), 2, translate);
  const double scale = CaseHas(c, BodyKey(key, body, "scale")) ? CasePositive(c, key) : 1.0;
  for (int k = 0; k < 2 * mesh->nv; k++) mesh->x[k] = scale * mesh->x[k] + translate[k % 2];
  PetscFunctionReturn(0);
}

static PetscErrorCode ReadShape(Case c, int body, MeshSerial *mesh)
{
  static const char *const SHAPES[] = {"disc", "rectangle", NULL};
  double centre[2];
  char key[KEY];
  PetscFunctionBeginUser;
  if (CaseHas(c, BodyKey(key, body, "mesh"))) {
    PetscCall(ReadMeshFile(c, body, mesh));
    PetscFunctionReturn(0);
  }
  const int shape = CaseWord(c, BodyKey(key, body, "shape"), -1, SHAPES);
  CaseVector(c, BodyKey(key, body, "centre"), 2, centre);
  const double size = CasePositive(c, BodyKey(key, body, "size"));
  if (shape == 0) {
    PetscCall(ShapeDisc(centre, CasePositive(c, BodyKey(key, body, "radius")), size, mesh));
  } else {
    const double width = CasePositive(c, BodyKey(key, body, "width"));
    const double height = CasePositive(c, BodyKey(key, body, "height"));
    const double angle = CaseNumberOr(c, BodyKey(key, body, "angle"), 0.0, -HUGE_VAL, HUGE_VAL);
    PetscCall(ShapeRectangle(centre, width, height, angle, size, mesh));
  }
  PetscFunctionReturn(0);
}

/* true, or a list of boundary names (*name is allocated). */
static PetscErrorCode ReadFixed(Case c, int body, BodySetup *setup, const char ***name)
{
  char key[KEY], item[KEY + 16];
  PetscFunctionBeginUser;
  *name = NULL;
  BodyKey(key, body, "fixed");
  (void)snprintf(item, sizeof item, "%s[0]", key);
  if (!CaseHas(c, item)) {
    setup->fixed = CaseBoolOr(c, key, false);
    PetscFunctionReturn(0);
  }
  setup->nfixed = CaseCount(c, key);
  PetscCall(PetscMalloc1((size_t)setup->nfixed, name));
  for (int k = 0; k < setup->nfixed; k++) {
    (void)snprintf(item, sizeof item, "%s[%d]", key, k);
    (*name)[k] = CaseString(c, item);
  }
  setup->fixed_name = *name;
  PetscFunctionReturn(0);
}

static PetscErrorCode AddBody(Case c, int body, Assembly *a)
{
  BodySetup setup = {.stretch = {1.0, 1.0}};
  MeshSerial mesh = {0};
  const char **name, *why = NULL;
  char key[KEY];
  PetscFunctionBeginUser;
  setup.material = BodyMaterial(c, body);
  PetscCall(ReadShape(c, body, &mesh));
  PetscCall(ReadFixed(c, body, &setup, &name));
  (void)CaseVectorOptional(c, BodyKey(key, body, "stretch"), 2, setup.stretch);
  if (!(setup.stretch[0] > 0.0 && setup.stretch[1] > 0.0)) CaseRefuse(c, key, "expected two numbers > 0");
  (void)CaseVectorOptional(c, BodyKey(key, body, "velocity"), 2, setup.velocity);
  if (setup.fixed && (setup.velocity[0] != 0.0 || setup.velocity[1] != 0.0))
    CaseRefuse(c, key, "a fixed body has no velocity");
  setup.angular_velocity = CaseNumberOr(c, BodyKey(key, body, "angular_velocity"), 0.0, -HUGE_VAL, HUGE_VAL);
  if (setup.fixed && setup.angular_velocity != 0.0) CaseRefuse(c, key, "a fixed body does not turn");
  if (AssemblyAdd(a, &mesh, &setup, &why)) CaseRefuse(c, BodyKey(key, body, ""), "%s", why);
  PetscCall(PetscFree(name));
  PetscCall(MeshSerialDestroy(&mesh));
  PetscFunctionReturn(0);
}

/* --- the whole
 * ---------------------------------------------------------------------------------------------- */

static void ReadWalls(Case c, const Assembly *a, SolidSetup *setup)
{
  char key[KEY];
  setup->walls = (PetscBool)CaseHas(c, "solid.walls");
  if (!setup->walls) return;
  CaseVector(c, "solid.walls.lower", 2, setup->lower);
  CaseVector(c, "solid.walls.upper", 2, setup->upper);
  for (int n = 0; n < a->nnodes; n++)
    for (int k = 0; k < 2; k++)
      if (a->x[2 * n + k] < setup->lower[k] || a->x[2 * n + k] > setup->upper[k])
        CaseRefuse(c, BodyKey(key, a->node_body[n], ""), "the body reaches through solid.walls at (%g, %g)",
                   a->x[2 * n], a->x[2 * n + 1]);
}

PetscErrorCode SolidCaseRead(Case c, Assembly *a, SolidSetup *setup)
{
  const int nbodies = CaseCount(c, "solid.bodies");
  int first, second;
  char key[KEY];
  PetscFunctionBeginUser;
  CaseVector(c, "gravity", 2, setup->gravity);
  setup->courant = CaseNumberOr(c, "solid.courant", 0.8, 0.01, 1.0);
  CaseKeys(c, "solid.materials", CheckMaterial, c);
  if (nbodies == 0) CaseRefuse(c, "solid.bodies", "expected a list of at least one body");
  for (int b = 0; b < nbodies; b++) PetscCall(AddBody(c, b, a));
  ReadWalls(c, a, setup);
  PetscCall(AssemblyOverlap(a, &first, &second));
  if (first >= 0) CaseRefuse(c, BodyKey(key, second, ""), "the body overlaps solid.bodies[%d]", first);
  PetscFunctionReturn(0);
}
