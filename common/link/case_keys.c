/* The list of keys that a program reads, as its readers described them. */
#include "common/link/case_impl.h"
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* --- keeping -------------------------------------------------------------------------------------------- */

/* Where the reading of a key as this type is, or would be. */
static int *SlotOf(const CoracleCase c, const char *key, const char *type)
{
  const unsigned long long n = (unsigned long long)c->nreading_slots,
                           hash = CaseFnv1a(CASE_FNV_START, key, strlen(key) + 1);
  unsigned long long k = CaseFnv1a(hash, type, strlen(type)) % n;
  for (int i; (i = c->reading_slot[k]) >= 0; k = (k + 1) % n)
    if (!strcmp(c->reading[i].key, key) && !strcmp(c->reading[i].type, type)) break;
  return &c->reading_slot[k];
}

/* Room for one more reading. */
static void Grow(CoracleCase c)
{
  if (c->nreadings < c->readings_capacity) return;
  c->readings_capacity = c->readings_capacity ? 2 * c->readings_capacity : 64;
  c->reading = realloc(c->reading, (size_t)c->readings_capacity * sizeof *c->reading);
  c->nreading_slots = 2 * c->readings_capacity;
  c->reading_slot = realloc(c->reading_slot, (size_t)c->nreading_slots * sizeof *c->reading_slot);
  for (int k = 0; k < c->nreading_slots; k++) c->reading_slot[k] = -1;
  for (int i = 0; i < c->nreadings; i++) *SlotOf(c, c->reading[i].key, c->reading[i].type) = i;
}

void CaseNote(CoracleCase c, const char *key, bool required, const char *type, const char *range,
              const char *fallback)
{
  if (!c->listing) return;
  CaseReading note = {.key = NULL, .required = required};
  snprintf(note.type, sizeof note.type, "%s", type);
  Grow(c);
  int *slot = SlotOf(c, key, note.type);
  if (*slot >= 0) return;
  *slot = c->nreadings++;
  CaseReading *r = &c->reading[*slot];
  *r = note;
  r->key = strdup(key);
  snprintf(r->range, sizeof r->range, "%s", range + strspn(range, " "));
  snprintf(r->fallback, sizeof r->fallback, "%s", fallback);
}

/* Where the open map that the first n characters of a key name is, or would be. */
static int *OpenSlotOf(const CoracleCase c, const char *key, size_t n)
{
  const unsigned long long nslots = (unsigned long long)c->nopen_slots;
  unsigned long long k = CaseFnv1a(CASE_FNV_START, key, n) % nslots;
  for (int i; (i = c->open_slot[k]) >= 0; k = (k + 1) % nslots)
    if (!strncmp(c->open[i], key, n) && !c->open[i][n]) break;
  return &c->open_slot[k];
}

static void HashOpen(CoracleCase c)
{
  c->nopen_slots = 4 * c->nopen + 16;
  c->open_slot = realloc(c->open_slot, (size_t)c->nopen_slots * sizeof *c->open_slot);
  for (int k = 0; k < c->nopen_slots; k++) c->open_slot[k] = -1;
  for (int i = 0; i < c->nopen; i++) *OpenSlotOf(c, c->open[i], strlen(c->open[i])) = i;
}

void CaseNoteMap(CoracleCase c, const char *key)
{
  if (!c->listing) return;
  if (2 * c->nopen + 2 > c->nopen_slots) HashOpen(c);
  int *slot = OpenSlotOf(c, key, strlen(key));
  if (*slot >= 0) return;
  *slot = c->nopen;
  CasePush(&c->open, &c->nopen, &c->open_capacity, strdup(key));
}

void CaseNotesFree(CoracleCase c)
{
  for (int i = 0; i < c->nreadings; i++) free(c->reading[i].key);
  for (int i = 0; i < c->nopen; i++) free(c->open[i]);
  free(c->reading);
  free(c->reading_slot);
  free(c->open_slot);
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
    /* whether the name that starts here is the user's */
    const bool users =
        c->nopen > 0 && k > key && k[-1] == '.' && *OpenSlotOf(c, key, (size_t)(k - key) - 1) >= 0;
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
