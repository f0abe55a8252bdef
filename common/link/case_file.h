/* A case file: YAML, strict.  Every key that is read says its type, its default and its range here and now;
 * what nobody has read by the time of CoracleCaseFinish is an error, as are wrong types and impossible values.  An
 * error ends the job with "coracle <role>[rank]: error: file.yaml:12: key 'fluid.density': expected a number
 * > 0, found '-3'". All functions may be called by any rank; each rank reads the file itself.  A case is
 * parsed from argv: `program case.yaml [--set key=value]...`; a set replaces or adds the key (dotted path,
 * list items as name[0].key).
 *
 * A wrong call (a case that is not open, a key that no path can be, a default outside its range, nobody to call back) is an error
 * that names the function; where there is no case to tell it, it goes to stderr and the process aborts.
 *
 * The top-level sections are: case (name), note (what a reader of the results must know), gravity, time,
 * fluid, solid, coupler, output; resume (a checkpoint's folder, or `last`: that of output.folder, if there
 * is one), which the library reads.  A participant opens the whole file but must read only its sections:
 * CoracleCaseFinish checks the sections it names. */
#ifndef CORACLE_CASE_FILE_H
#define CORACLE_CASE_FILE_H
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#define CASE_NORETURN [[noreturn]]
#else
#define CASE_NORETURN _Noreturn
#endif
#include <stdio.h>

typedef struct CoracleCase_s *CoracleCase;

/* fail: called with the message when something is wrong; must not return. */
int CoracleCaseOpen(int argc, char **argv, void (*fail)(void *context, const char *message), void *context,
                    CoracleCase *c);
int CoracleCaseClose(CoracleCase *c);
const char *CoracleCasePath(CoracleCase c);
/* 64-bit FNV-1a hash of the file's bytes and of the sets: the same on all participants of a job. */
unsigned long long CoracleCaseHash(CoracleCase c);

/* keys are dotted paths: "fluid.boundaries.left", "solid.bodies[0].centre" */
bool CoracleCaseHas(CoracleCase c, const char *key);
/* Number of items of the list at key; 0 if absent. */
int CoracleCaseCount(CoracleCase c, const char *key);
/* Required number within [lower, upper] (HUGE_VAL for open ends; `open` makes lower exclusive). */
double CoracleCaseNumber(CoracleCase c, const char *key, double lower, double upper);
double CoracleCasePositive(CoracleCase c, const char *key); /* > 0 */
double CoracleCaseNumberOr(CoracleCase c, const char *key, double fallback, double lower, double upper);
int CoracleCaseIntegerOr(CoracleCase c, const char *key, int fallback, int lower, int upper);
bool CoracleCaseBoolOr(CoracleCase c, const char *key, bool fallback);
/* n numbers as a flow list: [0.0, -9.81] */
void CoracleCaseVector(CoracleCase c, const char *key, int n, double v[]);
bool CoracleCaseVectorOptional(CoracleCase c, const char *key, int n,
                               double v[]); /* false: absent, v untouched */
/* The rows of n numbers each of the list at key, [*nrows][n], whose first numbers rise; NULL: absent.  Borrowed until CoracleCaseClose. */
const double *CoracleCaseTable(CoracleCase c, const char *key, int n, int *nrows);
/* Borrowed until CoracleCaseClose.  A relative path is resolved by CoracleCaseFile against the case file's folder. */
const char *CoracleCaseString(CoracleCase c, const char *key);
const char *CoracleCaseStringOr(CoracleCase c, const char *key, const char *fallback);
const char *CoracleCaseFile(CoracleCase c, const char *key);
/* One of the words in the null-terminated list; returns its index.  fallback < 0: required. */
int CoracleCaseWord(CoracleCase c, const char *key, int fallback, const char *const words[]);
/* Calls f(context, name) for each key of the map at key, in file order (names borrowed). */
int CoracleCaseKeys(CoracleCase c, const char *key, void (*f)(void *context, const char *name),
                    void *context);
/* The error of a value that was read well but cannot be: names file, line and key. */
CASE_NORETURN void CoracleCaseRefuse(CoracleCase c, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* A key that was called `old` in earlier versions: refused where it is found, with its name of today. */
void CoracleCaseRenamed(CoracleCase c, const char *old, const char *new_name);
/* Refuses the keys of the null-terminated list in a map (its path) that has `name`, too. */
void CoracleCaseNotBeside(CoracleCase c, const char *map, const char *name, const char *const others[]);
/* Checks that every key under the sections (null-terminated list) has been read, and that no unknown
 * top-level section exists. */
int CoracleCaseFinish(CoracleCase c, const char *const sections[]);

/* --- all of a case at once: its faults, its keys -------------------------------------------------------- */

/* What no call that reads a key can say of it: its unit ("" for none) and its meaning.  Items of lists are written
 * "solid.bodies[].radius", names that are the user's "solid.materials.*.density".  Type, range and default are said by
 * the calls that read the key. */
typedef struct {
  const char *key, *unit, *meaning;
} CoracleCaseKey;
/* table ends with a NULL key; borrowed until CoracleCaseClose. */
void CoracleCaseDescribe(CoracleCase c, const CoracleCaseKey table[]);

/* Reads a case from its first key to CoracleCaseFinish. */
typedef void (*CoracleCaseReader)(CoracleCase c, void *context);
/* Finds all faults of a case and calls tell for each; returns their number.  read is called once more than there are
 * faults, each time without those found before (a key's default holds, or something within its range), and is left by
 * longjmp at the next: it must make nothing that may not be left behind.  For one process. */
int CoracleCaseCheck(int argc, char **argv, CoracleCaseReader read, void *context,
                     void (*tell)(void *context, const char *message));
/* Within read: whether no fault has been found (so far). */
bool CoracleCaseFaultless(CoracleCase c);
/* Prints a line for each key that read asks for, fields separated by tabs: key, required or optional, type, range,
 * default, unit, meaning. */
int CoracleCaseKeysOf(int argc, char **argv, CoracleCaseReader read, void *context,
                      void (*fail)(void *context, const char *message), FILE *out);

#ifdef __cplusplus
}
#endif
#endif
