/* One message between a client rank and its home, the coupler rank (client rank % coupler ranks), which is
 * the only partner it has:
 *
 *     header: kind, step, action, flag, counts, t, dt | block | block | ...      blocks are padded to 8 bytes
 *
 *     SURFACE    solid -> coupler   count = nodes, facets, elements: gid, x, velocities, inertia, facets, elements
 *                                   (Ready; End after a change)
 *     MOTION     solid -> coupler   count = nodes: x, velocities (fitted or given, mean), mobility, acceleration  (End)
 *     FORCE      solid <- coupler   count = nodes, -, bytes of path: force, where to save; action, t, dt (Begin)
 *     ASK        fluid <- coupler   count = boxes: corners                                    (within Ready, End)
 *     ELEMENTS   fluid -> coupler   count = elements: vertices, density; bounds; dt = proposed      (answers ASK)
 *     COUPLING   fluid <- coupler   count = corrections, couplings, bytes of path: .., where to save; action,
 *                                   t, dt                                                    (ends Ready, End)
 *     FLOW       fluid -> coupler   count = elements: u*, u+, p, mu; flag; dt = proposed                  (End)
 *     CLOSE      both  -> coupler   count = reports                                                         (Close)
 *
 * Kind and step travel with every message: one that does not fit ends the job with both sides' names. */
#ifndef CORACLE_MESSAGE_H
#define CORACLE_MESSAGE_H
#include "common/link/participant.h"
#include <stddef.h>
#include <stdint.h>

typedef enum {
  KIND_SURFACE = 1,
  KIND_MOTION,
  KIND_FORCE,
  KIND_ASK,
  KIND_ELEMENTS,
  KIND_COUPLING,
  KIND_FLOW,
  KIND_CLOSE,
  KIND_END
} MessageKind;

/* flag: of FLOW; of FLOW, MOTION, SURFACE and CLOSE; of all that a client sends. */
enum { FLAG_CHANGED = 1, FLAG_SAVED = 2, FLAG_RESUMES = 4 };

typedef struct {
  uint32_t magic;
  int32_t kind, step, action, flag, unused;
  int64_t count[3];
  double t, dt; /* s */
} MessageHeader;

/* Memory that grows and is kept: [0, size) is in use. */
typedef struct {
  char *data;
  size_t size, capacity;
} Buffer;

typedef struct {
  Buffer buffer;
  size_t at;           /* of reading */
  MPI_Request request; /* of sending */
  Role role;           /* the partner */
  int rank;
} Message;

/* Room for at least `bytes` (never NULL), and size = bytes; what was there stays. */
void *BufferResize(Buffer *b, size_t bytes);
/* Room for `bytes` more at the end: where to write them. */
void *BufferExtend(Buffer *b, size_t bytes);
void BufferFree(Buffer *b);

/* The partner never changes. */
void MessageInit(Message *m, Role role, int rank);
void MessageFree(Message *m);
/* Writing: a header, then blocks. */
MessageHeader *MessageStart(Message *m, MessageKind kind, int step);
void MessageAdd(Message *m, const void *block, size_t bytes);
/* Sending is done when MessageFinish returns; the message must stay as it is until then. */
void MessageSend(Participant *p, Message *m);
void MessageFinish(Participant *p, Message *m);
/* Waits for the partner's next message, which must be of one of two kinds (or one, twice) and of `step`. */
const MessageHeader *MessageReceive(Participant *p, Message *m, MessageKind kind, MessageKind other,
                                    int step);
/* The next block; its size must be `bytes`.  Borrowed until the next receive. */
const void *MessageTake(Participant *p, Message *m, size_t bytes);

/* Fails when array[n][per], about to travel, holds a NaN or an infinity: names field, entry, component. */
void MessageCheckFinite(Participant *p, const char *field, const char *entry, size_t n, int per,
                        const double array[]);
#endif
