/* State that the library saves when a step begins and puts back when it is redone. */
#include "client_impl.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>

static size_t StateCount(const Buffer *states)
{
  return states->size / sizeof(BoundState);
}
static BoundState *States(const Buffer *states)
{
  return (BoundState *)(void *)states->data;
}

/* --- checkpoints: <folder>/<role>.<rank>.state, of every buffer its size and its bytes ------------------- */

enum { STATE_PATH = 4200 };

static void StatePath(CoracleClient c, const char *folder, char path[STATE_PATH])
{
  snprintf(path, STATE_PATH, "%s/%s.%d.state", folder, ROLE_NAMES[c->p->role], c->p->rank);
}

/* Whether buffers are all that there is. */
static bool AllFlat(CoracleClient c)
{
  for (size_t i = 0; i < StateCount(&c->states); i++)
    if (States(&c->states)[i].f) return false;
  return StateCount(&c->states) > 0;
}

/* The buffers as they have just been saved. */
static void Write(CoracleClient c)
{
  char path[STATE_PATH];
  StatePath(c, c->save.data, path);
  FILE *file = fopen(path, "wb");
  for (size_t i = 0; file && i < StateCount(&c->states); i++) {
    const Buffer *saved = &States(&c->states)[i].saved;
    fwrite(&saved->size, sizeof saved->size, 1, file);
    if (saved->size) fwrite(saved->data, 1, saved->size, file);
  }
  const bool wrong = !file || ferror(file);
  if ((file && fclose(file)) || wrong) ParticipantFail(c->p, "%s: %s", path, strerror(errno));
  c->asked_save = true;
}

/* Buffer number `which` out of the checkpoint that the run goes on from. */
static void Read(CoracleClient c, size_t which, void *state, size_t bytes)
{
  char path[STATE_PATH];
  size_t size = 0;
  StatePath(c, c->p->resume, path);
  FILE *file = fopen(path, "rb");
  if (!file)
    ParticipantFail(c->p, "%s: %s (it was saved on as many ranks as it can be put back on)", path,
                    strerror(errno));
  bool good = fread(&size, sizeof size, 1, file) == 1;
  for (; good && which > 0; which--)
    good = !fseek(file, (long)size, SEEK_CUR) && fread(&size, sizeof size, 1, file) == 1;
  if (!good || size != bytes || fread(state, 1, bytes, file) != bytes)
    ParticipantFail(c->p, "%s does not hold the %zu bytes of state that are bound", path, bytes);
  fclose(file);
  c->asked_resume = true;
}

/* --- binding -------------------------------------------------------------------------------------------- */

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
  Bind(c, "CoracleBindState", bound);
  if (c->p->resume && AllFlat(c)) Read(c, StateCount(&c->states) - 1, state, bytes);
  return 0;
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
  if (c->save.size && AllFlat(c)) Write(c);
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
