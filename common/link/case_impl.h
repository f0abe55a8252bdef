/* Private to the case file: the tree that a YAML text becomes, and the dotted paths into it.  Nothing here
 * prints or ends a run: what goes wrong is written into a buffer and reported by the caller. */
#ifndef CORACLE_CASE_IMPL_H
#define CORACLE_CASE_IMPL_H
#include "common/link/case_file.h"
#include "common/link/case_key.h"
#include <setjmp.h>
#include <stddef.h>

enum { CASE_NAME = 128, CASE_MESSAGE = 1024, CASE_FAULTS = 64, CASE_TABLES = 8, CASE_NODES = 1000000 };

typedef enum { NODE_SCALAR, NODE_LIST, NODE_MAP } CaseKind;

typedef struct CaseNode_s {
  CaseKind kind;
  char *key;       /* name within the parent map, else NULL */
  char *text;      /* of a scalar */
  bool quoted;     /* '3' and "3" are strings, 3 is a number */
  bool read;       /* some reader has asked for this value */
  bool below;      /* or for a key below it */
  bool file;       /* as the name of a file */
  int line;        /* in the file, from 1 */
  const char *set; /* borrowed: the --set argument that the value comes from, or NULL */
  int n, capacity;
  struct CaseNode_s **child; /* [n] in file order */
  int nslots, *slot;         /* of a large map: hashed places of names in child, -1: empty */
} CaseNode;

/* One value as its reader described it, for the reference of keys. */
typedef struct {
  char *key;                                                  /* as asked for: solid.bodies[0].radius */
  char type[CASE_NAME], range[CASE_KEY], fallback[CASE_NAME]; /* fallback "": there is none */
  bool required;
} CaseReading;

/* The faults of a case that is checked (CoracleCaseCheck): where each is, and the way back to the check's loop. */
typedef struct {
  jmp_buf next;
  int n;
  /* A key was refused again although its value had been set aside, or a file, on which others depend. */
  bool stuck;
  char *key[CASE_FAULTS], *message[CASE_FAULTS];
} CaseFaults;

struct CoracleCase_s {
  char *path, *folder;
  CaseNode *root;
  unsigned long long file_hash, set_hash;
  int nasked, asked_capacity;
  char **asked; /* [nasked] every key that was asked for: what a misspelt key is compared with */
  int nslots;
  int *slot; /* [nslots] hashed places in asked, -1: empty */
  int nkept, kept_capacity;
  char **kept;  /* [nkept] what CoracleCaseFile and CoracleCaseTable handed out */
  bool listing; /* readings are kept, for CaseListKeys */
  int nreadings, readings_capacity;
  CaseReading *reading; /* [nreadings] */
  int nreading_slots;
  int *reading_slot; /* [nreading_slots] hashed places in reading, by key and type, -1: empty */
  int nopen, open_capacity;
  char **open; /* [nopen] maps whose names are the user's: materials, boundaries */
  int nopen_slots;
  int *open_slot; /* [nopen_slots] hashed places in open, -1: empty */
  int ntables;
  const CoracleCaseKey *table[CASE_TABLES]; /* borrowed: of CoracleCaseDescribe */
  CaseFaults *faults;                       /* borrowed; NULL: the first fault ends the run */
  void (*fail)(void *context, const char *message);
  void *context;
};

/* The tree of a YAML text; NULL when it is not valid, with problem[CASE_MESSAGE] = "label:line: why". */
CaseNode *CaseTreeParse(const char *text, size_t size, const char *label, char problem[]);
void CaseTreeDestroy(CaseNode **node);
/* A child becomes the parent's last, and is taken out of it again and destroyed. */
void CaseTreeAppend(CaseNode *parent, CaseNode *child);
void CaseTreeDrop(CaseNode *parent, CaseNode *child);
/* The child of a map, or NULL. */
CaseNode *CaseTreeChild(const CaseNode *map, const char *name);

/* case_path.c: takes the scalar at a dotted path out of its map, if it is there. */
void CaseTreeRemove(CaseNode *root, const char *key);
/* Whether it is one of names and indices: name.name[0].name. */
bool CasePathIsValid(const char *path);
/* The node at a dotted path, or NULL. */
CaseNode *CaseTreeFind(CaseNode *root, const char *key);
/* Says to all nodes above the key that something below them was asked for. */
void CaseTreeMark(CaseNode *root, const char *key);
/* The deepest node on the way to key that exists: root at the least. */
const CaseNode *CaseTreeNearest(const CaseNode *root, const char *key);
/* Applies one `key=value`; false with a problem when it cannot be. */
bool CaseTreeSet(CaseNode *root, const char *argument, char problem[]);

/* Ends the program over a wrong call: by the case's function, or, where c is NULL or has none, by abort. */
_Noreturn void CaseMisuse(CoracleCase c, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* To be called first by `function`: c must be open and the key one that a path can be. */
void CaseUse(CoracleCase c, const char *function, const char *key);
/* The error of a node (NULL: of the file) at a key: "<place>: <message>".  Does not return. */
_Noreturn void CaseDie(CoracleCase c, const CaseNode *node, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* The same with what is there in place of what was expected. */
_Noreturn void CaseUnexpected(CoracleCase c, const char *key, const CaseNode *node, const char *expected);
/* Whether a reader has asked for the key. */
bool CaseAsked(CoracleCase c, const char *key);
/* The value at a key that must be there; a scalar, which is read then, and of which any stands for one whose fault has
 * been found. */
CaseNode *CaseRequire(CoracleCase c, const char *key);
CaseNode *CaseRequireScalar(CoracleCase c, const char *key, const char *expected);
/* As CaseExcused, of a key that is asked for with this. */
bool CaseIsExcused(CoracleCase c, const char *key);
/* Whether the key is one of the faults that a check has found, so that its value does not matter. */
bool CaseExcused(CoracleCase c, const char *key);
/* The check's answer to a fault: remembers it and reads the case again.  Does not return. */
_Noreturn void CaseFault(CaseFaults *faults, const char *key, const char *message, bool last);
/* Sets aside the values at which a check has found faults. */
void CaseFaultsApply(CoracleCase c);
/* While keys are listed: remembers how a value was read, once a key. */
void CaseNote(CoracleCase c, const char *key, bool required, const char *type, const char *range,
              const char *fallback);
void CaseNoteMap(CoracleCase c, const char *key);
void CaseNotesFree(CoracleCase c);
/* One line a reading, as CoracleCaseKeysOf. */
void CaseListKeys(CoracleCase c, FILE *out);

/* Appends to a growing list of strings, which owns them. */
void CasePush(char ***list, int *n, int *capacity, char *string);

unsigned long long CaseFnv1a(unsigned long long hash, const char *bytes, size_t n);
#define CASE_FNV_START 14695981039346656037ULL

/* Number of single-letter edits (insert, delete, replace, swap of neighbours) between two words, at most
 * `limit` + 1. */
int CaseEditDistance(const char *a, const char *b, int limit);
/* Whether b is a plausible misspelling of a. */
bool CaseSimilar(const char *a, const char *b);

/* As CoracleCaseOpen, but returns 1 with a message instead of failing (the start of a job reports once for all
 * ranks). */
int CaseLoad(int argc, char **argv, char problem[], CoracleCase *c);
#endif
