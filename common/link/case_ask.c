/* What a case file has: keys that are asked for, and what is said when one is not as it must be. */
#include "common/link/case_impl.h"
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- failing -------------------------------------------------------------------------------------------- */

/* "file.yaml:12" or "--set key=value": where a node comes from. */
static void Place(CoracleCase c, const CaseNode *node, char place[CASE_KEY])
{
  if (node && node->set)
    snprintf(place, CASE_KEY, "--set %s", node->set);
  else if (node && node->line)
    snprintf(place, CASE_KEY, "%s:%d", c->path, node->line);
  else
    snprintf(place, CASE_KEY, "%s", c->path);
}

void CaseDie(CoracleCase c, const CaseNode *node, const char *key, const char *format, ...)
{
  char place[CASE_KEY], text[CASE_MESSAGE], message[CASE_KEY + CASE_MESSAGE + 2];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  Place(c, node, place);
  snprintf(message, sizeof message, "%s: %s", place, text);
  if (c->faults) CaseFault(c->faults, key, message, node && node->file);
  c->fail(c->context, message);
  abort(); /* fail must not return */
}

void CoracleCaseRefuse(CoracleCase c, const char *key, const char *format, ...)
{
  char text[CASE_MESSAGE - CASE_KEY];
  va_list list;
  CaseUse(c, "CoracleCaseRefuse", key);
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  CaseDie(c, CaseTreeNearest(c->root, key), key, "key '%s': %s", key, text);
}

/* What stands in the file, for "found ...". */
static const char *Found(const CaseNode *node, char found[CASE_NAME])
{
  if (node->kind == NODE_LIST)
    snprintf(found, CASE_NAME, "a list of %d", node->n);
  else if (node->kind == NODE_MAP)
    snprintf(found, CASE_NAME, "a map of %d keys", node->n);
  else if (!node->text[0] && !node->quoted)
    snprintf(found, CASE_NAME, "nothing");
  else
    snprintf(found, CASE_NAME, "%s'%.*s'", node->quoted ? "the string " : "", CASE_NAME - 32, node->text);
  return found;
}

void CaseUnexpected(CoracleCase c, const char *key, const CaseNode *node, const char *expected)
{
  char found[CASE_NAME];
  CaseDie(c, node, key, "key '%s': expected %s, found %s", key, expected, Found(node, found));
}

/* --- finding -------------------------------------------------------------------------------------------- */

void CasePush(char ***list, int *n, int *capacity, char *string)
{
  if (*n == *capacity) {
    *capacity = *capacity ? 2 * *capacity : 64;
    *list = realloc(*list, (size_t)*capacity * sizeof **list);
  }
  (*list)[(*n)++] = string;
}

/* Where the key is, or would be, among those asked for. */
static int *SlotOf(CoracleCase c, const char *key)
{
  unsigned long long k = CaseFnv1a(CASE_FNV_START, key, strlen(key)) % (unsigned long long)c->nslots;
  while (c->slot[k] >= 0 && strcmp(c->asked[c->slot[k]], key)) k = (k + 1) % (unsigned long long)c->nslots;
  return &c->slot[k];
}

bool CaseAsked(CoracleCase c, const char *key)
{
  return c->nslots && *SlotOf(c, key) >= 0;
}

static void Remember(CoracleCase c, const char *key)
{
  if (2 * (c->nasked + 1) > c->nslots) {
    c->nslots = c->nslots ? 2 * c->nslots : 256;
    c->slot = realloc(c->slot, (size_t)c->nslots * sizeof *c->slot);
    for (int k = 0; k < c->nslots; k++) c->slot[k] = -1;
    for (int i = 0; i < c->nasked; i++) *SlotOf(c, c->asked[i]) = i;
  }
  *SlotOf(c, key) = c->nasked;
  CasePush(&c->asked, &c->nasked, &c->asked_capacity, strdup(key));
}

static CaseNode *Ask(CoracleCase c, const char *key)
{
  if (!CaseAsked(c, key)) {
    Remember(c, key);
    CaseTreeMark(c->root, key);
  }
  return CaseTreeFind(c->root, key);
}

bool CaseIsExcused(CoracleCase c, const char *key)
{
  return c->faults && (Ask(c, key), CaseExcused(c, key));
}

CaseNode *CaseRequire(CoracleCase c, const char *key)
{
  CaseNode *node = Ask(c, key);
  if (node) return node;
  const CaseNode *parent = CaseTreeNearest(c->root, key);
  const char *dot = strrchr(key, '.'), *name = dot ? dot + 1 : key;
  for (int i = 0; i < parent->n; i++) {
    const CaseNode *child = parent->child[i];
    if (child->key && CaseSimilar(name, child->key))
      CaseDie(c, child, key, "key '%s' is missing (is it '%s' here?)", key, child->key);
  }
  CaseDie(c, parent == c->root ? NULL : parent, key, "key '%s' is missing", key);
}

/* Of a fault that a check has found before: any scalar, which no reader takes for what it is not. */
static CaseNode *NeutralScalar(void)
{
  static char text[] = "?";
  static CaseNode neutral = {.kind = NODE_SCALAR, .text = text, .quoted = true};
  return &neutral;
}

CaseNode *CaseRequireScalar(CoracleCase c, const char *key, const char *expected)
{
  if (CaseIsExcused(c, key)) return NeutralScalar();
  CaseNode *node = CaseRequire(c, key);
  if (node->kind != NODE_SCALAR || (!node->text[0] && !node->quoted)) CaseUnexpected(c, key, node, expected);
  node->read = true;
  return node;
}

void CoracleCaseRenamed(CoracleCase c, const char *old, const char *new_name)
{
  CaseUse(c, "CoracleCaseRenamed", old);
  CaseUse(c, "CoracleCaseRenamed", new_name);
  const CaseNode *node = CaseTreeFind(c->root, old);
  if (node && !CaseExcused(c, old)) CaseDie(c, node, old, "key '%s' is now called '%s'", old, new_name);
}

void CoracleCaseNotBeside(CoracleCase c, const char *map, const char *name, const char *const others[])
{
  char key[CASE_KEY];
  CaseUse(c, "CoracleCaseNotBeside", map);
  CaseUse(c, "CoracleCaseNotBeside", name);
  if (!CaseTreeFind(c->root, CaseKey(key, "%s.%s", map, name))) return;
  for (int i = 0; others[i]; i++) {
    const CaseNode *node = CaseTreeFind(c->root, CaseKey(key, "%s.%s", map, others[i]));
    if (node && !CaseExcused(c, key))
      CaseDie(c, node, key, "key '%s': expected %s or %s, not both", key, name, others[i]);
  }
}

bool CoracleCaseHas(CoracleCase c, const char *key)
{
  CaseUse(c, "CoracleCaseHas", key);
  return Ask(c, key) != NULL;
}

int CoracleCaseCount(CoracleCase c, const char *key)
{
  CaseUse(c, "CoracleCaseCount", key);
  CaseNode *node = Ask(c, key);
  CaseNote(c, key, false, "list", "", "");
  if (!node || CaseIsExcused(c, key)) return 0;
  if (node->kind != NODE_LIST) CaseUnexpected(c, key, node, "a list");
  return node->n;
}

int CoracleCaseKeys(CoracleCase c, const char *key, void (*f)(void *context, const char *name), void *context)
{
  CaseUse(c, "CoracleCaseKeys", key);
  if (!f) CaseMisuse(c, "CoracleCaseKeys: there must be a function for the keys of '%s'", key);
  CaseNode *node = Ask(c, key);
  CaseNoteMap(c, key);
  if (!node || CaseIsExcused(c, key)) return 0;
  if (node->kind != NODE_MAP) CaseUnexpected(c, key, node, "a map (key: ...)");
  for (int i = 0; i < node->n; i++) f(context, node->child[i]->key);
  return 0;
}
