/* One message between a client rank and the coupler rank that it belongs to, its owner (client rank % coupler
 * ranks), which is the only partner it has:
 *
 *     +--------+---------+---------+-----
 *     | header | block 0 | block 1 | ...     each block is padded to 8 bytes
 *     +--------+---------+---------+-----
 *
 *     kind      direction          count[0], [1], [2], [3]         blocks                             sent within
 *     SURFACE   solid -> coupler   nodes, facets, elements         nodes, motion, facets, elements    Ready; End after a change
 *     MOTION    solid -> coupler   nodes, -, -, bytes of reason    motion; or reason                  End
 *     FORCE     solid <- coupler   nodes, -, bytes of path         force; path                        Begin
 *     ASK       fluid <- coupler   boxes                           boxes                              GetRegion, Ready, End
 *     ELEMENTS  fluid -> coupler   elements                        domain, elements                   answers ASK
 *     STEP      fluid <- coupler   corrections, -, bytes of path,  corrections, gauges; path          ends Ready, End
 *                                  gauges
 *     COUPLING  fluid <- coupler   couplings                       couplings                          GetCoupling
 *     FLOW      fluid -> coupler   elements, -, -, bytes of reason flow; or reason                    End
 *     CLOSE     both  -> coupler   reports, spans of the trace     reports, spans                     Close
 *
 * A reason (CoracleRejectStep) says why the step cannot be made.  FORCE and STEP carry the coming step (action, t, dt) and
 * the path of the checkpoint that is due in it; ELEMENTS and FLOW carry in dt the step that the fluid proposes.
 * Kind and step travel with every message: one that does not fit ends the job with both sides' names. */
#ifndef CORACLE_MESSAGE_H
#define CORACLE_MESSAGE_H
#include "common/link/buffer.h"
#include "common/link/participant.h"
#include <stddef.h>
#include <stdint.h>

#define MESSAGE_KINDS(KIND)                                                                                  \
  KIND(SURFACE)                                                                                              \
  KIND(MOTION) KIND(FORCE) KIND(ASK) KIND(ELEMENTS) KIND(STEP) KIND(COUPLING) KIND(FLOW) KIND(CLOSE)

#define MESSAGE_KIND(name) KIND_##name,
typedef enum { KIND_NONE, MESSAGE_KINDS(MESSAGE_KIND) KIND_END } MessageKind;

/* The groups of fields that are the messages' blocks (fields.h, fields.c) and the C structures that hold them:
 *
 *     SURFACE    FIELDS_NODES, FIELDS_MOTION       ServerSolid, arrays over the nodes
 *                FIELDS_FACETS, FIELDS_SIMPLICES   ServerSolid, arrays over the facets, over the solid's elements
 *     MOTION     FIELDS_MOTION
 *     FORCE      FIELDS_FORCE                      FieldsForce, an array over the nodes
 *     ASK        FIELDS_BOXES                      FieldsBoxes, an array over the boxes
 *     ELEMENTS   FIELDS_DOMAIN, FIELDS_ELEMENTS    FieldsDomain, one; CoracleElements, arrays over the fluid's elements
 *     FLOW       FIELDS_FLOW                       CoracleFlow, arrays over the fluid's elements
 *     STEP       FIELDS_CORRECTION, FIELDS_GAUGES  CoracleCorrection, one an element; CoracleGauge, one a gauge on the solid
 *     COUPLING   FIELDS_COUPLING                   CoracleCoupling, one an element */
#define FIELD_GROUPS(GROUP)                                                                                  \
  GROUP(NODES)                                                                                               \
  GROUP(MOTION)                                                                                              \
  GROUP(FACETS)                                                                                              \
  GROUP(SIMPLICES)                                                                                           \
  GROUP(FORCE)                                                                                               \
  GROUP(BOXES) GROUP(DOMAIN) GROUP(ELEMENTS) GROUP(FLOW) GROUP(CORRECTION) GROUP(COUPLING) GROUP(GAUGES)

typedef struct FieldGroup FieldGroup;
#define FIELD_GROUP(name) extern const FieldGroup FIELDS_##name;
FIELD_GROUPS(FIELD_GROUP)

/* MessageHeader.flag */
enum {
  FLAG_CHANGED = 1,        /* FLOW: the fluid's elements will be others */
  FLAG_SAVED = 2,          /* of a client: it has saved itself into the checkpoint that was due */
  FLAG_RESUMES = 4,        /* of a client: it resumes from a checkpoint */
  FLAG_PRESSURE = 8,       /* ASK: the coupling mode or the solid needs the pressure; FLOW: it is there */
  FLAG_PRESSURE_LOAD = 16, /* SURFACE: the solid wants it as a load */
  FLAG_FILM = 32           /* FORCE: films of fluid between solids yield, the same on all ranks */
};

typedef struct {
  uint32_t magic;
  int32_t kind, step, action, flag, dim;
  int64_t count[4];
  double t, dt; /* s */
} MessageHeader;

typedef struct {
  Buffer buffer;
  size_t at;           /* of reading: the next block */
  size_t last;         /* of writing: the block added last */
  MPI_Request request; /* of sending */
  Role role;           /* the partner */
  int rank;
} Message;

/* The partner never changes. */
void MessageInit(Message *m, Role role, int rank);
void MessageFree(Message *m);
/* Writing: a header, then blocks. */
MessageHeader *MessageStart(Message *m, MessageKind kind, int step);
/* The header of the message being written, or received last; moves when the message grows. */
MessageHeader *MessageHeaderOf(const Message *m);
/* Copies a block; NULL: its bytes are to be written. */
void MessageAdd(Message *m, const void *block, size_t bytes);
/* Sending is done when MessageFinish returns; the message must stay as it is until then. */
void MessageSend(Participant *p, Message *m);
void MessageFinish(Participant *p, Message *m);
/* Waits for the partner's next message, which must be of one of two kinds (or one, twice) and of `step`. */
const MessageHeader *MessageReceive(Participant *p, Message *m, MessageKind kind, MessageKind other,
                                    int step);
/* The next block; its size must be `bytes`.  Borrowed until the next receive. */
const void *MessageTake(Participant *p, Message *m, size_t bytes);

/* Fails when array[n][per], about to travel, holds a NaN or an infinity: names field, entry, component.
 * carries: NULL, or for each entry whether the array has a row of it. */
void MessageCheckFinite(Participant *p, const char *field, const char *entry, const char carries[], size_t n,
                        int per, const double array[]);
#endif
