/* Wrong use of the functions that read a case: the program's fault, not the file's. */
#include "common/link/case_impl.h"
#include <stdio.h>
#include <stdlib.h>

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

void CaseUse(CoracleCase c, const char *function, const char *key)
{
  if (!c) CaseMisuse(NULL, "%s: the case is not open", function);
  if (!key) CaseMisuse(c, "%s: the key is NULL", function);
  if (!CasePathIsValid(key))
    CaseMisuse(c, "%s: the key '%s' is malformed (expected name.name[0].name)", function, key);
}
