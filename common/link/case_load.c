/* Opening a case: from the arguments of a program to the tree of its case file. */
#include "common/link/case_impl.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

unsigned long long CaseFnv1a(unsigned long long hash, const char *bytes, size_t n)
{
  for (size_t i = 0; i < n; i++) hash = (hash ^ (unsigned char)bytes[i]) * 1099511628211ULL;
  return hash;
}

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
  c->set_hash = CASE_FNV_START;
  for (int i = 1; i < argc; i++) {
    if (strcmp(argv[i], "--set")) continue;
    const char *set = argv[++i];
    c->set_hash = CaseFnv1a(c->set_hash, set, strlen(set) + 1);
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
  c->file_hash = CaseFnv1a(CASE_FNV_START, text, size);
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
  if (!fail || !c)
    CaseMisuse(NULL,
               "CoracleCaseOpen: there must be a function that ends the program, and room for the case");
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
  CaseNotesFree(*c);
  free((*c)->path);
  free((*c)->folder);
  free(*c);
  *c = NULL;
  return 0;
}

const char *CoracleCasePath(CoracleCase c)
{
  if (!c) CaseMisuse(NULL, "CoracleCasePath: the case is not open");
  return c->path;
}
unsigned long long CoracleCaseHash(CoracleCase c)
{
  if (!c) CaseMisuse(NULL, "CoracleCaseHash: the case is not open");
  return CaseFnv1a(c->file_hash, (const char *)&c->set_hash, sizeof c->set_hash);
}
