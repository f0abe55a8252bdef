/* Runs a piece of a test that must fail with a given message, or must not fail at all. */
#ifndef TEST_CATCH_H
#define TEST_CATCH_H
#include "common/link/case_file.h"
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
  jmp_buf jump;
  char message[2048];
} Catch;

static void CatchFail(void *context, const char *message)
{
  Catch *c = context;
  snprintf(c->message, sizeof c->message, "%s", message);
  longjmp(c->jump, 1);
}

/* Writes `text` to a scratch file and opens it with up to four --set arguments; what f then does must fail
 * with exactly `expected` (without the file's path; NULL: must not fail). */
static inline void CheckCase(const char *text, const char *const sets[], void (*f)(CoracleCase c),
                             const char *expected)
{
  static Catch catcher; /* static: it outlives the jump */
  static CoracleCase c;
  static char path[] = "/tmp/coracle-case-XXXXXX", *argv[16];
  static int argc;
  strcpy(path, "/tmp/coracle-case-XXXXXX");
  const int file = mkstemp(path);
  if (file < 0 || write(file, text, strlen(text)) < 0) exit(2);
  close(file);
  argc = 0;
  argv[argc++] = (char *)"test";
  argv[argc++] = path;
  for (int i = 0; sets && sets[i]; i++) {
    argv[argc++] = (char *)"--set";
    argv[argc++] = (char *)sets[i];
  }
  c = NULL;
  catcher.message[0] = '\0';
  if (!setjmp(catcher.jump)) {
    CoracleCaseOpen(argc, argv, CatchFail, &catcher, &c);
    f(c);
  }
  CoracleCaseClose(&c);
  unlink(path);
  const char *got = catcher.message, *stem = strstr(got, path);
  if (stem == got) got += strlen(path);
  if (strcmp(got, expected ? expected : "")) {
    fprintf(stderr, "expected '%s'\n     got '%s'\n", expected ? expected : "(no failure)", got);
    exit(1);
  }
}

#define CHECK(condition)                                                                                     \
  do {                                                                                                       \
    if (!(condition)) {                                                                                      \
      fprintf(stderr, "%s:%d: failed: %s\n", __FILE__, __LINE__, #condition);                                \
      exit(1);                                                                                               \
    }                                                                                                        \
  } while (0)
#endif
