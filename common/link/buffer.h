/* Memory of the link's messages and lists. */
#ifndef CORACLE_BUFFER_H
#define CORACLE_BUFFER_H
#include <stddef.h>

/* Memory that grows and is kept: [0, size) is in use. */
typedef struct {
  char *data;
  size_t size, capacity;
} Buffer;

/* Room for at least `bytes` (never NULL), and size = bytes; what was there stays. */
void *BufferResize(Buffer *b, size_t bytes);
/* Room for `bytes` more at the end: where to write them. */
void *BufferExtend(Buffer *b, size_t bytes);
/* size = bytes, with what is at `from`. */
void BufferCopy(Buffer *b, const void *from, size_t bytes);
void BufferFree(Buffer *b);
#endif
