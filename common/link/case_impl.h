/* Private to the case file: the tree that a YAML text becomes, and the dotted paths into it.  Nothing here
 * prints or ends a run: what goes wrong is written into a buffer and reported by the caller. */
#ifndef CORACLE_CASE_IMPL_H
#define CORACLE_CASE_IMPL_H
#include "common/link/case_file.h"
#include <stddef.h>

enum { CASE_NAME = 128, CASE_KEY = 512, CASE_MESSAGE = 1024 };

typedef enum { NODE_SCALAR, NODE_LIST, NODE_MAP } CaseKind;

typedef struct CaseNode_s {
  CaseKind kind;
  char *key;       /* name within the parent map, else NULL */
  char *text;      /* of a scalar */
  bool quoted;     /* '3' and "3" are strings, 3 is a number */
  bool read;       /* some reader has asked for this value */
  bool below;      /* or for a key below it */
  int line;        /* in the file, from 1 */
  const char *set; /* borrowed: the --set argument that the value comes from, or NULL */
  int n, capacity;
  struct CaseNode_s **child; /* [n] in file order */
} CaseNode;

struct CoracleCase_s {
  char *path, *folder;
  CaseNode *root;
  unsigned long long file_hash, set_hash;
  int nasked, asked_capacity;
  char **asked; /* [nasked] every key that was asked for: what a misspelt key is compared with */
  int nslots;
  int *slot; /* [nslots] hashed places in asked, -1: empty */
  int nkept, kept_capacity;
  char **kept; /* [nkept] strings handed out by CoracleCaseFile */
  void (*fail)(void *context, const char *message);
  void *context;
};

/* The tree of a YAML text; NULL when it is not valid, with problem[CASE_MESSAGE] = "label:line: why". */
CaseNode *CaseTreeParse(const char *text, size_t size, const char *label, char problem[]);
void CaseTreeDestroy(CaseNode **node);
/* The child of a map, or NULL. */
CaseNode *CaseTreeChild(const CaseNode *map, const char *name);
/* The node at a dotted path, or NULL. */
CaseNode *CaseTreeFind(CaseNode *root, const char *key);
/* Says to all nodes above the key that something below them was asked for. */
void CaseTreeMark(CaseNode *root, const char *key);
/* The deepest node on the way to key that exists: root at the least. */
const CaseNode *CaseTreeNearest(const CaseNode *root, const char *key);
/* Applies one `key=value`; false with a problem when it cannot be. */
bool CaseTreeSet(CaseNode *root, const char *argument, char problem[]);

/* Number of single-letter edits (insert, delete, replace, swap of neighbours) between two words, at most
 * `limit` + 1. */
int CaseEditDistance(const char *a, const char *b, int limit);
/* Whether b is a plausible misspelling of a. */
bool CaseSimilar(const char *a, const char *b);

/* As CoracleCaseOpen, but returns 1 with a message instead of failing (the start of a job reports once for all
 * ranks). */
int CaseLoad(int argc, char **argv, char problem[], CoracleCase *c);
#endif
