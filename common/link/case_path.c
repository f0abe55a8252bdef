/* Dotted paths into the tree behind a case file, and the --set arguments that have them. */
#include "common/link/case_impl.h"
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum { STEP_END, STEP_NAME, STEP_ITEM, STEP_BAD } PathStep;

/* Takes one step off a path such as solid.bodies[0].centre. */
static PathStep PathNext(const char **path, char name[CASE_NAME], int *item)
{
  const char *p = *path;
  if (!*p) return STEP_END;
  if (*p == '[') {
    char *end;
    if (!isdigit((unsigned char)p[1])) return STEP_BAD;
    const long value = strtol(p + 1, &end, 10);
    if (*end != ']' || value > CASE_NODES) return STEP_BAD;
    *item = (int)value;
    *path = end + 1;
    if (**path == '.') ++*path;
    return STEP_ITEM;
  }
  const size_t length = strcspn(p, ".[]");
  if (length == 0 || length >= CASE_NAME) return STEP_BAD;
  memcpy(name, p, length);
  name[length] = '\0';
  *path = p + length;
  if (**path == '.' && *++*path == '\0') return STEP_BAD;
  return STEP_NAME;
}

bool CasePathIsValid(const char *path)
{
  char name[CASE_NAME];
  int item;
  PathStep step = *path ? STEP_NAME : STEP_BAD;
  while (step == STEP_NAME || step == STEP_ITEM) step = PathNext(&path, name, &item);
  return step == STEP_END;
}

/* One step down: STEP_END leaves the node. */
static PathStep Descend(const CaseNode **node, const char **key)
{
  char name[CASE_NAME];
  int item = 0;
  const PathStep step = PathNext(key, name, &item);
  if (step == STEP_NAME)
    *node = CaseTreeChild(*node, name);
  else if (step == STEP_ITEM && (*node)->kind == NODE_LIST && item < (*node)->n)
    *node = (*node)->child[item];
  else if (step != STEP_END)
    *node = NULL;
  return step;
}

static CaseNode *Walk(const CaseNode *root, const char *key, const CaseNode **nearest)
{
  const CaseNode *node = root;
  for (*nearest = root; node;) {
    *nearest = node;
    if (Descend(&node, &key) == STEP_END) break;
  }
  return (CaseNode *)node;
}

void CaseTreeMark(CaseNode *root, const char *key)
{
  const CaseNode *node = root;
  while (node) {
    CaseNode *above = (CaseNode *)node;
    if (Descend(&node, &key) == STEP_END) break;
    above->below = true;
  }
}

CaseNode *CaseTreeFind(CaseNode *root, const char *key)
{
  const CaseNode *nearest;
  return Walk(root, key, &nearest);
}

const CaseNode *CaseTreeNearest(const CaseNode *root, const char *key)
{
  const CaseNode *nearest;
  Walk(root, key, &nearest);
  return nearest;
}

void CaseTreeRemove(CaseNode *root, const char *key)
{
  char above[CASE_KEY];
  CaseNode *node = CaseTreeFind(root, key), *parent = root;
  if (!node || node->kind != NODE_SCALAR || !node->key) return;
  const char *dot = strrchr(key, '.');
  snprintf(above, sizeof above, "%.*s", dot ? (int)(dot - key) : 0, key);
  if (dot) parent = CaseTreeFind(root, above);
  if (!parent) return;
  CaseTreeDrop(parent, node);
  if (!parent->n) parent->read = true; /* not an unknown key for being empty */
}

/* --- one --set argument --------------------------------------------------------------------------------- */

static void MarkSet(CaseNode *node, const char *argument)
{
  node->set = argument;
  for (int i = 0; i < node->n; i++) MarkSet(node->child[i], argument);
}

/* The node that a step leads to, made when it is a new name or the item after the last. */
static CaseNode *Enter(CaseNode *node, PathStep step, const char *name, int item, const char **why)
{
  CaseNode *child = NULL;
  if (step == STEP_NAME && node->kind == NODE_MAP)
    child = CaseTreeChild(node, name);
  else if (step == STEP_ITEM && node->kind == NODE_LIST && item <= node->n)
    child = item < node->n ? node->child[item] : NULL;
  else {
    *why = step == STEP_BAD ? "the key is malformed (expected name.name[0].name)"
           : step == STEP_ITEM && node->kind != NODE_LIST
               ? "the key has an index on a value that is not a list"
           : step == STEP_ITEM       ? "the list is shorter than this index"
           : node->kind == NODE_LIST ? "the key goes through a list without an index (expected name[0].name)"
                                     : "the key goes through a value that is not a map";
    return NULL;
  }
  if (child) return child;
  child = calloc(1, sizeof *child);
  child->kind = NODE_MAP;
  if (step == STEP_NAME) child->key = strdup(name);
  CaseTreeAppend(node, child);
  return child;
}

static CaseNode *EnterPath(CaseNode *root, const char *key, const char **why)
{
  CaseNode *node = root;
  for (;;) {
    char name[CASE_NAME];
    int item = 0;
    const PathStep step = PathNext(&key, name, &item);
    if (step == STEP_END) return node;
    if (!(node = Enter(node, step, name, item, why))) return NULL;
  }
}

bool CaseTreeSet(CaseNode *root, const char *argument, char problem[])
{
  const char *equals = strchr(argument, '='), *why = NULL;
  char label[CASE_KEY], key[CASE_KEY];
  snprintf(label, sizeof label, "--set %s", argument);
  if (!equals || equals == argument || (size_t)(equals - argument) >= sizeof key) {
    snprintf(problem, CASE_MESSAGE, "%s: expected --set key=value", label);
    return false;
  }
  snprintf(key, sizeof key, "%.*s", (int)(equals - argument), argument);
  const char *text =
      equals[1 + strspn(equals + 1, " \t\n")] ? equals + 1 : "''"; /* as an empty value of a file */
  CaseNode *value = CaseTreeParse(text, strlen(text), label, problem);
  if (!value) {
    snprintf(problem, CASE_MESSAGE, "%s: the value is not valid YAML", label);
    return false;
  }
  MarkSet(value, argument);
  CaseNode *node = EnterPath(root, key, &why);
  if (!node) {
    snprintf(problem, CASE_MESSAGE, "%s: %s", label, why);
    CaseTreeDestroy(&value);
    return false;
  }
  /* the new value moves into the old node, which keeps its name and its place */
  CaseNode old = *node;
  *node = *value;
  node->key = old.key;
  old.key = NULL;
  *value = old;
  CaseTreeDestroy(&value);
  return true;
}
