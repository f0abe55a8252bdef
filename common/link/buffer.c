#include "common/link/buffer.h"
#include <stdlib.h>
#include <string.h>

static void Reserve(Buffer *b, size_t bytes)
{
  if (b->data && bytes <= b->capacity) return;
  b->capacity = bytes + bytes / 2 + 64;
  char *data = realloc(b->data, b->capacity);
  if (!data) abort(); /* the other participants are told by the launcher */
  b->data = data;
}

void *BufferResize(Buffer *b, size_t bytes)
{
  Reserve(b, bytes);
  b->size = bytes;
  return b->data;
}

void *BufferExtend(Buffer *b, size_t bytes)
{
  Reserve(b, b->size + bytes);
  b->size += bytes;
  return b->data + b->size - bytes;
}

void BufferCopy(Buffer *b, const void *from, size_t bytes)
{
  BufferResize(b, bytes);
  if (bytes) memcpy(b->data, from, bytes);
}

void BufferFree(Buffer *b)
{
  free(b->data);
  *b = (Buffer){0};
}
