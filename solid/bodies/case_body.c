/* One body and its materials, from the case. */
#include "solid/bodies/case_body.h"
#include "solid/bodies/case_shape.h"
#include <limits.h>

const char *BodyKey(char key[CASE_KEY], int body, const char *name)
{
  return CaseKey(key, "solid.bodies[%d]%s%s", body, name[0] ? "." : "", name);
}

/* --- materials ---------------------------------------------------------------------------------------- */

static const char *MaterialKey(char key[CASE_KEY], const char *material, const char *name)
{
  return CaseKey(key, "solid.materials.%s.%s", material, name);
}

/* What joints need; all of it or nothing. */
static void ReadStrength(CoracleCase c, const char *name, Material *m)
{
  char key[CASE_KEY];
  if (!CoracleCaseHas(c, MaterialKey(key, name, "tensile_strength"))) return;
  m->strength[0] = CoracleCasePositive(c, MaterialKey(key, name, "tensile_strength"));
  m->strength[1] = CoracleCasePositive(c, MaterialKey(key, name, "shear_strength"));
  m->fracture_energy[0] = m->fracture_energy[1] =
      CoracleCasePositive(c, MaterialKey(key, name, "fracture_energy"));
  m->internal_friction = CoracleCaseNumberOr(c, MaterialKey(key, name, "internal_friction"), 0.0, 0.0, 10.0);
  if (CoracleCaseHas(c, MaterialKey(key, name, "shear_fracture_energy")))
    m->fracture_energy[1] = CoracleCasePositive(c, key);
  if (CoracleCaseHas(c, MaterialKey(key, name, "weibull_modulus")))
    m->weibull_modulus = CoracleCaseNumber(c, key, 1.0, HUGE_VAL);
  m->weibull_seed = CoracleCaseIntegerOr(c, MaterialKey(key, name, "weibull_seed"), 0, 0, INT_MAX);
}

/* Stiffness of bodies and of contact; a rigid material needs that of contact alone. */
static void ReadStiffness(CoracleCase c, const char *name, Material *m)
{
  char key[CASE_KEY];
  if (!m->rigid || CoracleCaseHas(c, MaterialKey(key, name, "youngs_modulus")))
    m->youngs_modulus = CoracleCasePositive(c, MaterialKey(key, name, "youngs_modulus"));
  if (!m->rigid || CoracleCaseHas(c, MaterialKey(key, name, "poisson_ratio")))
    m->poisson_ratio = CoracleCaseNumber(c, MaterialKey(key, name, "poisson_ratio"), 0.0, 0.499);
  (void)MaterialKey(key, name, "penalty");
  m->penalty =
      m->youngs_modulus > 0.0 && !CoracleCaseHas(c, key) ? m->youngs_modulus : CoracleCasePositive(c, key);
}

/* What bodies are made of, not joints. */
static void ReadBulk(CoracleCase c, const char *name, Material *m)
{
  static const char *const PLANES[] = {"strain", "stress", NULL};
  char key[CASE_KEY];
  m->density = CoracleCasePositive(c, MaterialKey(key, name, "density"));
  ReadStiffness(c, name, m);
  m->damping = CoracleCaseNumberOr(c, MaterialKey(key, name, "damping"), 0.0, 0.0, 0.999);
  m->damping_ratio = CoracleCaseNumberOr(c, MaterialKey(key, name, "damping_ratio"), 0.0, 0.0, 1.0);
  if (CoracleCaseHas(c, key))
    m->damping_frequency = CoracleCasePositive(c, MaterialKey(key, name, "damping_frequency"));
  m->plane_stress = CoracleCaseWord(c, MaterialKey(key, name, "plane"), 0, PLANES);
  m->thickness = CoracleCaseHas(c, MaterialKey(key, name, "thickness")) ? CoracleCasePositive(c, key) : 1.0;
}

static Material ReadMaterial(CoracleCase c, const char *name)
{
  /* in the order of ElementLawKind, then those that are none */
  enum { RIGID = LAW_ST_VENANT_KIRCHHOFF + 1, JOINT };
  static const char *const LAWS[] = {"neo_hookean", "corotated", "st_venant_kirchhoff",
                                     "rigid",       "joint",     NULL};
  Material m = {0};
  char key[CASE_KEY];
  m.law = CoracleCaseWord(c, MaterialKey(key, name, "law"), 0, LAWS);
  m.rigid = m.law == RIGID;
  m.joints_alone = m.law == JOINT;
  if (!m.joints_alone) ReadBulk(c, name, &m);
  m.friction = CoracleCaseNumberOr(c, MaterialKey(key, name, "friction"), 0.0, 0.0, HUGE_VAL);
  m.contact_damping = CoracleCaseNumberOr(c, MaterialKey(key, name, "contact_damping"), 0.0, 0.0, 10.0);
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

/* The names of materials as they are listed in a message, cut where it is full. */
typedef struct {
  char text[256];
} Names;

static void AddName(void *names, const char *name)
{
  Names *n = names;
  const size_t used = strlen(n->text);
  (void)snprintf(n->text + used, sizeof n->text - used, "%s%s", used ? ", " : "", name);
}

void CaseMaterialExists(CoracleCase c, const char *key, const char *name, PetscBool walls)
{
  char material[CASE_KEY];
  Names names = {""};
  if ((walls && !strcmp(name, CONTACT_WALLS)) ||
      CoracleCaseHas(c, CaseKey(material, "solid.materials.%s", name)))
    return;
  CoracleCaseKeys(c, "solid.materials", AddName, &names);
  if (walls) AddName(&names, CONTACT_WALLS);
  CoracleCaseRefuse(c, key, "there is no material '%s' in solid.materials%s%s", name,
                    names.text[0] ? ": expected one of " : "", names.text);
}

static Material MaterialAt(CoracleCase c, const char *key, PetscBool of_joints)
{
  const char *name = CoracleCaseString(c, key);
  CaseMaterialExists(c, key, name, PETSC_FALSE);
  const Material m = ReadMaterial(c, name);
  if (m.joints_alone && !of_joints)
    CoracleCaseRefuse(c, key, "material '%s' is of joints (law: joint): bodies need another one", name);
  if (of_joints && m.strength[0] == 0.0)
    CoracleCaseRefuse(
        c, key, "material '%s' of joints needs tensile_strength, shear_strength and fracture_energy", name);
  return m;
}

/* --- bodies ------------------------------------------------------------------------------------------- */

/* true, or a list of names of boundaries and regions (*name is allocated). */
static PetscErrorCode ReadFixed(CoracleCase c, int body, BodySetup *setup, const char ***name)
{
  char key[CASE_KEY], item[CASE_KEY];
  PetscFunctionBeginUser;
  *name = NULL;
  BodyKey(key, body, "fixed");
  if (!CoracleCaseHas(c, CaseKey(item, "%s[0]", key))) {
    setup->fixed = CoracleCaseBoolOr(c, key, false);
    PetscFunctionReturn(0);
  }
  setup->nfixed = CoracleCaseCount(c, key);
  PetscCall(PetscMalloc1((size_t)setup->nfixed, name));
  for (int k = 0; k < setup->nfixed; k++) {
    (*name)[k] = CoracleCaseString(c, CaseKey(item, "%s[%d]", key, k));
  }
  setup->fixed_name = *name;
  PetscFunctionReturn(0);
}

/* A number, or rows of time and angular velocity. */
static void ReadSpin(CoracleCase c, const char *item, PrescribedMotion *d)
{
  static const char *const SWINGS[] = {"period", "rise", NULL};
  char key[CASE_KEY], first[CASE_KEY];
  (void)CaseKey(key, "%s.angular_velocity", item);
  if (!CoracleCaseHas(c, CaseKey(first, "%s[0]", key))) {
    d->angular_velocity = CoracleCaseNumber(c, key, -HUGE_VAL, HUGE_VAL);
    return;
  }
  d->spin.width = 2;
  d->spin.row = CoracleCaseTable(c, key, 2, &d->spin.nrows);
  for (int k = 0; SWINGS[k]; k++)
    if (CoracleCaseHas(c, CaseKey(key, "%s.%s", item, SWINGS[k])))
      CoracleCaseRefuse(c, key, "an angular velocity in rows depends on time by them alone");
}

static PetscBool ReadRotation(CoracleCase c, const char *item, PrescribedMotion *d)
{
  char key[CASE_KEY];
  if (!CoracleCaseHas(c, CaseKey(key, "%s.angular_velocity", item))) return PETSC_FALSE;
  ReadSpin(c, item, d);
  if (!d->prescribed[0] || !d->prescribed[1])
    CoracleCaseRefuse(c, key, "a rotation prescribes both components");
  CoracleCaseVector(c, CaseKey(key, "%s.pivot", item), 2, d->pivot);
  return PETSC_TRUE;
}

/* A velocity of one row, unless there is a rotation alone, and how both depend on time. */
static void ReadSteady(CoracleCase c, const char *item, PetscBool turns, PrescribedMotion *d,
                       double velocity[2])
{
  char key[CASE_KEY];
  (void)CaseKey(key, "%s.velocity", item);
  if (!turns || CoracleCaseHas(c, key)) CoracleCaseVector(c, key, 2, velocity);
  if (CoracleCaseHas(c, CaseKey(key, "%s.period", item))) d->period = CoracleCasePositive(c, key);
  d->rise = CoracleCaseNumberOr(c, CaseKey(key, "%s.rise", item), 0.0, 0.0, HUGE_VAL);
}

/* One item of `prescribed`; steady: room for the only row of one that has no table. */
static void ReadMotion(CoracleCase c, const char *item, BoundaryMotion *d, double steady[3])
{
  static const char *const COMPONENTS[] = {"both", "x", "y", NULL};
  char key[CASE_KEY];
  d->boundary = CoracleCaseHas(c, CaseKey(key, "%s.boundary", item)) ? CoracleCaseString(c, key) : NULL;
  const char *name = CoracleCaseStringOr(c, CaseKey(key, "%s.name", item), "");
  if (strlen(name) >= sizeof d->motion.name)
    CoracleCaseRefuse(c, key, "expected a name of at most %d characters", MOTION_NAME - 1);
  strncpy(d->motion.name, name, sizeof d->motion.name - 1);
  const int component = CoracleCaseWord(c, CaseKey(key, "%s.component", item), 0, COMPONENTS);
  d->motion.prescribed[0] = component != 2;
  d->motion.prescribed[1] = component != 1;
  const PetscBool turns = ReadRotation(c, item, &d->motion);
  d->motion.row = CoracleCaseTable(c, CaseKey(key, "%s.table", item), 3, &d->motion.nrows);
  if (!d->motion.row) {
    ReadSteady(c, item, turns, &d->motion, steady + 1);
    d->motion.row = steady;
    d->motion.nrows = 1;
  }
  if (CoracleCaseHas(c, CaseKey(key, "%s.release", item))) d->motion.release = CoracleCasePositive(c, key);
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
  char key[CASE_KEY], old[CASE_KEY], item[CASE_KEY];
  PetscFunctionBeginUser;
  CoracleCaseRenamed(c, CaseKey(old, "solid.bodies[%d].driven", body), BodyKey(key, body, "prescribed"));
  setup->nprescribed = CoracleCaseCount(c, key);
  PetscCall(PetscCalloc2((size_t)setup->nprescribed, prescribed, (size_t)setup->nprescribed, steady));
  for (int k = 0; k < setup->nprescribed; k++) {
    ReadMotion(c, CaseKey(item, "%s[%d]", key, k), &(*prescribed)[k], (*steady)[k]);
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
  char key[CASE_KEY];
  if (r->n == MAX_REGIONS)
    CoracleCaseRefuse(r->c, BodyKey(key, r->body, "regions"), "more than %d regions", MAX_REGIONS);
  r->region[r->n++] = (RegionMaterial){
      name, MaterialAt(r->c, CaseKey(key, "solid.bodies[%d].regions.%s", r->body, name), PETSC_FALSE)};
}

static PetscBool HasRegion(const Regions *r, const char *name)
{
  for (int k = 0; k < r->n; k++)
    if (!strcmp(r->region[k].region, name)) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* That of what is in none of the regions; where they are everywhere it may be absent, and is that of one of them. */
static Material ReadBodyMaterial(const Regions *r, const MeshSerial *m)
{
  char key[CASE_KEY];
  BodyKey(key, r->body, "material");
  if (r->n == 0 || CoracleCaseHas(r->c, key)) return MaterialAt(r->c, key, PETSC_FALSE);
  for (int e = 0; e < m->ne; e++) {
    const int region = m->region ? m->region[e] : -1;
    if (region < 0) CoracleCaseRefuse(r->c, key, "expected a material: the mesh has triangles of no surface");
    if (!HasRegion(r, m->region_name[region]))
      CoracleCaseRefuse(r->c, key, "expected a material: regions have none for the mesh's surface '%s'",
                        m->region_name[region]);
  }
  return r->region[0].material;
}

/* An item of a list of joints: a box, or the name of a physical surface or curve, that of a curve alone or with a material. */
static void ReadJointItem(CoracleCase c, const char *key, JointSetup *joints, double (*box)[4],
                          NamedJoints named[])
{
  char lower[CASE_KEY], upper[CASE_KEY];
  NamedJoints *next = &named[joints->nnames];
  if (CoracleCaseHas(c, CaseKey(lower, "%s.material", key))) {
    next->has_material = 1;
    next->material = MaterialAt(c, lower, PETSC_TRUE);
    next->name = CoracleCaseString(c, CaseKey(lower, "%s.name", key));
    joints->nnames++;
    return;
  }
  const bool has_lower = CoracleCaseHas(c, CaseKey(lower, "%s.lower", key)),
             has_upper = CoracleCaseHas(c, CaseKey(upper, "%s.upper", key));
  if (!has_lower && !has_upper) {
    next->name = CoracleCaseString(c, key);
    joints->nnames++;
    return;
  }
  CoracleCaseVector(c, lower, 2, box[joints->nboxes]);
  CoracleCaseVector(c, upper, 2, box[joints->nboxes++] + 2);
}

/* all, none, or a list (*box and *named are allocated). */
static PetscErrorCode ReadJoints(CoracleCase c, int body, JointSetup *joints, double (**box)[4],
                                 NamedJoints **named)
{
  static const char *const WORDS[] = {"none", "all", NULL};
  char key[CASE_KEY], item[CASE_KEY];
  PetscFunctionBeginUser;
  BodyKey(key, body, "joints");
  const int n = CoracleCaseHas(c, CaseKey(item, "%s[0]", key)) ? CoracleCaseCount(c, key) : 0;
  PetscCall(PetscCalloc2((size_t)n, box, (size_t)n, named));
  if (n == 0) joints->all = CoracleCaseWord(c, key, 0, WORDS);
  for (int k = 0; k < n; k++) {
    ReadJointItem(c, CaseKey(item, "%s[%d]", key, k), joints, *box, *named);
  }
  joints->box = *box;
  joints->named = *named;
  PetscFunctionReturn(0);
}

/* What of a body has a place: position: of BodySetup, or NULL; boxes of joints; pivots of motions. */
static void Shift(MeshSerial *mesh, double position[], BodySetup *setup, double (*box)[4],
                  BoundaryMotion prescribed[], double dx, double dy)
{
  const double by[2] = {dx, dy};
  for (int k = 0; k < 2 * mesh->nv; k++) mesh->x[k] += by[k % 2];
  for (int k = 0; position && k < 2 * mesh->nv; k++) position[k] += by[k % 2];
  for (int k = 0; k < 4 * setup->joints.nboxes; k++) box[k / 4][k % 4] += by[k % 2];
  for (int k = 0; k < 2 * setup->nprescribed; k++) prescribed[k / 2].motion.pivot[k % 2] += by[k % 2];
}

/* Row after row. */
static PetscErrorCode AddRepeated(CoracleCase c, Model *a, MeshSerial *mesh, BodySetup *setup,
                                  double position[], double (*box)[4], BoundaryMotion prescribed[])
{
  const BodyRepeat r = CaseReadRepeat(c, setup->entry);
  const char *why = NULL;
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  for (int k = 0; k < r.n[1]; k++) {
    for (int i = 0; i < r.n[0]; i++) {
      if (ModelAdd(a, mesh, setup, &why)) CoracleCaseRefuse(c, BodyKey(key, setup->entry, ""), "%s", why);
      Shift(mesh, position, setup, box, prescribed, r.step[0], 0.0);
    }
    Shift(mesh, position, setup, box, prescribed, -r.n[0] * r.step[0], r.step[1]);
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
  const char **name;
  NamedJoints *joint_name;
  double(*joint_box)[4], *position;
  CaseLoads loads;
  char key[CASE_KEY];
  PetscFunctionBeginUser;
  CoracleCaseKeys(c, BodyKey(key, body, "regions"), ReadRegion, &regions);
  setup.nregions = regions.n;
  setup.region = regions.region;
  PetscCall(CaseReadShape(c, body, &mesh, &setup.circle));
  setup.material = ReadBodyMaterial(&regions, &mesh);
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
  PetscCall(AddRepeated(c, a, &mesh, &setup, position, joint_box, prescribed));
  PetscCall(PetscFree2(prescribed, steady));
  PetscCall(PetscFree(name));
  PetscCall(PetscFree(position));
  PetscCall(CaseFreeLoads(&loads));
  PetscCall(PetscFree2(joint_box, joint_name));
  PetscCall(MeshSerialDestroy(&mesh));
  PetscFunctionReturn(0);
}
