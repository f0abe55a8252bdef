/* Mutants of a file, the same for a seed on any machine: bits and bytes, lines, and numbers that no case or mesh should have. */
#ifndef TESTS_HARDENING_FUZZ_H
#define TESTS_HARDENING_FUZZ_H
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  size_t n;
  char *byte; /* [n + 1], ended by 0 */
} Text;

static inline unsigned long long FuzzNext(unsigned long long *state) /* xorshift64* */
{
  *state ^= *state >> 12;
  *state ^= *state << 25;
  *state ^= *state >> 27;
  return *state * 2685821657736338717ULL;
}
static inline size_t FuzzBelow(unsigned long long *state, size_t n)
{
  return n ? (size_t)(FuzzNext(state) >> 11) % n : 0;
}

static inline Text FuzzRead(const char *path)
{
  Text t = {0, NULL};
  FILE *file = fopen(path, "rb");
  if (!file || fseek(file, 0, SEEK_END)) exit(2);
  t.n = (size_t)ftell(file);
  rewind(file);
  t.byte = calloc(t.n + 1, 1);
  if (fread(t.byte, 1, t.n, file) != t.n) exit(2);
  fclose(file);
  return t;
}
static inline void FuzzWrite(const char *path, const Text *t)
{
  FILE *file = fopen(path, "wb");
  if (!file || fwrite(t->byte, 1, t->n, file) != t->n || fclose(file)) exit(2);
}

/* Puts `with` in the place of [at, at + length). */
static inline void FuzzReplace(Text *t, size_t at, size_t length, const char *with, size_t n)
{
  char *byte = calloc(t->n - length + n + 1, 1);
  memcpy(byte, t->byte, at);
  memcpy(byte + at, with, n);
  memcpy(byte + at + n, t->byte + at + length, t->n - at - length);
  free(t->byte);
  t->byte = byte;
  t->n += n - length;
}

static inline void FuzzNumber(Text *t, unsigned long long *state)
{
  static const char *const NASTY[] = {"-1", "0",  "1e300", "-1e-300", ".nan", "nan", ".inf",       "1e9",
                                      "",   "[]", "{}",    "~",       "x",    "2",   "2147483648", "1e-12"};
  const char *with = NASTY[FuzzBelow(state, sizeof NASTY / sizeof *NASTY)];
  size_t at = FuzzBelow(state, t->n), end;
  while (at < t->n && !isdigit((unsigned char)t->byte[at])) at++;
  for (end = at; end < t->n && strchr("0123456789.e-+", t->byte[end]) && t->byte[end]; end++) continue;
  FuzzReplace(t, at, end - at, with, strlen(with));
}

/* The line that holds byte `at`, with its end. */
static inline size_t FuzzLine(const Text *t, size_t at, size_t *length)
{
  size_t start = at, end = at;
  while (start > 0 && t->byte[start - 1] != '\n') start--;
  while (end < t->n && t->byte[end] != '\n') end++;
  *length = (end < t->n ? end + 1 : end) - start;
  return start;
}

static inline void FuzzMutateLine(Text *t, unsigned long long *state)
{
  size_t length, start = FuzzLine(t, FuzzBelow(state, t->n), &length), other, n;
  char *line = calloc(length + 1, 1);
  memcpy(line, t->byte + start, length);
  switch (FuzzBelow(state, 3)) {
  case 0:
    FuzzReplace(t, start, length, "", 0);
    break; /* without it */
  case 1:
    FuzzReplace(t, start, 0, line, length);
    break; /* twice */
  default: /* in another place, too */
    other = FuzzLine(t, FuzzBelow(state, t->n), &n);
    FuzzReplace(t, other, n, line, length);
  }
  free(line);
}

/* A mutant of t after one to three mutations; to be freed. */
static inline Text FuzzMutate(const Text *t, unsigned long long *state)
{
  Text m = {t->n, calloc(t->n + 1, 1)};
  memcpy(m.byte, t->byte, t->n);
  for (size_t k = 1 + FuzzBelow(state, 3); k > 0 && m.n > 0; k--) {
    const char byte = (char)FuzzBelow(state, 256);
    switch (FuzzBelow(state, 6)) {
    case 0:
      m.byte[FuzzBelow(state, m.n)] ^= (char)(1 << FuzzBelow(state, 8));
      break;
    case 1:
      FuzzReplace(&m, FuzzBelow(state, m.n), 1, &byte, 1);
      break;
    case 2:
      FuzzMutateLine(&m, state);
      break;
    case 3:
      FuzzReplace(&m, FuzzBelow(state, m.n), 1, "", 0);
      break;
    case 4:
      if (FuzzBelow(state, 4) == 0) m.byte[m.n = FuzzBelow(state, m.n)] = 0; /* cut off */
      break;
    default:
      FuzzNumber(&m, state);
    }
  }
  return m;
}
#endif
