/* One body and its materials, from the case. */
#include "solid/bodies/case_body.h"
#include "solid/bodies/shape.h"
#include <stdarg.h>
#include <stdio.h>

enum { KEY = CASE_BODY_KEY };

const char *BodyKey(char key[CASE_BODY_KEY], int body, const char *name)
{
  (void)snprintf(key, KEY, "solid.bodies[%d]%s%s", body, name[0] ? "." : "", name);
  return key;
}

/* --- materials ---------------------------------------------------------------------------------------- */

static double Property(CoracleCase c, const char *material, const char *name, double lower, double upper)
{
  char key[KEY];
  (void)snprintf(key, sizeof key, "solid.materials.%s.%s", material, name);
  return lower < upper ? CoracleCaseNumber(c, key, lower, upper) : CoracleCasePositive(c, key);
}

/* What joints need; all of it or nothing. */
static void ReadStrength(CoracleCase c, const char *name, Material *m)
{
  char key[KEY];
  (void)snprintf(key, sizeof key, "solid.materials.%s.tensile_strength", name);
  if (!CoracleCaseHas(c, key)) return;
  m->strength[0] = Property(c, name, "tensile_strength", 0.0, 0.0);
  m->strength[1] = Property(c, name, "shear_strength", 0.0, 0.0);
  m->fracture_energy[0] = m->fracture_energy[1] = Property(c, name, "fracture_energy", 0.0, 0.0);
  (void)snprintf(key, sizeof key, "solid.materials.%s.internal_friction", name);
  m->internal_friction = CoracleCaseNumberOr(c, key, 0.0, 0.0, 10.0);
  (void)snprintf(key, sizeof key, "solid.materials.%s.shear_fracture_energy", name);
  if (CoracleCaseHas(c, key)) m->fracture_energy[1] = CoracleCasePositive(c, key);
}

static Material ReadMaterial(CoracleCase c, const char *name)
{
  static const char *const PLANES[] = {"strain", "stress", NULL};
  static const char *const LAWS[] = {"neo_hookean", "corotated", NULL};
  Material m = {0};
  char key[KEY];
  m.density = Property(c, name, "density", 0.0, 0.0);
  m.youngs_modulus = Property(c, name, "youngs_modulus", 0.0, 0.0);
  m.poisson_ratio = Property(c, name, "poisson_ratio", 0.0, 0.499);
  (void)snprintf(key, sizeof key, "solid.materials.%s.damping", name);
  m.damping = CoracleCaseNumberOr(c, key, 0.0, 0.0, 0.999);
  (void)snprintf(key, sizeof key, "solid.materials.%s.damping_ratio", name);
  m.damping_ratio = CoracleCaseNumberOr(c, key, 0.0, 0.0, 1.0);
  if (CoracleCaseHas(c, key)) m.damping_frequency = Property(c, name, "damping_frequency", 0.0, 0.0);
  (void)snprintf(key, sizeof key, "solid.materials.%s.penalty", name);
  m.penalty = CoracleCaseHas(c, key) ? CoracleCasePositive(c, key) : m.youngs_modulus;
  (void)snprintf(key, sizeof key, "solid.materials.%s.friction", name);
  m.friction = CoracleCaseNumberOr(c, key, 0.0, 0.0, HUGE_VAL);
  (void)snprintf(key, sizeof key, "solid.materials.%s.contact_damping", name);
  m.contact_damping = CoracleCaseNumberOr(c, key, 0.0, 0.0, 10.0);
  (void)snprintf(key, sizeof key, "solid.materials.%s.plane", name);
  m.plane_stress = CoracleCaseWord(c, key, 0, PLANES);
  (void)snprintf(key, sizeof key, "solid.materials.%s.law", name);
  m.corotated = CoracleCaseWord(c, key, 0, LAWS);
  (void)snprintf(key, sizeof key, "solid.materials.%s.thickness", name);
  m.thickness = CoracleCaseHas(c, key) ? CoracleCasePositive(c, key) : 1.0;
  ReadStrength(c, name, &m);
  if (strlen(name) >= MATERIAL_NAME || !strcmp(name, CONTACT_WALLS))
    CoracleCaseRefuse(c, key, "a material's name must be shorter than %d characters and not '%s'",
                      MATERIAL_NAME, CONTACT_WALLS);
  (void)snprintf(m.name, sizeof m.name, "%s", name);
  return m;
}

/* Every material is read, also those that no body has. */
void CaseCheckMaterial(void *c, const char *name)
{
  (void)ReadMaterial(c, name);
}

void CaseMaterialExists(CoracleCase c, const char *key, const char *name)
{
  char material[KEY];
  (void)snprintf(material, sizeof material, "solid.materials.%.100s", name);
  if (!CoracleCaseHas(c, material))
    CoracleCaseRefuse(c, key, "there is no material '%s' in solid.materials", name);
}

static Material MaterialAt(CoracleCase c, const char *key)
{
  const char *name = CoracleCaseString(c, key);
  CaseMaterialExists(c, key, name);
  return ReadMaterial(c, name);
}

/* --- bodies ------------------------------------------------------------------------------------------- */

/* How often the body is there along x and y, and how far apart. */
typedef struct {
  int n[2];
  double step[2]; /* m */
} Repeat;

static Repeat ReadRepeat(CoracleCase c, int body)
{
  Repeat r = {.n = {1, 1}};
  double n[2];
  char key[KEY];
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
  const Repeat r = ReadRepeat(c, body);
  const double bodies = (double)r.n[0] * r.n[1];
  char key[KEY];
  if (elements * bodies <= ELEMENTS_MAX) return;
  CoracleCaseRefuse(c, BodyKey(key, body, elements > ELEMENTS_MAX ? name : "repeat.n"),
                    "%.3g bodies of about %.3g elements each are more than %g elements", bodies, elements,
                    ELEMENTS_MAX);
}

static PetscErrorCode ReadMeshFile(CoracleCase c, int body, MeshSerial *mesh)
{
  char key[KEY];
  const char *path = CoracleCaseFile(c, BodyKey(key, body, "mesh")), *why = NULL;
  double translate[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  if (MeshReadGmsh(path, mesh, &why)) CoracleCaseRefuse(c, key, "%s", why);
  CheckCount(c, body, "mesh", mesh->ne);
  (void)CoracleCaseVectorOptional(c, BodyKey(key, body, "translate"), 2, translate);
  const double scale = CoracleCaseHas(c, BodyKey(key, body, "scale")) ? CoracleCasePositive(c, key) : 1.0;
  for (int k = 0; k < 2 * mesh->nv; k++) mesh->x[k] = scale * mesh->x[k] + translate[k % 2];
  PetscFunctionReturn(0);
}

static PetscErrorCode ReadRing(CoracleCase c, int body, const double centre[2], double size, MeshSerial *mesh)
{
  double inner, outer;
  char key[KEY];
  PetscFunctionBeginUser;
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

typedef enum { SHAPE_DISC, SHAPE_RECTANGLE, SHAPE_RING, SHAPE_FILE } Shape;

static Shape ReadShapeName(CoracleCase c, int body)
{
  static const char *const SHAPES[] = {"disc", "rectangle", "ring", NULL};
  char key[KEY];
  return CoracleCaseHas(c, BodyKey(key, body, "mesh"))
             ? SHAPE_FILE
             : (Shape)CoracleCaseWord(c, BodyKey(key, body, "shape"), -1, SHAPES);
}

static PetscErrorCode ReadShape(CoracleCase c, int body, MeshSerial *mesh)
{
  const Shape shape = ReadShapeName(c, body);
  double centre[2];
  char key[KEY];
  PetscFunctionBeginUser;
  if (shape == SHAPE_FILE) {
    PetscCall(ReadMeshFile(c, body, mesh));
    PetscFunctionReturn(0);
  }
  CoracleCaseVector(c, BodyKey(key, body, "centre"), 2, centre);
  const double size = CoracleCasePositive(c, BodyKey(key, body, "size"));
  if (shape == SHAPE_DISC) {
    const double radius = CoracleCasePositive(c, BodyKey(key, body, "radius")),
                 rings = M_PI * radius / (3.0 * size);
    CheckCount(c, body, "size", 6.0 * rings * rings);
    PetscCall(ShapeDisc(centre, radius, size, mesh));
  } else if (shape == SHAPE_RECTANGLE) {
    const double width = CoracleCasePositive(c, BodyKey(key, body, "width"));
    const double height = CoracleCasePositive(c, BodyKey(key, body, "height"));
    const double angle = CoracleCaseNumberOr(c, BodyKey(key, body, "angle"), 0.0, -HUGE_VAL, HUGE_VAL);
    CheckCount(c, body, "size", 2.0 * (width / size + 1.0) * (height / size + 1.0));
    PetscCall(ShapeRectangle(centre, width, height, angle, size, mesh));
  } else {
    PetscCall(ReadRing(c, body, centre, size, mesh));
  }
  PetscFunctionReturn(0);
}

/* A ring keeps its wall (*position is allocated), other shapes are stretched as they are. */
static PetscErrorCode ReadStretch(CoracleCase c, int body, const MeshSerial *mesh, BodySetup *setup,
                                  double **position)
{
  double centre[2];
  char key[KEY];
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

/* true, or a list of names of boundaries and regions (*name is allocated). */
static PetscErrorCode ReadFixed(CoracleCase c, int body, BodySetup *setup, const char ***name)
{
  char key[KEY], item[KEY + 16];
  PetscFunctionBeginUser;
  *name = NULL;
  BodyKey(key, body, "fixed");
  (void)snprintf(item, sizeof item, "%s[0]", key);
  if (!CoracleCaseHas(c, item)) {
    setup->fixed = CoracleCaseBoolOr(c, key, false);
    PetscFunctionReturn(0);
  }
  setup->nfixed = CoracleCaseCount(c, key);
  PetscCall(PetscMalloc1((size_t)setup->nfixed, name));
  for (int k = 0; k < setup->nfixed; k++) {
    (void)snprintf(item, sizeof item, "%s[%d]", key, k);
    (*name)[k] = CoracleCaseString(c, item);
  }
  setup->fixed_name = *name;
  PetscFunctionReturn(0);
}

/* One item of `prescribed`: rows are allocated. */
static PetscErrorCode ReadMotion(CoracleCase c, const char *item, BoundaryMotion *d)
{
  static const char *const COMPONENTS[] = {"both", "x", "y", NULL};
  char key[KEY + 64];
  double *row;
  PetscFunctionBeginUser;
  (void)snprintf(key, sizeof key, "%s.boundary", item);
  d->boundary = CoracleCaseString(c, key);
  (void)snprintf(key, sizeof key, "%s.component", item);
  const int component = CoracleCaseWord(c, key, 0, COMPONENTS);
  d->motion.prescribed[0] = component != 2;
  d->motion.prescribed[1] = component != 1;
  (void)snprintf(key, sizeof key, "%s.table", item);
  const int nrows = CoracleCaseHas(c, key) ? CoracleCaseCount(c, key) : 0;
  d->motion.nrows = PetscMax(nrows, 1);
  PetscCall(PetscCalloc1(3 * (size_t)d->motion.nrows, &row));
  d->motion.row = row;
  for (int k = 0; k < nrows; k++) {
    (void)snprintf(key, sizeof key, "%s.table[%d]", item, k);
    CoracleCaseVector(c, key, 3, row + 3 * k);
    if (k > 0 && !(row[3 * k] > row[3 * k - 3])) CoracleCaseRefuse(c, key, "the table's times must rise");
  }
  if (nrows == 0) {
    (void)snprintf(key, sizeof key, "%s.velocity", item);
    CoracleCaseVector(c, key, 2, row + 1);
  }
  (void)snprintf(key, sizeof key, "%s.release", item);
  if (CoracleCaseHas(c, key)) d->motion.release = CoracleCasePositive(c, key);
  PetscFunctionReturn(0);
}

static PetscErrorCode ReadPrescribed(CoracleCase c, int body, BodySetup *setup, BoundaryMotion **prescribed)
{
  char key[KEY], old[KEY], item[KEY + 16];
  PetscFunctionBeginUser;
  (void)snprintf(old, sizeof old, "solid.bodies[%d].driven", body);
  CoracleCaseRenamed(c, old, BodyKey(key, body, "prescribed"));
  setup->nprescribed = CoracleCaseCount(c, key);
  PetscCall(PetscCalloc1((size_t)setup->nprescribed, prescribed));
  for (int k = 0; k < setup->nprescribed; k++) {
    (void)snprintf(item, sizeof item, "%s[%d]", key, k);
    PetscCall(ReadMotion(c, item, &(*prescribed)[k]));
  }
  setup->prescribed = *prescribed;
  PetscFunctionReturn(0);
}

/* The map `regions`: physical surface -> material. */
enum { MAX_REGIONS = 64 };
typedef struct {
  CoracleCase c;
  int body, n;
  RegionMaterial region[MAX_REGIONS];
} Regions;

static void ReadRegion(void *context, const char *name)
{
  Regions *r = context;
  char key[KEY], item[KEY + 80];
  (void)snprintf(item, sizeof item, "%s.%.64s", BodyKey(key, r->body, "regions"), name);
  if (r->n == MAX_REGIONS) CoracleCaseRefuse(r->c, key, "more than %d regions", MAX_REGIONS);
  r->region[r->n++] = (RegionMaterial){name, MaterialAt(r->c, item)};
}

/* Item k of a list of joints: a box, or the name of a physical surface. */
static void ReadJointRegion(CoracleCase c, const char *key, JointSetup *joints, double (*box)[4],
                            const char **region)
{
  char corner[2][KEY + 32];
  (void)snprintf(corner[0], sizeof corner[0], "%s.lower", key);
  (void)snprintf(corner[1], sizeof corner[1], "%s.upper", key);
  if (!CoracleCaseHas(c, corner[0]) && !CoracleCaseHas(c, corner[1])) {
    region[joints->nregions++] = CoracleCaseString(c, key);
    return;
  }
  for (int i = 0; i < 2; i++) CoracleCaseVector(c, corner[i], 2, box[joints->nboxes] + 2 * i);
  joints->nboxes++;
}

/* all, none, or a list (*box and *region are allocated). */
static PetscErrorCode ReadJoints(CoracleCase c, int body, JointSetup *joints, double (**box)[4],
                                 const char ***region)
{
  static const char *const WORDS[] = {"none", "all", NULL};
  char key[KEY], item[KEY + 16];
  PetscFunctionBeginUser;
  BodyKey(key, body, "joints");
  (void)snprintf(item, sizeof item, "%s[0]", key);
  const int n = CoracleCaseHas(c, item) ? CoracleCaseCount(c, key) : 0;
  PetscCall(PetscMalloc2((size_t)n, box, (size_t)n, region));
  if (n == 0) joints->all = CoracleCaseWord(c, key, 0, WORDS);
  for (int k = 0; k < n; k++) {
    (void)snprintf(item, sizeof item, "%s[%d]", key, k);
    ReadJointRegion(c, item, joints, *box, *region);
  }
  joints->box = *box;
  joints->region = *region;
  PetscFunctionReturn(0);
}

static void Shift(MeshSerial *mesh, JointSetup *joints, double (*box)[4], double dx, double dy)
{
  const double by[2] = {dx, dy};
  for (int k = 0; k < 2 * mesh->nv; k++) mesh->x[k] += by[k % 2];
  for (int k = 0; k < 4 * joints->nboxes; k++) box[k / 4][k % 4] += by[k % 2];
}

/* Row after row. */
static PetscErrorCode AddRepeated(CoracleCase c, Model *a, MeshSerial *mesh, BodySetup *setup,
                                  double (*box)[4])
{
  const Repeat r = ReadRepeat(c, setup->entry);
  const char *why = NULL;
  char key[KEY];
  PetscFunctionBeginUser;
  for (int k = 0; k < r.n[1]; k++) {
    for (int i = 0; i < r.n[0]; i++) {
      if (ModelAdd(a, mesh, setup, &why)) CoracleCaseRefuse(c, BodyKey(key, setup->entry, ""), "%s", why);
      Shift(mesh, &setup->joints, box, r.step[0], 0.0);
    }
    Shift(mesh, &setup->joints, box, -r.n[0] * r.step[0], r.step[1]);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode CaseReadBody(CoracleCase c, int body, Model *a)
{
  BodySetup setup = {.entry = body, .stretch = {1.0, 1.0}};
  Regions regions = {.c = c, .body = body};
  MeshSerial mesh = {0};
  BoundaryMotion *prescribed;
  const char **name, **joint_region;
  double(*joint_box)[4], *position;
  char key[KEY];
  PetscFunctionBeginUser;
  setup.material = MaterialAt(c, BodyKey(key, body, "material"));
  CoracleCaseKeys(c, BodyKey(key, body, "regions"), ReadRegion, &regions);
  setup.nregions = regions.n;
  setup.region = regions.region;
  PetscCall(ReadShape(c, body, &mesh));
  PetscCall(ReadFixed(c, body, &setup, &name));
  PetscCall(ReadPrescribed(c, body, &setup, &prescribed));
  PetscCall(ReadJoints(c, body, &setup.joints, &joint_box, &joint_region));
  PetscCall(ReadStretch(c, body, &mesh, &setup, &position));
  (void)CoracleCaseVectorOptional(c, BodyKey(key, body, "velocity"), 2, setup.velocity);
  if (setup.fixed && (setup.velocity[0] != 0.0 || setup.velocity[1] != 0.0))
    CoracleCaseRefuse(c, key, "a fixed body has no velocity");
  setup.angular_velocity =
      CoracleCaseNumberOr(c, BodyKey(key, body, "angular_velocity"), 0.0, -HUGE_VAL, HUGE_VAL);
  if (setup.fixed && setup.angular_velocity != 0.0) CoracleCaseRefuse(c, key, "a fixed body does not turn");
  PetscCall(AddRepeated(c, a, &mesh, &setup, joint_box));
  for (int k = 0; k < setup.nprescribed; k++) PetscCall(PetscFree(prescribed[k].motion.row));
  PetscCall(PetscFree(prescribed));
  PetscCall(PetscFree(name));
  PetscCall(PetscFree(position));
  PetscCall(PetscFree2(joint_box, joint_region));
  PetscCall(MeshSerialDestroy(&mesh));
  PetscFunctionReturn(0);
}
