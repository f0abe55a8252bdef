/* Wrong use of the functions that read a case: the program's fault, not the file's. */
#include "common/link/case_impl.h"
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void CaseMisuse(CoracleCase c, const char *format, ...)
{
  char message[CASE_MESSAGE];
  va_list list;
  va_start(list, format);
  vsnprintf(message, sizeof message, format, list);
  va_end(list);
  if (c && c->fail) c->fail(c->context, message);
  fprintf(stderr, "coracle: error: %s\n", message); /* there is nobody to be told, or it has returned */
  abort();
}

/* name.name[0].name: names are not empty, an index is a number. */
static bool WellFormed(const char *key)
{
  for (;;) {
    const size_t name = strcspn(key, ".[]");
    if (name == 0) return false;
    key += name;
    while (*key == '[') {
      const size_t index = strspn(key + 1, "0123456789");
      if (index == 0 || key[1 + index] != ']') return false;
      key += index + 2;
    }
    if (!*key) return true;
    if (*key++ != '.') return false;
  }
}

void CaseUse(CoracleCase c, const char *function, const char *key)
{
  if (!c) CaseMisuse(NULL, "%s: the case is not open", function);
  if (!key) CaseMisuse(c, "%s: the key is NULL", function);
  if (!WellFormed(key))
    CaseMisuse(c, "%s: the key '%s' is malformed (expected name.name[0].name)", function, key);
}
