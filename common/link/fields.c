#include "common/link/fields.h"
#include <string.h>

/* --- the table ------------------------------------------------------------------------------------------ */

#define VECTOR                                                                                               \
  {                                                                                                          \
    EXTENT_DIM                                                                                               \
  }
#define P1_VECTOR                                                                                            \
  {                                                                                                          \
    EXTENT_DIM, EXTENT_VERTICES                                                                              \
  }
#define P1_TENSOR                                                                                            \
  {                                                                                                          \
    EXTENT_DIM, EXTENT_VERTICES, EXTENT_DIM, EXTENT_VERTICES                                                 \
  }
#define P1_MATRIX                                                                                            \
  {                                                                                                          \
    EXTENT_VERTICES, EXTENT_VERTICES                                                                         \
  }
#define NUMBER_OF(list) (int)(sizeof(list) / sizeof *(list))
#define ARRAYS(entity, direction, list)                                                                      \
  {                                                                                                          \
    entity, direction, 0, NUMBER_OF(list), list                                                              \
  }
#define ENTRIES(entity, direction, type, list)                                                               \
  {                                                                                                          \
    entity, direction, sizeof(type), NUMBER_OF(list), list                                                   \
  }

/* clang-format off */
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

static const Field FORCE[] = {
  {"force", "N", FIELD_REAL, VECTOR,                       offsetof(FieldsForce, force), 0, FIELD_ANY}};
static const Field BOXES[] = {
  {"box",   "m", FIELD_REAL, {EXTENT_CORNERS, EXTENT_DIM}, offsetof(FieldsBoxes, box),   0, FIELD_ANY}};

#define AT(member) offsetof(FieldsDomain, member)
static const Field DOMAIN_BOUNDS[] = {
  {"lower corner of the domain", "m", FIELD_REAL, VECTOR, AT(lower), 0, FIELD_ANY},
  {"upper corner of the domain", "m", FIELD_REAL, VECTOR, AT(upper), 0, FIELD_ANY}};
#undef AT

#define AT(member) offsetof(CoracleElements, member)
static const Field ELEMENTS[] = {
  {"vertices",  "m",     FIELD_REAL, {EXTENT_VERTICES, EXTENT_DIM}, AT(x),   0, FIELD_ANY},
  {"density",   "kg/m3", FIELD_REAL, {0},                           AT(rho), 0, FIELD_POSITIVE},
  {"viscosity", "Pa s",  FIELD_REAL, {0},                           AT(mu),  0, FIELD_NOT_NEGATIVE},
  {"density inside the solid",  "kg/m3", FIELD_REAL, {0}, AT(rho_inside), 0, FIELD_POSITIVE},
  {"density beside the solid",  "kg/m3", FIELD_REAL, {0}, AT(rho_beside), 0, FIELD_NOT_NEGATIVE}};
#undef AT

#define AT(member) offsetof(CoracleFlow, member)
static const Field FLOW[] = {
  {"velocity at the start of the step", "m/s", FIELD_REAL, P1_VECTOR, AT(u_start),   0, FIELD_ANY},
  {"velocity before the projection", "m/s", FIELD_REAL, P1_VECTOR,  AT(u_star),      0, FIELD_ANY},
  {"projected velocity", "m/s",   FIELD_REAL, P1_VECTOR,         AT(u_projected), 0, FIELD_ANY},
  {"pressure",           "Pa",    FIELD_REAL, {EXTENT_PRESSURE}, AT(p), FLAG_PRESSURE, FIELD_ANY},
  {"density",            "kg/m3", FIELD_REAL, {0},               AT(rho),         0, FIELD_POSITIVE},
  {"viscosity",          "Pa s",  FIELD_REAL, {0},               AT(mu),          0, FIELD_NOT_NEGATIVE},
  {"density inside the solid", "kg/m3", FIELD_REAL, {0},         AT(rho_inside),  0, FIELD_POSITIVE},
  {"density beside the solid", "kg/m3", FIELD_REAL, {0},         AT(rho_beside),  0, FIELD_NOT_NEGATIVE}};
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
  {"implicit coefficient a", "kg/s", FIELD_REAL, P1_TENSOR,   AT(a),                0, FIELD_ANY},
  {"implicit inertia",       "kg/s", FIELD_REAL, P1_MATRIX,   AT(implicit_inertia), FLAG_INERTIA, FIELD_ANY},
  {"source s",               "N",    FIELD_REAL, P1_VECTOR,   AT(s),                0, FIELD_ANY},
  {"solid mass",             "m2",   FIELD_REAL, P1_MATRIX,   AT(ms),               0, FIELD_ANY},
  {"solid momentum",         "m3/s", FIELD_REAL, P1_VECTOR,   AT(us),               0, FIELD_ANY},
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

const FieldGroup FIELDS_NODES = ARRAYS("node", "solid -> coupler", NODES);
const FieldGroup FIELDS_MOTION = ARRAYS("node", "solid -> coupler", MOTION);
const FieldGroup FIELDS_FACETS = ARRAYS("facet", "solid -> coupler", FACETS);
const FieldGroup FIELDS_SIMPLICES = ARRAYS("element", "solid -> coupler", SIMPLICES);
const FieldGroup FIELDS_FORCE = ARRAYS("node", "coupler -> solid", FORCE);
const FieldGroup FIELDS_BOXES = ARRAYS("box", "coupler -> fluid", BOXES);
const FieldGroup FIELDS_DOMAIN = ENTRIES("corner", "fluid -> coupler", FieldsDomain, DOMAIN_BOUNDS);
const FieldGroup FIELDS_ELEMENTS = ARRAYS("element", "fluid -> coupler", ELEMENTS);
const FieldGroup FIELDS_FLOW = ARRAYS("element", "fluid -> coupler", FLOW);
const FieldGroup FIELDS_CORRECTION = ENTRIES("entry", "coupler -> fluid", CoracleCorrection, CORRECTION);
const FieldGroup FIELDS_COUPLING = ENTRIES("entry", "coupler -> fluid", CoracleCoupling, COUPLING);
const FieldGroup FIELDS_GAUGES = ENTRIES("gauge", "coupler -> fluid", CoracleGauge, GAUGES);

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

static size_t Bytes(const Field *field, const int extent[NEXTENTS])
{
  static const size_t TYPE[] = {sizeof(double), sizeof(int), sizeof(int), sizeof(long long)};
  return TYPE[field->type] * (size_t)FieldSize(field, extent);
}

static bool Travels(const Field *field, int flags)
{
  return !field->only || (flags & field->only);
}

/* --- packing -------------------------------------------------------------------------------------------- */

/* Checks values[n][size], where they are about to travel. */
static void Check(Participant *p, const FieldGroup *group, const Field *field, size_t n, int size,
                  const double values[])
{
  static const char *const EXPECTED[] = {"", "it must not be negative", "it must be positive"};
  MessageCheckFinite(p, field->name, group->entity, n, size, values);
  if (field->range == FIELD_ANY) return;
  for (size_t i = 0; i < n * (size_t)size; i++)
    if (values[i] < 0.0 || (field->range == FIELD_POSITIVE && values[i] == 0.0))
      ParticipantFail(p, "%s is %g %s at %s %zu in step %d: %s", field->name, values[i], field->unit,
                      group->entity, i / (size_t)size, p->step, EXPECTED[field->range]);
}

static void PackArray(Participant *p, Message *m, const FieldGroup *group, const Field *field, size_t n,
                      size_t bytes, const void *structure)
{
  const void *array;
  memcpy(&array, (const char *)structure + field->offset, sizeof array);
  if (!array && n)
    ParticipantFail(p, "the %s of %zu %ss is missing in step %d: the pointer is NULL", field->name, n,
                    group->entity, p->step);
  MessageAdd(m, array, n * bytes);
}

static void PackEntries(Message *m, const FieldGroup *group, const Field *field, size_t n, size_t bytes,
                        const char *entries)
{
  MessageAdd(m, NULL, n * bytes);
  char *to = m->buffer.data + m->last;
  for (size_t i = 0; i < n; i++) memcpy(to + i * bytes, entries + i * group->entry + field->offset, bytes);
}

void FieldsPack(Participant *p, Message *m, const FieldGroup *group, size_t n, const void *data)
{
  int extent[NEXTENTS];
  FieldsExtents(p->dim, extent);
  MessageHeaderOf(m)->dim = p->dim;
  for (int k = 0; k < group->nfields; k++) {
    const Field *field = &group->field[k];
    const size_t bytes = Bytes(field, extent);
    if (!Travels(field, MessageHeaderOf(m)->flag)) continue;
    if (group->entry)
      PackEntries(m, group, field, n, bytes, data);
    else
      PackArray(p, m, group, field, n, bytes, data);
    if (field->type == FIELD_REAL)
      Check(p, group, field, n, FieldSize(field, extent),
            (const double *)(const void *)(m->buffer.data + m->last));
  }
}

/* --- unpacking ------------------------------------------------------------------------------------------ */

/* The next block of the message, or NULL if the field has not travelled. */
static const void *TakeBlock(Participant *p, Message *m, const Field *field, size_t n, size_t *bytes)
{
  const MessageHeader *h = MessageHeaderOf(m);
  int extent[NEXTENTS];
  if (h->dim != p->dim)
    ParticipantFail(p, "%s rank %d sends fields in %d dimensions, this run has %d", ROLE_NAMES[m->role],
                    m->rank, h->dim, p->dim);
  FieldsExtents(p->dim, extent);
  *bytes = Bytes(field, extent);
  return Travels(field, h->flag) ? MessageTake(p, m, n * *bytes) : NULL;
}

void FieldsAppend(Participant *p, Message *m, const FieldGroup *group, size_t n, FieldLists *lists)
{
  for (int k = 0; k < group->nfields; k++) {
    size_t bytes;
    const void *block = TakeBlock(p, m, &group->field[k], n, &bytes);
    if (block && n) memcpy(BufferExtend(&lists->list[k], n * bytes), block, n * bytes);
  }
}

void FieldsView(const FieldGroup *group, const FieldLists *lists, int flags, void *structure)
{
  for (int k = 0; k < group->nfields; k++) {
    const void *array = Travels(&group->field[k], flags) ? lists->list[k].data : NULL;
    memcpy((char *)structure + group->field[k].offset, &array, sizeof array);
  }
}

void FieldsTake(Participant *p, Message *m, const FieldGroup *group, size_t n, Buffer *entries)
{
  char *to = BufferResize(entries, n * group->entry);
  if (n) memset(to, 0, n * group->entry); /* where a field has not travelled it is 0 */
  for (int k = 0; k < group->nfields; k++) {
    const Field *field = &group->field[k];
    size_t bytes;
    const char *block = TakeBlock(p, m, field, n, &bytes);
    for (size_t i = 0; block && i < n; i++)
      memcpy(to + i * group->entry + field->offset, block + i * bytes, bytes);
  }
}

void FieldListsClear(FieldLists *lists)
{
  for (int k = 0; k < FIELDS_MAX; k++) BufferResize(&lists->list[k], 0);
}

void FieldListsFree(FieldLists *lists)
{
  for (int k = 0; k < FIELDS_MAX; k++) BufferFree(&lists->list[k]);
}
