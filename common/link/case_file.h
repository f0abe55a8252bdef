/* A case file: YAML, strict.  Every key that is read says its type, its default and its range here and now;
 * what nobody has read by the time of CaseFinish is an error, as are wrong types and impossible values.  An
 * error ends the job with "coracle <role>[rank]: error: file.yaml:12: key 'fluid.density': expected a number
 * > 0, found '-3'". All functions may be called by any rank; each rank reads the file itself.  A case is
 * parsed from argv: `program case.yaml [--set key=value]...`; a set replaces or adds the key (dotted path,
 * list items as name[0].key).
 *
 * The top-level sections are: case (name), note (what a reader of the results must know), gravity, time,
 * fluid, solid, coupler, output; resume (a checkpoint's folder, or `last`: that of output.folder, if there
 * is one), which the library reads.  A participant opens the whole file but must read only its sections:
 * CaseFinish checks the sections it names. */
#ifndef CORACLE_CASE_FILE_H
#define CORACLE_CASE_FILE_H
#include <stdbool.h>
#include <stdio.h>

typedef struct Case_s *Case;

/* fail: called with the message when something is wrong; must not return. */
int CaseOpen(int argc, char **argv, void (*fail)(void *context, const char *message), void *context, Case *c);
int CaseClose(Case *c);
const char *CasePath(Case c);
/* 64-bit FNV-1a hash of the file's bytes and of the sets: the same on all participants of a job. */
unsigned long long CaseHash(Case c);

/* keys are dotted paths: "fluid.boundaries.left", "solid.bodies[0].centre" */
bool CaseHas(Case c, const char *key);
/* Number of items of the list at key; 0 if absent. */
int CaseCount(Case c, const char *key);
/* Required number within [lower, upper] (HUGE_VAL for open ends; `open` makes lower exclusive). */
double CaseNumber(Case c, const char *key, double lower, double upper);
double CasePositive(Case c, const char *key); /* > 0 */
double CaseNumberOr(Case c, const char *key, double fallback, double lower, double upper);
int CaseIntegerOr(Case c, const char *key, int fallback, int lower, int upper);
bool CaseBoolOr(Case c, const char *key, bool fallback);
/* n numbers as a flow list: [0.0, -9.81] */
void CaseVector(Case c, const char *key, int n, double v[]);
bool CaseVectorOptional(Case c, const char *key, int n, double v[]); /* false: absent, v untouched */
/* Borrowed until CaseClose.  A relative path is resolved by CaseFile against the case file's folder. */
const char *CaseString(Case c, const char *key);
const char *CaseStringOr(Case c, const char *key, const char *fallback);
const char *CaseFile(Case c, const char *key);
/* One of the words in the null-terminated list; returns its index.  fallback < 0: required. */
int CaseWord(Case c, const char *key, int fallback, const char *const words[]);
/* Calls f(context, name) for each key of the map at key, in file order (names borrowed). */
int CaseKeys(Case c, const char *key, void (*f)(void *context, const char *name), void *context);
/* The error of a value that was read well but cannot be: names file, line and key. */
_Noreturn void CaseRefuse(Case c, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* A key that was called `old` in earlier versions: refused where it is found, with its name of today. */
void CaseRenamed(Case c, const char *old, const char *new_name);
/* Checks that every key under the sections (null-terminated list) has been read, and that no unknown
 * top-level section exists. */
int CaseFinish(Case c, const char *const sections[]);

/* --- all of a case at once: its faults, its keys -------------------------------------------------------- */

/* What no call that reads a key can say of it: its unit ("" for none) and its meaning.  Items of lists are written
 * "solid.bodies[].radius", names that are the user's "solid.materials.*.density".  Type, range and default are said by
 * the calls that read the key. */
typedef struct {
  const char *key, *unit, *meaning;
} CaseKey;
/* table ends with a NULL key; borrowed until CaseClose. */
void CaseDescribe(Case c, const CaseKey table[]);

/* Reads a case from its first key to CaseFinish. */
typedef void (*CaseReader)(Case c, void *context);
/* Finds all faults of a case and calls tell for each; returns their number.  read is called once more than there are
 * faults, each time without those found before (a key's default holds, or something within its range), and is left by
 * longjmp at the next: it must make nothing that may not be left behind.  For one process. */
int CaseCheck(int argc, char **argv, CaseReader read, void *context,
              void (*tell)(void *context, const char *message));
/* Within read: whether no fault has been found (so far). */
bool CaseFaultless(Case c);
/* Prints a line for each key that read asks for, fields separated by tabs: key, required or optional, type, range,
 * default, unit, meaning. */
int CaseKeysOf(int argc, char **argv, CaseReader read, void *context,
               void (*fail)(void *context, const char *message), FILE *out);
#endif
