/* The list of keys that a program reads, as its readers described them. */
#include "common/link/case_impl.h"
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* --- keeping -------------------------------------------------------------------------------------------- */

void CaseNote(CoracleCase c, const char *key, bool required, const char *type, const char *range,
              const char *fallback)
{
  if (!c->listing) return;
  for (int i = 0; i < c->nreadings; i++)
    if (!strcmp(c->reading[i].key, key) && !strcmp(c->reading[i].type, type)) return;
  if (c->nreadings == c->readings_capacity) {
    c->readings_capacity = c->readings_capacity ? 2 * c->readings_capacity : 64;
    c->reading = realloc(c->reading, (size_t)c->readings_capacity * sizeof *c->reading);
  }
  CaseReading *r = &c->reading[c->nreadings++];
  *r = (CaseReading){.key = strdup(key), .required = required};
  snprintf(r->type, sizeof r->type, "%s", type);
  snprintf(r->range, sizeof r->range, "%s", range + strspn(range, " "));
  snprintf(r->fallback, sizeof r->fallback, "%s", fallback);
}

void CaseNoteMap(CoracleCase c, const char *key)
{
  if (c->listing) CasePush(&c->open, &c->nopen, &c->open_capacity, strdup(key));
}

void CaseNotesFree(CoracleCase c)
{
  for (int i = 0; i < c->nreadings; i++) free(c->reading[i].key);
  for (int i = 0; i < c->nopen; i++) free(c->open[i]);
  free(c->reading);
  free(c->open);
}

void CoracleCaseDescribe(CoracleCase c, const CoracleCaseKey table[])
{
  if (!c || !table)
    CaseMisuse(c, "CoracleCaseDescribe: %s", c ? "there must be a table" : "the case is not open");
  if (c->ntables == CASE_TABLES) CaseMisuse(c, "CoracleCaseDescribe: more than %d tables", CASE_TABLES);
  c->table[c->ntables++] = table;
}

/* --- patterns ------------------------------------------------------------------------------------------- */

/* solid.bodies[3].radius -> solid.bodies[].radius; names within maps of the user's names become '*'. */
static void Pattern(CoracleCase c, const char *key, char pattern[CASE_KEY])
{
  size_t n = 0;
  for (const char *k = key; *k && n + 2 < CASE_KEY;) {
    pattern[n] = '\0';
    bool users = false; /* the name that starts here */
    for (int i = 0; i < c->nopen && k > key && k[-1] == '.'; i++) {
      const size_t above = (size_t)(k - key) - 1;
      users = users || (strlen(c->open[i]) == above && !strncmp(c->open[i], key, above));
    }
    if (users) {
      pattern[n++] = '*';
      k += strcspn(k, ".[");
    } else if (isdigit((unsigned char)*k) && k > key && k[-1] == '[') {
      k += strspn(k, "0123456789");
    } else {
      pattern[n++] = *k++;
    }
  }
  pattern[n] = '\0';
}

static const CoracleCaseKey *Describe(CoracleCase c, const char *pattern)
{
  for (int t = 0; t < c->ntables; t++)
    for (const CoracleCaseKey *k = c->table[t]; k->key; k++)
      if (!strcmp(k->key, pattern)) return k;
  return NULL;
}

void CaseListKeys(CoracleCase c, FILE *out)
{
  char pattern[CASE_KEY];
  for (int i = 0; i < c->nreadings; i++) {
    const CaseReading *r = &c->reading[i];
    Pattern(c, r->key, pattern);
    const CoracleCaseKey *k = Describe(c, pattern);
    fprintf(out, "%s\t%s\t%s\t%s\t%s\t%s\t%s\n", pattern, r->required ? "required" : "optional", r->type,
            r->range, r->fallback, k ? k->unit : "", k ? k->meaning : "");
  }
}
