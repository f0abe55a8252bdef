/* The tree behind a case file: its nodes, and how they come from libyaml's document. */
#include "common/link/case_impl.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

enum { MAX_DEPTH = 32 }; /* an alias that contains itself would never end */

void CaseTreeDestroy(CaseNode **node)
{
  if (!*node) return;
  for (int i = 0; i < (*node)->n; i++) CaseTreeDestroy(&(*node)->child[i]);
  free((*node)->child);
  free((*node)->slot);
  free((*node)->key);
  free((*node)->text);
  free(*node);
  *node = NULL;
}

/* --- names within a map: large maps are hashed ----------------------------------------------------------- */

enum { FEW = 8 };

/* Where a name is, or would be, among the children of a map with slots. */
static int *SlotOf(const CaseNode *map, const char *name)
{
  const unsigned long long n = (unsigned long long)map->nslots;
  unsigned long long k = CaseFnv1a(CASE_FNV_START, name, strlen(name)) % n;
  while (map->slot[k] >= 0 && strcmp(map->child[map->slot[k]]->key, name)) k = (k + 1) % n;
  return &map->slot[k];
}

static void HashNames(CaseNode *map)
{
  map->nslots = 4 * map->n;
  map->slot = realloc(map->slot, (size_t)map->nslots * sizeof *map->slot);
  for (int k = 0; k < map->nslots; k++) map->slot[k] = -1;
  for (int i = 0; i < map->n; i++) *SlotOf(map, map->child[i]->key) = i;
}

void CaseTreeAppend(CaseNode *parent, CaseNode *child)
{
  if (parent->n == parent->capacity) {
    parent->capacity = parent->capacity ? 2 * parent->capacity : 4;
    parent->child = realloc(parent->child, (size_t)parent->capacity * sizeof *parent->child);
  }
  parent->child[parent->n++] = child;
  if (parent->kind != NODE_MAP || parent->n <= FEW) return;
  if (2 * parent->n > parent->nslots)
    HashNames(parent);
  else
    *SlotOf(parent, child->key) = parent->n - 1;
}

void CaseTreeDrop(CaseNode *parent, CaseNode *child)
{
  for (int i = 0; i < parent->n; i++) {
    if (parent->child[i] != child) continue;
    memmove(&parent->child[i], &parent->child[i + 1], (size_t)(parent->n - 1 - i) * sizeof *parent->child);
    parent->n--;
    CaseTreeDestroy(&child);
    if (parent->nslots) HashNames(parent);
    return;
  }
}

CaseNode *CaseTreeChild(const CaseNode *map, const char *name)
{
  if (map->kind != NODE_MAP) return NULL;
  if (map->nslots) {
    const int found = *SlotOf(map, name);
    return found < 0 ? NULL : map->child[found];
  }
  for (int i = 0; i < map->n; i++)
    if (!strcmp(map->child[i]->key, name)) return map->child[i];
  return NULL;
}

/* --- from a document of libyaml ------------------------------------------------------------------------- */

typedef struct {
  yaml_document_t *document;
  const char *label;
  char *problem;
  int nodes;
} Builder;

static CaseNode *BuildNode(Builder *b, int index, int depth);

static bool BuildMap(Builder *b, const yaml_node_t *y, int depth, CaseNode *node)
{
  for (const yaml_node_pair_t *pair = y->data.mapping.pairs.start; pair < y->data.mapping.pairs.top; pair++) {
    const yaml_node_t *key = yaml_document_get_node(b->document, pair->key);
    const int line = (int)key->start_mark.line + 1;
    if (key->type != YAML_SCALAR_NODE) {
      snprintf(b->problem, CASE_MESSAGE, "%s:%d: a key must be a word", b->label, line);
      return false;
    }
    const char *name = (const char *)key->data.scalar.value;
    if (!*name || strlen(name) >= CASE_NAME || strpbrk(name, ".[]")) {
      snprintf(b->problem, CASE_MESSAGE,
               "%s:%d: key '%.40s%s' cannot be told in a path: expected 1 to %d characters without '.', '[' "
               "and ']'",
               b->label, line, name, strlen(name) > 40 ? "..." : "", CASE_NAME - 1);
      return false;
    }
    const CaseNode *twin = CaseTreeChild(node, name);
    if (twin) {
      snprintf(b->problem, CASE_MESSAGE, "%s:%d: key '%s' is given twice (first in line %d)", b->label, line,
               name, twin->line);
      return false;
    }
    CaseNode *child = BuildNode(b, pair->value, depth + 1);
    if (!child) return false;
    child->key = strdup(name);
    child->line = line;
    CaseTreeAppend(node, child);
  }
  return true;
}

static bool BuildList(Builder *b, const yaml_node_t *y, int depth, CaseNode *node)
{
  for (const yaml_node_item_t *item = y->data.sequence.items.start; item < y->data.sequence.items.top;
       item++) {
    CaseNode *child = BuildNode(b, *item, depth + 1);
    if (!child) return false;
    CaseTreeAppend(node, child);
  }
  return true;
}

static CaseNode *BuildNode(Builder *b, int index, int depth)
{
  const yaml_node_t *y = yaml_document_get_node(b->document, index);
  const int line = (int)y->start_mark.line + 1;
  if (depth > MAX_DEPTH || ++b->nodes > CASE_NODES) {
    snprintf(b->problem, CASE_MESSAGE, "%s:%d: nested too deeply (an alias within itself?)", b->label, line);
    return NULL;
  }
  CaseNode *node = calloc(1, sizeof *node);
  bool good = true;
  node->line = line;
  if (y->type == YAML_SCALAR_NODE) {
    node->kind = NODE_SCALAR;
    node->text = strdup((const char *)y->data.scalar.value);
    node->quoted = y->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
  } else if (y->type == YAML_SEQUENCE_NODE) {
    node->kind = NODE_LIST;
    good = BuildList(b, y, depth, node);
  } else {
    node->kind = NODE_MAP;
    good = BuildMap(b, y, depth, node);
  }
  if (!good) CaseTreeDestroy(&node);
  return node;
}

static CaseNode *BuildDocument(yaml_parser_t *parser, Builder *b)
{
  yaml_document_t document, next;
  CaseNode *root = NULL;
  if (!yaml_parser_load(parser, &document)) return NULL;
  b->document = &document;
  if (yaml_document_get_root_node(&document))
    root = BuildNode(b, 1, 0);
  else
    snprintf(b->problem, CASE_MESSAGE, "%s: is empty", b->label);
  yaml_document_delete(&document);
  if (!root) return NULL;
  if (!yaml_parser_load(parser, &next)) {
    CaseTreeDestroy(&root);
    return NULL;
  }
  if (yaml_document_get_root_node(&next)) {
    snprintf(b->problem, CASE_MESSAGE, "%s: holds more than one YAML document", b->label);
    CaseTreeDestroy(&root);
  }
  yaml_document_delete(&next);
  return root;
}

/* Before libyaml makes a document, whose time grows with the square of the depth: the text's events alone. */
static bool CheckSize(const char *text, size_t size, const char *label, char problem[])
{
  yaml_parser_t parser;
  yaml_event_t event;
  int depth = 0, nodes = 0;
  if (!yaml_parser_initialize(&parser)) return true;
  yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
  for (bool more = true; more && depth <= MAX_DEPTH && nodes <= CASE_NODES;) {
    if (!yaml_parser_parse(&parser, &event)) break; /* the document will say why */
    const yaml_event_type_t type = event.type;
    depth += (type == YAML_SEQUENCE_START_EVENT || type == YAML_MAPPING_START_EVENT) -
             (type == YAML_SEQUENCE_END_EVENT || type == YAML_MAPPING_END_EVENT);
    nodes++;
    more = type != YAML_STREAM_END_EVENT;
    if (depth > MAX_DEPTH)
      snprintf(problem, CASE_MESSAGE, "%s:%d: nested more than %d deep", label,
               (int)event.start_mark.line + 1, MAX_DEPTH);
    yaml_event_delete(&event);
  }
  if (nodes > CASE_NODES) snprintf(problem, CASE_MESSAGE, "%s: has more than %d values", label, CASE_NODES);
  yaml_parser_delete(&parser);
  return depth <= MAX_DEPTH && nodes <= CASE_NODES;
}

CaseNode *CaseTreeParse(const char *text, size_t size, const char *label, char problem[])
{
  yaml_parser_t parser;
  Builder builder = {.label = label, .problem = problem};
  if (!yaml_parser_initialize(&parser)) {
    snprintf(problem, CASE_MESSAGE, "%s: libyaml did not start", label);
    return NULL;
  }
  problem[0] = '\0';
  if (!CheckSize(text, size, label, problem)) {
    yaml_parser_delete(&parser);
    return NULL;
  }
  yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
  CaseNode *root = BuildDocument(&parser, &builder);
  if (!root && !problem[0])
    snprintf(problem, CASE_MESSAGE, "%s:%d: not valid YAML: %s%s%s", label, (int)parser.problem_mark.line + 1,
             parser.problem ? parser.problem : "unreadable", parser.context ? " " : "",
             parser.context ? parser.context : "");
  yaml_parser_delete(&parser);
  return root;
}
