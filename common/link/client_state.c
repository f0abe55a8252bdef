/* State that the library saves when a step begins and puts back when it is redone. */
#include "client_impl.h"
#include <string.h>

static size_t StateCount(const Buffer *states)
{
  return states->size / sizeof(BoundState);
}
static BoundState *States(const Buffer *states)
{
  return (BoundState *)(void *)states->data;
}

static int Bind(CoracleClient c, const char *function, BoundState state)
{
  if (c->p->step > 0) ClientMisuse(c, function, "state is bound before the first step");
  *(BoundState *)BufferExtend(&c->states, sizeof state) = state;
  return 0;
}

int CoracleBindState(CoracleClient c, void *state, size_t bytes)
{
  BoundState bound = {.state = state};
  BufferResize(&bound.saved, bytes);
  return Bind(c, "CoracleBindState", bound);
}

int CoracleBindStateFunction(CoracleClient c, int (*f)(void *context, int save), void *context)
{
  return Bind(c, "CoracleBindStateFunction", (BoundState){.f = f, .context = context});
}

static void SaveOrRestore(CoracleClient c, BoundState *s, bool save)
{
  if (s->f) {
    if (s->f(s->context, save))
      ParticipantFail(c->p, "saving or restoring its state failed in step %d", c->p->step);
  } else if (s->saved.size > 0) {
    memcpy(save ? (void *)s->saved.data : s->state, save ? s->state : (void *)s->saved.data, s->saved.size);
  }
}

void StateSave(CoracleClient c)
{
  for (size_t i = 0; i < StateCount(&c->states); i++) SaveOrRestore(c, &States(&c->states)[i], true);
}

void StateRestore(CoracleClient c)
{
  for (size_t i = 0; i < StateCount(&c->states); i++) SaveOrRestore(c, &States(&c->states)[i], false);
}

void StateFree(CoracleClient c)
{
  for (size_t i = 0; i < StateCount(&c->states); i++) BufferFree(&States(&c->states)[i].saved);
  BufferFree(&c->states);
}
