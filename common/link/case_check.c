/* All faults of a case at once: it is read again and again, each time without what was wrong before. */
#include "common/link/case_impl.h"
#include <stdlib.h>
#include <string.h>

void CaseFault(CaseFaults *faults, const char *key, const char *message, bool last)
{
  faults->stuck = faults->n == CASE_FAULTS;
  for (int i = 0; i < faults->n; i++) faults->stuck = faults->stuck || !strcmp(faults->key[i], key);
  if (!faults->stuck) {
    faults->key[faults->n] = strdup(key);
    faults->message[faults->n++] = strdup(message);
  }
  faults->stuck |= last;
  longjmp(faults->next, 1);
}

bool CaseExcused(CoracleCase c, const char *key)
{
  for (int i = 0; c->faults && i < c->faults->n; i++)
    if (!strcmp(c->faults->key[i], key)) return true;
  return false;
}

/* A scalar of a map goes, so that its default holds; lists and maps stay, for what is below them. */
void CaseFaultsApply(CoracleCase c)
{
  for (int i = 0; i < c->faults->n; i++) CaseTreeRemove(c->root, c->faults->key[i]);
}

bool CoracleCaseFaultless(CoracleCase c)
{
  if (!c) CaseMisuse(NULL, "CoracleCaseFaultless: the case is not open");
  return !c->faults || c->faults->n == 0;
}

/* One reading: true when it went through. */
static bool ReadOnce(int argc, char **argv, CoracleCaseReader read, void *context, CaseFaults *faults)
{
  static CoracleCase c; /* static: they outlive the jump */
  static char problem[CASE_MESSAGE];
  c = NULL;
  if (setjmp(faults->next)) {
    CoracleCaseClose(&c);
    return false;
  }
  if (CaseLoad(argc, argv, problem, &c)) CaseFault(faults, "", problem, false);
  c->faults = faults;
  CaseFaultsApply(c);
  read(c, context);
  c->faults = NULL;
  CoracleCaseClose(&c);
  return true;
}

/* Whether fault i is that of a list or a map in which a fault has been found before: what is said of it then may come from that. */
static bool Follows(const CaseFaults *faults, int i)
{
  const size_t length = strlen(faults->key[i]);
  for (int k = 0; k < i && length > 0; k++) {
    const char *rest = faults->key[k] + length;
    if (!strncmp(faults->key[k], faults->key[i], length) && (*rest == '.' || *rest == '[')) return true;
  }
  return false;
}

int CoracleCaseCheck(int argc, char **argv, CoracleCaseReader read, void *context,
                     void (*tell)(void *context, const char *message))
{
  static CaseFaults faults;
  if (!read || !tell)
    CaseMisuse(NULL, "CoracleCaseCheck: there must be a function that reads and one that is told");
  faults.n = 0;
  faults.stuck = false;
  while (!ReadOnce(argc, argv, read, context, &faults) && !faults.stuck) {
  }
  int nfaults = 0;
  for (int i = 0; i < faults.n; i++) {
    if (!Follows(&faults, i)) {
      tell(context, faults.message[i]);
      nfaults++;
    }
    free(faults.message[i]);
  }
  if (faults.stuck && faults.key[0][0]) tell(context, "(the rest can be checked when these are right)");
  for (int i = 0; i < faults.n; i++) free(faults.key[i]);
  return nfaults;
}

int CoracleCaseKeysOf(int argc, char **argv, CoracleCaseReader read, void *context,
                      void (*fail)(void *context, const char *message), FILE *out)
{
  CoracleCase c;
  if (!read || !out)
    CaseMisuse(NULL, "CoracleCaseKeysOf: there must be a function that reads and a file to print to");
  CoracleCaseOpen(argc, argv, fail, context, &c);
  c->listing = true;
  read(c, context);
  CaseListKeys(c, out);
  CoracleCaseClose(&c);
  return 0;
}
