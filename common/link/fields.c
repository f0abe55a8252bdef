#include "common/link/fields.h"

/* --- the table ------------------------------------------------------------------------------------------ */

/* clang-format off */
#define VECTOR {EXTENT_DIM}
#define P1_VECTOR {EXTENT_DIM, EXTENT_VERTICES}
#define P1_TENSOR {EXTENT_DIM, EXTENT_VERTICES, EXTENT_DIM, EXTENT_VERTICES}
#define P1_MATRIX {EXTENT_VERTICES, EXTENT_VERTICES}
#define NUMBER_OF(list) (int)(sizeof(list) / sizeof *(list))
#define ARRAYS(entity, list) {entity, 0, NUMBER_OF(list), list}
#define ENTRIES(entity, type, list) {entity, sizeof(type), NUMBER_OF(list), list}

#define AT(member) offsetof(ServerSolid, member)
static const Field NODES[] = {
  {"global id",    "-",    FIELD_ID,   {0},    AT(gid),          0, FIELD_ANY}};
static const Field MOTION[] = {
  {"position",     "m",    FIELD_REAL, VECTOR, AT(x),            0, FIELD_ANY},
  {"velocity",     "m/s",  FIELD_REAL, VECTOR, AT(u),            0, FIELD_ANY},
  {"mean velocity","m/s",  FIELD_REAL, VECTOR, AT(mean),         0, FIELD_ANY},
  {"mobility",     "1/kg", FIELD_REAL, {0},    AT(mobility),     0, FIELD_NOT_NEGATIVE},
  {"acceleration", "m/s2", FIELD_REAL, VECTOR, AT(acceleration), 0, FIELD_ANY}};
static const Field FACETS[] = {
  {"facet node",   "-",    FIELD_INDEX, {EXTENT_FACET},    AT(facet),   0, FIELD_ANY}};
static const Field SIMPLICES[] = {
  {"element node", "-",    FIELD_INDEX, {EXTENT_VERTICES}, AT(element), 0, FIELD_ANY}};
#undef AT

#define AT(member) offsetof(FieldsForce, member)
static const Field FORCE[] = {
  {"force",           "N",     FIELD_REAL, VECTOR,                   AT(force),           0,         FIELD_ANY},
  {"film load",       "N",     FIELD_REAL, VECTOR,                   AT(film_load),       FLAG_FILM, FIELD_ANY},
  {"film resistance", "N s/m", FIELD_REAL, {EXTENT_DIM, EXTENT_DIM}, AT(film_resistance), FLAG_FILM, FIELD_ANY}};
#undef AT
static const Field BOXES[] = {
  {"box",   "m", FIELD_REAL, {EXTENT_CORNERS, EXTENT_DIM}, offsetof(FieldsBoxes, box),   0, FIELD_ANY}};

#define AT(member) offsetof(FieldsDomain, member)
static const Field DOMAIN_BOUNDS[] = {
  {"lower corner of the domain", "m", FIELD_REAL, VECTOR, AT(lower), 0, FIELD_ANY},
  {"upper corner of the domain", "m", FIELD_REAL, VECTOR, AT(upper), 0, FIELD_ANY}};
#undef AT

/* of the fluid, with the elements and with the flow */
#define PROPERTIES \
  {"density",                  "kg/m3", FIELD_REAL, {0}, AT(rho),        0, FIELD_POSITIVE},     \
  {"viscosity",                "Pa s",  FIELD_REAL, {0}, AT(mu),         0, FIELD_NOT_NEGATIVE}, \
  {"density inside the solid", "kg/m3", FIELD_REAL, {0}, AT(rho_inside), 0, FIELD_POSITIVE},     \
  {"density beside the solid", "kg/m3", FIELD_REAL, {0}, AT(rho_beside), 0, FIELD_NOT_NEGATIVE}
#define AT(member) offsetof(CoracleElements, member)
static const Field ELEMENTS[] = {
  {"vertices", "m", FIELD_REAL, {EXTENT_VERTICES, EXTENT_DIM}, AT(x), 0, FIELD_ANY},
  PROPERTIES};
#undef AT

#define AT(member) offsetof(CoracleFlow, member)
static const Field FLOW[] = {
  {"velocity at the start of the step", "m/s", FIELD_REAL, P1_VECTOR, AT(u_start),   0, FIELD_ANY},
  {"velocity before the projection", "m/s", FIELD_REAL, P1_VECTOR,  AT(u_star),      0, FIELD_ANY},
  {"projected velocity", "m/s",   FIELD_REAL, P1_VECTOR,         AT(u_projected), 0, FIELD_ANY},
  {"pressure",           "Pa",    FIELD_REAL, {EXTENT_PRESSURE}, AT(p), FLAG_PRESSURE, FIELD_ANY},
  {"remainder of the force", "N", FIELD_REAL, VECTOR,            AT(remainder),   0, FIELD_ANY},
  PROPERTIES};
#undef AT

#define AT(member) offsetof(CoracleCorrection, member)
static const Field CORRECTION[] = {
  {"element",    "-",    FIELD_INDEX, {0},       AT(element), 0, FIELD_ANY},
  {"correction", "m3/s", FIELD_REAL,  P1_VECTOR, AT(r),       0, FIELD_ANY}};
#undef AT

#define AT(member) offsetof(CoracleCoupling, member)
static const Field COUPLING[] = {
  {"element",                "-",    FIELD_INDEX, {0},        AT(element),          0, FIELD_ANY},
  {"flags",                  "-",    FIELD_FLAGS, {0},        AT(flags),            0, FIELD_ANY},
  {"implicit coefficient a", "kg/s", FIELD_REAL, P1_TENSOR,   AT(a),                FIELD_SPARSE, FIELD_ANY},
  {"implicit inertia",       "kg/s", FIELD_REAL, P1_MATRIX,   AT(implicit_inertia), FIELD_SPARSE, FIELD_ANY},
  {"inertia tensor",         "-",    FIELD_REAL, {EXTENT_DIM, EXTENT_DIM}, AT(inertia_tensor), FIELD_SPARSE, FIELD_ANY},
  {"kept velocity",          "-",    FIELD_REAL, {EXTENT_DIM, EXTENT_DIM}, AT(kept), FIELD_SPARSE, FIELD_ANY},
  {"source s",               "N",    FIELD_REAL, P1_VECTOR,   AT(s),                0, FIELD_ANY},
  {"solid mass",             "m2",   FIELD_REAL, P1_MATRIX,   AT(ms),               FIELD_SPARSE, FIELD_ANY},
  {"solid momentum",         "m3/s", FIELD_REAL, P1_VECTOR,   AT(us),               FIELD_SPARSE, FIELD_ANY},
  {"solid velocity",         "m/s",  FIELD_REAL, VECTOR,      AT(velocity),         0, FIELD_ANY},
  {"solid fraction",         "-",    FIELD_REAL, {0},         AT(alpha),            0, FIELD_NOT_NEGATIVE},
  {"shell fraction",         "-",    FIELD_REAL, {0},         AT(shell),            0, FIELD_NOT_NEGATIVE}};
#undef AT

#define AT(member) offsetof(CoracleGauge, member)
static const Field GAUGES[] = {
  {"position of the gauge", "m", FIELD_REAL, VECTOR, AT(x),      0, FIELD_ANY},
  {"normal at the gauge",   "-", FIELD_REAL, VECTOR, AT(normal), 0, FIELD_ANY}};
#undef AT
/* clang-format on */

const FieldGroup FIELDS_NODES = ARRAYS("node", NODES);
const FieldGroup FIELDS_MOTION = ARRAYS("node", MOTION);
const FieldGroup FIELDS_FACETS = ARRAYS("facet", FACETS);
const FieldGroup FIELDS_SIMPLICES = ARRAYS("element", SIMPLICES);
const FieldGroup FIELDS_FORCE = ARRAYS("node", FORCE);
const FieldGroup FIELDS_BOXES = ARRAYS("box", BOXES);
const FieldGroup FIELDS_DOMAIN = ENTRIES("corner", FieldsDomain, DOMAIN_BOUNDS);
const FieldGroup FIELDS_ELEMENTS = ARRAYS("element", ELEMENTS);
const FieldGroup FIELDS_FLOW = ARRAYS("element", FLOW);
const FieldGroup FIELDS_CORRECTION = ENTRIES("entry", CoracleCorrection, CORRECTION);
const FieldGroup FIELDS_COUPLING = ENTRIES("entry", CoracleCoupling, COUPLING);
const FieldGroup FIELDS_GAUGES = ENTRIES("gauge", CoracleGauge, GAUGES);

void FieldsExtents(int dim, int extent[NEXTENTS])
{
  extent[EXTENT_END] = 1;
  extent[EXTENT_DIM] = extent[EXTENT_FACET] = dim;
  extent[EXTENT_VERTICES] = dim + 1;
  extent[EXTENT_PRESSURE] = (dim + 1) * (dim + 2) / 2;
  extent[EXTENT_CORNERS] = 2;
}

int FieldSize(const Field *field, const int extent[NEXTENTS])
{
  int size = 1;
  for (int k = 0; field->shape[k] != EXTENT_END; k++) size *= extent[field->shape[k]];
  return size;
}

/* --- the protocol --------------------------------------------------------------------------------------- */

static unsigned HashText(unsigned hash, const char *text)
{
  do hash = (hash ^ (unsigned char)*text) * 16777619U;
  while (*text++);
  return hash;
}

static unsigned HashField(unsigned hash, const Field *field)
{
  const int numbers[] = {(int)field->type, field->only};
  hash = HashText(HashText(hash, field->name), field->unit);
  for (int k = 0; k < 2; k++) hash = (hash ^ (unsigned)numbers[k]) * 16777619U;
  for (int k = 0; k <= FIELD_RANK; k++) hash = (hash ^ (unsigned)field->shape[k]) * 16777619U;
  return hash;
}

unsigned FieldsProtocol(void)
{
#define KIND_TEXT(name) #name " "
#define GROUP_ADDRESS(name) &FIELDS_##name,
  static const char KINDS[] = MESSAGE_KINDS(KIND_TEXT);
  static const FieldGroup *const GROUPS[] = {FIELD_GROUPS(GROUP_ADDRESS)};
  unsigned hash = HashText(2166136261U ^ (unsigned)sizeof(MessageHeader), KINDS);
  for (int g = 0; g < NUMBER_OF(GROUPS); g++)
    for (int k = 0; k < GROUPS[g]->nfields; k++) hash = HashField(hash, &GROUPS[g]->field[k]);
  return hash;
}
