#include "common/link/case_impl.h"
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const SECTIONS[] = {"case",  "note",    "gravity", "time",   "fluid",
                                       "solid", "coupler", "output",  "resume", NULL};

/* --- opening -------------------------------------------------------------------------------------------- */

static unsigned long long Fnv1a(unsigned long long hash, const char *bytes, size_t n)
{
  for (size_t i = 0; i < n; i++) hash = (hash ^ (unsigned char)bytes[i]) * 1099511628211ULL;
  return hash;
}

static const unsigned long long FNV_START = 14695981039346656037ULL;

static char *ReadFile(const char *path, size_t *size, char problem[])
{
  FILE *file = fopen(path, "rb");
  char *text = NULL;
  size_t n = 0, capacity = 0, got = 1;
  if (!file) {
    snprintf(problem, CASE_MESSAGE, "case file '%s': %s", path, strerror(errno));
    return NULL;
  }
  while (got > 0) {
    if (capacity - n < 4096) text = realloc(text, capacity = 2 * capacity + 8192);
    got = fread(text + n, 1, capacity - n, file);
    n += got;
  }
  if (ferror(file)) {
    snprintf(problem, CASE_MESSAGE, "case file '%s': %s", path, strerror(errno));
    free(text);
    text = NULL;
  }
  fclose(file);
  *size = n;
  return text;
}

/* The one argument that is no --set is the case file. */
static bool FindPath(int argc, char **argv, const char **path, char problem[])
{
  *path = NULL;
  for (int i = 1; i < argc; i++) {
    if (!strcmp(argv[i], "--set")) {
      if (++i == argc) {
        snprintf(problem, CASE_MESSAGE, "--set needs key=value behind it");
        return false;
      }
    } else if (argv[i][0] == '-' || *path) {
      snprintf(problem, CASE_MESSAGE, "unknown argument '%s': expected case.yaml [--set key=value]...",
               argv[i]);
      return false;
    } else {
      *path = argv[i];
    }
  }
  if (!*path) snprintf(problem, CASE_MESSAGE, "no case file: expected case.yaml [--set key=value]...");
  return *path != NULL;
}

static bool ApplySets(CoracleCase c, int argc, char **argv, char problem[])
{
  c->set_hash = FNV_START;
  for (int i = 1; i < argc; i++) {
    if (strcmp(argv[i], "--set")) continue;
    const char *set = argv[++i];
    c->set_hash = Fnv1a(c->set_hash, set, strlen(set) + 1);
    if (!CaseTreeSet(c->root, set, problem)) return false;
  }
  return true;
}

static bool ReadTree(CoracleCase c, int argc, char **argv, char problem[])
{
  const char *path;
  size_t size;
  if (!FindPath(argc, argv, &path, problem)) return false;
  c->path = strdup(path);
  const char *slash = strrchr(path, '/');
  c->folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup("");
  char *text = ReadFile(path, &size, problem);
  if (!text) return false;
  c->file_hash = Fnv1a(FNV_START, text, size);
  c->root = CaseTreeParse(text, size, path, problem);
  free(text);
  if (!c->root) return false;
  if (c->root->kind != NODE_MAP) {
    snprintf(problem, CASE_MESSAGE, "%s:1: expected sections (key: ...) at the top level", path);
    return false;
  }
  return ApplySets(c, argc, argv, problem);
}

int CaseLoad(int argc, char **argv, char problem[], CoracleCase *c)
{
  *c = calloc(1, sizeof **c);
  if (ReadTree(*c, argc, argv, problem)) return 0;
  CoracleCaseClose(c);
  return 1;
}

int CoracleCaseOpen(int argc, char **argv, void (*fail)(void *context, const char *message), void *context,
                    CoracleCase *c)
{
  char problem[CASE_MESSAGE];
  if (CaseLoad(argc, argv, problem, c)) {
    fail(context, problem);
    return 1;
  }
  (*c)->fail = fail;
  (*c)->context = context;
  return 0;
}

int CoracleCaseClose(CoracleCase *c)
{
  if (!*c) return 0;
  CaseTreeDestroy(&(*c)->root);
  for (int i = 0; i < (*c)->nasked; i++) free((*c)->asked[i]);
  for (int i = 0; i < (*c)->nkept; i++) free((*c)->kept[i]);
  free((*c)->asked);
  free((*c)->slot);
  free((*c)->kept);
  free((*c)->path);
  free((*c)->folder);
  free(*c);
  *c = NULL;
  return 0;
}

const char *CoracleCasePath(CoracleCase c)
{
  return c->path;
}
unsigned long long CoracleCaseHash(CoracleCase c)
{
  return Fnv1a(c->file_hash, (const char *)&c->set_hash, sizeof c->set_hash);
}

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

static _Noreturn void Die(CoracleCase c, const CaseNode *node, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static _Noreturn void Die(CoracleCase c, const CaseNode *node, const char *format, ...)
{
  char place[CASE_KEY], text[CASE_MESSAGE], message[CASE_KEY + CASE_MESSAGE + 2];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  Place(c, node, place);
  snprintf(message, sizeof message, "%s: %s", place, text);
  c->fail(c->context, message);
  abort(); /* fail must not return */
}

void CoracleCaseRefuse(CoracleCase c, const char *key, const char *format, ...)
{
  char text[CASE_MESSAGE - CASE_KEY];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  Die(c, CaseTreeNearest(c->root, key), "key '%s': %s", key, text);
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
  Die(c, node, "key '%s': expected %s, found %s", key, expected, Found(node, found));
}

/* --- finding -------------------------------------------------------------------------------------------- */

static void Push(char ***list, int *n, int *capacity, char *string)
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
  unsigned long long k = Fnv1a(FNV_START, key, strlen(key)) % (unsigned long long)c->nslots;
  while (c->slot[k] >= 0 && strcmp(c->asked[c->slot[k]], key)) k = (k + 1) % (unsigned long long)c->nslots;
  return &c->slot[k];
}

static bool Asked(CoracleCase c, const char *key)
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
  Push(&c->asked, &c->nasked, &c->asked_capacity, strdup(key));
}

static CaseNode *Ask(CoracleCase c, const char *key)
{
  if (!Asked(c, key)) {
    Remember(c, key);
    CaseTreeMark(c->root, key);
  }
  return CaseTreeFind(c->root, key);
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
      Die(c, child, "key '%s' is missing (is it '%s' here?)", key, child->key);
  }
  Die(c, parent == c->root ? NULL : parent, "key '%s' is missing", key);
}

static CaseNode *RequireScalar(CoracleCase c, const char *key, const char *expected)
{
  CaseNode *node = Require(c, key);
  if (node->kind != NODE_SCALAR || (!node->text[0] && !node->quoted)) Unexpected(c, key, node, expected);
  node->read = true;
  return node;
}

bool CoracleCaseHas(CoracleCase c, const char *key)
{
  return Ask(c, key) != NULL;
}

int CoracleCaseCount(CoracleCase c, const char *key)
{
  CaseNode *node = Ask(c, key);
  if (!node) return 0;
  if (node->kind != NODE_LIST) Unexpected(c, key, node, "a list");
  return node->n;
}

int CoracleCaseKeys(CoracleCase c, const char *key, void (*f)(void *context, const char *name), void *context)
{
  CaseNode *node = Ask(c, key);
  if (!node) return 0;
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

static double NumberAt(CoracleCase c, const char *key, double lower, double upper, bool open)
{
  char expected[CASE_NAME];
  double value = 0.0;
  CaseNode *node = RequireScalar(c, key, Range("a number", lower, upper, open, expected));
  if (!ToNumber(node, &value) || value < lower || value > upper || (open && value == lower))
    Unexpected(c, key, node, expected);
  return value;
}

double CoracleCaseNumber(CoracleCase c, const char *key, double lower, double upper)
{
  return NumberAt(c, key, lower, upper, false);
}
double CoracleCasePositive(CoracleCase c, const char *key)
{
  return NumberAt(c, key, 0.0, HUGE_VAL, true);
}

double CoracleCaseNumberOr(CoracleCase c, const char *key, double fallback, double lower, double upper)
{
  return CoracleCaseHas(c, key) ? NumberAt(c, key, lower, upper, false) : fallback;
}

int CoracleCaseIntegerOr(CoracleCase c, const char *key, int fallback, int lower, int upper)
{
  char expected[CASE_NAME], *end;
  if (!CoracleCaseHas(c, key)) return fallback;
  Range("an integer", lower, upper, false, expected);
  CaseNode *node = RequireScalar(c, key, expected);
  errno = 0;
  const long value = strtol(node->text, &end, 10);
  if (node->quoted || *end || errno || value < lower || value > upper) Unexpected(c, key, node, expected);
  return (int)value;
}

void CoracleCaseVector(CoracleCase c, const char *key, int n, double v[])
{
  char expected[CASE_NAME];
  CaseNode *node = Require(c, key);
  snprintf(expected, sizeof expected, "a list of %d numbers", n);
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
  if (!CoracleCaseHas(c, key)) return fallback;
  CaseNode *node = RequireScalar(c, key, "true or false");
  const bool yes = !strcmp(node->text, "true");
  if (node->quoted || (!yes && strcmp(node->text, "false"))) Unexpected(c, key, node, "true or false");
  return yes;
}

const char *CoracleCaseString(CoracleCase c, const char *key)
{
  return RequireScalar(c, key, "a string")->text;
}

const char *CoracleCaseStringOr(CoracleCase c, const char *key, const char *fallback)
{
  return CoracleCaseHas(c, key) ? CoracleCaseString(c, key) : fallback;
}

const char *CoracleCaseFile(CoracleCase c, const char *key)
{
  const char *name = CoracleCaseString(c, key), *folder = name[0] == '/' ? "" : c->folder;
  char *path = malloc(strlen(folder) + strlen(name) + 1);
  strcpy(path, folder);
  strcat(path, name);
  Push(&c->kept, &c->nkept, &c->kept_capacity, path);
  return path;
}

int CoracleCaseWord(CoracleCase c, const char *key, int fallback, const char *const words[])
{
  char expected[CASE_KEY] = "one of";
  if (fallback >= 0 && !CoracleCaseHas(c, key)) return fallback;
  for (int i = 0; words[i]; i++) {
    const size_t used = strlen(expected);
    snprintf(expected + used, sizeof expected - used, "%s %s", i ? "," : "", words[i]);
  }
  CaseNode *node = RequireScalar(c, key, expected);
  for (int i = 0; words[i]; i++)
    if (!strcmp(node->text, words[i])) return i;
  Unexpected(c, key, node, expected);
}

/* --- what nobody has read ------------------------------------------------------------------------------- */

/* A key that was asked for, did not exist, and lies beside this one under a similar name. */
static const char *Suggestion(CoracleCase c, const char *key)
{
  const char *dot = strrchr(key, '.');
  const size_t stem = dot ? (size_t)(dot - key) + 1 : 0;
  for (int i = 0; i < c->nasked; i++) {
    const char *asked = c->asked[i];
    if (strncmp(asked, key, stem) || strpbrk(asked + stem, ".[") || CaseTreeFind(c->root, asked)) continue;
    if (CaseSimilar(asked + stem, key + stem)) return asked + stem;
  }
  return NULL;
}

/* Nothing under an unknown map was ever asked for: the map itself is the unknown key, not its first value. */
static void CheckRead(CoracleCase c, const CaseNode *node, const char *key)
{
  const bool leaf = node->kind == NODE_SCALAR || (node->n == 0 && !node->read);
  const bool asked = Asked(c, key);
  if (node->read || (leaf && node->kind != NODE_SCALAR && asked)) return;
  if (leaf || (!asked && !node->below)) {
    const char *better = Suggestion(c, key);
    if (better) Die(c, node, "unknown key '%s' (did you mean '%s'?)", key, better);
    Die(c, node, "unknown key '%s'", key);
  }
  for (int i = 0; i < node->n; i++) {
    char below[CASE_KEY + 16];
    if (node->kind == NODE_MAP)
      snprintf(below, sizeof below, "%s.%s", key, node->child[i]->key);
    else
      snprintf(below, sizeof below, "%s[%d]", key, i);
    CheckRead(c, node->child[i], below);
  }
}

static void CheckSection(CoracleCase c, const CaseNode *section)
{
  for (int i = 0; SECTIONS[i]; i++)
    if (!strcmp(SECTIONS[i], section->key)) return;
  for (int i = 0; SECTIONS[i]; i++)
    if (CaseSimilar(SECTIONS[i], section->key))
      Die(c, section, "unknown section '%s' (did you mean '%s'?)", section->key, SECTIONS[i]);
  Die(c, section, "unknown section '%s'", section->key);
}

int CoracleCaseFinish(CoracleCase c, const char *const sections[])
{
  for (int i = 0; i < c->root->n; i++) CheckSection(c, c->root->child[i]);
  for (int i = 0; sections[i]; i++) {
    const CaseNode *node = CaseTreeChild(c->root, sections[i]);
    const bool empty = node && node->n == 0 && (node->kind != NODE_SCALAR || !node->text[0]);
    if (node && !empty) CheckRead(c, node, sections[i]);
  }
  return 0;
}
