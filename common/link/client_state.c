/* State that the library saves when a step begins and puts back when it is redone. */
#include "common/link/client_impl.h"
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

/* --- checkpoints ---------------------------------------------------------------------------------------- */

/* <folder>/<role>.<rank>.state: the number of ranks, and of every buffer its size and its bytes */

enum { STATE_PATH = 4200 };

static void StatePath(CoracleClient c, const char *folder, char path[STATE_PATH])
{
  snprintf(path, STATE_PATH, "%s/%s.%d.state", folder, ROLE_NAMES[c->p->role], c->p->rank);
}

static bool IsBuffer(const BoundState *s)
{
  return !s->f;
}

static size_t CountBuffers(CoracleClient c)
{
  size_t count = 0;
  for (size_t i = 0; i < StateCount(&c->states); i++) count += IsBuffer(&States(&c->states)[i]);
  return count;
}

bool StateIsBuffers(CoracleClient c)
{
  return CountBuffers(c) > 0 && CountBuffers(c) == StateCount(&c->states);
}

/* The buffers as they have just been saved. */
static void Write(CoracleClient c)
{
  const size_t ranks = (size_t)c->p->size;
  char path[STATE_PATH];
  StatePath(c, c->save.data, path);
  FILE *file = fopen(path, "wb");
  if (file) fwrite(&ranks, sizeof ranks, 1, file);
  for (size_t i = 0; file && i < StateCount(&c->states); i++) {
    const BoundState *s = &States(&c->states)[i];
    if (!IsBuffer(s)) continue;
    fwrite(&s->saved.size, sizeof s->saved.size, 1, file);
    if (s->saved.size) fwrite(s->saved.data, 1, s->saved.size, file);
  }
  const bool wrong = !file || ferror(file);
  if ((file && fclose(file)) || wrong) ParticipantFail(c->p, "%s: %s", path, strerror(errno));
}

/* Buffer number `which` out of the checkpoint that the run resumes from. */
static void Read(CoracleClient c, size_t which, void *state, size_t bytes)
{
  char path[STATE_PATH];
  size_t ranks = 0, size = 0;
  StatePath(c, c->p->resume, path);
  FILE *file = fopen(path, "rb");
  if (!file)
    ParticipantFail(c->p, "cannot go on: %s: %s (bound state needs as many ranks as it was saved on)", path,
                    strerror(errno));
  bool good = fread(&ranks, sizeof ranks, 1, file) == 1;
  if (good && ranks != (size_t)c->p->size)
    ParticipantFail(c->p, "cannot go on: its bound state was saved on %zu ranks, here are %d", ranks,
                    c->p->size);
  good = good && fread(&size, sizeof size, 1, file) == 1;
  for (; good && which > 0; which--)
    good = !fseek(file, (long)size, SEEK_CUR) && fread(&size, sizeof size, 1, file) == 1;
  if (!good || size != bytes || fread(state, 1, bytes, file) != bytes)
    ParticipantFail(c->p, "cannot go on: %s does not hold the %zu bytes of state that are bound", path,
                    bytes);
  fclose(file);
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
  ClientMustBe(c, "CoracleBindState");
  if (!state && bytes) ClientMisuse(c, "CoracleBindState", "state is NULL");
  BufferResize(&bound.saved, bytes);
  Bind(c, "CoracleBindState", bound);
  if (c->p->resume) Read(c, CountBuffers(c) - 1, state, bytes);
  return 0;
}

int CoracleBindStateFunction(CoracleClient c, int (*f)(void *context, int save), void *context)
{
  ClientMustBe(c, "CoracleBindStateFunction");
  if (!f) ClientMisuse(c, "CoracleBindStateFunction", "there must be a function");
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
  if (c->save.size && CountBuffers(c) > 0) Write(c);
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
