/* One body and its materials, from the case. */
#include "solid/bodies/case_body.h"
#include "solid/bodies/case_shape.h"
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
  /* in the order of ElementLawKind */
  static const char *const LAWS[] = {"neo_hookean", "corotated", "st_venant_kirchhoff", NULL};
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
  m.law = CoracleCaseWord(c, key, 0, LAWS);
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

/* Of one row: velocity, rotation, and how they depend on time. */
static void ReadSteady(CoracleCase c, const char *item, PrescribedMotion *d, double velocity[2])
{
  char key[KEY + 64];
  (void)snprintf(key, sizeof key, "%s.angular_velocity", item);
  const PetscBool turns = (PetscBool)CoracleCaseHas(c, key);
  if (turns) {
    d->angular_velocity = CoracleCaseNumber(c, key, -HUGE_VAL, HUGE_VAL);
    if (!d->prescribed[0] || !d->prescribed[1])
      CoracleCaseRefuse(c, key, "a rotation prescribes both components");
    (void)snprintf(key, sizeof key, "%s.pivot", item);
    CoracleCaseVector(c, key, 2, d->pivot);
  }
  (void)snprintf(key, sizeof key, "%s.velocity", item);
  if (!turns || CoracleCaseHas(c, key)) CoracleCaseVector(c, key, 2, velocity);
  (void)snprintf(key, sizeof key, "%s.period", item);
  if (CoracleCaseHas(c, key)) d->period = CoracleCasePositive(c, key);
  (void)snprintf(key, sizeof key, "%s.rise", item);
  d->rise = CoracleCaseNumberOr(c, key, 0.0, 0.0, HUGE_VAL);
}

/* One item of `prescribed`; steady: room for the only row of one that has no table. */
static void ReadMotion(CoracleCase c, const char *item, BoundaryMotion *d, double steady[3])
{
  static const char *const COMPONENTS[] = {"both", "x", "y", NULL};
  char key[KEY + 64];
  (void)snprintf(key, sizeof key, "%s.boundary", item);
  d->boundary = CoracleCaseHas(c, key) ? CoracleCaseString(c, key) : NULL;
  (void)snprintf(key, sizeof key, "%s.component", item);
  const int component = CoracleCaseWord(c, key, 0, COMPONENTS);
  d->motion.prescribed[0] = component != 2;
  d->motion.prescribed[1] = component != 1;
  (void)snprintf(key, sizeof key, "%s.table", item);
  d->motion.row = CoracleCaseTable(c, key, 3, &d->motion.nrows);
  if (!d->motion.row) {
    ReadSteady(c, item, &d->motion, steady + 1);
    d->motion.row = steady;
    d->motion.nrows = 1;
  }
  (void)snprintf(key, sizeof key, "%s.release", item);
  if (CoracleCaseHas(c, key)) d->motion.release = CoracleCasePositive(c, key);
}

/* Whether both prescribe a component of the same nodes. */
static PetscBool Collide(const BoundaryMotion *a, const BoundaryMotion *b)
{
  const PetscBool same = (PetscBool)(a->boundary && b->boundary ? !strcmp(a->boundary, b->boundary)
                                                                : a->boundary == b->boundary);
  return (PetscBool)(same && ((a->motion.prescribed[0] && b->motion.prescribed[0]) ||
                              (a->motion.prescribed[1] && b->motion.prescribed[1])));
}

static PetscErrorCode ReadPrescribed(CoracleCase c, int body, BodySetup *setup, BoundaryMotion **prescribed,
                                     double (**steady)[3])
{
  char key[KEY], old[KEY], item[KEY + 16];
  PetscFunctionBeginUser;
  (void)snprintf(old, sizeof old, "solid.bodies[%d].driven", body);
  CoracleCaseRenamed(c, old, BodyKey(key, body, "prescribed"));
  setup->nprescribed = CoracleCaseCount(c, key);
  PetscCall(PetscCalloc2((size_t)setup->nprescribed, prescribed, (size_t)setup->nprescribed, steady));
  for (int k = 0; k < setup->nprescribed; k++) {
    (void)snprintf(item, sizeof item, "%s[%d]", key, k);
    ReadMotion(c, item, &(*prescribed)[k], (*steady)[k]);
    for (int i = 0; i < k; i++)
      if (Collide(&(*prescribed)[i], &(*prescribed)[k]))
        CoracleCaseRefuse(c, item, "an item before this one prescribes the same component of the same nodes");
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

/* An item of a list of joints: a box, or the name of a physical surface or curve. */
static void ReadJointItem(CoracleCase c, const char *key, JointSetup *joints, double (*box)[4],
                          const char **name)
{
  char corner[2][KEY + 32];
  (void)snprintf(corner[0], sizeof corner[0], "%s.lower", key);
  (void)snprintf(corner[1], sizeof corner[1], "%s.upper", key);
  if (!CoracleCaseHas(c, corner[0]) && !CoracleCaseHas(c, corner[1])) {
    name[joints->nnames++] = CoracleCaseString(c, key);
    return;
  }
  for (int i = 0; i < 2; i++) CoracleCaseVector(c, corner[i], 2, box[joints->nboxes] + 2 * i);
  joints->nboxes++;
}

/* all, none, or a list (*box and *name are allocated). */
static PetscErrorCode ReadJoints(CoracleCase c, int body, JointSetup *joints, double (**box)[4],
                                 const char ***name)
{
  static const char *const WORDS[] = {"none", "all", NULL};
  char key[KEY], item[KEY + 16];
  PetscFunctionBeginUser;
  BodyKey(key, body, "joints");
  (void)snprintf(item, sizeof item, "%s[0]", key);
  const int n = CoracleCaseHas(c, item) ? CoracleCaseCount(c, key) : 0;
  PetscCall(PetscMalloc2((size_t)n, box, (size_t)n, name));
  if (n == 0) joints->all = CoracleCaseWord(c, key, 0, WORDS);
  for (int k = 0; k < n; k++) {
    (void)snprintf(item, sizeof item, "%s[%d]", key, k);
    ReadJointItem(c, item, joints, *box, *name);
  }
  joints->box = *box;
  joints->name = *name;
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
  const BodyRepeat r = CaseReadRepeat(c, setup->entry);
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
  double(*steady)[3];
  const char **name, **joint_name;
  double(*joint_box)[4], *position;
  CaseLoads loads;
  char key[KEY];
  PetscFunctionBeginUser;
  setup.material = MaterialAt(c, BodyKey(key, body, "material"));
  CoracleCaseKeys(c, BodyKey(key, body, "regions"), ReadRegion, &regions);
  setup.nregions = regions.n;
  setup.region = regions.region;
  PetscCall(CaseReadShape(c, body, &mesh));
  PetscCall(ReadFixed(c, body, &setup, &name));
  PetscCall(ReadPrescribed(c, body, &setup, &prescribed, &steady));
  PetscCall(CaseReadLoads(c, body, &setup, &loads));
  PetscCall(ReadJoints(c, body, &setup.joints, &joint_box, &joint_name));
  PetscCall(CaseReadStretch(c, body, &mesh, &setup, &position));
  setup.six_node = CoracleCaseIntegerOr(c, BodyKey(key, body, "order"), PetscMax(mesh.order, 1), 1, 2) == 2;
  if (setup.six_node && mesh.order != 2) PetscCall(SixNodeSplit(&mesh, &position));
  setup.position = position;
  (void)CoracleCaseVectorOptional(c, BodyKey(key, body, "velocity"), 2, setup.velocity);
  if (setup.fixed && (setup.velocity[0] != 0.0 || setup.velocity[1] != 0.0))
    CoracleCaseRefuse(c, key, "a fixed body has no velocity");
  setup.angular_velocity =
      CoracleCaseNumberOr(c, BodyKey(key, body, "angular_velocity"), 0.0, -HUGE_VAL, HUGE_VAL);
  if (setup.fixed && setup.angular_velocity != 0.0) CoracleCaseRefuse(c, key, "a fixed body does not turn");
  if (setup.fixed && setup.nprescribed > 0)
    CoracleCaseRefuse(c, BodyKey(key, body, "prescribed"), "a fixed body has no prescribed motion");
  PetscCall(AddRepeated(c, a, &mesh, &setup, joint_box));
  PetscCall(PetscFree2(prescribed, steady));
  PetscCall(PetscFree(name));
  PetscCall(PetscFree(position));
  PetscCall(CaseFreeLoads(&loads));
  PetscCall(PetscFree2(joint_box, joint_name));
  PetscCall(MeshSerialDestroy(&mesh));
  PetscFunctionReturn(0);
}
