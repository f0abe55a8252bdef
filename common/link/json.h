/* Strings in JSON. */
#ifndef CORACLE_JSON_H
#define CORACLE_JSON_H
#include <stdio.h>

/* The characters between the quotes. */
static inline void JsonCharacters(FILE *f, const char *s)
{
  for (; *s; s++) {
    if (*s == '"' || *s == '\\') fputc('\\', f);
    if ((unsigned char)*s < 0x20)
      fprintf(f, "\\u%04x", (unsigned)*s);
    else
      fputc(*s, f);
  }
}
#endif
