/* trace.json stays JSON, and UTF-8, whatever a program calls its phases. */
#include "common/link/trace.h"
#include "common/link/wait.h"
#include "tests/check.h"
#include <string.h>
#include <unistd.h>

static void Phase(Trace *t, const char *name)
{
  TracePhase(t, name);
  const double start = WaitClock();
  while (WaitClock() - start < 1e-3) continue;
}

int main(void)
{
  char path[] = "/tmp/coracle_trace_XXXXXX";
  static char text[10000];
  Trace t = {.on = true, .step_start = WaitClock()};
  const int file = mkstemp(path);
  CHECK(file >= 0, "no file");
  close(file);
  Phase(&t, "a \"b\\\n");
  Phase(&t, "of 22 characters, and \xc3\xa9"); /* its last one does not fit */
  Phase(&t, "of 21 characters, an \xc3\xa9\xc3\xa9");
  TraceEnd(&t);
  CHECK(TraceWrite(path, t.spans.size / sizeof(TraceSpan), (const TraceSpan *)(const void *)t.spans.data),
        "not written");
  FILE *f = fopen(path, "r");
  CHECK(f, "no file");
  text[fread(text, 1, sizeof text - 1, f)] = 0;
  fclose(f);
  unlink(path);
  CHECK(strstr(text, "\"name\": \"a \\\"b\\\\\\u000a\""), "%s", text);
  CHECK(strstr(text, "\"name\": \"of 22 characters, and \""), "%s", text);
  CHECK(strstr(text, "\"name\": \"of 21 characters, an \xc3\xa9\""), "%s", text);
  BufferFree(&t.spans);
  return 0;
}
