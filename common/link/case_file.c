/* The values of a case file: numbers and words, with their ranges. */
#include "common/link/case_impl.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
  if (CaseIsExcused(c, key)) return Neutral(lower, upper, open);
  CaseNode *node = CaseRequireScalar(c, key, expected);
  if (!ToNumber(node, &value) || value < lower || value > upper || (open && value == lower))
    CaseUnexpected(c, key, node, expected);
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
  if (!CoracleCaseHas(c, key) || CaseIsExcused(c, key)) return fallback;
  CaseNode *node = CaseRequireScalar(c, key, expected);
  errno = 0;
  const long value = strtol(node->text, &end, 10);
  if (node->quoted || *end || errno || value < lower || value > upper) CaseUnexpected(c, key, node, expected);
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
  if (CaseIsExcused(c, key)) return;
  CaseNode *node = CaseRequire(c, key);
  if (node->kind != NODE_LIST || node->n != n) CaseUnexpected(c, key, node, expected);
  for (int i = 0; i < n; i++) {
    if (!ToNumber(node->child[i], &v[i])) CaseUnexpected(c, key, node->child[i], expected);
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

const double *CoracleCaseTable(CoracleCase c, const char *key, int n, int *nrows)
{
  char row[CASE_KEY];
  CaseUse(c, "CoracleCaseTable", key);
  if (n < 1 || !nrows)
    CaseMisuse(c, "CoracleCaseTable: key '%s': rows have 1 number or more, and their number needs a place",
               key);
  *nrows = CoracleCaseHas(c, key) ? CoracleCaseCount(c, key) : 0;
  if (!*nrows) return NULL;
  double *table = calloc((size_t)*nrows * (size_t)n, sizeof *table);
  CasePush(&c->kept, &c->nkept, &c->kept_capacity, (char *)table);
  for (int k = 0; k < *nrows; k++) {
    double *v = table + (size_t)k * (size_t)n;
    snprintf(row, sizeof row, "%s[%d]", key, k);
    CoracleCaseVector(c, row, n, v);
    if (k > 0 && !(v[0] > v[-n])) CoracleCaseRefuse(c, row, "the first numbers of the rows must rise");
  }
  return table;
}

/* --- words ---------------------------------------------------------------------------------------------- */

bool CoracleCaseBoolOr(CoracleCase c, const char *key, bool fallback)
{
  CaseUse(c, "CoracleCaseBoolOr", key);
  CaseNote(c, key, false, "true or false", "", fallback ? "true" : "false");
  if (!CoracleCaseHas(c, key) || CaseIsExcused(c, key)) return fallback;
  CaseNode *node = CaseRequireScalar(c, key, "true or false");
  const bool yes = !strcmp(node->text, "true");
  if (node->quoted || (!yes && strcmp(node->text, "false"))) CaseUnexpected(c, key, node, "true or false");
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
  CaseNode *node = CaseRequireScalar(c, key, expected);
  if (IsNull(node)) CaseUnexpected(c, key, node, expected);
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
  CaseNode *node = CaseTreeFind(c->root, key);
  if (node) node->file = true; /* none: of a fault that a check has found before */
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
  if (CaseIsExcused(c, key)) return fallback < 0 ? 0 : fallback;
  CaseNode *node = CaseRequireScalar(c, key, expected);
  for (int i = 0; words[i]; i++)
    if (!strcmp(node->text, words[i])) return i;
  CaseUnexpected(c, key, node, expected);
}
