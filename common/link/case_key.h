/* A key of the case whose path has numbers of items or names in it. */
#ifndef CORACLE_CASE_KEY_H
#define CORACLE_CASE_KEY_H
#include <stdarg.h>
#include <stdio.h>

enum { CASE_KEY = 512 };

/* Writes key as printf would, CaseKey(key, "fluid.phases[%d].density", k), at most CASE_KEY - 1 characters of it, and returns key. */
__attribute__((format(printf, 2, 3))) static inline const char *CaseKey(char key[CASE_KEY],
                                                                        const char *format, ...)
{
  va_list values;
  va_start(values, format);
  (void)vsnprintf(key, CASE_KEY, format, values);
  va_end(values);
  return key;
}
#endif
