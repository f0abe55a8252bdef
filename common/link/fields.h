/* The table of the fields that travel between the participants.  A field is added here and in the C structure
 * that holds it; packing, unpacking and the checks of both ends follow.  Which groups a message has: message.h.
 *
 * A group travels field by field in the table's order, each as an array over its entities:
 *
 *     x: n * dim doubles | u: n * dim doubles | ...          C order, each array padded to 8 bytes
 *
 * A field that is 0 for most entities travels for the others alone:
 *
 *     carries: n bytes, 0 or 1 | a: so many times its doubles as there are 1
 *
 * Shapes are products of extents that depend on the dimension of the mesh (FieldsExtents), which the header of
 * each message carries. */
#ifndef CORACLE_FIELDS_H
#define CORACLE_FIELDS_H
#include "common/link/message.h"
#include "common/link/server.h"

typedef enum { FIELD_REAL, FIELD_INDEX, FIELD_FLAGS, FIELD_ID } FieldType; /* double, int, int, long long */

/* What a real value must be beside finite. */
typedef enum { FIELD_ANY, FIELD_NOT_NEGATIVE, FIELD_POSITIVE } FieldRange;

typedef enum {
  EXTENT_END,
  EXTENT_DIM,      /* components of a vector */
  EXTENT_VERTICES, /* of an element; also the nodes of the fluid's velocity on it */
  EXTENT_FACET,    /* vertices of a facet */
  EXTENT_PRESSURE, /* nodes of the fluid's pressure on an element */
  EXTENT_CORNERS,  /* of a box: lower, upper */
  NEXTENTS
} FieldExtent;

/* Instead of a header's flag, of a real field of structures: it travels for the entities where it is not 0 throughout. */
enum { FIELD_SPARSE = -1 };

enum { FIELD_RANK = 4, FIELDS_MAX = 10 }; /* most extents of a field, most fields of a group */

typedef struct {
  const char *name, *unit;
  FieldType type;
  FieldExtent shape[FIELD_RANK + 1]; /* of one entity, ended by EXTENT_END; none: a scalar */
  size_t offset; /* in the C structure: of the pointer to the array, or of the value itself */
  int only;      /* travels only in messages whose header has this flag; 0: always; or FIELD_SPARSE */
  FieldRange range;
} Field;

struct FieldGroup {
  const char *entity; /* "node" */
  size_t entry;       /* bytes of the C structure of one entity; 0: a structure of arrays */
  int nfields;
  const Field *field; /* [nfields] */
};

typedef struct {
  const double *force;           /* [n][dim] N */
  const double *film_load;       /* [n][dim] N */
  const double *film_resistance; /* [n][dim][dim] N s/m */
} FieldsForce;
typedef struct {
  const double *box; /* [n][2][dim] m */
} FieldsBoxes;
typedef struct {
  double lower[CORACLE_DIM], upper[CORACLE_DIM]; /* m */
} FieldsDomain;

/* extent[NEXTENTS] of simplices in dim dimensions with P1 velocity and P2 pressure. */
void FieldsExtents(int dim, int extent[NEXTENTS]);
/* Number of values of one entity. */
int FieldSize(const Field *field, const int extent[NEXTENTS]);

/* A number that differs, as good as always, where kinds of messages, groups or their fields differ: programs of one protocol alone
 * can run together. */
unsigned FieldsProtocol(void);

/* Checks the group's n entities and adds them to the message.  data: the structure of arrays, or the array of
 * n structures.  Ends the job naming field, entity and component of a value that cannot be. */
void FieldsPack(Participant *p, Message *m, const FieldGroup *group, size_t n, const void *data);

/* Received arrays of a group, one list a field, in the table's order. */
typedef struct {
  Buffer list[FIELDS_MAX];
} FieldLists;
void FieldListsClear(FieldLists *lists);
void FieldListsFree(FieldLists *lists);
/* Structure of arrays: appends the next n entities of the message to the lists. */
void FieldsAppend(Participant *p, Message *m, const FieldGroup *group, size_t n, FieldLists *lists);
/* Sets the structure's pointers to the lists; NULL where a field did not travel in messages with `flags`. */
void FieldsView(const FieldGroup *group, const FieldLists *lists, int flags, void *structure);
/* Array of structures: the next n entities of the message (overwritten). */
void FieldsTake(Participant *p, Message *m, const FieldGroup *group, size_t n, Buffer *entries);
#endif
