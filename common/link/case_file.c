#include "common/link/case_impl.h"
#include <errno.h>
#include <math.h>
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
  if (c->faults) CaseFault(c->faults, key, message);
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

static _Noreturn void Unexpected(CoracleCase c, const char *key, const CaseNode *node, const char *expected)
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

/* Whether a check has found this key's fault before: it has been asked for all the same. */
static bool Excused(CoracleCase c, const char *key)
{
  return c->faults && (Ask(c, key), CaseExcused(c, key));
}

/* The value at a key that must be there. */
static CaseNode *Require(CoracleCase c, const char *key)
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

static CaseNode *RequireScalar(CoracleCase c, const char *key, const char *expected)
{
  if (Excused(c, key)) return NeutralScalar();
  CaseNode *node = Require(c, key);
  if (node->kind != NODE_SCALAR || (!node->text[0] && !node->quoted)) Unexpected(c, key, node, expected);
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
  if (!node || Excused(c, key)) return 0;
  if (node->kind != NODE_LIST) Unexpected(c, key, node, "a list");
  return node->n;
}

int CoracleCaseKeys(CoracleCase c, const char *key, void (*f)(void *context, const char *name), void *context)
{
  CaseUse(c, "CoracleCaseKeys", key);
  if (!f) CaseMisuse(c, "CoracleCaseKeys: there must be a function for the keys of '%s'", key);
  CaseNode *node = Ask(c, key);
  CaseNoteMap(c, key);
  if (!node || Excused(c, key)) return 0;
  if (node->kind != NODE_MAP) Unexpected(c, key, node, "a map (key: ...)");
  for (int i = 0; i < node->n; i++) f(context, node->child[i]->key);
  return 0;
}

/* --- numbers -------------------------------------------------------------------------------------------- */

static bool ToNumber(const CaseNode *node, double *value)
{
  char *end;
  if (node->kind != NODE_SCALAR || node->quoted || !node->text[0]) return false;
  if (strspn(node->text, "+-.0123456789eE") != strlen(node->text)) return false; /* no hex, no nan, no inf */
  *value = strtod(node->text, &end);
  return *end == '\0' && isfinite(*value);
}

static const char *Range(const char *what, double lower, double upper, bool open, char text[CASE_NAME])
{
  if (lower > -HUGE_VAL && upper < HUGE_VAL)
    snprintf(text, CASE_NAME, "%s from %.10g to %.10g", what, lower, upper);
  else if (lower > -HUGE_VAL)
    snprintf(text, CASE_NAME, "%s %s %.10g", what, open ? ">" : ">=", lower);
  else if (upper < HUGE_VAL)
    snprintf(text, CASE_NAME, "%s <= %.10g", what, upper);
  else
    snprintf(text, CASE_NAME, "%s", what);
  return text;
}

/* What a number is when its fault has been told: within the range. */
static double Neutral(double lower, double upper, bool open)
{
  if (lower == -HUGE_VAL) return fmin(0.0, upper);
  return open ? fmin(lower + 1.0, upper) : lower;
}

static double NumberAt(CoracleCase c, const char *key, double lower, double upper, bool open)
{
  if (!(lower <= upper))
    CaseMisuse(c, "CoracleCaseNumber: key '%s': no number is from %g to %g", key, lower, upper);
  char expected[CASE_NAME];
  double value = 0.0;
  Range("a number", lower, upper, open, expected);
  CaseNote(c, key, !CaseAsked(c, key), "number", expected + strlen("a number"), "");
  if (Excused(c, key)) return Neutral(lower, upper, open);
  CaseNode *node = RequireScalar(c, key, expected);
  if (!ToNumber(node, &value) || value < lower || value > upper || (open && value == lower))
    Unexpected(c, key, node, expected);
  return value;
}

double CoracleCaseNumber(CoracleCase c, const char *key, double lower, double upper)
{
  CaseUse(c, "CoracleCaseNumber", key);
  return NumberAt(c, key, lower, upper, false);
}
double CoracleCasePositive(CoracleCase c, const char *key)
{
  CaseUse(c, "CoracleCasePositive", key);
  return NumberAt(c, key, 0.0, HUGE_VAL, true);
}

double CoracleCaseNumberOr(CoracleCase c, const char *key, double fallback, double lower, double upper)
{
  CaseUse(c, "CoracleCaseNumberOr", key);
  if (!(lower <= fallback && fallback <= upper))
    CaseMisuse(c, "CoracleCaseNumberOr: key '%s': the default %g is not from %g to %g", key, fallback, lower,
               upper);
  char range[CASE_NAME], given[CASE_NAME];
  snprintf(given, sizeof given, "%.10g", fallback);
  CaseNote(c, key, false, "number", Range("", lower, upper, false, range), given);
  return CoracleCaseHas(c, key) ? NumberAt(c, key, lower, upper, false) : fallback;
}

int CoracleCaseIntegerOr(CoracleCase c, const char *key, int fallback, int lower, int upper)
{
  char expected[CASE_NAME], given[CASE_NAME], *end;
  CaseUse(c, "CoracleCaseIntegerOr", key);
  if (fallback < lower || fallback > upper)
    CaseMisuse(c, "CoracleCaseIntegerOr: key '%s': the default %d is not from %d to %d", key, fallback, lower,
               upper);
  Range("an integer", lower, upper, false, expected);
  snprintf(given, sizeof given, "%d", fallback);
  CaseNote(c, key, false, "integer", expected + strlen("an integer"), given);
  if (!CoracleCaseHas(c, key) || Excused(c, key)) return fallback;
  CaseNode *node = RequireScalar(c, key, expected);
  errno = 0;
  const long value = strtol(node->text, &end, 10);
  if (node->quoted || *end || errno || value < lower || value > upper) Unexpected(c, key, node, expected);
  return (int)value;
}

void CoracleCaseVector(CoracleCase c, const char *key, int n, double v[])
{
  char expected[CASE_NAME];
  CaseUse(c, "CoracleCaseVector", key);
  if (n < 1 || !v) CaseMisuse(c, "CoracleCaseVector: key '%s': there must be room for 1 number or more", key);
  snprintf(expected, sizeof expected, "a list of %d numbers", n);
  CaseNote(c, key, !CaseAsked(c, key), expected + strlen("a "), "", "");
  for (int i = 0; i < n; i++) v[i] = 0.0;
  if (Excused(c, key)) return;
  CaseNode *node = Require(c, key);
  if (node->kind != NODE_LIST || node->n != n) Unexpected(c, key, node, expected);
  for (int i = 0; i < n; i++) {
    if (!ToNumber(node->child[i], &v[i])) Unexpected(c, key, node->child[i], expected);
    node->child[i]->read = true;
  }
  node->read = true;
}

bool CoracleCaseVectorOptional(CoracleCase c, const char *key, int n, double v[])
{
  if (!CoracleCaseHas(c, key)) return false;
  CoracleCaseVector(c, key, n, v);
  return true;
}

/* --- words ---------------------------------------------------------------------------------------------- */

bool CoracleCaseBoolOr(CoracleCase c, const char *key, bool fallback)
{
  CaseUse(c, "CoracleCaseBoolOr", key);
  CaseNote(c, key, false, "true or false", "", fallback ? "true" : "false");
  if (!CoracleCaseHas(c, key) || Excused(c, key)) return fallback;
  CaseNode *node = RequireScalar(c, key, "true or false");
  const bool yes = !strcmp(node->text, "true");
  if (node->quoted || (!yes && strcmp(node->text, "false"))) Unexpected(c, key, node, "true or false");
  return yes;
}

/* YAML's null is no word: a folder of that name has to be quoted. */
static bool IsNull(const CaseNode *node)
{
  static const char *const NULLS[] = {"null", "Null", "NULL", "~", NULL};
  if (node->quoted) return false;
  for (int k = 0; NULLS[k]; k++)
    if (!strcmp(node->text, NULLS[k])) return true;
  return false;
}

static const char *StringAt(CoracleCase c, const char *key, const char *type)
{
  char expected[CASE_NAME];
  CaseNote(c, key, !CaseAsked(c, key), type, "", "");
  snprintf(expected, sizeof expected, "a %s", type);
  CaseNode *node = RequireScalar(c, key, expected);
  if (IsNull(node)) Unexpected(c, key, node, expected);
  return node->text;
}

const char *CoracleCaseString(CoracleCase c, const char *key)
{
  CaseUse(c, "CoracleCaseString", key);
  return StringAt(c, key, "string");
}

const char *CoracleCaseStringOr(CoracleCase c, const char *key, const char *fallback)
{
  CaseUse(c, "CoracleCaseStringOr", key);
  if (!fallback) CaseMisuse(c, "CoracleCaseStringOr: key '%s': the default is NULL", key);
  CaseNote(c, key, false, "string", "", fallback);
  return CoracleCaseHas(c, key) ? CoracleCaseString(c, key) : fallback;
}

const char *CoracleCaseFile(CoracleCase c, const char *key)
{
  CaseUse(c, "CoracleCaseFile", key);
  const char *name = StringAt(c, key, "file name"), *folder = name[0] == '/' ? "" : c->folder;
  char *path = malloc(strlen(folder) + strlen(name) + 1);
  strcpy(path, folder);
  strcat(path, name);
  CasePush(&c->kept, &c->nkept, &c->kept_capacity, path);
  return path;
}

int CoracleCaseWord(CoracleCase c, const char *key, int fallback, const char *const words[])
{
  char expected[CASE_KEY] = "one of";
  int n = 0;
  CaseUse(c, "CoracleCaseWord", key);
  while (words && words[n]) n++;
  if (n == 0) CaseMisuse(c, "CoracleCaseWord: key '%s': there must be words", key);
  if (fallback >= n)
    CaseMisuse(c, "CoracleCaseWord: key '%s': the default is word %d of %d", key, fallback, n);
  for (int i = 0; words[i]; i++) {
    const size_t used = strlen(expected);
    snprintf(expected + used, sizeof expected - used, "%s %s", i ? "," : "", words[i]);
  }
  const bool required = fallback < 0 && !CaseAsked(c, key);
  CaseNote(c, key, required, "word", expected + strlen("one of"), fallback < 0 ? "" : words[fallback]);
  if (fallback >= 0 && !CoracleCaseHas(c, key)) return fallback;
  if (Excused(c, key)) return fallback < 0 ? 0 : fallback;
  CaseNode *node = RequireScalar(c, key, expected);
  for (int i = 0; words[i]; i++)
    if (!strcmp(node->text, words[i])) return i;
  Unexpected(c, key, node, expected);
}
