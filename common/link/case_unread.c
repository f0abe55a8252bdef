/* The keys of a case that no reader has asked for: they are errors. */
#include "common/link/case_impl.h"
#include <stdio.h>
#include <string.h>

static const char *const SECTIONS[] = {"case",  "note",    "gravity", "time",   "fluid",
                                       "solid", "coupler", "output",  "resume", NULL};

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
  const bool asked = CaseAsked(c, key);
  if (CaseExcused(c, key)) return;
  if (node->read || (leaf && node->kind != NODE_SCALAR && asked)) return;
  if (leaf || (!asked && !node->below)) {
    const char *better = Suggestion(c, key);
    if (better) CaseDie(c, node, key, "unknown key '%s' (did you mean '%s'?)", key, better);
    CaseDie(c, node, key, "unknown key '%s'", key);
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
  if (CaseExcused(c, section->key)) return;
  for (int i = 0; SECTIONS[i]; i++)
    if (!strcmp(SECTIONS[i], section->key)) return;
  for (int i = 0; SECTIONS[i]; i++)
    if (CaseSimilar(SECTIONS[i], section->key))
      CaseDie(c, section, section->key, "unknown section '%s' (did you mean '%s'?)", section->key,
              SECTIONS[i]);
  CaseDie(c, section, section->key, "unknown section '%s'", section->key);
}

int CoracleCaseFinish(CoracleCase c, const char *const sections[])
{
  if (!c || !sections)
    CaseMisuse(c, "CoracleCaseFinish: %s", c ? "there must be a list of sections" : "the case is not open");
  for (int i = 0; i < c->root->n; i++) CheckSection(c, c->root->child[i]);
  for (int i = 0; sections[i]; i++) {
    const CaseNode *node = CaseTreeChild(c->root, sections[i]);
    const bool empty = node && node->n == 0 && (node->kind != NODE_SCALAR || !node->text[0]);
    if (node && !empty) CheckRead(c, node, sections[i]);
  }
  return 0;
}
